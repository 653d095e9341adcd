//! Fields and buttons: a number that nobody edited is not written.

use svbrdf_core::loss::{Ask, Texels};

use super::*;

/// Frames with Tab: more than there are controls.
const STEPS: usize = 150;

/// The window with numbers that no field shows in full.
fn precise<'a>() -> Window<'a> {
    let mut window = built_in();
    let model = &mut window.state_mut().parts.model;
    model.view.scene.light = [-0.08779578655958176, 0.512_345_678_9, 1.200_049_999];
    model.view.scene.view = [0.000_123_4, -0.333_333_333_333, 2.499_999];
    model.view.exposure_ev = 0.724_967_9;
    model.view.display.auto_exposure = AutoExposure::Once;
    model.view.display.difference = true;
    let rendering = svbrdf_core::picture::quantity::Quantity::Rendering;
    model.view.display.differences.set_range(rendering, Some(0.123_456_789));
    model.settings.loss.target_percent = 1.234_567;
    model.settings.loss.seed = 9_007_199_254_740_993;
    model.settings.loss.texels = Texels::Sampled(123_457);
    window.run_steps(4);
    window
}

/// Walks through all controls.
fn tab_through(window: &mut Window<'_>) -> usize {
    let mut fields = std::collections::BTreeSet::new();
    for _ in 0..STEPS {
        window.key_press(egui::Key::Tab);
        window.run_steps(2);
        let focused =
            window.query_all_by_role(Role::TextInput).chain(window.query_all_by_role(Role::SpinButton));
        let focused = focused.filter(|node| node.is_focused());
        fields.extend(focused.map(|node| format!("{:?}", node.rect())));
    }
    fields.len()
}

#[needs(adapter)]
fn tab_through_all_fields_changes_no_number() {
    let mut window = precise();
    window.set_size(vec2(1400.0, 1600.0));
    for ask in [Ask::Scenes, Ask::Accuracy, Ask::Time] {
        window.state_mut().parts.model.settings.loss.ask = ask;
        window.state_mut().parts.model.settings.tab = Tab::Loss;
        window.run_steps(4);
        let model = &window.model();
        let before = (model.view.clone(), model.settings.loss.clone());
        let fields = tab_through(&mut window);
        assert!(fields >= 8, "{ask:?}: {fields} fields had the focus");
        let model = &window.model();
        assert_eq!((model.view.clone(), model.settings.loss.clone()), before, "{ask:?}");
    }
    assert_eq!(window.view().display.auto_exposure, AutoExposure::Once);
}

/// Types texts into a field, one after the other.
fn type_x(window: &mut Window<'_>, texts: &[&str]) {
    window.get_by_role_and_label(Role::SpinButton, "Light x").click();
    window.run_steps(3);
    for text in texts {
        window.event(egui::Event::Text((*text).to_owned()));
        window.run_steps(2);
    }
}

#[needs(adapter)]
fn what_is_typed_into_a_field_is_written_in_full_however_it_is_left() {
    for leave in [egui::Key::Tab, egui::Key::Enter] {
        let mut window = precise();
        let field = |window: &Window<'_>| window.get_by_role_and_label(Role::SpinButton, "Light x").rect();
        let at = field(&window).center();
        type_x(&mut window, &["0.12345678"]);
        press(&mut window, leave);
        assert_eq!(window.scene().light[0], 0.123_456_78, "{leave:?}");
        // The very text that the field shows of another number.
        window.state_mut().parts.model.view.scene.light[0] = -0.08779578655958176;
        window.run_steps(3);
        assert!(field(&window).contains(at));
        type_x(&mut window, &["-0.08", "8"]);
        press(&mut window, leave);
        assert_eq!(window.scene().light[0], -0.088, "{leave:?}");
    }
}

#[needs(adapter)]
fn a_double_click_on_a_number_puts_back_its_default() {
    let mut window = built_in();
    press(&mut window, egui::Key::E);
    assert_ne!(window.view().exposure_ev, 0.0);
    let at = window.get_by_role_and_label(Role::SpinButton, "Exposure").rect().center();
    for pressed in [true, false, true, false] {
        window.event(egui::Event::PointerMoved(at));
        window.event(primary(at, pressed));
    }
    window.run_steps(6);
    assert_eq!(window.view().exposure_ev, 0.0);
}

#[needs(adapter)]
fn closing_another_prediction_keeps_the_one_that_is_looked_at() {
    let mut window = built_in();
    window.set_size(vec2(1200.0, 2000.0));
    window.run_steps(4);
    tab(&mut window, "Files");
    press(&mut window, egui::Key::Num2);
    assert_eq!(window.view().display.prediction, 1);
    window.get_all_by_label("Close").next().unwrap().click();
    window.run_steps(4);
    assert_eq!(window.names(), ["worn tiles", "wrong roughness"]);
    assert_eq!(window.view().display.prediction, 0);
    window.get_all_by_label("Close").next().unwrap().click();
    window.run_steps(4);
    assert_eq!((window.names().len(), window.view().display.prediction), (1, 0));
}

#[needs(adapter)]
fn a_loss_that_cannot_be_computed_says_why_in_its_panel() {
    let mut window = by_scenes();
    for name in ["Near-field scenes", "Distant scenes"] {
        enter(&mut window, name, "0");
    }
    see(&mut window, "at least one scene");
    assert!(window.messages().is_empty(), "{:?}", window.messages());
    enter(&mut window, "Near-field scenes", "3");
    wait(&mut window, "the loss", |app| app.losses().is_some());
    assert!(!has(&window, "at least one scene"));
}
