//! Nothing: only with a build script are the build dependencies resolved.

fn main() {}
