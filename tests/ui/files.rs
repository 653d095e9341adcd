//! Opening and saving.

use super::*;

#[test]
fn the_window_starts_on_the_built_in_pair() {
    let Some(mut window) = built_in() else { return };
    assert_eq!(window.state().names(), ["worn tiles", "blurred normals", "wrong roughness"]);
    let rect = pane(&window, GROUND_TRUTH);
    let picture = pixels(&mut window, rect);
    let colours: std::collections::HashSet<_> = picture.pixels().map(|p| p.0).collect();
    assert!(colours.len() > 1000, "a rendering has many colours, this has {}", colours.len());
}

#[test]
fn dropped_files_replace_the_built_in_pair() {
    let Some(mut window) = built_in() else { return };
    let assets = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    let mut strips: Vec<_> = std::fs::read_dir(assets)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.to_string_lossy().contains("tiles") || path.to_string_lossy().contains("blurred"))
        .collect();
    strips.sort();
    assert_eq!(strips.len(), 2);
    window.input_mut().dropped_files =
        strips.into_iter().map(|path| std::sync::Arc::new(Dropped(path)) as _).collect();
    wait(&mut window, "the dropped files", |app| app.names().len() == 2);
    assert!(window.state().messages().is_empty(), "{:?}", window.state().messages());
}

#[test]
fn a_file_that_is_not_there_is_an_error_in_the_window_and_keeps_what_was_open() {
    let Some(mut window) = built_in() else { return };
    window.get_by_label("Open").click();
    window.run_steps(4);
    let field = "Files, folders or name prefixes, one a line:";
    window
        .get_by_role_and_label(egui::accesskit::Role::MultilineTextInput, field)
        .type_text("no/such/brick.png");
    window.run_steps(3);
    window.get_by_label("Open these").click();
    wait(&mut window, "the error", |app| !app.messages().is_empty());
    let message = window.state().messages()[0].clone();
    assert!(message.contains("no/such/brick.png"), "{message}");
    assert_eq!(window.state().names().len(), 3);
    window.get_by_label(&message);
    window.get_by_label("Dismiss").click();
    window.run_steps(3);
    assert!(window.state().messages().is_empty());
}

#[test]
fn the_saved_view_is_written_and_said_so() {
    let Some(mut window) = built_in() else { return };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("view.png");
    window.get_by_label("Save").click();
    window.run_steps(4);
    let label = "To file (.png as displayed, .exr as linear floats):";
    let field = || egui::accesskit::Role::TextInput;
    window.get_by_role_and_label(field(), label).focus();
    window.run_steps(2);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.run_steps(2);
    window.get_by_role_and_label(field(), label).type_text(&path.display().to_string());
    window.run_steps(2);
    window.get_by_label("Save picture").click();
    wait(&mut window, "the file", |app| !app.messages().is_empty());
    assert_eq!(window.state().messages(), [format!("Saved {}", path.display())]);
    let picture = image::open(&path).unwrap();
    assert_eq!((picture.width(), picture.height()), (3 * 256 + 2 * 4, 256));
}
