//! Number fields: one that nobody edited writes nothing.

use svbrdf_core::loss::{Ask, Texels};
use svbrdf_viewer::model::settings::Tab;
use svbrdf_viewer::model::view::state::AutoExposure;

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
    model.settings.auto_loss = false;
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
        let model = &window.state().parts.model;
        let before = (model.view.clone(), model.settings.loss.clone());
        let fields = tab_through(&mut window);
        assert!(fields >= 8, "{ask:?}: {fields} fields had the focus");
        let model = &window.state().parts.model;
        assert_eq!((model.view.clone(), model.settings.loss.clone()), before, "{ask:?}");
    }
    assert_eq!(window.state().parts.model.view.display.auto_exposure, AutoExposure::Once);
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
        assert_eq!(window.state().parts.model.view.scene.light[0], 0.123_456_78, "{leave:?}");
        // The very text that the field shows of another number.
        window.state_mut().parts.model.view.scene.light[0] = -0.08779578655958176;
        window.run_steps(3);
        assert!(field(&window).contains(at));
        type_x(&mut window, &["-0.08", "8"]);
        press(&mut window, leave);
        assert_eq!(window.state().parts.model.view.scene.light[0], -0.088, "{leave:?}");
    }
}
