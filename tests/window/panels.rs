//! Fields and buttons.

use super::*;

#[test]
#[cfg_attr(not(has_adapter), ignore = "no graphics adapter")]
fn a_double_click_on_a_number_puts_back_its_default() {
    let mut window = built_in();
    press(&mut window, egui::Key::E);
    assert_eq!(window.state().model.view.exposure_ev, 0.5);
    let at = window.get_by_role_and_label(egui::accesskit::Role::SpinButton, "Exposure").rect().center();
    for pressed in [true, false, true, false] {
        let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
        window.event(egui::Event::PointerMoved(at));
        window.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
    }
    window.run_steps(6);
    assert_eq!(window.state().model.view.exposure_ev, 0.0);
}

#[test]
#[cfg_attr(not(has_adapter), ignore = "no graphics adapter")]
fn closing_another_prediction_keeps_the_one_that_is_looked_at() {
    let mut window = built_in();
    window.set_size(vec2(1200.0, 2000.0));
    window.run_steps(4);
    tab(&mut window, "Files");
    press(&mut window, egui::Key::Num2);
    assert_eq!(window.state().model.view.display.prediction, 1);
    window.get_all_by_label("Close").next().unwrap().click();
    window.run_steps(4);
    assert_eq!(window.state().names(), ["worn tiles", "wrong roughness"]);
    assert_eq!(window.state().model.view.display.prediction, 0);
    window.get_all_by_label("Close").next().unwrap().click();
    window.run_steps(4);
    assert_eq!((window.state().names().len(), window.state().model.view.display.prediction), (1, 0));
}

#[test]
#[cfg_attr(not(has_adapter), ignore = "no graphics adapter")]
fn a_loss_that_cannot_be_computed_says_why_in_its_panel() {
    let mut window = by_scenes();
    for name in ["Near-field scenes", "Distant scenes"] {
        let number = egui::accesskit::Role::SpinButton;
        window.get_by_role_and_label(number, name).click();
        window.run_steps(2);
        window.get_by_role_and_label(number, name).type_text("0");
        press(&mut window, egui::Key::Enter);
    }
    // The loss before it may be under way.
    for _ in 0..6000 {
        if window.query_by_label_contains("at least one scene").is_some() {
            break;
        }
        window.step();
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    window.get_by_label_contains("at least one scene");
    assert!(window.state().messages().is_empty(), "{:?}", window.state().messages());
    let number = egui::accesskit::Role::SpinButton;
    window.get_by_role_and_label(number, "Near-field scenes").click();
    window.run_steps(2);
    window.get_by_role_and_label(number, "Near-field scenes").type_text("3");
    press(&mut window, egui::Key::Enter);
    wait(&mut window, "the loss", |app| app.losses().is_some());
    assert_eq!(window.query_all_by_label_contains("at least one scene").count(), 0);
}

#[test]
#[cfg_attr(not(has_adapter), ignore = "no graphics adapter")]
fn what_opens_materials_is_in_sight_in_a_small_window_after_many() {
    let mut window = built_in();
    window.set_size(vec2(900.0, 600.0));
    let path =
        |i| format!("/runs/of/a/very/long/name/that/does/not/fit/into/one/line/of/the/window/epoch_{i:04}");
    window.state_mut().model.settings.recent = (0..12).map(|i| path(i).into()).collect();
    window.get_by_label("Open").click();
    window.run_steps(6);
    let button = window.get_by_label("Open these").rect();
    assert!(button.bottom() < 600.0 && button.top() > 0.0, "{button:?}");
    let end = window.get_by_label_contains("epoch_0001").rect();
    assert!(end.right() < 700.0, "{end:?}");
    window.get_by_label_contains("epoch_0001").click();
    window.run_steps(3);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Enter);
    wait(&mut window, "the end of reading", |app| !app.is_reading());
    window.get_by_label_contains(&format!("cannot read {}", path(1)));
    assert_eq!(window.state().model.settings.recent.len(), 12, "what could not be opened is not remembered");
}

#[test]
#[cfg_attr(not(has_adapter), ignore = "no graphics adapter")]
fn the_side_panel_stands_beside_the_panes_in_the_smallest_window() {
    let mut window = built_in();
    // While it is computed, there is another button.
    wait(&mut window, "the loss", |app| app.losses().is_some());
    for size in [vec2(640.0, 420.0), vec2(760.0, 500.0), vec2(1600.0, 900.0)] {
        window.set_size(size);
        window.run_steps(8);
        // Narrow windows start without it.
        if window.query_by_label("Copy scene").is_none() {
            assert!(size.x < 900.0);
            press(&mut window, egui::Key::B);
            window.run_steps(20);
        }
        let panes =
            ["GROUND TRUTH  worn tiles", "1  blurred normals"].map(|title| pane(&window, title).right());
        let panes = panes.into_iter().fold(0.0, f32::max);
        for label in ["Near-field", "Copy scene", "Compute loss"] {
            let rect = window.get_by_label(label).rect();
            assert!(
                rect.left() >= panes && rect.right() <= size.x,
                "{label} at {rect:?}, panes up to {panes}, {size}"
            );
        }
    }
}
