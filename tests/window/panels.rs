//! Fields and buttons.

use super::*;

#[needs(adapter)]
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
