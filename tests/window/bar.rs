//! Controls of the window: the drawer, the clipboard, the exposure.

use super::*;

/// The panes of all materials.
fn panes(window: &Window<'_>) -> [egui::Rect; 3] {
    [GROUND_TRUTH, PREDICTIONS[0], PREDICTIONS[1]].map(|title| pane(window, title))
}

#[needs(adapter)]
fn the_drawer_lies_over_the_lower_end_of_the_panes_which_stay() {
    let mut window = built_in();
    for size in [vec2(1360.0, 860.0), vec2(700.0, 600.0)] {
        window.set_size(size);
        window.run_steps(6);
        let before = panes(&window);
        hover(&mut window, before[0].center());
        press(&mut window, egui::Key::I);
        window.run_steps(6);
        let heading = window.get_by_label("Pinned texels").rect();
        assert_eq!(panes(&window), before, "{size:?}");
        assert!(heading.top() > before[0].center().y, "{size:?}: {heading:?}");
        // A drag on it moves no light.
        let scene = window.scene();
        let screen = egui::Rect::from_min_size(egui::Pos2::ZERO, vec2(1.0, 1.0));
        let at = egui::pos2(before[0].center().x, heading.bottom() + 20.0).to_vec2();
        drag_primary(&mut window, screen, at, at - vec2(20.0, 0.0));
        assert_eq!(window.scene(), scene, "{size:?}");
        click(&mut window, "Remove all pins");
        window.run_steps(6);
        assert_eq!(panes(&window), before, "{size:?}");
    }
}

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
    window.run_steps(2);
    window.get_by_label_contains("the view as a picture");
    // The same pixels as a saved view has.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("view.png");
    edit(&mut window, |model| model.messages.dismiss_all());
    save(&mut window, SaveKind::View, &path);
    let saved = image::open(&path).unwrap().to_rgb8();
    let differ = saved.pixels().zip(&copied.pixels).filter(|(a, b)| a.0 != [b.r(), b.g(), b.b()]).count();
    assert_eq!(differ, 0, "pixels differ");
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
    edit(&mut window, |model| exposure::choose_scene(model, grazing));
    let chosen = exposure(&window);
    assert_ne!(chosen, start);
    click(&mut window, "Exposure follows");
    assert_eq!(exposure(&window), chosen, "for the same light it is the same");
    move_light(&mut window);
    assert_ne!(exposure(&window), chosen, "it follows");
    click(&mut window, "Brighter");
    let by_hand = exposure(&window);
    edit(&mut window, |model| exposure::choose_scene(model, grazing));
    move_light(&mut window);
    assert_eq!(exposure(&window), by_hand, "a hand has set it");
}
