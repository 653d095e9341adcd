//! Algorithm 3 on the graphics adapter.
