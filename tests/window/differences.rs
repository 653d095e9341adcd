//! The difference as a quantity: in every layout, with its numbers, its range and its colours.

use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_viewer::model::view::state::Layout;

use super::materials::materials;
use super::*;

#[needs(adapter)]
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
fn the_range_is_dragged_and_automatic_again() {
    let mut window = built_in();
    press(&mut window, egui::Key::D);
    statistics(&mut window);
    let auto = window.state().difference_range();
    let scale = window.get_by_label("Difference range").rect();
    let before = pane(&window, PREDICTIONS[0]);
    let automatic = pixels(&mut window, before);
    drag_primary(&mut window, scale, vec2(0.6, 0.5), vec2(0.5, 0.5));
    let range = window.state().difference_range();
    assert!((range - 0.75 * auto).abs() < 0.02 * auto, "half of an axis to 1.5 {auto}: {range}");
    assert!(pixels(&mut window, before) != automatic, "other colours");
    // Another quantity has its own range.
    press(&mut window, egui::Key::M);
    statistics(&mut window);
    assert!(window.state().difference_range() != range);
    press_with(&mut window, Modifiers::SHIFT, egui::Key::M);
    statistics(&mut window);
    assert_eq!(window.state().difference_range(), range);
    click(&mut window, "Auto range");
    assert_eq!(window.state().difference_range(), auto);
    assert!(pixels(&mut window, before) == automatic);
}

#[needs(adapter)]
fn the_range_of_a_signed_difference_is_dragged_at_either_end() {
    let mut window = built_in();
    let display = &mut window.state_mut().parts.model.view.display;
    display.differences.choose(Quantity::Rendering, Difference::SignedLog);
    press(&mut window, egui::Key::D);
    statistics(&mut window);
    let auto = window.state().difference_range();
    // The axis goes from -1.5 to 1.5 times the automatic range, between margins of 8 points.
    let scale = window.get_by_label("Difference range").rect().shrink2(vec2(8.0, 0.0));
    let at = |value: f32| vec2((value + 1.5) / 3.0, 0.5);
    for (from, to) in [(-1.0, -0.75), (0.75, 1.2), (-1.2, -0.5)] {
        drag_primary(&mut window, scale, at(from), at(to));
        let range = window.state().difference_range();
        let expected = f64::from(to.abs()) * auto;
        assert!((range - expected).abs() < 0.01 * auto, "from {from} to {to}: {range}, expected {expected}");
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
        for (start, index) in [("gt ", 0), ("1 ", 1), ("2 ", 2)] {
            let expected = format!("{start}{:8.4}", roughness(index));
            assert_eq!(column(&window, start), expected, "under the pointer is slot {slot}");
        }
    }
    assert_eq!(window.state().parts.model.view.display.prediction, 0, "the pointer chooses none");
}

#[needs(adapter)]
fn every_pane_in_false_colours_has_a_scale_and_no_other() {
    use svbrdf_viewer::ui::pane::scale::PaneScale;
    let mut window = built_in();
    let scales = |window: &Window<'_>| {
        let parts = &window.state().parts;
        let displayed = svbrdf_viewer::jobs::displayed::Displayed::of(&parts.model, &parts.jobs);
        let scenery = svbrdf_viewer::ui::content::scenery(&window.ctx, displayed);
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
