//! Options that are saved in a sidecar file.

use super::*;

#[test]
fn saved_options_hold_for_every_command_until_others_are_specified() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    let report = succeed(folder.path(), "info a.png --read roughness=gloss --read exemplar=0 --save");
    assert_has(&report, &["roughness: gloss: as specified"]);
    let saved = || json(&text_of(folder.path(), "a.svbrdf.json"));
    assert_eq!(saved(), json!({"roughness": "gloss", "exemplar": 0}));

    let read = succeed(folder.path(), "info a.png");
    let parts =
        ["roughness: gloss: as saved in a.svbrdf.json", "a.svbrdf.json specifies how the material is read"];
    assert_has(&read, &parts);
    assert_eq!(succeed(folder.path(), "info a.svbrdf.json"), read);
    // The same material as with the option, and another one than without.
    std::fs::copy(of("a.png"), of("c.png")).unwrap();
    let loss = |args: &str| loss_of(folder.path(), &format!("gt.png {args} --near 2"));
    assert_eq!(loss("a.png"), loss("c.png --read c:roughness=gloss"));
    assert_ne!(loss("a.png"), loss("c.png"));
    assert_ne!(loss("a.png"), loss("a.png --read a:roughness=r"));
    RgbImage::from_pixel(8, 8, Rgb([99; 3])).save(of("r.png")).unwrap();
    // Saved again, new options are added and specified ones replaced.
    let again = "info a.png --read roughness=alpha --map roughness=r.png --read grid=4x1 --save";
    assert_has(&succeed(folder.path(), again), &["roughness: alpha: as specified"]);
    let maps = json!({"roughness": "r.png"});
    assert_eq!(saved(), json!({"roughness": "alpha", "exemplar": 0, "grid": "4x1", "maps": maps}));
}

#[test]
fn nothing_is_saved_of_options_that_are_refused() {
    let folder = folder();
    fail(folder.path(), "info a.png --read grid=5x1 --save", 1);
    std::fs::write(folder.path().join("a.svbrdf.json"), r#"{"albdo": "srgb"}"#).unwrap();
    assert_refused(folder.path(), &[("info a.png", 1, "unknown key `albdo`")]);
    fail(folder.path(), "info a.png --save --read albedo=srgb", 1);
    assert_has(&text_of(folder.path(), "a.svbrdf.json"), &["albdo"]);
}
