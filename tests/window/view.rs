//! Light and view: what the mouse grabs, what stays in sight, what small windows show.

use svbrdf_viewer::model::command::DisplayCommand;
use svbrdf_viewer::model::view::state::Layout;

use super::*;

#[needs(adapter)]
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

/// The pane that changes is drawn into the window, and from the next frame on its kept pixels are copied.
#[needs(adapter)]
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
fn the_magnification_is_a_number_that_can_be_typed() {
    let mut window = built_in();
    let before = window.state().parts.model.view.display.framing;
    enter(&mut window, "Magnification", "4");
    assert!((magnification(&window) - 4.0).abs() < 0.01, "{}", magnification(&window));
    apply(&mut window, DisplayCommand::Undo);
    assert_eq!(window.state().parts.model.view.display.framing, before);
}
