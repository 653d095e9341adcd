//! The study window.

use svbrdf_core::loss::Texels;
use svbrdf_core::model::sampler::Sampler;

use super::*;
use crate::pictures::packed;

/// The window on two materials of 4 x 4 texels.
fn tiny<'a>(folder: &Path) -> Window<'a> {
    let write = |name: &str, brightness: f64| {
        let path = folder.join(name);
        let encode = |map, value| if map == 'D' { brightness * value } else { value };
        packed("NDRS", 4, encode).save(&path).unwrap();
        path
    };
    on_files([write("gt.png", 1.0), write("a.png", 0.5)])
}

#[needs(adapter)]
#[test]
fn a_click_on_a_point_of_the_study_sets_the_loss_to_it() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = tiny(folder.path());
    click(&mut window, "Menu");
    click(&mut window, "Study: time against error...");
    wait(&mut window, "the first points", |app| app.study().is_some_and(|(study, _)| study.points.len() > 4));
    // While it grows, points move.
    click(&mut window, "Cancel study");
    window.get_by_label("Measure again");
    let options = window.state().study().unwrap().0.points[2].choice.options();
    assert_eq!(options, "--sampler sobol --near 64 --distant 32 --texels 128");
    click(&mut window, &options);
    let loss = &window.state().parts.model.settings.loss;
    assert_eq!((loss.near, loss.distant, loss.sampler), (64, 32, Sampler::Sobol));
    assert_eq!(loss.texels, Texels::Sampled(128));
    wait(&mut window, "the loss of that setting", |app| {
        app.losses().is_some_and(|l| l[0].per_scene.len() == 96)
    });

    assert!(window.state().study().unwrap().0.points.len() > 4, "what was measured stays");
    press(&mut window, egui::Key::Escape);
    assert!(window.query_by_label("Measure again").is_none());
}
