//! Panels around the panes: the bars, light and view, the inspected texels, and the messages.

pub mod inspection;
pub mod light_and_view;
pub mod menu;
pub mod messages;
pub mod status;
pub mod top;
