//! Opening and saving.

use super::materials::SIDE;
use super::*;

const FIELD: &str = "Files, folders or name prefixes, one a line:";

/// Files whose names steer terminals, shells, spreadsheets, patterns or the direction of writing.
#[cfg(unix)]
#[needs(adapter)]
fn hostile_names_of_dropped_files_are_lines_in_the_window_and_on_the_clipboard() {
    use std::os::unix::ffi::OsStrExt as _;
    const NAMES: [&[u8]; 7] = [
        b"\x1b]0;x\x07.png",
        b"a\nb.png",
        b"\xe2\x80\xaegnp.png",
        b"\xff\xfe.png",
        b"=cmd|' !A0.png",
        b"{}[a]*?.png",
        b"-o.png",
    ];
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &[u8]| folder.path().join(std::ffi::OsStr::from_bytes(name));
    for name in NAMES.iter().chain([&b"gt.png".as_slice()]) {
        write_packed(&path(name), 8, |tile, _, _| {
            [[128, 128, 255], [120; 3], [140; 3], [20; 3]][tile as usize]
        });
    }
    std::fs::write(path(b"\x1b[2J.png"), "no picture").unwrap();
    let mut window = window(options_of([path(b"gt.png")]));
    drop_files(&mut window, NAMES.map(path).into_iter().chain([path(b"\x1b[2J.png")]));
    wait(&mut window, "the materials", |app| app.names().len() == 8 && !app.messages().is_empty());
    see(&mut window, r"\u{1b}[2J.png");
    wait(&mut window, "the losses", |app| app.losses().is_some());
    window.get_by_label("Copy losses").click();
    let copied = commands(&mut window).into_iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text),
        _ => None,
    });
    let told = window.query_all_by_label_contains("").filter_map(|node| node.accesskit_node().label());
    let told: Vec<String> = told.chain(copied).collect();
    assert!(told.iter().any(|text| text.contains(r"\u{a}b")), "{told:?}");
    for text in told.iter().flat_map(|text| text.lines()) {
        assert!(!text.contains(|c: char| c.is_control() || c == '\u{202e}') && text != "b", "{text:?}");
    }
}

#[needs(adapter)]
fn a_file_that_is_not_there_is_an_error_in_the_dialog_and_keeps_what_was_open() {
    let mut window = built_in();
    click(&mut window, "Open");
    let text = |window: &Window<'_>| window.get_by_role_and_label(Role::MultilineTextInput, FIELD).value();
    let type_text = |window: &Window<'_>, text: &str| {
        window.get_by_role_and_label(Role::MultilineTextInput, FIELD).type_text(text);
    };
    type_text(&window, "no");
    // Shift and return begin a line, return opens, and letters are no commands.
    press_with(&mut window, Modifiers::SHIFT, egui::Key::Enter);
    let view = window.view().clone();
    type_text(&window, "such/mcex.png");
    press(&mut window, egui::Key::M);
    assert_eq!(*window.view(), view);
    assert_eq!(text(&window).as_deref(), Some("no\nsuch/mcex.png"));
    press(&mut window, egui::Key::Enter);
    wait(&mut window, "the end of reading", |app| !app.is_reading());
    assert_eq!(window.names().len(), 3);
    // The dialog stays open, with its text and the error.
    window.get_by_label_contains("cannot read no");
    assert_eq!(text(&window).as_deref(), Some("no\nsuch/mcex.png"));
    window.get_by_label("Open these");
    assert!(window.messages().is_empty(), "it is said once: {:?}", window.messages());
}

#[needs(adapter)]
fn a_file_is_replaced_only_by_a_person_who_knows() {
    let mut window = built_in();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("view.png");
    std::fs::write(&path, "precious").unwrap();
    click(&mut window, "Save");
    // The cursor is in the field whatever is saved, and return saves it.
    click(&mut window, "Renderings");
    retype(&mut window, path.to_str().unwrap());
    press(&mut window, egui::Key::Enter);
    assert_eq!(std::fs::read(&path).unwrap(), b"precious");
    window.get_by_label("This file exists.");
    // Return presses the button now.
    window.key_press(egui::Key::Enter);
    wait(&mut window, "the file", |app| !app.messages().is_empty());
    assert_eq!(image::image_dimensions(&path).unwrap(), (3 * 256 + 2 * 4, 256));
}

#[needs(adapter)]
fn a_prediction_of_another_size_is_refused_or_resized_and_said() {
    let folder = tempfile::tempdir().unwrap();
    let [large, small] = strips(folder.path(), ["large.png", "small.png"]);
    image::imageops::thumbnail(&strip(), 2 * SIDE, SIDE / 2).save(&small).unwrap();
    for fit in [false, true] {
        let mut window = window(ViewerOptions { fit, ..options_of([large.clone(), small.clone()]) });
        window.set_size(vec2(1200.0, 2000.0));
        wait(&mut window, "the end of reading", |app| !app.is_reading());
        if fit {
            assert_eq!(window.names(), ["large", "small"]);
            tab(&mut window, "Files");
            window.get_by_label("Resized from 128 x 128 to the 256 x 256 of the ground truth.");
            wait(&mut window, "the loss", |app| app.losses().is_some());
        } else {
            assert_eq!(window.names(), ["large"]);
            assert_eq!(window.messages().len(), 1, "{:?}", window.messages());
            click(&mut window, "Fit and open");
            wait(&mut window, "the fitted prediction", |app| app.names().len() == 2);
            assert!(window.messages().is_empty(), "{:?}", window.messages());
        }
    }
}

#[needs(adapter)]
fn guesses_are_refused_where_the_window_was_told_to() {
    let folder = tempfile::tempdir().unwrap();
    for map in 0..4 {
        // Numbers for names: that these are N, D, R and S is a guess.
        let path = folder.path().join(format!("map_{map}.png"));
        image::imageops::crop_imm(&strip(), map * SIDE, 0, SIDE, SIDE).to_image().save(path).unwrap();
    }
    for strict in [false, true] {
        let ground_truth = Some(folder.path().join("map").into());
        let window = window(ViewerOptions { ground_truth, strict, ..ViewerOptions::default() });
        assert_eq!(window.names().len(), usize::from(!strict));
        let refused = window.messages().iter().any(|text| text.contains("ambiguous"));
        assert_eq!(refused, strict, "{:?}", window.messages());
    }
}

/// A glTF file that names its picture by an absolute path, and the picture, elsewhere.
fn gltf(folder: &Path, elsewhere: &Path) -> (PathBuf, PathBuf) {
    let picture = elsewhere.join("albedo.png");
    image::RgbImage::from_pixel(256, 256, image::Rgb([90, 120, 150])).save(&picture).unwrap();
    let text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "images": [{{"uri": {:?}}}], "textures": [{{"source": 0}}],
            "materials": [{{"name": "wall", "pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0}}}}}}]}}"#,
        picture.to_str().unwrap()
    );
    let path = folder.join("wall.gltf");
    std::fs::write(&path, text).unwrap();
    (path, picture)
}

#[test]
#[ignore = "allows absolute paths in all of this process: run it alone, as `cargo test outside -- --ignored`"]
fn a_file_outside_is_not_read_before_the_window_has_asked_and_named_it() {
    let [folder, elsewhere] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let (file, picture) = gltf(folder.path(), elsewhere.path());
    let mut window = built_in();
    drop_files(&mut window, [file]);
    wait(&mut window, "the question", |app| !app.messages().is_empty());
    let message = window.messages().remove(0);
    assert!(message.contains(picture.to_str().unwrap()), "{message}");
    assert!(!window.names().contains(&"wall".to_owned()));
    window.get_by_label("Allow absolute paths").click();
    wait(&mut window, "the material", |app| app.names().iter().any(|name| name.contains("wall")));
    assert!(window.messages().is_empty(), "{:?}", window.messages());
}
