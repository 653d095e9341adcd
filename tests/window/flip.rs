//! FLIP as a difference in the panes: computed by the core at the exposure of the panes.

use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::picture::colour_map::difference_to_display;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::flip::flip;
use svbrdf_core::picture::statistics::Statistics;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_f32;
use svbrdf_viewer::model::command::{Command, DisplayCommand, WindowCommand};
use svbrdf_viewer::model::settings::save_kind::{SaveKind, SaveRequest};

use super::*;

const PREDICTIONS: [&str; 2] = ["1  blurred normals", "2  wrong roughness"];

fn apply(window: &mut Window<'_>, command: impl Into<Command>) {
    let (ctx, command) = (window.ctx.clone(), command.into());
    window.state_mut().apply(&ctx, command);
    window.run_steps(2);
}

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
#[test]
fn flip_is_that_of_the_core_in_every_scene_and_at_every_exposure() {
    let mut window = shown();
    let first = settle(&mut window);
    window.get_by_label("Title 1  blurred normals: FLIP");
    let rect = pane(&window, GROUND_TRUTH);
    drag(&mut window, egui::PointerButton::Primary, rect, vec2(0.7, 0.3), vec2(0.2, 0.8));
    let moved = settle(&mut window);
    apply(&mut window, DisplayCommand::StepExposure(2.0));
    let brighter = settle(&mut window);
    let mean = |map: &[f32]| map.iter().sum::<f32>() / map.len() as f32;
    let means = [&first, &moved, &brighter].map(|maps| mean(&maps[0]));
    assert!((means[0] - means[1]).abs() > 1e-4 && (means[1] - means[2]).abs() > 1e-4, "{means:?}");
    assert!((mean(&first[0]) - mean(&first[1])).abs() > 1e-3, "a planted fault: the other prediction");
}

#[needs(adapter)]
#[test]
fn texels_have_the_colours_and_the_readout_of_flip() {
    let mut window = shown();
    press(&mut window, egui::Key::Num0);
    apply(&mut window, DisplayCommand::Zoom { factor: 4.0, at: [0.0, 0.0] });
    let maps = settle(&mut window);
    let range = window.state().difference_range() as f32;
    for (slot, title) in [1, 2].into_iter().zip(PREDICTIONS) {
        let rect = pane(&window, title);
        let mut reads = Vec::new();
        for share in [vec2(0.12, 0.17), vec2(0.83, 0.31), vec2(0.21, 0.88), vec2(0.62, 0.93)] {
            let at = rect.min + rect.size() * share;
            hover(&mut window, at);
            window.run_steps(2);
            let [x, y] = texel_read(&window).unwrap();
            let value = maps[slot - 1][y * 256 + x];
            assert_eq!(
                column(&window, &format!("{slot} ")),
                format!("{slot} {value:8.4}"),
                "{title}: {x}, {y}"
            );
            reads.push((at, value));
        }
        hover(&mut window, egui::pos2(600.0, 20.0));
        window.run_steps(2);
        let seen = pixels(&mut window, rect);
        let far = |at: egui::Pos2, value: f32| {
            let [x, y] = [at.x - rect.left().floor(), at.y - rect.top().floor()];
            let got = seen.get_pixel(x as u32, y as u32).0;
            let expected = difference_to_display(value, range, false);
            (0..3).map(|c| got[c].abs_diff(expected[c])).max().unwrap()
        };
        assert!(reads.iter().all(|(at, value)| far(*at, *value) <= 3), "{title}: {reads:?}");
        assert!(reads.iter().any(|(at, value)| far(*at, 2.0 * value + 0.1) > 20), "a planted fault");
    }
}

#[needs(adapter)]
#[test]
fn a_saved_flip_has_its_numbers() {
    let mut window = shown();
    apply(&mut window, DisplayCommand::SetExposure(1.0));
    let maps = settle(&mut window);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("flip.exr");
    let request = SaveRequest { kind: SaveKind::Renderings, path: path.clone(), size: [0; 2], handles: true };
    apply(&mut window, WindowCommand::Save(request));
    wait(&mut window, "the file", |app| !app.messages().is_empty());
    let saved = exr::prelude::read_first_rgba_layer_from_file(
        &path,
        |size, _| (size.width(), vec![[0f32; 3]; size.area()]),
        |(width, pixels), at, (r, g, b, _): (f32, f32, f32, f32)| {
            pixels[at.y() * *width + at.x()] = [r, g, b]
        },
    );
    let (width, saved) = saved.unwrap().layer_data.channel_data.pixels;
    let left = width - 256;
    for (i, value) in maps[1].iter().enumerate().step_by(97) {
        let rgb = saved[i / 256 * width + left + i % 256];
        assert!(rgb.iter().all(|channel| (channel - value).abs() < 1e-6), "{i}: {rgb:?}, expected {value}");
    }
}
