//! Opening and saving.

use super::*;

#[needs(adapter)]
#[test]
fn the_window_starts_on_the_built_in_pair() {
    let mut window = built_in();
    assert_eq!(window.state().names(), ["worn tiles", "blurred normals", "wrong roughness"]);
    let rect = pane(&window, GROUND_TRUTH);
    let picture = pixels(&mut window, rect);
    let colours: std::collections::HashSet<_> = picture.pixels().map(|p| p.0).collect();
    assert!(colours.len() > 1000, "a rendering has many colours, this has {}", colours.len());
}

#[needs(adapter)]
#[test]
fn dropped_files_replace_the_built_in_pair() {
    let mut window = built_in();
    let assets = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../src/files/samples");
    let mut strips: Vec<_> = std::fs::read_dir(assets)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.ends_with("worn_tiles.png") || path.ends_with("blurred_normals.png"))
        .collect();
    strips.sort();
    assert_eq!(strips.len(), 2);
    window.input_mut().dropped_files =
        strips.into_iter().map(|path| std::sync::Arc::new(Dropped(path)) as _).collect();
    wait(&mut window, "the dropped files", |app| app.names().len() == 2);
    assert!(window.state().messages().is_empty(), "{:?}", window.state().messages());
}

#[needs(adapter)]
#[test]
fn a_file_that_is_not_there_is_an_error_in_the_window_and_keeps_what_was_open() {
    let mut window = built_in();
    window.get_by_label("Open").click();
    window.run_steps(4);
    let field = "Files, folders or name prefixes, one a line:";
    window
        .get_by_role_and_label(egui::accesskit::Role::MultilineTextInput, field)
        .type_text("no/such/brick.png");
    window.run_steps(3);
    window.get_by_label("Open these").click();
    wait(&mut window, "the end of reading", |app| !app.is_reading());
    assert_eq!(window.state().names().len(), 3);
    // The dialog stays open, with its text and the error.
    window.get_by_label_contains("cannot read no/such/brick.png");
    let text = window.get_by_role_and_label(egui::accesskit::Role::MultilineTextInput, field).value();
    assert_eq!(text.as_deref(), Some("no/such/brick.png"));
    window.get_by_label("Open these");
    assert!(window.state().messages().is_empty(), "it is said once: {:?}", window.state().messages());
}

#[needs(adapter)]
#[test]
fn the_saved_view_is_written_and_said_so() {
    let mut window = built_in();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("view.png");
    window.get_by_label("Save").click();
    window.run_steps(4);
    window.get_by_label("Renderings").click();
    window.run_steps(3);
    // The cursor is in the field whatever is saved, and Return saves it.
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.run_steps(2);
    window.event(egui::Event::Text(path.display().to_string()));
    window.run_steps(2);
    window.key_press(egui::Key::Enter);
    wait(&mut window, "the file", |app| !app.messages().is_empty());
    assert_eq!(window.state().messages(), [format!("Saved {}", path.display())]);
    let picture = image::open(&path).unwrap();
    assert_eq!((picture.width(), picture.height()), (3 * 256 + 2 * 4, 256));
}

#[needs(adapter)]
#[test]
fn what_was_said_already_is_not_said_twice() {
    let mut window = built_in();
    for _ in 0..2 {
        window.input_mut().dropped_files =
            vec![std::sync::Arc::new(Dropped("no/such/brick.png".into())) as _];
        window.run_steps(2);
        wait(&mut window, "the end of reading", |app| !app.is_reading());
    }
    let messages = window.state().messages();
    assert_eq!(messages.len(), 1, "{messages:?}");
}

#[needs(adapter)]
#[test]
fn a_file_is_replaced_only_by_a_person_who_knows() {
    let mut window = built_in();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("view.png");
    std::fs::write(&path, "precious").unwrap();
    window.get_by_label("Save").click();
    window.run_steps(4);
    // The field has the focus when the window opens.
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.run_steps(2);
    window.event(egui::Event::Text(path.display().to_string()));
    window.run_steps(2);
    window.key_press(egui::Key::Enter);
    window.run_steps(4);
    assert_eq!(std::fs::read(&path).unwrap(), b"precious");
    window.get_by_label("This file exists.");
    // Return presses the button now.
    window.key_press(egui::Key::Enter);
    wait(&mut window, "the file", |app| !app.messages().is_empty());
    assert!(image::open(&path).is_ok());
}

/// Two strips of the built-in ground truth, the second one a half as large.
fn two_sizes(folder: &std::path::Path) -> [std::path::PathBuf; 2] {
    let side = svbrdf_files::samples::generate::SIDE as u32;
    let pixels = svbrdf_files::samples::generate::pack(&svbrdf_files::samples::generate::ground_truth());
    let large = image::RgbImage::from_raw(4 * side, side, pixels).unwrap();
    let small = image::imageops::thumbnail(&large, 2 * side, side / 2);
    [("large.png", large), ("small.png", small)].map(|(name, picture)| {
        let path = folder.join(name);
        picture.save(&path).unwrap();
        path
    })
}

#[needs(adapter)]
#[test]
fn a_prediction_of_another_size_is_refused_or_resized_and_said() {
    let folder = tempfile::tempdir().unwrap();
    let [large, small] = two_sizes(folder.path());
    for fit in [false, true] {
        let options = ViewerOptions {
            ground_truth: Some(large.clone().into()),
            predictions: vec![small.clone().into()],
            fit,
            ..ViewerOptions::default()
        };
        let mut window = window(options);
        window.set_size(vec2(1200.0, 2000.0));
        wait(&mut window, "the end of reading", |app| !app.is_reading());
        if fit {
            assert_eq!(window.state().names(), ["large", "small"]);
            tab(&mut window, "Files");
            window.get_by_label("Resized from 128 x 128 to the 256 x 256 of the ground truth.");
            wait(&mut window, "the loss", |app| app.losses().is_some());
        } else {
            assert_eq!(window.state().names(), ["large"]);
            assert_eq!(window.state().messages().len(), 1, "{:?}", window.state().messages());
            window.get_by_label("Fit and open").click();
            wait(&mut window, "the fitted prediction", |app| app.names().len() == 2);
            assert!(window.state().messages().is_empty(), "{:?}", window.state().messages());
        }
    }
}

#[needs(adapter)]
#[test]
fn guesses_are_refused_where_the_window_was_told_to() {
    let folder = tempfile::tempdir().unwrap();
    let [large, _] = two_sizes(folder.path());
    let strip = image::open(large).unwrap();
    let side = strip.height();
    for map in 0..4 {
        // Numbers for names: that these are N, D, R and S is a guess.
        let path = folder.path().join(format!("map_{map}.png"));
        strip.crop_imm(map * side, 0, side, side).save(path).unwrap();
    }
    for strict in [false, true] {
        let ground_truth = Some(folder.path().join("map").into());
        let window = window(ViewerOptions { ground_truth, strict, ..ViewerOptions::default() });
        assert_eq!(window.state().names().len(), usize::from(!strict));
        let refused = window.state().messages().iter().any(|text| text.contains("ambiguous"));
        assert_eq!(refused, strict, "{:?}", window.state().messages());
    }
}

#[needs(adapter)]
#[test]
fn predictions_of_one_name_are_told_apart_by_their_folders() {
    let folder = tempfile::tempdir().unwrap();
    let [large, _] = two_sizes(folder.path());
    let predictions = ["run_a", "run_b"].map(|run| {
        std::fs::create_dir(folder.path().join(run)).unwrap();
        let path = folder.path().join(run).join("out.png");
        std::fs::copy(&large, &path).unwrap();
        path
    });
    let options = ViewerOptions {
        ground_truth: Some(large.into()),
        predictions: predictions.map(Into::into).to_vec(),
        ..ViewerOptions::default()
    };
    let mut window = window(options);
    wait(&mut window, "the loss", |app| app.losses().is_some());
    assert_eq!(window.state().names(), ["large", "run_a/out.png", "run_b/out.png"]);
    let losses = window.state().losses().unwrap().iter().map(|loss| loss.prediction.clone());
    assert_eq!(losses.collect::<Vec<_>>(), ["run_a/out.png", "run_b/out.png"]);
}
