//! Conventions against the numbers of their authors' code.

mod peers;
