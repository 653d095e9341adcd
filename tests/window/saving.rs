//! Saving the view, renderings, strips and sessions.

use svbrdf_core::picture::content::{ColouredDifference, PictureContent};
use svbrdf_files::read::NormalY;

use super::*;

#[needs(adapter)]
fn saved_renderings_are_what_is_selected() {
    let mut window = built_in();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("normals.png");
    edit(&mut window, |model| model.view.display.quantity = Quantity::Normal);
    edit(&mut window, |model| model.view.display.difference = true);
    edit(&mut window, |model| set_range(model, Some(20.0)));
    edit(&mut window, |model| model.view.set_exposure(3.0));
    save(&mut window, SaveKind::Renderings, &path);
    let got = image::open(&path).unwrap().to_rgb8();
    let materials: Vec<_> = window.materials().collect();
    let difference = ColouredDifference { kind: Difference::Angle, range: Some(20.0) };
    let shown = PictureContent { quantity: Quantity::Normal, difference: Some(difference) };
    let view = window.view();
    let pictures = shown.pictures(&materials, &view.scene, &view.convention(), 3.0, &Progress::default());
    let image = &pictures.unwrap().images[0];
    for (i, rgb) in image.pixels.iter().enumerate() {
        let (x, y) = (i % image.width, i / image.width);
        assert_eq!(got.get_pixel(x as u32, y as u32).0, shown.colour(*rgb, 0.0), "{x}, {y}");
    }
    assert!(image.pixels.iter().any(|rgb| rgb[0] > 1.0), "the normals differ");
}

#[needs(adapter)]
fn a_saved_strip_is_that_of_the_session_and_has_the_rectangle_as_a_crop() {
    let mut window = built_in();
    let folder = tempfile::tempdir().unwrap();
    let [plain, cropped, session] =
        ["plain.png", "cropped.png", "a.svbrdf-session.json"].map(|name| folder.path().join(name));
    let rect = pane(&window, GROUND_TRUTH);
    drag_primary(&mut window, rect, vec2(0.7, 0.3), vec2(0.2, 0.8));
    save(&mut window, SaveKind::Strip, &plain);
    save(&mut window, SaveKind::Session, &session);
    let strip = |arguments: &[&Path]| {
        let path = folder.path().join("strip.png");
        let mut command = crate::surroundings::command(super::loss_panel::program());
        let output = command.arg("strip").args(arguments).arg("-o").arg(&path).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        image::open(path).unwrap()
    };
    assert!(strip(&[&session]) == image::open(&plain).unwrap());
    assert!(strip(&[]) != image::open(&plain).unwrap(), "a planted fault: another light");
    let region = Region { first: [40, 60], last: [71, 79] };
    edit(&mut window, |model| model.inspection.region = Some(region));
    save(&mut window, SaveKind::Strip, &cropped);
    let width = |path: &Path| image::open(path).unwrap().width();
    // 8 times as large, beside each of 6 cells of 256 pixels: with gaps.
    let gaps = f64::from(width(&cropped) - width(&plain)) / 6.0 - 256.0;
    assert!((4.0..20.0).contains(&gaps), "{gaps}");
    assert!(file_contains(&cropped, "40,60,32,20"));
}

/// Height of the caption of a saved view, in points.
const CAPTION: u32 = 20;

#[needs(adapter)]
fn the_saved_view_has_the_pixels_of_the_window_with_a_caption() {
    let mut window = built_in();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("view.png");
    wait(&mut window, "the losses", |app| app.losses().is_some());
    edit(&mut window, |model| display::zoom(model, 2.0, [0.2, 0.1]));
    save(&mut window, SaveKind::View, &path);
    window.run_steps(8);
    let whole = image::open(&path).unwrap().to_rgb8();
    let [width, height] = window.model().geometry.picture;
    assert_eq!([whole.width(), whole.height()], [width, height + CAPTION]);
    let caption = image::imageops::crop_imm(&whole, 0, height, width, CAPTION).to_image();
    assert!(caption.pixels().filter(|pixel| pixel.0[0] > 90).count() > 300, "no caption");
    let top = pane(&window, GROUND_TRUTH).top() - 24.0;
    let rect = egui::Rect::from_min_size(egui::pos2(0.0, top), vec2(width as f32, height as f32));
    let seen = pixels(&mut window, rect);
    let seen = opaque(&window, seen);
    let far = |(a, b): (&image::Rgb<u8>, &image::Rgb<u8>)| (0..3).any(|c| a.0[c].abs_diff(b.0[c]) > 8);
    let different = whole.pixels().zip(seen.pixels()).filter(|pair| far(*pair)).count();
    assert!(different * 100 < (width * height) as usize, "{different} pixels differ");
    assert!(file_contains(&path, "svbrdf:shows"));
}

#[needs(adapter)]
fn the_saved_view_of_a_narrow_window_has_the_statistics() {
    let mut window = with_differences();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("view.png");
    window.set_size(vec2(640.0, 500.0));
    window.run_steps(4);
    save(&mut window, SaveKind::View, &path);
    let whole = image::open(&path).unwrap().to_rgb8();
    assert_eq!(whole.width(), 640);
    // Over the whole width were the colours of the range.
    let is_coloured = |x: u32| {
        (whole.height() - CAPTION - 92..whole.height() - CAPTION).any(|y| {
            let [r, g, b] = whole.get_pixel(x, y).0;
            r.max(g).max(b) - r.min(g).min(b) > 60
        })
    };
    assert!((200..220).any(is_coloured) && !(560..636).any(is_coloured));
}

#[needs(adapter)]
fn a_session_opens_as_it_was_saved_and_so_does_the_last_one() {
    let folder = tempfile::tempdir().unwrap();
    let mut first = on_files(strips(folder.path(), ["gt.png", "p.png"]));
    let read = ReadOptions { normal_y: Some(NormalY::Down), ..ReadOptions::AUTO };
    edit(&mut first, |model| opening::read_as(model, 1, read));
    wait(&mut first, "the other assumption", |app| !app.is_reading());
    edit(&mut first, |model| model.use_convention(ChosenConvention::read("guided-2020").unwrap()));
    edit(&mut first, |model| model.view.set_exposure(1.5));
    let model = &mut first.state_mut().parts.model;
    let display = &mut model.view.display;
    (display.layout, display.projection) = (Layout::Wipe, Projection::Perspective);
    display.quantity = Quantity::Normal;
    (model.view.scene.light, model.settings.loss.near) = ([0.1, -0.7, 1.3], 17);
    let region = Some(Region { first: [2, 1], last: [5, 3] });
    let inspection = Inspection { pins: vec![[3, 2], [0, 0]], region, is_armed: false };
    first.state_mut().parts.model.inspection = inspection.clone();
    let path = folder.path().join("a.svbrdf-session.json");
    save(&mut first, SaveKind::Session, &path);
    let (state, materials) = (first.view().clone(), first.materials().cloned().collect::<Vec<_>>());

    let same = |window: &Window<'_>| {
        assert_eq!(*window.view(), state);
        assert_eq!(window.materials().cloned().collect::<Vec<_>>(), materials);
        assert_eq!(window.model().settings.loss.near, 17);
        assert_eq!(window.model().inspection, inspection);
    };
    same(&on_session(&path));
    let pictures = [
        (SaveKind::View, "view.png"),
        (SaveKind::Renderings, "maps.png"),
        (SaveKind::Renderings, "maps.exr"),
        (SaveKind::Strip, "strip.pdf"),
    ];
    for (kind, name) in pictures {
        let picture = folder.path().join(name);
        save(&mut first, kind, &picture);
        same(&on_session(&picture));
    }

    let mut later = built_in();
    assert!(later.messages().is_empty());
    open(&mut later, [folder.path().join("maps.exr")]);
    wait(&mut later, "the session", |app| app.names() == ["gt", "p"] && !app.is_reading());
    same(&later);
    later.run_steps(3);
    edit(&mut later, opening::open_built_in);
    wait(&mut later, "the built-in pair", |app| app.names().len() == 3 && !app.is_reading());
    edit(&mut later, |model| opening::reopen(model, 0));
    wait(&mut later, "the last materials", |app| app.names() == ["gt", "p"] && !app.is_reading());
    same(&later);

    let changed = folder.path().join("p.png");
    let mut bytes = std::fs::read(&changed).unwrap();
    bytes.push(0);
    std::fs::write(&changed, bytes).unwrap();
    let mut other = built_in();
    open(&mut other, [folder.path().join("view.png")]);
    wait(&mut other, "what has changed", |app| !app.messages().is_empty());
    let expected = format!("{} has changed since the picture was saved", changed.display());
    assert!(other.messages().contains(&expected), "{:?}", other.messages());
}

#[needs(adapter)]
fn an_error_in_saving_stays_in_the_dialog_with_its_text() {
    let mut window = built_in();
    click(&mut window, "Save");
    retype(&mut window, "no/such/folder/view.png");
    click(&mut window, "Save file");
    see(&mut window, "its folder does not exist");
    let field = window.get_by_role_and_label(Role::TextInput, "To file:");
    assert_eq!(field.value().as_deref(), Some("no/such/folder/view.png"));
    assert!(window.messages().is_empty());
}

#[needs(adapter)]
fn nothing_that_is_saved_replaces_a_map_a_photograph_or_a_scene_file() {
    let folder = tempfile::tempdir().unwrap();
    let [gt, p] = strips(folder.path(), ["gt.png", "p.png"]);
    let scenes = folder.path().join("scenes.json");
    let text = r#"{"scenes": [{"kind": "near", "view": [0, 0, 2], "light": [0.1, 0, 2]}]}"#;
    std::fs::write(&scenes, text).unwrap();
    let mut window = window(ViewerOptions {
        scenes: Some(svbrdf_files::scene_file::read_named(&scenes).unwrap()),
        ..options_of([gt.clone(), p.clone()])
    });
    let all = [gt, p, scenes];
    let bytes = || all.each_ref().map(|path| std::fs::read(path).unwrap());
    let before = bytes();
    for (number, kind) in [SaveKind::View, SaveKind::Strip, SaveKind::Scenes].into_iter().enumerate() {
        let path = all[number].clone();
        edit(&mut window, |model| model.effects.push(Effect::Save(SaveRequest { kind, path })));
        wait(&mut window, "the refusal", |app| app.messages().len() > number);
        let message = window.messages().last().unwrap().clone();
        assert!(message.contains("which the result is made from"), "{message}");
    }
    assert!(before == bytes(), "a file was replaced");
}
