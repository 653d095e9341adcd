//! Session files in place of materials.

use std::path::Path;

use super::{assert_has, assert_refused, fail, folder, losses_as_json, succeed, text_of};

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
    write(at, r#"{"path": "gt.png"}, {"path": "a.png"}, {"path": "b.png", "read": {"roughness": "gloss"}}"#);
    let [of_session, as_found] = [SESSION, "gt.png a.png b.png --convention guided-2020"]
        .map(|materials| losses_as_json(at, &format!("{materials} --near 6"))["results"].clone());
    assert_eq!(of_session[0]["loss"], as_found[0]["loss"]);
    assert_ne!(of_session[1]["loss"], as_found[1]["loss"], "its options are not used");
    assert_refused(at, &[(&format!("loss {SESSION} a.png"), 64, "names its predictions itself")]);
    write(at, r#"{"path": "gt.png"}, {"path": "a.png"}"#);
    let of_files = |rest: &str| succeed(at, &format!("loss gt.png a.png --convention guided-2020 {rest}"));
    assert_eq!(succeed(at, &format!("loss {SESSION}")), of_files("--near 4 --distant 2"));
    assert_eq!(succeed(at, &format!("loss {SESSION} --seed 5")), of_files("--near 4 --distant 2 --seed 5"));
    assert_eq!(succeed(at, &format!("loss {SESSION} --near 3")), of_files("--near 3"));
    assert_ne!(of_files("--near 4 --distant 2"), of_files("--near 4 --distant 2 --seed 5"));
    write(at, r#"{"path": "gt.png"}"#);
    fail(at, &format!("loss {SESSION}"), 64);
    write(at, r#"{"path": "gt.png"}, {"path": "a.png"}"#);

    let scene = "--view 0,0.1,2 --exposure 1.5 --convention guided-2020 --light";
    for (of_session, rest) in [
        ("", "--show roughness --difference --range auto".to_owned()),
        ("--show rendering", format!("{scene} 0.5,0.5,1")),
        ("--show rendering --light 1,0,1", format!("{scene} 1,0,1")),
    ] {
        succeed(at, &format!("render {SESSION} -o one.png {of_session}"));
        succeed(at, &format!("render gt.png a.png -o two.png {rest}"));
        assert!(pixels(at, "one.png") == pixels(at, "two.png"), "{of_session}");
    }
    succeed(at, "render gt.png a.png -o usual.png");
    assert!(pixels(at, "usual.png") != pixels(at, "one.png"));
}

/// The commands that take a session, with what each needs beside it.
const COMMANDS: [&str; 10] = [
    "loss {}",
    "render {} -o x.png",
    "strip {} -o x.png",
    "rank {} --target-error 30%",
    "blame {} --scenes one.json",
    "scenes {}",
    "worst {}",
    "map {} --over lights --side 4 -o x.csv",
    "metrics {}",
    "photo photo.png {}",
];

#[test]
fn every_command_refuses_a_convention_and_loss_settings_that_do_not_exist_and_names_the_field() {
    let folder = folder();
    let at = folder.path();
    succeed(at, "render gt.png -o photo.png");
    write(at, r#"{"path": "gt.png"}, {"path": "a.png"}"#);
    let good = text_of(at, SESSION);
    let no_scenes = r#""ask": "File", "file": {"name": "a.json", "scenes": []}"#;
    let below = r#""ask": "File", "file": {"name": "a.json", "scenes": [
        {"kind": "near", "view": [0, 0, 1], "light": [0, 0, -1]}]}"#;
    let loss = r#""ask": "Scenes", "near": 4, "distant": 2"#;
    for (of, wrong, field, found) in [
        ("guided-2020", "guided-2120", "printed, single-image-2018", "guided-2120"),
        (loss, r#""ask": "Accuracy", "target_percent": -1"#, "window.loss.target_percent", "found -1"),
        (loss, r#""ask": "Scenes", "near": 4, "texels": {"sampled": 0}"#, "window.loss.texels", "found 0"),
        (loss, no_scenes, "window.loss.file.scenes", "found none"),
        (loss, below, "window.loss.file.scenes", "scene 0"),
    ] {
        let text = good.replace(of, wrong);
        assert_ne!(text, good);
        std::fs::write(at.join(SESSION), text).unwrap();
        for command in COMMANDS {
            assert_has(&fail(at, &command.replace("{}", SESSION), 1), &[SESSION, field, found]);
        }
    }
}

/// A session that can be opened once: a pipe, which is removed as soon as it has been opened.
#[cfg(unix)]
#[test]
fn every_command_opens_a_session_once() {
    use std::process::Command;

    let folder = folder();
    let at = folder.path();
    succeed(at, "render gt.png -o photo.png");
    write(at, r#"{"path": "gt.png"}, {"path": "a.png"}"#);
    let text = text_of(at, SESSION);
    std::fs::remove_file(at.join(SESSION)).unwrap();
    for command in COMMANDS {
        assert!(Command::new("mkfifo").arg(at.join(SESSION)).status().unwrap().success());
        let (pipe, text) = (at.join(SESSION), text.clone());
        let writer = std::thread::spawn(move || {
            let mut file = std::fs::File::options().write(true).open(&pipe).unwrap();
            std::fs::remove_file(&pipe).unwrap();
            std::io::Write::write_all(&mut file, text.as_bytes()).unwrap();
        });
        succeed(at, &command.replace("{}", SESSION));
        writer.join().unwrap();
    }
}
