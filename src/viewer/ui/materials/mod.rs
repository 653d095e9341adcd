//! Tab *Files*: the materials, and what was assumed about each.

pub mod alone;
pub mod assumptions;
pub mod panel;
