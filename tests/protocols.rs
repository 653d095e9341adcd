//! Protocols: those that are built in, and files.

use std::fs;

use tempfile::TempDir;

use svbrdf_core::loss::LossOptions;
use svbrdf_evaluate::protocols::Protocol;

#[test]
fn built_in_protocols_say_where_they_are_from_and_are_in_the_docs() {
    let docs = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/protocols.md")).unwrap();
    for name in Protocol::names() {
        let protocol = Protocol::read(name).unwrap();
        assert_eq!(protocol.name, name);
        let source = &protocol.source;
        assert!([&source.paper, &source.code, &source.follows].iter().all(|said| !said.is_empty()), "{name}");
        assert!(protocol.options(&LossOptions::default()).unwrap().request().is_ok(), "{name}");
        assert!(docs.contains(&format!("| `{name}` |")), "{name}");
    }
}

#[test]
fn a_file_is_a_protocol_and_what_it_says_wrong_is_named() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("ours.toml");
    let whole = r#"
version = 1
name = "ours"
about = "RMSE of roughness"
registration = ["centre-crop"]
[source]
paper = "ours"
[predictions]
read = "albedo=gamma2.2"
roughness = [0.9, 0.1]
[scenes]
near = 6
distant = 3
[[metrics]]
metric = "rmse_roughness"
label = "R"
over_materials = "pooled"
"#;
    let read = |text: &str| {
        fs::write(&path, text).unwrap();
        Protocol::read(path.to_str().unwrap())
    };
    let protocol = read(whole).unwrap();
    assert_eq!(protocol.argument(), path.display().to_string());
    assert_eq!(protocol.metrics[0].summary(), "rmse_pooled_roughness");
    for (right, wrong, expected) in [
        ("version = 1", "version = 2", "expected 1"),
        ("about", "abut", "unknown field `abut`"),
        ("albedo=gamma2.2", "albdo=gamma2.2", "albedo, dielectric-f0"),
        ("centre-crop", "center-crop", "centre-crop"),
        ("\"rmse_roughness\"", "\"rmse_roughnes\"", "docs/metrics.md"),
        ("\"rmse_roughness\"", "\"l1_roughness\"", "only RMSE and PSNR are pooled"),
        ("pooled", "sum", "expected one of `mean`, `median`, `pooled`"),
        ("near = 6", "lights = \"flash\"", "near and distant, or lights"),
        ("near = 6\ndistant = 3", "lights = \"flash-10\"", "flash-9"),
        ("[scenes]\nnear = 6\ndistant = 3", "convention = \"print\"", "unknown field"),
        ("registration", "convention = \"print\"\nregistration", "single-image-2018"),
    ] {
        assert!(whole.contains(right), "{right}");
        let problem = read(&whole.replace(right, wrong)).unwrap_err().to_string();
        assert!(problem.contains(expected) && problem.contains("ours.toml"), "{wrong}: {problem}");
    }
    let unknown = Protocol::read("weyi").unwrap_err().to_string();
    assert!(unknown.contains("weiyi") && unknown.contains("stanford-orb"), "{unknown}");
}
