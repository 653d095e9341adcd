//! Tells the tests whether the reference numbers beside the checkout are there, so that tests that need them are
//! reported as ignored where they are not.

use std::path::Path;

const GOLDEN: &str = "../shared/golden";

fn main() {
    println!("cargo::rustc-check-cfg=cfg(has_shared)");
    println!("cargo::rerun-if-changed=build.rs");
    // Only where it is there: a missing path would rebuild the crate on every run.
    if Path::new(GOLDEN).is_dir() {
        println!("cargo::rerun-if-changed={GOLDEN}");
        println!("cargo::rustc-cfg=has_shared");
    }
}
