//! FLIP as a difference in the panes: computed by the core at the exposure of the panes.

use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::flip::flip;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_f32;
use svbrdf_viewer::model::command::DisplayCommand;

use super::*;

/// The FLIP of both predictions in the scene and at the exposure of the window, as the mean of three equal channels.
fn expected(window: &Window<'_>) -> [Vec<f32>; 2] {
    let view = &window.state().parts.model.view;
    let materials: Vec<_> = window.state().materials().collect();
    let render =
        |index: usize| render_f32(materials[index], &view.scene, &PRINTED, &Progress::default()).unwrap();
    let of = |index| flip(&render(0), &render(index), view.exposure_ev);
    [1, 2].map(|index| of(index).into_iter().map(|v| (v + v + v) / 3.0).collect())
}

/// Waits for the statistics of the current scene and exposure.
fn settle(window: &mut Window<'_>) -> [Vec<f32>; 2] {
    let expected = expected(window);
    let statistics = expected.each_ref().map(|map| Statistics::of(map));
    wait(window, "the FLIP of this scene", |app| {
        app.difference_statistics().is_some_and(|found| *found == statistics)
    });
    expected
}

/// The window with FLIP in its panes.
fn shown<'a>() -> Window<'a> {
    let mut window = built_in();
    press(&mut window, egui::Key::D);
    apply(&mut window, DisplayCommand::SetDifference(Difference::Flip));
    window
}

#[needs(adapter)]
fn flip_is_that_of_the_core_in_every_scene_and_at_every_exposure() {
    let mut window = shown();
    let first = settle(&mut window);
    window.get_by_label("Title 1  blurred normals: FLIP");
    let rect = pane(&window, GROUND_TRUTH);
    drag_primary(&mut window, rect, vec2(0.7, 0.3), vec2(0.2, 0.8));
    let moved = settle(&mut window);
    apply(&mut window, DisplayCommand::StepExposure(2.0));
    let brighter = settle(&mut window);
    let mean = |map: &[f32]| map.iter().sum::<f32>() / map.len() as f32;
    let means = [&first, &moved, &brighter].map(|maps| mean(&maps[0]));
    assert!((means[0] - means[1]).abs() > 1e-4 && (means[1] - means[2]).abs() > 1e-4, "{means:?}");
    assert!((mean(&first[0]) - mean(&first[1])).abs() > 1e-3, "a planted fault: the other prediction");
}

#[needs(adapter)]
fn panes_readout_and_saved_file_have_the_numbers_of_flip() {
    let mut window = shown();
    press(&mut window, egui::Key::Num0);
    apply(&mut window, DisplayCommand::Zoom { factor: 4.3, at: [0.0, 0.0] });
    apply(&mut window, DisplayCommand::SetExposure(1.0));
    let maps = settle(&mut window);
    for (slot, title) in PREDICTIONS.into_iter().enumerate() {
        assert_texels(&mut window, title, &format!("{} ", slot + 1), &maps[slot]);
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("flip.exr");
    save(&mut window, SaveKind::Renderings, &path);
    let (width, saved) = read_exr(&path);
    for (i, value) in maps[1].iter().enumerate().step_by(97) {
        let rgb = saved[i / 256 * width + width - 256 + i % 256];
        assert!(rgb.iter().all(|channel| (channel - value).abs() < 1e-6), "{i}: {rgb:?}, expected {value}");
    }
}
