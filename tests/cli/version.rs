//! The verbose version: what of the machine a report of a fault needs.

use super::succeed;

#[test]
fn the_verbose_version_names_the_build_the_instruction_set_and_the_adapter() {
    let text = succeed(std::path::Path::new("."), "--version --verbose");
    let value =
        |name: &str| text.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(": ")).unwrap();
    let (window, widest) = (cfg!(feature = "viewer"), svbrdf_core::render::simd::Level::best().name());
    assert_eq!(value("features"), if window { "viewer" } else { "none" });
    let processor = value("processor");
    assert!(processor.starts_with(&format!("{widest}, ")) && processor.ends_with(" threads"), "{text}");
    let adapter = value("adapter");
    assert_eq!(!window, adapter.ends_with("built without the window"), "{text}");
    assert!(!window || !svbrdf_needs::has!(adapter) || adapter.contains("driver "), "{text}");
}
