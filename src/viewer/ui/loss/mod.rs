//! Tab *Loss*: settings and results of the loss, and training runs.

pub mod panel;
pub mod results;
pub mod training;
