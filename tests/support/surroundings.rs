//! Surroundings of the programs that tests start: their own variables, so that a desktop, a locale or a shell changes no result.

use std::ffi::OsStr;
use std::process::{Command, Stdio};

/// Variables of the machine that programs keep: where programs, libraries and temporary files are, the graphics driver, and the
/// coverage of the build.
const KEPT: [&str; 10] = [
    "PATH",
    "LD_LIBRARY_PATH",
    "TMPDIR",
    "SystemRoot",
    "TEMP",
    "LLVM_PROFILE_FILE",
    "WGPU_BACKEND",
    "WGPU_ADAPTER_NAME",
    "VK_ICD_FILENAMES",
    "VK_DRIVER_FILES",
];
/// Variables that programs get: a home without settings, no bus of a desktop, one language and time zone.
const MADE: [(&str, &str); 4] = [
    ("HOME", env!("CARGO_TARGET_TMPDIR")),
    ("XDG_RUNTIME_DIR", env!("CARGO_TARGET_TMPDIR")),
    ("LANG", "C.UTF-8"),
    ("TZ", "UTC"),
];

/// A program in these surroundings, without input.
pub fn command(program: impl AsRef<OsStr>) -> Command {
    let kept = KEPT.iter().filter_map(|name| Some((*name, std::env::var_os(name)?)));
    let mut command = Command::new(program);
    command.env_clear().envs(kept).envs(MADE).stdin(Stdio::null());
    command
}
