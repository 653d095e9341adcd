//! The bar at the top, in windows of all sizes.

use svbrdf_viewer::model::command::{DisplayCommand, MaterialsCommand, PhotographCommand};

use super::*;

/// The controls of a bar with room for all.
pub(super) const CONTROLS: &[&str] = &[
    "Open",
    "Save",
    "Copy",
    "Layout side by side",
    "Layout wipe",
    "Layout single",
    "Show rendering",
    "Show normal",
    "Show diffuse",
    "Show specular",
    "Show roughness",
    "Value",
    "Difference",
    "Histogram",
    "3D",
    "Tile",
    "False colour",
    "Swap",
    "Exposure",
    "Darker",
    "Brighter",
    "Auto EV",
    "Exposure follows",
    "Clipped pixels",
    "Fit",
    "One texel per pixel",
    "Reset",
    "Undo",
    "Redo",
    "Menu",
    "Panel",
    "Help",
];

/// The labels of the bar that are visible now.
fn in_bar(window: &Window<'_>) -> Vec<(&'static str, egui::Rect)> {
    let top = |label: &&'static str| {
        let nodes = window.query_all_by_label(label).filter(|node| node.rect().top() < 80.0);
        Some((*label, nodes.map(|node| node.rect()).next()?))
    };
    CONTROLS.iter().filter_map(top).collect()
}

#[needs(adapter)]
#[test]
fn the_bar_is_one_line_at_every_width_and_what_it_has_no_room_for_is_in_the_menu() {
    let mut window = built_in();
    let mut most = 0;
    for width in (640..=2600).step_by(35) {
        window.set_size(vec2(width as f32, 500.0));
        window.run_steps(3);
        let mut bar = in_bar(&window);
        bar.sort_by(|a, b| a.1.left().total_cmp(&b.1.left()));
        for pair in bar.windows(2) {
            let [(left, one), (right, other)] = [pair[0], pair[1]];
            assert!(one.right() <= other.left() + 0.5, "{left} {one:?} covers {right} {other:?} at {width}");
        }
        let level = |(_, rect): &(&str, egui::Rect)| (rect.center().y - bar[0].1.center().y).abs() < 3.0;
        assert!(bar.iter().all(level) && bar.last().unwrap().1.right() <= width as f32, "{width}: {bar:?}");
        assert!(bar.len() >= most, "{width} has room for {}, less had for {most}", bar.len());
        most = bar.len();
    }
    assert_eq!(most, CONTROLS.len());
    for (difference, quantity) in [(true, 1), (false, 2)] {
        apply(&mut window, DisplayCommand::ShowDifference(difference));
        apply(&mut window, DisplayCommand::CycleQuantity(quantity));
        assert_eq!(in_bar(&window).len(), most, "nothing comes and goes with what is shown");
    }
    window.set_size(vec2(1330.0, 600.0));
    window.run_steps(3);
    assert_eq!(in_bar(&window).len(), most, "a window of the first start has room for all");
    // Undo is in the menu of a narrow window, and works there.
    window.set_size(vec2(800.0, 600.0));
    let before = window.state().parts.model.view.exposure_ev;
    press(&mut window, egui::Key::E);
    assert_eq!(window.state().parts.model.view.exposure_ev, before + 0.5);
    assert!(window.query_by_label("Undo").is_none());
    click(&mut window, "Menu");
    click(&mut window, "Undo");
    assert_eq!(window.state().parts.model.view.exposure_ev, before);
}

/// The panes of all materials.
fn panes(window: &Window<'_>) -> [egui::Rect; 3] {
    [GROUND_TRUTH, PREDICTIONS[0], PREDICTIONS[1]].map(|title| pane(window, title))
}

#[needs(adapter)]
#[test]
fn the_drawer_takes_its_room_from_the_panes_and_covers_none_of_them() {
    let mut window = built_in();
    for size in [vec2(1360.0, 860.0), vec2(700.0, 500.0)] {
        window.set_size(size);
        window.run_steps(6);
        let before = panes(&window);
        hover(&mut window, before[0].center());
        let texel = texel_read(&window);
        press(&mut window, egui::Key::I);
        window.run_steps(6);
        let heading = window.get_by_label("Pinned texels").rect();
        let after = panes(&window);
        assert!(after.iter().all(|pane| pane.bottom() <= heading.top()), "{after:?} {heading:?}");
        assert!(after[0].height() > 60.0, "{size:?}: {after:?}");
        // Fitted, the material keeps its middle; the pane has become smaller.
        hover(&mut window, after[0].center());
        assert_eq!(texel_read(&window), texel, "{size:?}");
        // The edge between them is a handle.
        let edge = heading.top() - 4.0;
        let screen = egui::Rect::from_min_size(egui::Pos2::ZERO, vec2(1.0, 1.0));
        let at = egui::pos2(after[0].center().x, edge);
        drag_primary(&mut window, screen, at.to_vec2(), at.to_vec2() - vec2(0.0, 60.0));
        window.run_steps(6);
        assert!(window.get_by_label("Pinned texels").rect().top() < heading.top() - 30.0, "{size:?}");
        click(&mut window, "Remove all pins");
        window.run_steps(6);
        assert_eq!(panes(&window), before, "{size:?}");
    }
}

#[needs(adapter)]
#[test]
fn the_scale_of_differences_is_there_where_a_difference_is_shown() {
    let mut window = built_in();
    // One prediction leaves no place for a difference beside it.
    apply(&mut window, MaterialsCommand::Close(2));
    window.run_steps(6);
    let has_scale = |window: &Window<'_>| window.query_by_label("Difference range").is_some();
    let whole = pane(&window, GROUND_TRUTH);
    assert!(!has_scale(&window));
    press(&mut window, egui::Key::D);
    assert!(has_scale(&window));
    assert!(pane(&window, GROUND_TRUTH).height() < whole.height());
    press(&mut window, egui::Key::D);
    assert!(!has_scale(&window));
    assert_eq!(pane(&window, GROUND_TRUTH), whole);
}

#[needs(adapter)]
#[test]
fn copy_puts_the_view_on_the_clipboard_in_its_pixels() {
    let mut window = built_in();
    // The range of the difference beside the panes is there, and the losses in their titles.
    statistics(&mut window);
    wait(&mut window, "the losses", |app| app.losses().is_some());
    window.run_steps(2);
    let size = window.state().picture_size();
    let (key, modifiers) = (egui::Key::C, Modifiers::COMMAND | Modifiers::SHIFT);
    window.event(egui::Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers });
    // Each frame has its own output: the copy is in one of them.
    let mut copied = None;
    for _ in 0..20 {
        window.step();
        for command in &window.output().platform_output.commands {
            if let egui::OutputCommand::CopyImage(image) = command {
                copied = Some(image.clone());
            }
        }
    }
    let copied = copied.expect("an image is copied");
    assert_eq!(copied.size.map(|side| side as u32), size);
    let colours: std::collections::HashSet<_> = copied.pixels.iter().collect();
    assert!(colours.len() > 1000, "it has the panes: {} colours", colours.len());
    window.run_steps(2);
    window.get_by_label_contains("the view as a picture");
    // The same pixels as a saved view has.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("view.png");
    apply(&mut window, WindowCommand::DismissMessages);
    save(&mut window, SaveKind::View, &path);
    let saved = image::open(&path).unwrap().to_rgb8();
    let differ = saved.pixels().zip(&copied.pixels).filter(|(a, b)| a.0 != [b.r(), b.g(), b.b()]).count();
    assert_eq!(differ, 0, "pixels differ");
}

/// Whether a tooltip appears under the pointer at `at`.
fn tooltip(window: &mut Window<'_>, at: Pos2) -> bool {
    window.event(egui::Event::PointerMoved(at));
    let is_open = |window: &Window<'_>| {
        window.ctx.memory(|memory| {
            let mut layers = memory.layer_ids();
            layers.any(|layer| layer.order == egui::Order::Tooltip && memory.areas().is_visible(&layer))
        })
    };
    // Twice as long as it takes to appear.
    let open = (0..40).any(|_| {
        window.step();
        is_open(window)
    });
    window.event(egui::Event::PointerMoved(egui::pos2(1.0, 1.0)));
    window.run_steps(3);
    open
}

/// The controls of the window: role and label, and the centre.
pub(super) fn controls(window: &Window<'_>) -> Vec<(String, Pos2)> {
    const ROLES: [Role; 7] = [
        Role::Button,
        Role::CheckBox,
        Role::RadioButton,
        Role::ComboBox,
        Role::SpinButton,
        Role::Slider,
        Role::Tab,
    ];
    let of = |role: Role| {
        window.query_all_by_role(role).map(move |node| {
            let label = egui_kittest::kittest::NodeT::accesskit_node(&node).label().unwrap_or_default();
            (format!("{role:?} {label}"), node.rect().center())
        })
    };
    ROLES.into_iter().flat_map(of).collect()
}

/// The labels of the `chosen` controls without a tooltip.
fn without_tooltip(
    window: &mut Window<'_>,
    controls: &[(String, Pos2)],
    chosen: impl Fn(&str, Pos2) -> bool,
) -> Vec<String> {
    let chosen = controls.iter().filter(|(label, at)| chosen(label, *at));
    chosen.filter(|(_, at)| !tooltip(window, *at)).map(|(label, _)| label.clone()).collect()
}

#[needs(adapter)]
#[test]
fn every_control_of_the_dialogs_has_a_tooltip() {
    type Show = fn(bool) -> Command;
    let dialogs: [(&str, Show); 3] = [
        ("open", |show| WindowCommand::ShowOpen(show).into()),
        ("save", |show| WindowCommand::ShowSave(show).into()),
        ("photograph", |show| PhotographCommand::ShowOpen(show).into()),
    ];
    let mut window = built_in();
    for (name, show) in dialogs {
        let behind: Vec<String> = controls(&window).into_iter().map(|(label, _)| label).collect();
        apply(&mut window, show(true));
        window.run_steps(8);
        let controls = controls(&window);
        // egui draws the button that closes a window.
        let of_dialog =
            |label: &str| label != "Button Close window" && !behind.iter().any(|one| one == label);
        let count = controls.iter().filter(|(label, _)| of_dialog(label)).count();
        assert!(count >= 3, "{name}: {controls:#?}");
        let without = without_tooltip(&mut window, &controls, |label, _| of_dialog(label));
        assert!(without.is_empty(), "{name}: no tooltip for {without:#?}");
        apply(&mut window, show(false));
    }
}

#[needs(adapter)]
#[test]
fn every_control_of_the_bar_and_of_the_panel_has_a_tooltip() {
    let mut window = built_in();
    window.set_size(vec2(1360.0, 1000.0));
    for name in ["Loss", "Why", "Files"] {
        tab(&mut window, name);
        window.run_steps(30);
        if name == "Why" {
            // Nothing moves any more.
            wait(&mut window, "the scenes", |app| app.listed_scenes().is_some());
            see(&mut window, "roughness of wrong roughness: 60.1% of the loss");
        }
        let controls = controls(&window);
        assert!(controls.len() > 30, "{name}: {}", controls.len());
        let inside = egui::Rect::from_min_size(Pos2::ZERO, vec2(1360.0, 1000.0));
        let without = without_tooltip(&mut window, &controls, |label, at| {
            inside.contains(at) && !label.contains("Title ")
        });
        assert!(without.is_empty(), "{name}: no tooltip for {without:#?}");
    }
}

#[needs(adapter)]
#[test]
fn the_exposure_is_automatic_once_follows_and_stays_where_a_hand_puts_it() {
    let mut window = built_in();
    let exposure = |window: &Window<'_>| window.state().parts.model.view.exposure_ev;
    let start = exposure(&window);
    assert_ne!(start, 0.0, "it is automatic once at the start");
    let rect = pane(&window, GROUND_TRUTH);
    let move_light = |window: &mut Window<'_>| {
        drag_primary(window, rect, vec2(0.5, 0.5), vec2(0.85, 0.8));
    };
    move_light(&mut window);
    assert_eq!(exposure(&window), start, "a drag leaves it");
    // A preset of the light is a scene that is chosen.
    more(&mut window);
    click(&mut window, "Grazing left");
    press(&mut window, egui::Key::Escape);
    let chosen = exposure(&window);
    assert_ne!(chosen, start);
    click(&mut window, "Exposure follows");
    assert_eq!(exposure(&window), chosen, "for the same light it is the same");
    move_light(&mut window);
    assert_ne!(exposure(&window), chosen, "it follows");
    click(&mut window, "Brighter");
    let by_hand = exposure(&window);
    more(&mut window);
    click(&mut window, "Grazing left");
    press(&mut window, egui::Key::Escape);
    move_light(&mut window);
    assert_eq!(exposure(&window), by_hand, "a hand has set it");
}
