//! Fields and buttons.

use super::*;

#[needs(adapter)]
#[test]
fn a_double_click_on_a_number_puts_back_its_default() {
    let mut window = built_in();
    press(&mut window, egui::Key::E);
    assert_ne!(window.state().parts.model.view.exposure_ev, 0.0);
    let at = window.get_by_role_and_label(Role::SpinButton, "Exposure").rect().center();
    for pressed in [true, false, true, false] {
        window.event(egui::Event::PointerMoved(at));
        window.event(primary(at, pressed));
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
        enter(&mut window, name, "0");
    }
    see(&mut window, "at least one scene");
    assert!(window.state().messages().is_empty(), "{:?}", window.state().messages());
    enter(&mut window, "Near-field scenes", "3");
    wait(&mut window, "the loss", |app| app.losses().is_some());
    assert!(!has(&window, "at least one scene"));
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
    click(&mut window, "Open");
    let button = window.get_by_label("Open these").rect();
    assert!(button.bottom() < 600.0 && button.top() > 0.0, "{button:?}");
    let name = "ground truth | a prediction with a long name";
    assert_eq!(window.get_all_by_label(name).count(), 12);
    window.get_all_by_label(name).nth(1).unwrap().click();
    window.run_steps(3);
    wait(&mut window, "the end of reading", |app| !app.is_reading());
    let problem = format!("cannot read {}/ground truth", path(1));
    assert!(has(&window, &problem));
    let recent = &window.state().parts.model.recent;
    assert_eq!(recent.len(), 12, "what could not be opened is not remembered");
}
