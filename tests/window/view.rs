//! Light and view: what the mouse grabs, what stays in sight, what small windows show.

use svbrdf_viewer::model::command::{DisplayCommand, MaterialsCommand};
use svbrdf_viewer::model::view::state::Layout;

use super::*;

#[needs(adapter)]
#[test]
fn the_wipe_line_wins_over_the_handle_of_the_view() {
    let mut window = built_in();
    press(&mut window, egui::Key::C);
    assert_eq!(window.state().parts.model.view.display.layout, Layout::Wipe);
    let title = "Pane 1  blurred normals";
    let rect = window.get_by_label(title).rect();
    let before = window.state().parts.model.view.scene;
    // The eye is in the middle, and so is the line.
    drag_primary(&mut window, rect, vec2(0.5, 0.5), vec2(0.3, 0.5));
    assert_eq!(window.state().parts.model.view.scene, before, "neither light nor view has moved");
    let wipe = window.state().parts.model.view.display.wipe;
    assert!((wipe - 0.3).abs() < 0.01, "the line is at {wipe}");
    // Without the line there, the same drag moves the view.
    drag_primary(&mut window, rect, vec2(0.5, 0.5), vec2(0.6, 0.5));
    let scene = window.state().parts.model.view.scene;
    assert!(scene.view[0] > 0.1, "{scene:?}");
}

#[needs(adapter)]
#[test]
fn a_hidden_handle_of_the_view_is_not_grabbed() {
    let mut window = built_in();
    let rect = pane(&window, GROUND_TRUTH);
    more(&mut window);
    click(&mut window, "View handle");
    press(&mut window, egui::Key::Escape);
    let before = window.state().parts.model.view.scene;
    drag_primary(&mut window, rect, vec2(0.5, 0.5), vec2(0.4, 0.4));
    let after = window.state().parts.model.view.scene;
    assert_eq!(after.view, before.view);
    assert_ne!(after.light, before.light);
}

#[needs(adapter)]
#[test]
fn a_narrow_window_has_no_side_panel_until_asked_and_room_for_the_readout() {
    let mut window = built_in();
    // While it is computed, there is another button.
    wait(&mut window, "the loss", |app| app.losses().is_some());
    for (size, columns) in [(vec2(640.0, 420.0), &["gt "][..]), (vec2(700.0, 500.0), &["gt ", "1 "])] {
        window.set_size(size);
        window.run_steps(20);
        assert!(window.query_by_label("Near-field").is_none());
        let at = pane(&window, GROUND_TRUTH).center();
        hover(&mut window, at);
        assert!(texel_read(&window).is_some());
        columns.iter().for_each(|start| drop(column(&window, start)));
        press(&mut window, egui::Key::B);
        window.run_steps(20);
        let panes = [GROUND_TRUTH, PREDICTIONS[0]].map(|title| pane(&window, title).right());
        let panes = panes.into_iter().fold(0.0, f32::max);
        for label in ["Near-field", "Distant", "Compute loss"] {
            let rect = window.get_by_label(label).rect();
            assert!(rect.left() >= panes && rect.right() <= size.x, "{label} at {rect:?}, panes to {panes}");
        }
        press(&mut window, egui::Key::B);
    }
    window.set_size(vec2(1200.0, 800.0));
    window.run_steps(20);
    window.get_by_label("Near-field");
    assert!(window.state().parts.model.settings.side_panel, "the choice of wide windows is their own");
}

/// The pane that changes is drawn into the window, and from the next frame on its kept pixels are copied.
#[needs(adapter)]
#[test]
fn a_pane_that_changes_has_the_pixels_that_are_kept_of_it() {
    for scale in [1.0, 1.25] {
        let mut window = scaled_window(ViewerOptions::default(), scale);
        press(&mut window, egui::Key::L);
        window.run_steps(8);
        let rect = pane(&window, GROUND_TRUTH);
        let [left, top, right, bottom] = [rect.left(), rect.top(), rect.right(), rect.bottom()];
        let [left, top, right, bottom] = [left, top, right, bottom].map(|side| (side * scale).round() as u32);
        let pixels = |window: &mut Window<'_>| {
            let picture = window.render().unwrap();
            image::imageops::crop_imm(&picture, left, top, right - left, bottom - top).to_image()
        };
        let mut seen = vec![pixels(&mut window)];
        for exposure in [2.0, 3.5] {
            window.state_mut().parts.model.view.exposure_ev = exposure;
            for _ in 0..4 {
                window.step();
                seen.push(pixels(&mut window));
            }
        }
        let changes = seen.windows(2).filter(|two| two[0] != two[1]).count();
        assert_eq!(changes, 2, "scale {scale}");
    }
}

#[needs(adapter)]
#[test]
fn a_texel_covers_a_pixel_also_where_the_material_is_repeated() {
    let mut window = built_in();
    for key in [egui::Key::Num0, egui::Key::T, egui::Key::Num0] {
        press(&mut window, key);
        if key == egui::Key::Num0 {
            assert!((magnification(&window) - 1.0).abs() < 0.01, "screen pixels per texel");
        } else {
            assert!((magnification(&window) - 0.5).abs() < 0.01, "a planted fault: copies are half as large");
        }
    }
}

/// The titles that the frame that has been drawn gives the window.
fn titles(window: &Window<'_>) -> Vec<String> {
    let commands = &window.output().viewport_output[&egui::ViewportId::ROOT].commands;
    let title = |command: &egui::ViewportCommand| match command {
        egui::ViewportCommand::Title(title) => Some(title.clone()),
        _ => None,
    };
    commands.iter().filter_map(title).collect()
}

#[needs(adapter)]
#[test]
fn the_window_is_named_after_what_is_open() {
    let mut window = built_in();
    assert!(titles(&window).is_empty(), "it is told once");
    let mut seen = Vec::new();
    for closed in [2, 1] {
        let ctx = window.ctx.clone();
        window.state_mut().apply(&ctx, MaterialsCommand::Close(closed).into());
        for _ in 0..4 {
            window.step();
            seen.extend(titles(&window));
        }
    }
    assert_eq!(seen, ["worn tiles, blurred normals - svbrdf", "worn tiles - svbrdf"]);
}

#[needs(adapter)]
#[test]
fn a_picture_on_the_clipboard_is_refused_with_the_reason() {
    let mut window = built_in();
    let picture = egui::ColorImage::filled([2, 2], egui::Color32::RED);
    window.event(egui::Event::PasteImage(std::sync::Arc::new(picture)));
    see(&mut window, "The clipboard holds a picture");
}

#[needs(adapter)]
#[test]
fn the_magnification_is_a_number_that_can_be_typed() {
    let mut window = built_in();
    let before = window.state().parts.model.view.display.framing;
    enter(&mut window, "Magnification", "4");
    assert!((magnification(&window) - 4.0).abs() < 0.01, "{}", magnification(&window));
    apply(&mut window, DisplayCommand::Undo);
    assert_eq!(window.state().parts.model.view.display.framing, before);
}
