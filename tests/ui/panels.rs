//! Fields and buttons.

use super::*;

#[test]
fn a_double_click_on_a_number_puts_back_its_default() {
    let Some(mut window) = built_in() else { return };
    press(&mut window, egui::Key::E);
    assert_eq!(window.state().state.exposure_ev, 0.5);
    let at = window.get_by_role_and_label(egui::accesskit::Role::SpinButton, "Exposure").rect().center();
    for pressed in [true, false, true, false] {
        let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
        window.event(egui::Event::PointerMoved(at));
        window.event(egui::Event::PointerButton { pos: at, button, pressed, modifiers });
    }
    window.run_steps(6);
    assert_eq!(window.state().state.exposure_ev, 0.0);
}
