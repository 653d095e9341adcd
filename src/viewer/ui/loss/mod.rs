//! Tab *Loss*: settings and results of the loss.

pub mod panel;
pub mod results;
