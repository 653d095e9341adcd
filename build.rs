//! Tells the tests what is there: the reference numbers beside the checkout, a graphics driver, a display to test the
//! window on, the validators of formats. A test that needs what is not there is reported as ignored, with the reason. Tells the program its commit and target.

use std::env;
use std::path::Path;
use std::process::Command;

#[path = "build/adapter.rs"]
mod adapter;
#[path = "build/commit.rs"]
mod commit;

use adapter::set;

const GOLDEN: &str = "../shared/golden";

/// What the tests of the report run.
const BROWSERS: [&str; 2] = ["chromium", "chromium-browser"];

/// What the test of the real window runs.
const DESKTOP: [&str; 3] = ["Xvfb", "xdotool", "import"];

/// What the tests of written glTF and MaterialX ask, with the variable that tells where libraries are.
const VALIDATORS: [(&str, &str, [&str; 3]); 2] = [
    ("has_gltf_validator", "NODE_PATH", ["node", "-e", "require('gltf-validator')"]),
    ("has_materialx", "PYTHONPATH", ["python3", "-c", "import MaterialX"]),
];

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=build");

    let shared = Path::new(GOLDEN).is_dir();
    // Only where it is there: a missing path would rebuild the crate on every run.
    if shared {
        println!("cargo::rerun-if-changed={GOLDEN}");
    }
    set("has_shared", shared);

    adapter::tell_cargo();

    commit::tell_cargo();
    for name in ["TARGET", "PROFILE"] {
        println!("cargo::rustc-env=SVBRDF_{name}={}", env::var(name).unwrap_or_default());
    }

    let path = env::var_os("PATH").unwrap_or_default();
    let installed = |program: &&str| env::split_paths(&path).any(|folder| folder.join(program).is_file());
    set("has_desktop", DESKTOP.iter().all(installed));
    set("has_browser", BROWSERS.iter().any(installed));

    let runs = |[program, option, script]: [&str; 3]| {
        let output = Command::new(program).args([option, script]).output();
        output.is_ok_and(|output| output.status.success())
    };
    for (name, library, script) in VALIDATORS {
        println!("cargo::rerun-if-env-changed={library}");
        set(name, runs(script));
    }
}
