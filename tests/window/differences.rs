//! The difference as a quantity: in every layout, with its numbers, its range and its colours.

use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::Statistics;
use svbrdf_core::progress::Progress;
use svbrdf_core::render;
use svbrdf_files::samples;
use svbrdf_viewer::model::view::state::Layout;

use super::*;

const PREDICTIONS: [&str; 2] = ["1  blurred normals", "2  wrong roughness"];

/// The built-in materials in f64, the ground truth first.
fn materials() -> Vec<Material<f64>> {
    let samples = samples::load::<f32>().unwrap();
    let all = std::iter::once(samples.ground_truth).chain(samples.predictions);
    all.map(|read| read.material.cast()).collect()
}

/// |ln(p + epsilon) - ln(g + epsilon)| of every texel, written out in f64.
fn log_differences(scene: &Scene, prediction: usize) -> Vec<f64> {
    let materials = materials();
    let rendering = |m| render::render(m, scene, &PRINTED, &Progress::default()).unwrap();
    let [g, p] = [0, prediction].map(|index| rendering(&materials[index]));
    let ln = |v: f64| (v + PRINTED.epsilon).ln();
    let texels = g.pixels.iter().zip(&p.pixels);
    texels.map(|(g, p)| (0..3).map(|c| (ln(p[c]) - ln(g[c])).abs()).sum::<f64>() / 3.0).collect()
}

/// The angles between normals of every texel in degrees, by their arc cosine in f64.
fn angles(prediction: usize) -> Vec<f64> {
    let materials = materials();
    let texels = materials[0].width() * materials[0].height();
    let normal = |index: usize, texel: usize| materials[index].texel(texel).normal;
    (0..texels)
        .map(|i| normal(0, i).dot(normal(prediction, i)).clamp(-1.0, 1.0).acos().to_degrees())
        .collect()
}

/// Whether the statistics are those of `values`, by sorting them, within `tolerance`.
fn are_those_of(got: &Statistics, mut values: Vec<f64>, tolerance: f64) -> bool {
    values.sort_by(f64::total_cmp);
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let at = |share: f64| super::quantities::quantile(&values, share);
    let expected = [mean, at(0.5), at(0.95), at(1.0)];
    let got = [got.mean, got.median, got.p95, got.maximum];
    got.iter().zip(expected).all(|(got, expected)| (got - expected).abs() <= tolerance * (1.0 + expected))
}

fn statistics(window: &mut Window<'_>) -> Vec<Statistics> {
    wait(window, "the statistics", |app| app.difference_statistics().is_some());
    window.state().difference_statistics().unwrap().iter().map(|one| one.unwrap()).collect()
}

#[needs(adapter)]
#[test]
fn the_statistics_of_a_rendering_are_those_of_the_core_in_f64_and_their_mean_is_the_loss() {
    let mut window = built_in();
    press(&mut window, egui::Key::D);
    let got = statistics(&mut window);
    let scene = window.state().parts.model.view.scene;
    for (index, got) in got.iter().enumerate() {
        let expected = log_differences(&scene, index + 1);
        assert!(are_those_of(got, expected.clone(), 1e-4), "{index}: {got:?}");
        // Planted faults: another prediction, and every value a little larger.
        assert!(!are_those_of(got, log_differences(&scene, 2 - index), 1e-4));
        assert!(!are_those_of(got, expected.iter().map(|v| v * 1.001 + 1e-3).collect(), 1e-4));
    }
    window.get_by_label("this scene");
    let mean = format!("{:.4}", got[0].mean);
    assert!(window.query_all_by_label(&mean).next().is_some(), "{mean} is in the strip");
}

#[needs(adapter)]
#[test]
fn the_difference_of_normals_is_their_angle_in_degrees() {
    let mut window = built_in();
    press(&mut window, egui::Key::D);
    press(&mut window, egui::Key::M);
    let got = statistics(&mut window);
    for (index, got) in got.iter().enumerate() {
        // Arc cosines of numbers near 1 are off by 1e-8 radians in f64; normals in f32 are units within 1e-7.
        assert!(are_those_of(got, angles(index + 1), 0.03), "{index}: {got:?}");
    }
    assert!(got[0].mean > 1.0, "blurred normals are off: {:?}", got[0]);
    assert!(!are_those_of(&got[0], angles(2), 0.03), "a planted fault");
    for title in PREDICTIONS {
        window.get_by_label(&format!("Title {title}: angle"));
    }
    window.get_by_label("degrees");
}

#[needs(adapter)]
#[test]
fn a_map_s_difference_is_not_called_logarithmic() {
    let mut window = built_in();
    press(&mut window, egui::Key::D);
    window.get_by_label("Title 1  blurred normals: log difference");
    for _ in 0..4 {
        press(&mut window, egui::Key::M);
    }
    window.get_by_label("Title 1  blurred normals: absolute difference");
    assert_eq!(window.query_all_by_label_contains("log difference").count(), 0);
    assert_eq!(window.query_all_by_label_contains("ln").count(), 0);
}

#[needs(adapter)]
#[test]
fn exposure_changes_values_and_no_difference() {
    let mut window = built_in();
    press(&mut window, egui::Key::D);
    statistics(&mut window);
    let [ground_truth, prediction] = [GROUND_TRUTH, PREDICTIONS[0]].map(|title| pane(&window, title));
    let before = [ground_truth, prediction].map(|rect| pixels(&mut window, rect));
    press(&mut window, egui::Key::E);
    let after = [ground_truth, prediction].map(|rect| pixels(&mut window, rect));
    assert!(before[0] != after[0], "the value is brighter");
    assert!(before[1] == after[1], "the difference is the same");
}

#[needs(adapter)]
#[test]
fn the_ground_truth_is_never_compared_with_itself() {
    let mut window = built_in();
    let colours = |window: &mut Window<'_>, title: &str| {
        let rect = pane(window, title);
        let picture = pixels(window, rect);
        picture.pixels().map(|p| p.0).collect::<std::collections::HashSet<_>>().len()
    };
    press(&mut window, egui::Key::D);
    for layout in [Layout::SideBySide, Layout::Wipe, Layout::Single] {
        assert_eq!(window.state().parts.model.view.display.layout, layout);
        for key in [egui::Key::X, egui::Key::G] {
            window.key_down(key);
            window.run_steps(4);
            let titles = window.query_all_by_label_contains("GROUND TRUTH  worn tiles: ").count();
            assert_eq!(titles, 0, "{layout:?}, {key:?}");
            for title in [GROUND_TRUTH, PREDICTIONS[0]] {
                if window.query_all_by_label(&format!("Pane {title}")).count() == 1 {
                    assert!(colours(&mut window, title) > 200, "{title} in {layout:?} after {key:?}");
                }
            }
            window.key_up(key);
            window.run_steps(2);
        }
        press(&mut window, egui::Key::X);
        press(&mut window, egui::Key::C);
    }
}

#[needs(adapter)]
#[test]
fn the_range_is_dragged_and_automatic_again() {
    let mut window = built_in();
    press(&mut window, egui::Key::D);
    statistics(&mut window);
    let auto = window.state().difference_range();
    let scale = window.get_by_label("Difference range").rect();
    let before = pane(&window, PREDICTIONS[0]);
    let automatic = pixels(&mut window, before);
    drag(&mut window, egui::PointerButton::Primary, scale, vec2(0.6, 0.5), vec2(0.5, 0.5));
    let range = window.state().difference_range();
    assert!((range - 0.75 * auto).abs() < 0.02 * auto, "half of an axis to 1.5 {auto}: {range}");
    assert!(pixels(&mut window, before) != automatic, "other colours");
    // Another quantity has its own range.
    press(&mut window, egui::Key::M);
    statistics(&mut window);
    assert!(window.state().difference_range() != range);
    window.key_press_modifiers(egui::Modifiers::SHIFT, egui::Key::M);
    window.run_steps(3);
    statistics(&mut window);
    assert_eq!(window.state().difference_range(), range);
    window.get_by_label("Auto range").click();
    window.run_steps(3);
    assert_eq!(window.state().difference_range(), auto);
    assert!(pixels(&mut window, before) == automatic);
}

#[needs(adapter)]
#[test]
fn the_range_of_a_signed_difference_is_dragged_at_either_end() {
    let mut window = built_in();
    window
        .state_mut()
        .parts
        .model
        .view
        .display
        .differences
        .choose(Quantity::Rendering, Difference::SignedLog);
    press(&mut window, egui::Key::D);
    statistics(&mut window);
    let auto = window.state().difference_range();
    // The axis goes from -1.5 to 1.5 times the automatic range, between margins of 8 points.
    let scale = window.get_by_label("Difference range").rect().shrink2(vec2(8.0, 0.0));
    let at = |value: f32| vec2((value + 1.5) / 3.0, 0.5);
    for (from, to) in [(-1.0, -0.75), (0.75, 1.2), (-1.2, -0.5)] {
        drag(&mut window, egui::PointerButton::Primary, scale, at(from), at(to));
        let range = window.state().difference_range();
        let expected = f64::from(to.abs()) * auto;
        assert!((range - expected).abs() < 0.01 * auto, "from {from} to {to}: {range}, expected {expected}");
    }
}

#[needs(adapter)]
#[test]
fn the_readout_has_the_value_of_every_material_in_whichever_pane_the_pointer_is() {
    let mut window = built_in();
    for _ in 0..4 {
        press(&mut window, egui::Key::M);
    }
    let materials = materials();
    for (slot, title) in [(1, PREDICTIONS[0]), (2, PREDICTIONS[1]), (1, GROUND_TRUTH)] {
        let at = pane(&window, title).center();
        window.event(egui::Event::PointerMoved(at));
        window.run_steps(3);
        let [column_, row] = texel_read(&window).unwrap();
        let roughness =
            |slot: usize| materials[slot].texel(row * materials[slot].width() + column_).roughness;
        for (start, index) in [("gt ", 0), ("1 ", 1), ("2 ", 2)] {
            let expected = format!("{start}{:8.4}", roughness(index));
            assert_eq!(column(&window, start), expected, "under the pointer is slot {slot}");
        }
    }
    assert_eq!(
        window.state().parts.model.view.display.prediction,
        0,
        "the first prediction is the chosen one"
    );
}

#[needs(adapter)]
#[test]
fn every_pane_in_false_colours_has_a_scale_and_no_other() {
    use svbrdf_viewer::ui::pane::scale::PaneScale;
    let mut window = built_in();
    let scales = |window: &Window<'_>| {
        let parts = &window.state().parts;
        let displayed = svbrdf_viewer::jobs::displayed::Displayed::of(&parts.model, &parts.jobs);
        let scenery = svbrdf_viewer::ui::content::scenery(&window.ctx, displayed, &parts.model.view);
        let contents = scenery.contents();
        contents.into_iter().map(|content| PaneScale::of(&scenery, content)).collect::<Vec<_>>()
    };
    assert_eq!(scales(&window), [None, None, None], "values have their own colours");
    press(&mut window, egui::Key::D);
    statistics(&mut window);
    let range = window.state().difference_range();
    let log = PaneScale { is_signed: false, range, unit: "" };
    assert_eq!(scales(&window), [None, Some(log.clone()), Some(log.clone())]);
    press(&mut window, egui::Key::C);
    assert_eq!(scales(&window), [Some(log)], "a wipe");
    press(&mut window, egui::Key::C);
    press(&mut window, egui::Key::C);
    press(&mut window, egui::Key::M);
    statistics(&mut window);
    let angle = PaneScale { is_signed: false, range: window.state().difference_range(), unit: "\u{b0}" };
    assert_eq!(scales(&window)[1], Some(angle));
    // The roughness itself, in false colours.
    press(&mut window, egui::Key::D);
    for key in [egui::Key::M, egui::Key::M, egui::Key::M, egui::Key::V] {
        press(&mut window, key);
    }
    let roughness = PaneScale { is_signed: false, range: 1.0, unit: "" };
    assert_eq!(scales(&window), vec![Some(roughness); 3]);
}
