//! Tab *Files*: the materials, and what was assumed about each.

pub mod panel;
