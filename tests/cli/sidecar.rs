//! Options that are saved in a sidecar file.

use svbrdf_core::progress::Progress;
use svbrdf_files::read::ReadOptions;

use super::*;

#[test]
fn saved_options_hold_for_every_command_until_others_are_specified() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    let report = succeed(folder.path(), "info a.png --read roughness=gloss --read exemplar=0 --save");
    assert!(report.contains("roughness: gloss: as specified"), "{report}");
    let saved: Value = serde_json::from_str(&std::fs::read_to_string(of("a.svbrdf.json")).unwrap()).unwrap();
    assert_eq!(saved, json!({"roughness": "gloss", "exemplar": 0}));

    let read = succeed(folder.path(), "info a.png");
    assert!(read.contains("roughness: gloss: as saved in a.svbrdf.json"), "{read}");
    assert!(read.contains("a.svbrdf.json specifies how the material is read"), "{read}");
    assert_eq!(succeed(folder.path(), "info a.svbrdf.json"), read);
    // The same material as with the option, and another one than without.
    std::fs::copy(of("a.png"), of("c.png")).unwrap();
    let converted = |args: &str| {
        let _ = std::fs::remove_file(of("out.exr"));
        succeed(folder.path(), &format!("convert {args} out.exr --depth float"));
        let read = svbrdf_files::read::read::<f32>(&of("out.exr"), &ReadOptions::AUTO, &Progress::default());
        read.unwrap().material.planes().clone()
    };
    let saved = converted("a.png");
    assert_eq!(saved, converted("c.png --read roughness=gloss"));
    assert_ne!(saved, converted("c.png"));
    assert_ne!(saved, converted("a.png --read roughness=r"));
    RgbImage::from_pixel(8, 8, Rgb([99; 3])).save(of("r.png")).unwrap();
    // Saved again, new options are added and specified ones replaced.
    let again = "info a.png --read roughness=alpha --map roughness=r.png --read grid=4x1 --save";
    assert!(succeed(folder.path(), again).contains("roughness: alpha: as specified"));
    let saved: Value = serde_json::from_str(&std::fs::read_to_string(of("a.svbrdf.json")).unwrap()).unwrap();
    assert_eq!(
        saved,
        json!({"roughness": "alpha", "exemplar": 0, "grid": "4x1", "maps": {"roughness": "r.png"}})
    );
}

#[test]
fn nothing_is_saved_of_options_that_are_refused() {
    let folder = folder();
    fail(folder.path(), "info a.png --read grid=5x1 --save", 1);
    std::fs::write(folder.path().join("a.svbrdf.json"), r#"{"albdo": "srgb"}"#).unwrap();
    let message = fail(folder.path(), "info a.png", 1);
    assert!(message.contains("unknown key `albdo`"), "{message}");
    fail(folder.path(), "info a.png --save --read albedo=srgb", 1);
    assert!(std::fs::read_to_string(folder.path().join("a.svbrdf.json")).unwrap().contains("albdo"));
}

#[test]
#[cfg(unix)]
fn options_are_not_saved_through_a_link() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    std::fs::write(of("elsewhere.json"), "a file of somebody").unwrap();
    std::os::unix::fs::symlink("elsewhere.json", of("a.svbrdf.json")).unwrap();
    let message = fail(folder.path(), "info a.png --read roughness=gloss --save", 1);
    assert!(message.contains("a.svbrdf.json"), "{message}");
    assert_eq!(std::fs::read_to_string(of("elsewhere.json")).unwrap(), "a file of somebody");
    std::fs::remove_file(of("elsewhere.json")).unwrap();
    // Nor where it points to nothing yet.
    let message = fail(folder.path(), "info a.png --read roughness=gloss --save", 1);
    assert!(
        message.contains("it is a link to elsewhere.json") && message.contains("remove the link"),
        "{message}"
    );
    assert!(!of("elsewhere.json").exists());
}

#[test]
fn a_byte_order_mark_before_json_changes_nothing() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    let commands =
        ["info a.png", "loss gt.png a.png --scenes one.json", "loss s.svbrdf-session.json --near 2"];
    let session = r#"{"svbrdf-session": 1, "materials": [{"path": "gt.png"}, {"path": "a.png"}], "convention": "printed",
        "scene": {"kind": "near", "view": [0, 0.1, 2], "light": [0.5, 0.5, 1]}}"#;
    let write = |mark: &str| {
        for (name, text) in
            [("a.svbrdf.json", r#"{"roughness": "gloss"}"#), ("s.svbrdf-session.json", session)]
        {
            std::fs::write(of(name), format!("{mark}{text}")).unwrap();
        }
        let scenes = std::fs::read_to_string(of("one.json")).unwrap();
        std::fs::write(of("one.json"), format!("{mark}{}", scenes.trim_start_matches('\u{feff}'))).unwrap();
        commands.map(|command| succeed(folder.path(), command))
    };
    let plain = write("");
    assert!(plain[0].contains("as saved in a.svbrdf.json"), "{}", plain[0]);
    assert_eq!(write("\u{feff}"), plain);
}
