//! The verbose version: what of the machine a report of a fault needs.

use super::{assert_has, data_set, succeed};

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

#[test]
fn a_table_names_the_commit_that_the_program_is_built_from() {
    let folder = data_set(&[("ours", 20)], 1);
    let table = succeed(folder.path(), "rank --dataset gt ours --near 2 --distant 2 --format latex");
    let commit = option_env!("SVBRDF_COMMIT").map_or(String::new(), |commit| format!("+{commit:.12}"));
    let version = env!("CARGO_PKG_VERSION");
    assert_has(&table, &[&format!("repeat with svbrdf {version}{commit}: svbrdf rank --dataset gt ours")]);
}
