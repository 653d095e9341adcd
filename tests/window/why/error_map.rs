//! The error map: the log difference of each texel, averaged over the scenes of the loss.

use svbrdf_core::image::Image;
use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::why;
use svbrdf_viewer::model::command::DisplayCommand;

use super::*;

fn expected() -> Vec<Image<f32>> {
    let materials = materials();
    let predictions: Vec<_> = materials[1..].iter().collect();
    let comparison = Comparison::new(&materials[0], &predictions, PRINTED).unwrap();
    let scenes = SAMPLING.scenes(&PRINTED).unwrap();
    why::error_maps(&comparison, &scenes, &Progress::default()).unwrap()
}

fn values(map: &Image<f32>) -> Vec<f32> {
    map.pixels.iter().map(|rgb| rgb.iter().sum::<f32>() / 3.0).collect()
}

/// The window with the error map in its panes.
fn shown<'a>() -> Window<'a> {
    let mut window = opened();
    click(&mut window, "Error map");
    statistics(&mut window);
    window
}

#[needs(adapter)]
fn the_error_map_has_the_statistics_of_the_core_and_its_mean_is_the_loss() {
    let mut window = shown();
    let found = statistics(&mut window);
    let losses = losses(&Request::Scenes(SAMPLING));
    for (index, (found, map)) in found.iter().zip(&expected()).enumerate() {
        assert_eq!(Some(*found), Statistics::of(&values(map)), "{index}");
        let [loss, other] = [index, 1 - index].map(|index| losses[index].estimate.mean);
        assert!((found.mean / loss - 1.0).abs() < 1e-5, "{}, expected {loss}", found.mean);
        assert!((found.mean / other - 1.0).abs() > 0.1, "a planted fault");
    }
    for title in PREDICTIONS {
        window.get_by_label(&format!("Title {title}: error map"));
    }
    window.get_by_label("over 192 scenes");
    window.get_by_label_contains("of 192 scenes");
    // It does not depend on the light.
    let rect = pane(&window, GROUND_TRUTH);
    let before = window.state().parts.model.view.scene;
    drag_primary(&mut window, rect, vec2(0.7, 0.3), vec2(0.2, 0.8));
    assert_ne!(window.state().parts.model.view.scene, before);
    assert_eq!(statistics(&mut window), found);
    // Another difference is of the scene again.
    apply(&mut window, DisplayCommand::SetDifference(Difference::Log));
    assert_ne!(statistics(&mut window), found);
    window.get_by_label("Title 1  blurred normals: log difference");
}

#[needs(adapter)]
fn panes_readout_and_saved_file_have_the_numbers_of_the_error_map() {
    let mut window = shown();
    press(&mut window, egui::Key::Num0);
    // Few edges of texels are in the middle of a pixel.
    apply(&mut window, DisplayCommand::Zoom { factor: 4.3, at: [0.0, 0.0] });
    let maps = expected();
    for (slot, title) in PREDICTIONS.into_iter().enumerate() {
        assert_texels(&mut window, title, &format!("{} ", slot + 1), &values(&maps[slot]));
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map.exr");
    save(&mut window, SaveKind::Renderings, &path);
    let (width, saved) = read_exr(&path);
    let gap = svbrdf_files::export::GAP;
    assert_eq!((width, saved.len()), (2 * 256 + gap, 256 * (2 * 256 + gap)));
    for (i, rgb) in maps[1].pixels.iter().enumerate().step_by(97) {
        let [x, y] = [i % 256 + 256 + gap, i / 256];
        assert_eq!(saved[y * width + x], *rgb, "{x}, {y}");
    }
    let text = "mean log difference of each texel over 128 near-field and 64 distant scenes, seed 0";
    assert!(file_contains(&path, text));
}
