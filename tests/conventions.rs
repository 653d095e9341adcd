//! Conventions against the numbers of their authors' code.

mod losses;
mod peers;
mod sampling;
