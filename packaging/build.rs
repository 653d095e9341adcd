//! Tells the program its target, its profile and the commit that it is built from, for `svbrdf --version --verbose`.

use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

/// The commit that `cargo package` has written down.
const OF_PACKAGE: &str = ".cargo_vcs_info.json";

fn main() {
    println!("cargo::rerun-if-changed=packaging/build.rs");
    for name in ["TARGET", "PROFILE"] {
        println!("cargo::rustc-env=SVBRDF_{name}={}", env::var(name).unwrap_or_default());
    }
    // Debug builds would be built anew after every commit.
    if env::var("PROFILE").is_ok_and(|profile| profile == "release")
        && let Some(commit) = of_package().or_else(of_checkout)
    {
        println!("cargo::rustc-env=SVBRDF_COMMIT={commit}");
    }
}

#[allow(clippy::disallowed_methods, reason = "a build script reads its own package")]
fn of_package() -> Option<String> {
    let text = fs::read_to_string(OF_PACKAGE).ok()?;
    let (_, after) = text.split_once("\"sha1\"")?;
    after.split('"').nth(1).map(str::to_owned)
}

/// That of the checkout whose root this is; other repositories around it are none of it.
fn of_checkout() -> Option<String> {
    if !Path::new(".git").exists() {
        return None;
    }
    // Every commit and every checkout is a line of this log.
    println!("cargo::rerun-if-changed={}", git(&["rev-parse", "--git-path", "logs/HEAD"])?);
    git(&["rev-parse", "HEAD"])
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    let line = String::from_utf8(output.stdout).ok()?.trim().to_owned();
    (output.status.success() && !line.is_empty()).then_some(line)
}
