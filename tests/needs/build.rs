//! Looks for what tests need: the reference numbers beside the checkout, a graphics driver, a display, a browser, a validator of
//! glTF.

use std::env;
use std::path::Path;
use std::process::Command;

mod adapter;

const SHARED: &str = "../../../shared/golden";

/// What the test of the real window runs.
const DESKTOP: [&str; 3] = ["Xvfb", "xdotool", "import"];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=adapter.rs");
    adapter::watch();
    let shared = Path::new(SHARED).is_dir();
    // Only where it is there: a missing path would rebuild the tests on every run.
    if shared {
        println!("cargo::rerun-if-changed={SHARED}");
    }
    let path = env::var_os("PATH").unwrap_or_default();
    let installed = |program: &&str| env::split_paths(&path).any(|folder| folder.join(program).is_file());
    // The variable tells where libraries are.
    println!("cargo::rerun-if-env-changed=NODE_PATH");
    let validator = Command::new("node").args(["-e", "require('gltf-validator')"]).output();
    let all = [
        ("shared", shared),
        ("adapter", adapter::is_there()),
        ("f32_adapter", adapter::renders_to_f32()),
        ("browser", ["chromium", "chromium-browser"].iter().any(installed)),
        ("desktop", DESKTOP.iter().all(installed)),
        ("gltf_validator", validator.is_ok_and(|output| output.status.success())),
    ];
    let found: Vec<_> = all.into_iter().filter_map(|(name, is_there)| is_there.then_some(name)).collect();
    println!("cargo::rustc-env=SVBRDF_TESTS_FOUND={}", found.join(" "));
}
