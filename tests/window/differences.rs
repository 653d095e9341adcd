//! The difference as a quantity: in every layout, with its numbers, its range and its colours.

use svbrdf_core::picture::flip::flip;

use super::*;

#[needs(adapter)]
fn exposure_changes_values_and_no_difference() {
    let mut window = with_differences();
    let [ground_truth, prediction] = [GROUND_TRUTH, PREDICTIONS[0]].map(|title| pane(&window, title));
    let before = [ground_truth, prediction].map(|rect| pixels(&mut window, rect));
    press(&mut window, egui::Key::E);
    let after = [ground_truth, prediction].map(|rect| pixels(&mut window, rect));
    assert!(before[0] != after[0], "the value is brighter");
    assert!(before[1] == after[1], "the difference is the same");
}

#[needs(adapter)]
fn the_ground_truth_is_never_compared_with_itself() {
    let mut window = built_in();
    let colours = |window: &mut Window<'_>, title: &str| {
        let rect = pane(window, title);
        let picture = pixels(window, rect);
        picture.pixels().map(|p| p.0).collect::<std::collections::HashSet<_>>().len()
    };
    press(&mut window, egui::Key::D);
    for layout in [Layout::SideBySide, Layout::Wipe, Layout::Single] {
        assert_eq!(window.view().display.layout, layout);
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
fn the_range_is_dragged_at_either_end_and_automatic_again() {
    let mut window = with_differences();
    for (kind, low, drags) in [
        (Difference::SignedLog, -1.5, [(-1.0, -0.75), (0.75, 1.2), (-1.2, -0.5)]),
        (Difference::Log, 0.0, [(1.0, 0.75), (0.75, 1.2), (1.2, 0.5)]),
    ] {
        edit(&mut window, |model| choose_difference(model, kind));
        statistics(&mut window);
        let auto = window.difference_range();
        let prediction = pane(&window, PREDICTIONS[0]);
        let automatic = pixels(&mut window, prediction);
        // The axis goes to 1.5 times the automatic range, between margins of 8 points.
        let scale = window.get_by_label("Difference range").rect().shrink2(vec2(8.0, 0.0));
        let at = |value: f32| vec2((value - low) / (1.5 - low), 0.5);
        for (from, to) in drags {
            drag_primary(&mut window, scale, at(from), at(to));
            let range = window.difference_range();
            let expected = f64::from(to.abs()) * auto;
            assert!((range - expected).abs() < 0.01 * auto, "from {from} to {to}: {range}, not {expected}");
        }
        let range = window.difference_range();
        assert!(pixels(&mut window, prediction) != automatic, "other colours");
        // Another quantity has its own range.
        press(&mut window, egui::Key::M);
        statistics(&mut window);
        assert!(window.difference_range() != range);
        press_with(&mut window, Modifiers::SHIFT, egui::Key::M);
        statistics(&mut window);
        assert_eq!(window.difference_range(), range);
        click(&mut window, "Auto range");
        assert_eq!(window.difference_range(), auto);
        assert!(pixels(&mut window, prediction) == automatic);
    }
}

#[needs(adapter)]
fn the_readout_has_the_value_of_every_material_in_whichever_pane_the_pointer_is() {
    let mut window = built_in();
    for _ in 0..4 {
        press(&mut window, egui::Key::M);
    }
    let materials = materials();
    for (slot, title) in [(1, PREDICTIONS[0]), (2, PREDICTIONS[1]), (1, GROUND_TRUTH)] {
        let at = pane(&window, title).center();
        hover(&mut window, at);
        let [x, y] = texel_read(&window).unwrap();
        let roughness = |slot: usize| materials[slot].texel(y * 256 + x).roughness;
        for (start, index) in [("GT ", 0), ("1 ", 1), ("2 ", 2)] {
            let expected = format!("{start}{:8.4}", roughness(index));
            assert_eq!(column(&window, start), expected, "under the pointer is slot {slot}");
        }
    }
    assert_eq!(window.view().display.prediction, 0, "the pointer chooses none");
}

/// The FLIP of both predictions in the scene and at the exposure of the window, as the mean of three equal channels.
fn flips(window: &Window<'_>) -> [Vec<f32>; 2] {
    let view = window.view();
    let materials: Vec<_> = window.materials().collect();
    let render =
        |index: usize| render_f32(materials[index], &view.scene, &PRINTED, &Progress::default()).unwrap();
    let of = |index| flip(&render(0), &render(index), view.exposure_ev);
    [1, 2].map(|index| of(index).into_iter().map(|v| (v + v + v) / 3.0).collect())
}

/// Waits for the statistics of the current scene and exposure.
fn settle(window: &mut Window<'_>) -> [Vec<f32>; 2] {
    let expected = flips(window);
    let statistics = expected.each_ref().map(|map| Statistics::of(map));
    wait(window, "the FLIP of this scene", |app| {
        app.difference_statistics().is_some_and(|found| found == statistics)
    });
    expected
}

/// The window with FLIP in its panes.
fn with_flip<'a>() -> Window<'a> {
    let mut window = built_in();
    press(&mut window, egui::Key::D);
    edit(&mut window, |model| choose_difference(model, Difference::Flip));
    window
}

#[needs(adapter)]
fn flip_is_that_of_the_core_in_every_scene_and_at_every_exposure() {
    let mut window = with_flip();
    let first = settle(&mut window);
    window.get_by_label("Title 1  blurred normals: FLIP");
    let rect = pane(&window, GROUND_TRUTH);
    drag_primary(&mut window, rect, vec2(0.7, 0.3), vec2(0.2, 0.8));
    let moved = settle(&mut window);
    edit(&mut window, |model| display::step_exposure(model, 2.0));
    let brighter = settle(&mut window);
    let mean = |map: &[f32]| map.iter().sum::<f32>() / map.len() as f32;
    let means = [&first, &moved, &brighter].map(|maps| mean(&maps[0]));
    assert!((means[0] - means[1]).abs() > 1e-4 && (means[1] - means[2]).abs() > 1e-4, "{means:?}");
    assert!((mean(&first[0]) - mean(&first[1])).abs() > 1e-3, "a planted fault: the other prediction");
}
