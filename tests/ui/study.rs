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
    wait(&mut window, "the first points", |app| app.study().is_some_and(|(study, _)| study.points.len() > 4));
    assert_eq!((window.state().settings.near, window.state().settings.distant), (6, 3));
    let options = window.state().study().unwrap().0.points[2].choice.options();
    assert_eq!(options, "--sampler sobol --near 64 --distant 32 --texels 128");
    window.get_by_label(&options).click();
    window.run_steps(3);
    assert_eq!((window.state().settings.near, window.state().settings.distant), (64, 32));

    window.get_by_label("Cancel study").click();
    window.run_steps(3);
    window.get_by_label("Measure again");
    assert!(window.state().study().unwrap().0.points.len() > 4, "what was measured stays");
    press(&mut window, egui::Key::Escape);
    assert!(window.query_by_label("Measure again").is_none());
}
