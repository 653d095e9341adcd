//! Keys and their commands.

use super::*;

#[needs(adapter)]
fn every_letter_does_what_the_help_says() {
    let mut window = built_in();
    let automatic = window.view().exposure_ev;
    type Holds = fn(&Model, f32) -> bool;
    let cases: [(egui::Key, &str, Holds); 23] = [
        (egui::Key::C, "wipe", |m, _| m.view.display.layout == Layout::Wipe),
        (egui::Key::C, "single", |m, _| m.view.display.layout == Layout::Single),
        (egui::Key::C, "side by side", |m, _| m.view.display.layout == Layout::SideBySide),
        (egui::Key::D, "difference", |m, _| m.view.display.difference),
        (egui::Key::D, "value", |m, _| !m.view.display.difference),
        (egui::Key::M, "normal", |m, _| m.view.display.quantity == Quantity::Normal),
        (egui::Key::P, "perspective", |m, _| m.view.display.projection == Projection::Perspective),
        (egui::Key::E, "brighter", |m, automatic| m.view.exposure_ev == automatic + 0.5),
        (egui::Key::Num2, "second prediction", |m, _| m.view.display.prediction == 1),
        (egui::Key::L, "clipping", |m, _| m.view.display.show_clipping),
        (egui::Key::H, "highlight", |m, _| m.settings.highlight_follows),
        (egui::Key::R, "reset", |m, automatic| {
            m.view.exposure_ev == automatic && !m.view.display.show_clipping
        }),
        (egui::Key::B, "no panel", |m, _| !m.settings.side_panel),
        (egui::Key::E, "brighter", |m, automatic| m.view.exposure_ev == automatic + 0.5),
        (egui::Key::N, "automatic exposure", |m, automatic| {
            m.view.exposure_ev == automatic && m.view.display.auto_exposure == AutoExposure::Once
        }),
        (egui::Key::V, "false colours", |m, _| m.view.display.false_colour),
        (egui::Key::Num0, "a texel per pixel", |m, _| {
            m.view.display.framing.is_some_and(|framing| framing.pixels_per_texel == 1.0)
        }),
        (egui::Key::F, "fitted", |m, _| m.view.display.framing.is_none()),
        // There are two predictions.
        (egui::Key::Num3, "no such prediction", |m, _| m.view.display.prediction == 1),
        (egui::Key::Num5, "no such prediction", |m, _| m.view.display.prediction == 1),
        (egui::Key::Num8, "no such prediction", |m, _| m.view.display.prediction == 1),
        (egui::Key::Num9, "no such prediction", |m, _| m.view.display.prediction == 1),
        (egui::Key::Num1, "first prediction", |m, _| m.view.display.prediction == 0),
    ];
    for (key, what, holds) in cases {
        press(&mut window, key);
        assert!(holds(window.model(), automatic), "{key:?}: {what}");
    }
}

#[needs(adapter)]
fn holding_g_shows_the_ground_truth_everywhere_and_x_swaps_the_sides() {
    let mut window = built_in();
    let prediction = "Pane 1  blurred normals";
    window.get_by_label(prediction);
    window.key_down(egui::Key::G);
    window.run_steps(3);
    assert!(window.query_by_label(prediction).is_none());
    assert_eq!(window.query_all_by_label("Pane GROUND TRUTH  worn tiles").count(), 3);
    window.key_up(egui::Key::G);
    window.run_steps(3);
    let before = window.get_by_label(prediction).rect();
    press(&mut window, egui::Key::X);
    assert_eq!(pane(&window, GROUND_TRUTH), before, "the ground truth is where the prediction was");
}

#[test]
fn the_page_of_the_window_lists_every_key() {
    let page = include_str!("../../docs/window.md");
    let missing: Vec<_> = actions::HELP
        .iter()
        .flat_map(|(_, lines)| *lines)
        .filter(|line| !page.contains(&format!("| {} | {} |", line.keys, line.effect)))
        .collect();
    assert!(missing.is_empty(), "docs/window.md does not list {missing:?}");
}

#[needs(adapter)]
fn undo_and_redo_go_through_the_changes() {
    let mut window = built_in();
    window.run_steps(30);
    let before = window.view().exposure_ev;
    press(&mut window, egui::Key::E);
    window.run_steps(30);
    let redo = [(Modifiers::COMMAND | Modifiers::SHIFT, egui::Key::Z), (Modifiers::COMMAND, egui::Key::Y)];
    for (modifiers, key) in redo {
        press_with(&mut window, Modifiers::COMMAND, egui::Key::Z);
        assert_eq!(window.view().exposure_ev, before);
        press_with(&mut window, modifiers, key);
        assert_eq!(window.view().exposure_ev, before + 0.5, "{key:?}");
    }
}

#[needs(adapter)]
fn escape_closes_an_open_drop_down_and_nothing_else() {
    let mut window = built_in();
    edit(&mut window, |model| model.help = true);
    window.get_by_role_and_label(Role::ComboBox, "Convention").click();
    window.run_steps(4);
    window.get_by_label("guided-2020");
    press(&mut window, egui::Key::Escape);
    assert!(window.query_by_label("guided-2020").is_none(), "the drop-down is closed");
    assert!(window.model().help);
    press(&mut window, egui::Key::Escape);
    assert!(!window.model().help, "then the help");
}

/// What users of other viewers try first.
#[needs(adapter)]
fn the_keys_of_other_viewers_go_on_close_and_magnify() {
    let mut window = built_in();
    let prediction = |window: &Window<'_>| window.view().display.prediction;
    for (key, expected) in [
        (egui::Key::ArrowDown, 1),
        (egui::Key::ArrowDown, 1),
        (egui::Key::ArrowUp, 0),
        (egui::Key::End, 1),
        (egui::Key::Home, 0),
        (egui::Key::PageDown, 1),
    ] {
        press(&mut window, key);
        assert_eq!(prediction(&window), expected, "{key:?}");
    }
    press_with(&mut window, Modifiers::CTRL | Modifiers::SHIFT, egui::Key::Tab);
    assert_eq!(prediction(&window), 0);
    press_with(&mut window, Modifiers::CTRL, egui::Key::Tab);
    assert_eq!(prediction(&window), 1);
    // As keyboards send it: the sign of the key in the layout, and the key itself.
    window.event(egui::Event::Key {
        key: egui::Key::Exclamationmark,
        physical_key: Some(egui::Key::Num1),
        pressed: true,
        repeat: false,
        modifiers: Modifiers::SHIFT,
    });
    window.run_steps(3);
    assert_eq!(window.names(), ["blurred normals", "worn tiles", "wrong roughness"]);
    press_with(&mut window, Modifiers::SHIFT, egui::Key::Num1);
    assert_eq!(window.names(), ["worn tiles", "blurred normals", "wrong roughness"]);
    press_with(&mut window, Modifiers::COMMAND, egui::Key::Num0);
    assert_eq!(window.view().display.framing.unwrap().pixels_per_texel, 1.0);
    press_with(&mut window, Modifiers::COMMAND, egui::Key::W);
    assert_eq!(window.names(), ["worn tiles", "blurred normals"]);
    // Until the first drag a pane tells what it does.
    edit(&mut window, |model| model.settings.has_dragged = false);
    let rect = pane(&window, GROUND_TRUTH);
    drag_primary(&mut window, rect, vec2(0.2, 0.2), vec2(0.3, 0.3));
    assert!(window.model().settings.has_dragged);
}

#[needs(adapter)]
fn shift_alone_shows_the_ground_truth_and_not_while_it_does_something_else() {
    let mut window = built_in();
    let count = |window: &Window<'_>| window.query_all_by_label("Pane GROUND TRUTH  worn tiles").count();
    window.event(egui::Event::ModifiersChanged(Modifiers::SHIFT));
    window.run_steps(2);
    assert_eq!(count(&window), 3);
    window.event(egui::Event::Key {
        key: egui::Key::M,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: Modifiers::SHIFT,
    });
    window.step();
    window.step();
    assert_eq!(count(&window), 1, "Shift + M is another key");
}
