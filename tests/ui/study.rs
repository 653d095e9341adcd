//! The study window.

use super::*;
use crate::support::pictures::packed;

/// The window on two materials of 4 x 4 texels.
fn tiny<'a>(folder: &std::path::Path) -> Option<Window<'a>> {
    let write = |name: &str, brightness: f64| {
        let path = folder.join(name);
        let encode = |map, value| if map == 'D' { brightness * value } else { value };
        packed("NDRS", 4, encode).save(&path).unwrap();
        path
    };
    let options = ViewerOptions {
        ground_truth: Some(write("gt.png", 1.0)),
        predictions: vec![write("a.png", 0.5)],
        ..ViewerOptions::default()
    };
    window(options)
}

#[test]
fn a_click_on_a_point_of_the_study_sets_the_loss_to_it() {
    let folder = tempfile::tempdir().unwrap();
    let Some(mut window) = tiny(folder.path()) else { return };
    window.get_by_label("Study: time against error...").click();
    window.run_steps(3);
    window.get_by_label("Cancel study");
    wait(&mut window, "the study", |app| app.study().is_some_and(|(_, complete)| complete));
    let points = window.state().study().unwrap().0.points.len();
    assert!(points > 20, "{points}");
    window.get_by_label("Measure again");
    let before = (window.state().settings.near, window.state().settings.distant);
    assert_eq!(before, (6, 3));
    window.get_by_label("--near 60 --distant 30").click();
    window.run_steps(3);
    assert_eq!((window.state().settings.near, window.state().settings.distant), (60, 30));
    press(&mut window, egui::Key::Escape);
    assert!(window.query_by_label("Measure again").is_none());
}
