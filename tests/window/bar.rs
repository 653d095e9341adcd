//! Controls of the window: the clipboard, the exposure.

use super::*;

#[needs(adapter)]
fn copy_puts_the_view_on_the_clipboard_in_its_pixels() {
    let mut window = built_in();
    // The losses are in the titles.
    wait(&mut window, "the losses", |app| app.losses().is_some());
    window.run_steps(2);
    let [width, height] = window.model().geometry.picture;
    let (key, modifiers) = (egui::Key::C, Modifiers::COMMAND | Modifiers::SHIFT);
    window.event(egui::Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers });
    let copied = commands(&mut window).into_iter().find_map(|command| match command {
        egui::OutputCommand::CopyImage(image) => Some(image),
        _ => None,
    });
    let copied = copied.expect("an image is copied");
    assert_eq!(copied.size.map(|side| side as u32), [width, height + 20]);
    let colours: std::collections::HashSet<_> = copied.pixels.iter().collect();
    assert!(colours.len() > 1000, "it has the panes: {} colours", colours.len());
}

/// The controls of the window: role and label, and the centre.
pub(super) fn controls(window: &Window<'_>) -> Vec<(String, Pos2)> {
    use Role::{Button, CheckBox, ComboBox, RadioButton, Slider, SpinButton, Tab};
    let of = |role: Role| {
        window.query_all_by_role(role).map(move |node| {
            let label = node.accesskit_node().label().unwrap_or_default();
            (format!("{role:?} {label}"), node.rect().center())
        })
    };
    [Button, CheckBox, RadioButton, ComboBox, SpinButton, Slider, Tab].into_iter().flat_map(of).collect()
}

#[needs(adapter)]
fn the_exposure_is_automatic_once_follows_and_stays_where_a_hand_puts_it() {
    let mut window = built_in();
    let exposure = |window: &Window<'_>| window.view().exposure_ev;
    let start = exposure(&window);
    assert_ne!(start, 0.0, "it is automatic once at the start");
    let rect = pane(&window, GROUND_TRUTH);
    let move_light = |window: &mut Window<'_>| drag_primary(window, rect, vec2(0.5, 0.5), vec2(0.85, 0.8));
    move_light(&mut window);
    assert_eq!(exposure(&window), start, "a drag leaves it");
    let mut grazing = window.scene();
    grazing.light = [-1.3, 0.0, 0.2];
    edit(&mut window, |model| display::choose_scene(model, grazing));
    let chosen = exposure(&window);
    assert_ne!(chosen, start);
    click(&mut window, "Exposure follows");
    assert_eq!(exposure(&window), chosen, "for the same light it is the same");
    move_light(&mut window);
    assert_ne!(exposure(&window), chosen, "it follows");
    click(&mut window, "Brighter");
    let by_hand = exposure(&window);
    edit(&mut window, |model| display::choose_scene(model, grazing));
    move_light(&mut window);
    assert_eq!(exposure(&window), by_hand, "a hand has set it");
}
