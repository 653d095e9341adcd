//! Tab *Loss*: settings and results of the loss, training runs, and the study.

pub mod panel;
pub mod results;
pub mod study;
pub mod training;
