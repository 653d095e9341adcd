//! What is said once and kept with the material.

use super::*;

#[test]
fn what_is_kept_holds_for_every_command_until_something_else_is_said() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    let said = succeed(folder.path(), "info a.png --roughness gloss --exemplar 0 --save");
    assert!(said.contains("roughness: gloss: as specified"), "{said}");
    let kept: Value = serde_json::from_str(&std::fs::read_to_string(of("a.svbrdf.json")).unwrap()).unwrap();
    assert_eq!(kept, json!({"roughness": "gloss", "exemplar": 0}));

    let read = succeed(folder.path(), "info a.png");
    assert!(read.contains("roughness: gloss: as a.svbrdf.json says"), "{read}");
    assert!(read.contains("a.svbrdf.json says how the material is read"), "{read}");
    assert_eq!(succeed(folder.path(), "info a.svbrdf.json"), read);
    let kept = succeed(folder.path(), "loss gt.png a.png --near 3 --distant 2");
    std::fs::copy(of("a.png"), of("c.png")).unwrap();
    let gloss = succeed(folder.path(), "loss gt.png c.png --near 3 --distant 2 --roughness r");
    assert_ne!(kept.replace("a ", "c "), gloss);
    RgbImage::from_pixel(8, 8, Rgb([99; 3])).save(of("r.png")).unwrap();
    // Kept again, what is said now is added; what is said otherwise is replaced.
    let again = "info a.png --roughness alpha --map roughness=r.png --grid 4x1 --save";
    assert!(succeed(folder.path(), again).contains("roughness: alpha: as specified"));
    let kept: Value = serde_json::from_str(&std::fs::read_to_string(of("a.svbrdf.json")).unwrap()).unwrap();
    assert_eq!(
        kept,
        json!({"roughness": "alpha", "exemplar": 0, "grid": "4x1", "maps": {"roughness": "r.png"}})
    );
}

#[test]
fn nothing_is_kept_of_what_is_refused() {
    let folder = folder();
    fail(folder.path(), "info a.png --grid 5x1 --save", 1);
    std::fs::write(folder.path().join("a.svbrdf.json"), r#"{"albdo": "srgb"}"#).unwrap();
    let message = fail(folder.path(), "info a.png", 1);
    assert!(message.contains("unknown key `albdo`"), "{message}");
    fail(folder.path(), "info a.png --save --albedo srgb", 1);
    assert!(std::fs::read_to_string(folder.path().join("a.svbrdf.json")).unwrap().contains("albdo"));
}
