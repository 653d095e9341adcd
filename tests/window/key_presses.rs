//! Keys and their commands.

use svbrdf_core::picture::quantity::Quantity;
use svbrdf_viewer::model::view::state::{AutoExposure, Layout, Projection};
use svbrdf_viewer::ui::input::keys;

use super::*;

#[needs(adapter)]
#[test]
fn every_letter_does_what_the_help_says() {
    let mut window = built_in();
    let expect = |window: &mut Window<'_>, key, what: &str, holds: &dyn Fn(&App) -> bool| {
        press(window, key);
        assert!(holds(window.state()), "{key:?}: {what}");
    };
    expect(&mut window, egui::Key::C, "wipe", &|a| a.parts.model.view.display.layout == Layout::Wipe);
    expect(&mut window, egui::Key::C, "single", &|a| a.parts.model.view.display.layout == Layout::Single);
    expect(&mut window, egui::Key::C, "side by side", &|a| {
        a.parts.model.view.display.layout == Layout::SideBySide
    });
    expect(&mut window, egui::Key::D, "difference", &|a| a.parts.model.view.display.difference);
    expect(&mut window, egui::Key::D, "value", &|a| !a.parts.model.view.display.difference);
    expect(&mut window, egui::Key::M, "normal", &|a| a.parts.model.view.display.quantity == Quantity::Normal);
    expect(&mut window, egui::Key::P, "perspective", &|a| {
        a.parts.model.view.display.projection == Projection::Perspective
    });
    let automatic = window.state().parts.model.view.exposure_ev;
    expect(&mut window, egui::Key::E, "brighter", &|a| a.parts.model.view.exposure_ev == automatic + 0.5);
    expect(&mut window, egui::Key::Num2, "second prediction", &|a| {
        a.parts.model.view.display.prediction == 1
    });
    expect(&mut window, egui::Key::L, "clipping", &|a| a.parts.model.view.display.show_clipping);
    expect(&mut window, egui::Key::H, "highlight", &|a| a.parts.model.settings.highlight_follows);
    expect(&mut window, egui::Key::R, "reset", &|a| {
        a.parts.model.view.exposure_ev == automatic && !a.parts.model.view.display.show_clipping
    });
    expect(&mut window, egui::Key::B, "no panel", &|a| !a.parts.model.settings.side_panel);
    press(&mut window, egui::Key::E);
    expect(&mut window, egui::Key::N, "automatic exposure", &|a| {
        a.parts.model.view.exposure_ev == automatic
            && a.parts.model.view.display.auto_exposure == AutoExposure::Once
    });
    expect(&mut window, egui::Key::T, "repeated", &|a| a.parts.model.view.display.tiled);
    expect(&mut window, egui::Key::J, "histograms", &|a| a.parts.model.settings.histograms);
    expect(&mut window, egui::Key::V, "false colours", &|a| a.parts.model.view.display.false_colour);
    expect(&mut window, egui::Key::Num0, "a texel per pixel", &|a| {
        a.parts.model.view.display.framing.is_some_and(|framing| framing.pixels_per_texel == 1.0)
    });
    expect(&mut window, egui::Key::F, "fitted", &|a| a.parts.model.view.display.framing.is_none());
    // There are two predictions.
    for key in [egui::Key::Num3, egui::Key::Num5, egui::Key::Num8, egui::Key::Num9] {
        expect(&mut window, key, "no such prediction", &|a| a.parts.model.view.display.prediction == 1);
    }
    expect(&mut window, egui::Key::Num1, "first prediction", &|a| a.parts.model.view.display.prediction == 0);
}

#[needs(adapter)]
#[test]
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
    let missing: Vec<_> = keys::HELP
        .iter()
        .flat_map(|(_, lines)| *lines)
        .filter(|(key, what)| !page.contains(&format!("| {key} | {what} |")))
        .collect();
    assert!(missing.is_empty(), "docs/window.md does not list {missing:?}");
}

#[needs(adapter)]
#[test]
fn undo_and_redo_go_through_the_changes() {
    let mut window = built_in();
    window.run_steps(30);
    let before = window.state().parts.model.view.exposure_ev;
    press(&mut window, egui::Key::E);
    window.run_steps(30);
    let redo = [
        (egui::Modifiers::COMMAND | egui::Modifiers::SHIFT, egui::Key::Z),
        (egui::Modifiers::COMMAND, egui::Key::Y),
    ];
    for (modifiers, key) in redo {
        window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
        window.run_steps(3);
        assert_eq!(window.state().parts.model.view.exposure_ev, before);
        window.key_press_modifiers(modifiers, key);
        window.run_steps(3);
        assert_eq!(window.state().parts.model.view.exposure_ev, before + 0.5, "{key:?}");
    }
}

#[needs(adapter)]
#[test]
fn letters_typed_into_a_field_are_no_commands() {
    let mut window = built_in();
    window.get_by_label("Open").click();
    window.run_steps(4);
    let before = window.state().parts.model.view.clone();
    let field = "Files, folders or name prefixes, one a line:";
    window.get_by_role_and_label(egui::accesskit::Role::MultilineTextInput, field).type_text("mcexp");
    press(&mut window, egui::Key::M);
    assert_eq!(window.state().parts.model.view, before);
}

#[needs(adapter)]
#[test]
fn escape_closes_an_open_drop_down_and_nothing_else() {
    let mut window = built_in();
    let (ctx, command) = (window.ctx.clone(), svbrdf_viewer::model::command::LossCommand::ShowStudy(true));
    window.state_mut().apply(&ctx, command.into());
    window.run_steps(3);
    window.get_by_role_and_label(egui::accesskit::Role::ComboBox, "Convention").click();
    window.run_steps(4);
    window.get_by_label("guided-2020");
    press(&mut window, egui::Key::Escape);
    assert!(window.query_by_label("guided-2020").is_none(), "the drop-down is closed");
    window.get_by_label("Cancel study");
    press(&mut window, egui::Key::Escape);
    assert!(window.query_by_label("Cancel study").is_none(), "then the study");
}
