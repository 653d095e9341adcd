//! Graphics interfaces that `WGPU_BACKEND` allows.

use std::ffi::OsStr;

use svbrdf_core::error::Error;

/// The variable of wgpu, in which several are separated by commas.
const VARIABLE: &str = "WGPU_BACKEND";
/// The names that wgpu knows.
const KNOWN: [&str; 11] =
    ["vulkan", "vk", "metal", "mtl", "dx12", "d3d12", "opengl", "gles", "gl", "webgpu", "noop"];

/// Checks that `WGPU_BACKEND`, where it is set, names graphics interfaces: wgpu passes over what it does not know.
///
/// # Errors
/// [`Error::NoAdapter`], which says what the variable holds.
pub(super) fn check() -> Result<(), Error> {
    match std::env::var_os(VARIABLE) {
        Some(value) if !is_known(&value) => Err(Error::NoAdapter {
            problem: format!(
                "expected names of graphics interfaces in {VARIABLE}, found \"{}\"",
                value.display()
            ),
            remedy: "set it to vulkan, metal, dx12 or gl, several separated by commas, or unset it",
        }),
        _ => Ok(()),
    }
}

fn is_known(value: &OsStr) -> bool {
    let value = value.to_string_lossy().to_lowercase();
    value.split(',').all(|name| KNOWN.contains(&name.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_known_in_lists_and_in_any_case_and_what_wgpu_passes_over_is_not() {
        for known in ["vulkan", "Vulkan", "gl, vulkan", "vk,dx12,metal"] {
            assert!(is_known(OsStr::new(known)), "{known}");
            assert!(!wgpu::Backends::from_comma_list(known).is_empty(), "{known}");
        }
        for name in KNOWN {
            assert!(!wgpu::Backends::from_comma_list(name).is_empty(), "{name}");
        }
        for unknown in ["", " ", "vulcan", "vulkan,", "vulkan;gl", "gpu"] {
            assert!(!is_known(OsStr::new(unknown)), "{unknown}");
        }
    }
}
