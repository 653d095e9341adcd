//! Looks for what tests need: the reference numbers beside the checkout, a graphics driver, a display, a browser, the validators of
//! formats.

use std::env;
use std::path::Path;
use std::process::Command;

mod adapter;

const SHARED: &str = "../../../shared/golden";

/// What the test of the real window runs.
const DESKTOP: [&str; 3] = ["Xvfb", "xdotool", "import"];

/// What the tests of written glTF and MaterialX ask, with the variable that tells where libraries are.
const VALIDATORS: [(&str, &str, [&str; 3]); 2] = [
    ("gltf_validator", "NODE_PATH", ["node", "-e", "require('gltf-validator')"]),
    ("materialx", "PYTHONPATH", ["python3", "-c", "import MaterialX"]),
];

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
    let mut all = vec![
        ("shared", shared),
        ("adapter", adapter::is_there()),
        ("f32_adapter", adapter::renders_to_f32()),
        ("browser", ["chromium", "chromium-browser"].iter().any(installed)),
        ("desktop", DESKTOP.iter().all(installed)),
    ];
    for (name, library, [program, option, script]) in VALIDATORS {
        println!("cargo::rerun-if-env-changed={library}");
        let output = Command::new(program).args([option, script]).output();
        all.push((name, output.is_ok_and(|output| output.status.success())));
    }
    let found: Vec<_> = all.into_iter().filter_map(|(name, is_there)| is_there.then_some(name)).collect();
    println!("cargo::rustc-env=SVBRDF_TESTS_FOUND={}", found.join(" "));
}
