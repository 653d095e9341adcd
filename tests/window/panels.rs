//! Fields and buttons.

use super::*;

#[needs(adapter)]
#[test]
fn a_double_click_on_a_number_puts_back_its_default() {
    let mut window = built_in();
    press(&mut window, egui::Key::E);
    assert_ne!(window.state().parts.model.view.exposure_ev, 0.0);
    let at = window.get_by_role_and_label(egui::accesskit::Role::SpinButton, "Exposure").rect().center();
    for pressed in [true, false, true, false] {
        let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
        window.event(egui::Event::PointerMoved(at));
        window.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
    }
    window.run_steps(6);
    assert_eq!(window.state().parts.model.view.exposure_ev, 0.0);
}

#[needs(adapter)]
#[test]
fn closing_another_prediction_keeps_the_one_that_is_looked_at() {
    let mut window = built_in();
    window.set_size(vec2(1200.0, 2000.0));
    window.run_steps(4);
    tab(&mut window, "Files");
    press(&mut window, egui::Key::Num2);
    assert_eq!(window.state().parts.model.view.display.prediction, 1);
    window.get_all_by_label("Close").next().unwrap().click();
    window.run_steps(4);
    assert_eq!(window.state().names(), ["worn tiles", "wrong roughness"]);
    assert_eq!(window.state().parts.model.view.display.prediction, 0);
    window.get_all_by_label("Close").next().unwrap().click();
    window.run_steps(4);
    assert_eq!((window.state().names().len(), window.state().parts.model.view.display.prediction), (1, 0));
}

#[needs(adapter)]
#[test]
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

#[needs(adapter)]
#[test]
fn what_opens_materials_is_in_sight_in_a_small_window_after_many() {
    let mut window = built_in();
    window.set_size(vec2(900.0, 600.0));
    let path =
        |i| format!("/runs/a/very/long/name/that/does/not/fit/into/one/line/of/the/window/epoch_{i:04}");
    let comparison = |i| {
        let mut session = window.state().parts.model.session();
        session.materials.truncate(2);
        for (one, name) in session.materials.iter_mut().zip(["ground truth", "a prediction with a long name"])
        {
            (one.path, one.built_in) = (Some(format!("{}/{name}", path(i)).into()), None);
        }
        session
    };
    let recent = (0..12).map(comparison).collect();
    window.state_mut().parts.model.recent = recent;
    window.get_by_label("Open").click();
    window.run_steps(6);
    let button = window.get_by_label("Open these").rect();
    assert!(button.bottom() < 600.0 && button.top() > 0.0, "{button:?}");
    let name = "ground truth | a prediction with a long name";
    assert_eq!(window.get_all_by_label(name).count(), 12);
    window.get_all_by_label(name).nth(1).unwrap().click();
    window.run_steps(3);
    wait(&mut window, "the end of reading", |app| !app.is_reading());
    let problem = format!("cannot read {}/ground truth", path(1));
    assert!(window.query_all_by_label_contains(&problem).next().is_some());
    let recent = &window.state().parts.model.recent;
    assert_eq!(recent.len(), 12, "what could not be opened is not remembered");
}

#[needs(adapter)]
#[test]
fn the_side_panel_stands_beside_the_panes_in_the_smallest_window() {
    let mut window = built_in();
    // While it is computed, there is another button.
    wait(&mut window, "the loss", |app| app.losses().is_some());
    for size in [vec2(640.0, 420.0), vec2(760.0, 500.0), vec2(1600.0, 900.0)] {
        window.set_size(size);
        window.run_steps(8);
        // Narrow windows start without it.
        if window.query_by_label("Near-field").is_none() {
            assert!(size.x < 900.0);
            press(&mut window, egui::Key::B);
            window.run_steps(20);
        }
        let panes =
            ["GROUND TRUTH  worn tiles", "1  blurred normals"].map(|title| pane(&window, title).right());
        let panes = panes.into_iter().fold(0.0, f32::max);
        for label in ["Near-field", "Distant", "Compute loss"] {
            let rect = window.get_by_label(label).rect();
            assert!(
                rect.left() >= panes && rect.right() <= size.x,
                "{label} at {rect:?}, panes up to {panes}, {size}"
            );
        }
    }
}

#[needs(adapter)]
#[test]
fn return_opens_what_is_typed_and_shift_return_begins_a_line() {
    let mut window = built_in();
    window.get_by_label("Open").click();
    window.run_steps(4);
    let field = "Files, folders or name prefixes, one a line:";
    let text =
        |window: &Window<'_>| window.state().parts.ui.dialogs.open.as_ref().map(|open| open.text.clone());
    window.get_by_role_and_label(egui::accesskit::Role::MultilineTextInput, field).type_text("no");
    window.key_press_modifiers(egui::Modifiers::SHIFT, egui::Key::Enter);
    window.run_steps(2);
    assert_eq!(text(&window).as_deref(), Some("no\n"));
    window.get_by_role_and_label(egui::accesskit::Role::MultilineTextInput, field).type_text("such file");
    press(&mut window, egui::Key::Enter);
    wait(&mut window, "the end of reading", |app| !app.is_reading());
    window.run_steps(3);
    window.get_by_label_contains("cannot read");
    assert_eq!(text(&window).as_deref(), Some("no\nsuch file"), "the text stays");
}

#[needs(adapter)]
#[test]
fn a_drag_on_the_hemisphere_moves_the_nearer_endpoint_and_keeps_its_distance() {
    let mut window = built_in();
    let before = window.state().parts.model.view.scene;
    let rect = window.get_by_label("Directions of light and view").rect();
    let length = |[x, y, z]: [f64; 3]| (x * x + y * y + z * z).sqrt();
    // The view is straight above: in the middle.
    drag(&mut window, egui::PointerButton::Primary, rect, vec2(0.5, 0.5), vec2(0.3, 0.5));
    let after = window.state().parts.model.view.scene;
    assert_eq!((after.light, after.kind), (before.light, before.kind));
    assert!(after.view[0] < -0.3 * length(before.view), "{after:?}");
    assert!((length(after.view) - length(before.view)).abs() < 1e-9);
    let radius = 0.5 * (rect.width() - 24.0);
    let [x, y, _] = before.light.map(|c| (c / length(before.light)) as f32);
    let at = vec2(0.5, 0.5) + vec2(x, -y) * radius / rect.width();
    drag(&mut window, egui::PointerButton::Primary, rect, at, vec2(0.5, 0.2));
    let moved = window.state().parts.model.view.scene;
    assert_eq!(moved.view, after.view);
    assert!(moved.light[1] > after.light[1] && (length(moved.light) - length(before.light)).abs() < 1e-9);
}
