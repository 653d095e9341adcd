//! The error map: the log difference of each texel, averaged over the scenes of the loss.

use svbrdf_core::image::Image;
use svbrdf_core::loss::{Request, Sampling, Texels};
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::picture::colour_map::difference_to_display;
use svbrdf_core::picture::statistics::Statistics;
use svbrdf_evaluate::why;
use svbrdf_viewer::model::command::{Command, DisplayCommand, WindowCommand};
use svbrdf_viewer::model::settings::save_kind::{SaveKind, SaveRequest};

use super::*;

const SAMPLING: Sampling =
    Sampling { near: 128, distant: 64, seed: 0, sampler: Sampler::Sobol, texels: Texels::All };

fn expected() -> Vec<Image<f32>> {
    let materials = materials();
    let predictions: Vec<_> = materials[1..].iter().collect();
    let comparison = Comparison::new(&materials[0], &predictions, PRINTED).unwrap();
    let scenes = SAMPLING.scenes(&PRINTED).unwrap();
    why::error_maps(&comparison, &scenes, &Progress::default()).unwrap()
}

fn value(rgb: &[f32; 3]) -> f32 {
    rgb.iter().sum::<f32>() / 3.0
}

fn apply(window: &mut Window<'_>, command: impl Into<Command>) {
    let (ctx, command) = (window.ctx.clone(), command.into());
    window.state_mut().apply(&ctx, command);
    window.run_steps(2);
}

/// The window with the error map in its panes.
fn shown<'a>() -> Window<'a> {
    let mut window = opened();
    window.get_by_label("Error map").click();
    window.run_steps(3);
    wait(&mut window, "the error map", |app| app.difference_statistics().is_some());
    window
}

fn statistics(window: &Window<'_>) -> Vec<Statistics> {
    window.state().difference_statistics().unwrap().iter().map(|one| one.unwrap()).collect()
}

#[needs(adapter)]
#[test]
fn the_error_map_has_the_statistics_of_the_core_and_its_mean_is_the_loss() {
    let mut window = shown();
    let found = statistics(&window);
    let maps = expected();
    let materials = materials();
    let predictions: Vec<_> = materials[1..].iter().collect();
    let comparison = Comparison::new(&materials[0], &predictions, PRINTED).unwrap();
    let losses = comparison.run(&Request::Scenes(SAMPLING), &Progress::default()).unwrap().losses;
    for (index, (found, map)) in found.iter().zip(&maps).enumerate() {
        let values: Vec<f32> = map.pixels.iter().map(value).collect();
        assert_eq!(Some(*found), Statistics::of(&values), "{index}");
        let [loss, other] = [index, 1 - index].map(|index| losses[index].estimate.mean);
        assert!((found.mean / loss - 1.0).abs() < 1e-5, "{}, expected {loss}", found.mean);
        assert!((found.mean / other - 1.0).abs() > 0.1, "a planted fault");
    }
    for label in
        ["Title 1  blurred normals: error map", "Title 2  wrong roughness: error map", "over 192 scenes"]
    {
        window.get_by_label(label);
    }
    window.get_by_label_contains("of 192 scenes");
    // It does not depend on the light.
    let rect = pane(&window, GROUND_TRUTH);
    let before = window.state().parts.model.view.scene;
    drag(&mut window, egui::PointerButton::Primary, rect, vec2(0.7, 0.3), vec2(0.2, 0.8));
    assert_ne!(window.state().parts.model.view.scene, before);
    assert_eq!(statistics(&window), found);
    // Another difference is of the scene again.
    apply(&mut window, DisplayCommand::SetDifference(svbrdf_core::picture::difference::Difference::Log));
    wait(&mut window, "the statistics", |app| app.difference_statistics().is_some());
    assert_ne!(statistics(&window), found);
    window.get_by_label("Title 1  blurred normals: log difference");
}

#[needs(adapter)]
#[test]
fn texels_have_the_colours_and_the_readout_of_the_error_map() {
    let mut window = shown();
    press(&mut window, egui::Key::Num0);
    // Four pixels for each texel along a side: what the pointer is on fills a pixel.
    apply(&mut window, DisplayCommand::Zoom { factor: 4.0, at: [0.0, 0.0] });
    let (range, maps) = (window.state().difference_range(), expected());
    for (slot, title) in [(1, "1  blurred normals"), (2, "2  wrong roughness")] {
        let rect = pane(&window, title);
        let mut reads = Vec::new();
        for share in [vec2(0.12, 0.17), vec2(0.83, 0.31), vec2(0.21, 0.88), vec2(0.62, 0.93)] {
            let at = rect.min + rect.size() * share;
            window.event(egui::Event::PointerMoved(at));
            window.run_steps(3);
            let [column_, row] = texel_read(&window).unwrap();
            let value = value(&maps[slot - 1].pixels[row * 256 + column_]);
            let text = column(&window, &format!("{slot} "));
            assert_eq!(text, format!("{slot} {:8.4}", value), "{title} at {column_}, {row}");
            reads.push((at, value));
        }
        window.event(egui::Event::PointerMoved(egui::pos2(600.0, 20.0)));
        window.run_steps(3);
        let seen = pixels(&mut window, rect);
        let colour = |at: egui::Pos2| {
            let [x, y] = [at.x - rect.left().floor(), at.y - rect.top().floor()];
            seen.get_pixel(x as u32, y as u32).0
        };
        let far = |at: egui::Pos2, value: f32| {
            let expected = difference_to_display(value, range as f32, false);
            (0..3).map(|c| colour(at)[c].abs_diff(expected[c])).max().unwrap()
        };
        for (at, value) in &reads {
            assert!(far(*at, *value) <= 3, "{:?} at {at:?}, expected {value} of {range}", colour(*at));
        }
        assert!(reads.iter().any(|(at, value)| far(*at, 2.0 * value + 0.1) > 20), "a planted fault");
    }
}

#[needs(adapter)]
#[test]
fn a_saved_error_map_has_its_numbers_and_says_what_it_is() {
    let mut window = shown();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map.exr");
    apply(
        &mut window,
        WindowCommand::Save(SaveRequest {
            kind: SaveKind::Renderings,
            path: path.clone(),
            size: [0; 2],
            handles: true,
        }),
    );
    wait(&mut window, "the file", |app| !app.messages().is_empty());
    assert_eq!(window.state().messages(), [format!("Saved {}", path.display())]);
    let saved = exr::prelude::read_first_rgba_layer_from_file(
        &path,
        |size, _| (size.width(), vec![[0f32; 3]; size.area()]),
        |(width, pixels), at, (r, g, b, _): (f32, f32, f32, f32)| {
            pixels[at.y() * *width + at.x()] = [r, g, b]
        },
    );
    let (width, saved) = saved.unwrap().layer_data.channel_data.pixels;
    let map = &expected()[1];
    let gap = svbrdf_files::export::GAP;
    assert_eq!((width, saved.len()), (2 * 256 + gap, 256 * (2 * 256 + gap)));
    for (i, rgb) in map.pixels.iter().enumerate().step_by(97) {
        let [x, y] = [i % 256 + 256 + gap, i / 256];
        assert_eq!(saved[y * width + x], *rgb, "{x}, {y}");
    }
    let bytes = std::fs::read(&path).unwrap();
    let text = b"mean log difference of each texel over 128 near-field and 64 distant scenes, seed 0";
    assert!(bytes.windows(text.len()).any(|window| window == text));
}
