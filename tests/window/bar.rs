//! The bar at the top, in windows of all sizes.

use svbrdf_viewer::model::command::{Command, DisplayCommand, PhotographCommand, WindowCommand};
use svbrdf_viewer::model::settings::save_kind::{SaveKind, SaveRequest};

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
    "?",
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
fn the_bar_is_one_line_in_every_window_and_what_it_has_no_room_for_is_in_the_menu() {
    let mut window = built_in();
    for width in [640.0, 700.0, 860.0, 900.0, 1100.0, 1330.0, 1360.0, 1920.0] {
        window.set_size(vec2(width, 600.0));
        for difference in [false, true] {
            for key in 0..5 {
                let (ctx, command) = (window.ctx.clone(), DisplayCommand::ShowDifference(difference));
                window.state_mut().apply(&ctx, command.into());
                press(&mut window, egui::Key::M);
                let bar = in_bar(&window);
                let first = bar[0].1;
                for (label, rect) in &bar {
                    assert!(
                        (rect.center().y - first.center().y).abs() < 3.0 && rect.right() <= width,
                        "{label} at {rect:?} in a window of {width}, quantity {key}, difference {difference}"
                    );
                }
            }
        }
        let visible = in_bar(&window).len();
        assert_eq!(visible == CONTROLS.len(), width >= 1330.0, "{visible} in {width}");
    }
    // Undo is in the menu of a narrow window, and works there.
    window.set_size(vec2(900.0, 600.0));
    let before = window.state().parts.model.view.exposure_ev;
    press(&mut window, egui::Key::E);
    assert_eq!(window.state().parts.model.view.exposure_ev, before + 0.5);
    assert!(window.query_by_label("Undo").is_none());
    window.get_by_label("Menu").click();
    window.run_steps(6);
    window.get_by_label("Undo").click();
    window.run_steps(3);
    assert_eq!(window.state().parts.model.view.exposure_ev, before);
}

#[needs(adapter)]
#[test]
fn panes_stay_in_their_places_when_a_texel_is_pinned() {
    let mut window = built_in();
    window.set_size(vec2(1360.0, 860.0));
    window.run_steps(6);
    let all = [GROUND_TRUTH, "1  blurred normals", "2  wrong roughness"];
    let corners = |window: &Window<'_>| all.map(|title| pane(window, title).left_top());
    let before = corners(&window);
    assert_eq!(before[0].x, before[2].x, "a grid of 2 x 2");
    let at = pane(&window, GROUND_TRUTH).center();
    window.event(egui::Event::PointerMoved(at));
    window.run_steps(2);
    press(&mut window, egui::Key::I);
    window.run_steps(6);
    window.get_by_label("Pinned texels");
    let after = corners(&window);
    assert_eq!(before, after);
    // The saved view has the same arrangement.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("view.png");
    let size = window.state().picture_size();
    let (ctx, what) = (window.ctx.clone(), SaveKind::View);
    let command = WindowCommand::Save(SaveRequest { kind: what, path: path.clone(), size, handles: true });
    window.state_mut().apply(&ctx, command.into());
    wait(&mut window, "the file", |app| !app.messages().is_empty());
    let saved = image::open(&path).unwrap().to_rgb8();
    let titled = |x: f32, y: f32| {
        // The title of the ground truth has the accent colour; those below each other are text.
        let area = image::imageops::crop_imm(&saved, x as u32, y as u32, 100, 20).to_image();
        area.pixels().filter(|pixel| pixel.0[0] > 150).count() > 20
    };
    let offset = after[0].y - 24.0;
    assert!(titled(after[2].x, after[2].y - 24.0 - offset), "the third pane is below the first");
}

#[needs(adapter)]
#[test]
fn copy_puts_the_view_on_the_clipboard_in_its_pixels() {
    let mut window = built_in();
    // The range of the difference beside the panes is there, and the losses in their titles.
    wait(&mut window, "the statistics", |app| app.difference_statistics().is_some());
    wait(&mut window, "the losses", |app| app.losses().is_some());
    window.run_steps(2);
    let size = window.state().picture_size();
    let key = egui::Key::C;
    let modifiers = egui::Modifiers::COMMAND | egui::Modifiers::SHIFT;
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
    let (ctx, what) = (window.ctx.clone(), SaveKind::View);
    window.state_mut().apply(&ctx, WindowCommand::DismissMessages.into());
    window.state_mut().apply(
        &ctx,
        WindowCommand::Save(SaveRequest { kind: what, path: path.clone(), size, handles: true }).into(),
    );
    wait(&mut window, "the file", |app| !app.messages().is_empty());
    let saved = image::open(&path).unwrap().to_rgb8();
    let differ = saved.pixels().zip(&copied.pixels).filter(|(a, b)| a.0 != [b.r(), b.g(), b.b()]).count();
    assert_eq!(differ, 0, "pixels differ");
}

/// The tooltip under the pointer at `at`, if one appears.
fn tooltip(window: &mut Window<'_>, at: egui::Pos2) -> bool {
    window.event(egui::Event::PointerMoved(at));
    // Longer than it takes to appear.
    window.run_steps(60);
    let open = window.ctx.memory(|memory| {
        let mut layers = memory.layer_ids();
        layers.any(|layer| layer.order == egui::Order::Tooltip && memory.areas().is_visible(&layer))
    });
    window.event(egui::Event::PointerMoved(egui::pos2(1.0, 1.0)));
    window.run_steps(3);
    open
}

/// The controls of the window: role and label, and the centre.
fn controls(window: &Window<'_>) -> Vec<(String, egui::Pos2)> {
    use egui::accesskit::Role;
    let roles = [
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
    roles.into_iter().flat_map(of).collect()
}

/// The labels of the `chosen` controls without a tooltip.
fn without_tooltip(
    window: &mut Window<'_>,
    controls: &[(String, egui::Pos2)],
    chosen: impl Fn(&str, egui::Pos2) -> bool,
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
        let ctx = window.ctx.clone();
        let behind: Vec<String> = controls(&window).into_iter().map(|(label, _)| label).collect();
        window.state_mut().apply(&ctx, show(true));
        window.run_steps(10);
        let controls = controls(&window);
        // egui draws the button that closes a window.
        let of_dialog =
            |label: &str| label != "Button Close window" && !behind.iter().any(|one| one == label);
        let count = controls.iter().filter(|(label, _)| of_dialog(label)).count();
        assert!(count >= 3, "{name}: {controls:#?}");
        let without = without_tooltip(&mut window, &controls, |label, _| of_dialog(label));
        assert!(without.is_empty(), "{name}: no tooltip for {without:#?}");
        window.state_mut().apply(&ctx, show(false));
        window.run_steps(3);
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
            wait(&mut window, "the directions", |app| app.direction_map().is_some_and(|map| map.side == 64));
            wait(&mut window, "the scenes", |app| app.listed_scenes().is_some());
            for _ in 0..500 {
                window.step();
                std::thread::sleep(std::time::Duration::from_millis(20));
                if window.query_by_label("roughness of wrong roughness: 60.1% of the loss").is_some() {
                    break;
                }
            }
        }
        let controls = controls(&window);
        assert!(controls.len() > 30, "{name}: {}", controls.len());
        let inside = egui::Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1360.0, 1000.0));
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
        drag(window, egui::PointerButton::Primary, rect, vec2(0.5, 0.5), vec2(0.85, 0.8));
    };
    move_light(&mut window);
    assert_eq!(exposure(&window), start, "a drag leaves it");
    // A preset of the light is a scene that is chosen.
    more(&mut window);
    window.get_by_label("Grazing left").click();
    window.run_steps(4);
    press(&mut window, egui::Key::Escape);
    let chosen = exposure(&window);
    assert_ne!(chosen, start);
    window.get_by_label("Exposure follows").click();
    window.run_steps(4);
    assert_eq!(exposure(&window), chosen, "for the same light it is the same");
    move_light(&mut window);
    assert_ne!(exposure(&window), chosen, "it follows");
    window.get_by_label("Brighter").click();
    window.run_steps(4);
    let by_hand = exposure(&window);
    more(&mut window);
    window.get_by_label("Grazing left").click();
    window.run_steps(4);
    press(&mut window, egui::Key::Escape);
    move_light(&mut window);
    assert_eq!(exposure(&window), by_hand, "a hand has set it");
}
