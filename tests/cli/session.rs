//! Session files in place of materials.

use std::path::Path;

use super::{fail, folder, succeed};

const SESSION: &str = "s.svbrdf-session.json";

/// A session of these materials, with a light, an exposure, a convention and loss settings of its own.
fn write(folder: &Path, materials: &str) {
    let text = format!(
        r#"{{"svbrdf-session": 1, "materials": [{materials}], "convention": "guided-2020", "exposure": 1.5,
            "scene": {{"kind": "near", "view": [0, 0.1, 2], "light": [0.5, 0.5, 1]}},
            "window": {{"loss": {{"ask": "Scenes", "near": 4, "distant": 2}},
                        "view": {{"quantity": "Roughness", "difference": true}}}}}}"#
    );
    std::fs::write(folder.join(SESSION), text).unwrap();
}

fn pixels(folder: &Path, name: &str) -> image::RgbImage {
    image::open(folder.join(name)).unwrap().into_rgb8()
}

#[test]
fn a_command_takes_from_a_session_what_no_option_says() {
    let folder = folder();
    let at = folder.path();
    write(at, r#"{"path": "gt.png"}, {"path": "a.png"}"#);
    let of_files = |rest: &str| succeed(at, &format!("loss gt.png a.png --convention guided-2020 {rest}"));
    assert_eq!(succeed(at, &format!("loss {SESSION}")), of_files("--near 4 --distant 2"));
    assert_eq!(succeed(at, &format!("loss {SESSION} --seed 5")), of_files("--near 4 --distant 2 --seed 5"));
    assert_eq!(succeed(at, &format!("loss {SESSION} --near 3")), of_files("--near 3"));
    assert_ne!(of_files("--near 4 --distant 2"), of_files("--near 4 --distant 2 --seed 5"));

    let scene = "--view 0,0.1,2 --exposure 1.5 --convention guided-2020";
    for (of_session, rest) in [
        ("", "--show roughness --difference --range auto"),
        ("--show rendering", ""),
        ("--show rendering --light 1,0,1", "--light 1,0,1"),
    ] {
        // An option is given once.
        let light = if rest.contains("--light") { "" } else { "--light 0.5,0.5,1" };
        succeed(at, &format!("render {SESSION} -o one.png {of_session}"));
        succeed(at, &format!("render gt.png a.png -o two.png {scene} {light} {rest}"));
        assert!(pixels(at, "one.png") == pixels(at, "two.png"), "{of_session}");
    }
    succeed(at, "render gt.png a.png -o usual.png");
    assert!(pixels(at, "usual.png") != pixels(at, "one.png"));
}

#[test]
fn a_session_without_a_prediction_has_no_loss() {
    let folder = folder();
    write(folder.path(), r#"{"path": "gt.png"}"#);
    fail(folder.path(), &format!("loss {SESSION}"), 64);
}
