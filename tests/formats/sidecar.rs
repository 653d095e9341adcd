//! Sidecar files: options saved beside a material.

use svbrdf_files::read::{Binding, MaterialPath, Sidecar};

use super::*;

/// The strip N D R S with roughness as gloss, as `a.png` in a folder.
fn glossy() -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempdir().unwrap();
    let image = packed("NDRS", 4, |letter, v| if letter == 'R' { 1.0 - v } else { v });
    let path = save(folder.path(), "a.png", &image, ImageFormat::Png);
    (folder, path)
}

fn why<T>(read: &Read<T>, what: What) -> String {
    read.assumptions.iter().find(|a| a.what == what).map_or(String::new(), |a| a.why.to_string())
}

#[test]
fn what_is_kept_beside_a_file_holds_until_something_else_is_said() {
    let (folder, path) = glossy();
    std::fs::write(folder.path().join("a.svbrdf.json"), r#"{"roughness": "gloss"}"#).unwrap();
    for opened in [path.clone(), folder.path().join("a.svbrdf.json")] {
        let read = open(&opened);
        assert_same(&read, EIGHT_BITS);
        assert_eq!(read.material.name(), "a");
        assert_eq!(certainty(&read, What::Roughness), Some(Certainty::Given));
        assert_eq!(why(&read, What::Roughness), "as saved in a.svbrdf.json");
        assert!(read.files.iter().any(|file| file.ends_with("a.svbrdf.json")), "{:?}", read.files);
    }
    let other = open_as(&path, &ReadOptions { roughness: Some(Roughness::R), ..ReadOptions::AUTO });
    assert!(worst(&other.material) > 0.1);
    assert_eq!(why(&other, What::Roughness), "as specified");
    // A preset says it, too.
    let other = open_as(&path, &ReadOptions { preset: Some(Preset::Deschaintre), ..ReadOptions::AUTO });
    assert_eq!(
        (chosen(&other, What::Roughness), why(&other, What::Roughness).as_str()),
        ("r", "as specified")
    );
    let alone =
        MaterialPath::new(&path, &ReadOptions::AUTO).alone().read::<f64>(&Progress::default()).unwrap();
    assert!(worst(&alone.material) > 0.1);
    assert_eq!(alone.saved.roughness, Some(Roughness::Gloss));
}

#[test]
fn everything_that_can_be_said_can_be_kept() {
    let (folder, path) = glossy();
    let options = ReadOptions {
        preset: Some(Preset::Gao),
        albedo: Some(Albedo::Linear),
        specular: Some(Albedo::Gamma22),
        normal_y: Some(NormalY::Down),
        normal_encoding: Some("xy".parse().unwrap()),
        roughness: Some(Roughness::Gloss),
        workflow: Some("specular".parse().unwrap()),
        dielectric: Some("0.05".parse().unwrap()),
        energy: Some("unscaled".parse().unwrap()),
        order: Some(Order::NDRS),
        grid: Some("4x1".parse().unwrap()),
        exemplar: Some(1),
        flip_v: Some(true),
        non_finite: Some(NonFinite::Replace),
    };
    let text = |name: &str| format!("{name}={}", folder.path().join("a b.png").display());
    let bindings: Vec<Binding> = ["normal", "specular"].map(|map| (text(map) + ":r").parse().unwrap()).into();
    let kept = Sidecar { options, bindings };
    let place = kept.save(&path, &Progress::default()).unwrap();
    assert_eq!(Sidecar::load(&path).unwrap(), kept);
    let written = std::fs::read_to_string(place).unwrap();
    for line in
        [r#""dielectric-f0": 0.05"#, r#""grid": "4x1""#, r#""normal": "a b.png:r""#, r#""flip-v": true"#]
    {
        assert!(written.contains(line), "{line} is missing in {written}");
    }
    // The name of a map alone does not make it one.
    std::fs::copy(&path, folder.path().join("metal.png")).unwrap();
    assert!(Sidecar::path_for(&folder.path().join("metal.png")).ends_with("metal.svbrdf.json"));
    Sidecar::default().save(&path, &Progress::default()).unwrap();
    assert_eq!(std::fs::read_to_string(Sidecar::path_for(&path)).unwrap(), "{}\n");
    assert_eq!(Sidecar::load(&path).unwrap(), Sidecar::default());
}

#[test]
fn maps_can_be_kept_in_a_folder() {
    let folder = tempdir().unwrap();
    folder_of(["normal.png", "diffuse.png", "other.png", "specular.png"], folder.path(), |_, v| v);
    let kept = r#"{"albedo": "linear", "maps": {"roughness": "other.png:r"}}"#;
    std::fs::write(folder.path().join("svbrdf.json"), kept).unwrap();
    for opened in ["", "svbrdf.json", "normal.png"] {
        let read = open(&folder.path().join(opened));
        assert_same(&read, EIGHT_BITS);
        assert_notes(&read, &["other.png, as saved in svbrdf.json"]);
    }
    assert_eq!(Sidecar::path_for(&folder.path().join("normal.png")), folder.path().join("svbrdf.json"));
    assert_eq!(Sidecar::path_for(&folder.path().join("other.png")), folder.path().join("svbrdf.json"));
    let said = format!("roughness={}", folder.path().join("normal.png").display()).parse().unwrap();
    let bindings = [said];
    let path = MaterialPath::new(folder.path(), &ReadOptions::AUTO).bound(&bindings);
    let read = path.read::<f64>(&Progress::default()).unwrap();
    assert_notes(&read, &["normal.png, as specified"]);
}

#[test]
fn what_is_kept_in_a_folder_holds_for_each_of_its_files_without_a_sidecar_of_its_own() {
    let folder = tempdir().unwrap();
    let of = |name: &str| folder.path().join(name);
    let (_other, path) = glossy();
    // The one name is a word for a map; the folder is none of them.
    let names = ["metal.png", "wood.png", "normal.png", "own.png"];
    for name in names {
        std::fs::copy(&path, of(name)).unwrap();
    }
    std::fs::write(of("svbrdf.json"), r#"{"albedo": "log0.01", "maps": {"roughness": "missing.png"}}"#)
        .unwrap();
    std::fs::write(of("own.svbrdf.json"), r#"{"albedo": "srgb"}"#).unwrap();
    let loaded = names.map(|name| Sidecar::load(&of(name)).unwrap().options.albedo.unwrap().name());
    assert_eq!(loaded, ["log0.01", "log0.01", "log0.01", "srgb"]);
    let read = open(&of("wood.png"));
    assert_eq!(why(&read, What::Albedo), "as saved in svbrdf.json");
    assert_notes(&read, &["svbrdf.json specifies how"]);
    assert!(Sidecar::load(&of("wood.png")).unwrap().bindings.is_empty(), "maps are of the folder");
    // What is saved for one of them is its own.
    let saved = Sidecar::load(&of("wood.png")).unwrap().save(&of("wood.png"), &Progress::default()).unwrap();
    assert_eq!(saved, of("wood.svbrdf.json"));
}

#[test]
fn what_is_kept_for_a_prefix_is_beside_its_files() {
    let folder = tempdir().unwrap();
    folder_of(["w_normal.png", "w_diffuse.png", "w_gloss.png", "w_specular.png"], folder.path(), |_, v| v);
    std::fs::write(folder.path().join("w.svbrdf.json"), r#"{"roughness": "r", "albedo": "linear"}"#).unwrap();
    for opened in ["w", "w_", "w.svbrdf.json"] {
        let read = open(&folder.path().join(opened));
        assert_same(&read, EIGHT_BITS);
        assert_eq!(why(&read, What::Roughness), "as saved in w.svbrdf.json", "{opened}");
    }
}

#[test]
fn what_is_kept_wrongly_is_refused_with_its_place() {
    let (folder, path) = glossy();
    let place = folder.path().join("a.svbrdf.json");
    for (text, expected) in [
        ("", "the text ends within"),
        ("[]", "expected a map"),
        (r#"{"roughnes": "r"}"#, "unknown key `roughnes`"),
        (r#"{"roughness": "shiny"}"#, "roughness: unknown variant `shiny`, expected one of `r`, `gloss`"),
        (r#"{"exemplar": -1}"#, "exemplar: invalid value"),
        (r#"{"dielectric-f0": 4}"#, "dielectric-f0: unknown reflectance `4`"),
        (r#"{"grid": "4"}"#, "grid: unknown grid of tiles `4`"),
        (r#"{"maps": 3}"#, "expected an object after maps, found 3"),
        (r#"{"maps": {"bumps": "a.png"}}"#, "unknown map `bumps`"),
        (r#"{"maps": {"normal": 3}}"#, "normal: expected FILE or FILE:PART, found 3"),
    ] {
        std::fs::write(&place, text).unwrap();
        // With the known keys.
        assert_refused(&path, &["a.svbrdf.json does not specify how", expected, "dielectric-f0, energy"]);
    }
    std::fs::write(&place, r#"{"maps": {"normal": "none.png"}}"#).unwrap();
    assert_refused(&path, &["the normal map", "none.png does not exist"]);
    std::fs::write(&place, "{}").unwrap();
    save(folder.path(), "a.jpg", &packed("NDRS", 4, linear), ImageFormat::Jpeg);
    assert_refused(&place, &["expected one material beside it"]);
    assert_refused(&folder.path().join("b.svbrdf.json"), &["cannot read"]);
}
