//! `#[needs(adapter, desktop)]` is a test, ignored with the reason where the machine lacks one of these; `has!(adapter)` tells.
//!
//! `build.rs` looks for them.

use proc_macro::TokenStream;

/// What the machine has, separated by spaces.
const FOUND: &str = env!("SVBRDF_TESTS_FOUND");

/// Each need, and what to install.
const NEEDS: [(&str, &str); 6] = [
    ("adapter", "a graphics adapter"),
    ("f32_adapter", "a graphics adapter that renders to 32-bit floats"),
    ("browser", "chromium"),
    ("desktop", "Xvfb, xdotool and import"),
    ("gltf_validator", "node and gltf-validator"),
    ("shared", "../shared"),
];

/// A test, ignored without one of the needs: in the place of `#[test]`.
#[proc_macro_attribute]
pub fn needs(names: TokenStream, test: TokenStream) -> TokenStream {
    let names = names.to_string();
    let missing = names.split(',').map(str::trim).find(|name| !found(name));
    let ignored = missing.map_or(String::new(), |name| format!("#[ignore = \"needs {}\"]", described(name)));
    format!("#[test]{ignored}").parse::<TokenStream>().into_iter().chain([test]).collect()
}

/// Whether the machine has it. No constant, which Clippy would not let a test assert.
#[proc_macro]
pub fn has(name: TokenStream) -> TokenStream {
    let found = found(&name.to_string());
    format!("std::hint::black_box({found})").parse().unwrap_or_default()
}

fn found(name: &str) -> bool {
    described(name);
    FOUND.split(' ').any(|found| found == name)
}

/// # Panics
/// Where there is no such need: the compiler prints it.
#[allow(clippy::panic, reason = "an error of the compiler")]
fn described(name: &str) -> &'static str {
    let known = NEEDS.iter().find(|(known, _)| *known == name);
    known.map_or_else(|| panic!("no need is called {name}: {NEEDS:?}"), |(_, described)| described)
}
