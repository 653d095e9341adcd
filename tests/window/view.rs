//! Light and view: what the mouse grabs, what stays in sight, what small windows show.

use super::*;
use svbrdf_viewer::model::material::textures::Uploaded;

#[needs(adapter)]
fn the_wipe_line_wins_over_the_handle_of_the_view() {
    let mut window = built_in();
    press(&mut window, egui::Key::C);
    assert_eq!(window.view().display.layout, Layout::Wipe);
    let title = "Pane 1  blurred normals";
    let rect = window.get_by_label(title).rect();
    let before = window.scene();
    // The eye is in the middle, and so is the line.
    drag_primary(&mut window, rect, vec2(0.5, 0.5), vec2(0.3, 0.5));
    assert_eq!(window.scene(), before, "neither light nor view has moved");
    let wipe = window.view().display.wipe;
    assert!((wipe - 0.3).abs() < 0.01, "the line is at {wipe}");
    // Without the line there, the same drag moves the view.
    drag_primary(&mut window, rect, vec2(0.5, 0.5), vec2(0.6, 0.5));
    let scene = window.scene();
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
    let before = window.view().display.framing;
    enter(&mut window, "Magnification", "4");
    assert!((magnification(&window) - 4.0).abs() < 0.01, "{}", magnification(&window));
    edit(&mut window, history::undo);
    assert_eq!(window.view().display.framing, before);
}

const BADGE: &str = "Reduced display: one of 2 x 2 texels";

/// Whether a text with this start is drawn.
fn draws(shape: &egui::Shape, start: &str) -> bool {
    match shape {
        egui::Shape::Vec(shapes) => shapes.iter().any(|shape| draws(shape, start)),
        egui::Shape::Text(text) => text.galley.text().starts_with(start),
        _ => false,
    }
}

fn badges(window: &Window<'_>) -> usize {
    window.output().shapes.iter().filter(|clipped| draws(&clipped.shape, BADGE)).count()
}

fn losses(window: &mut Window<'_>) -> Vec<f64> {
    wait(window, "the losses", |app| app.losses().is_some());
    window.losses().unwrap().iter().map(|loss| loss.estimate.mean).collect()
}

#[needs(adapter)]
fn a_material_for_which_there_is_no_room_is_displayed_reduced_with_a_badge_and_its_losses_are_whole() {
    let mut window = by_scenes();
    let (rect, expected) = (pane(&window, GROUND_TRUTH), losses(&mut window));
    let before = pixels(&mut window, rect);
    assert_eq!(badges(&window), 0);
    let parts = &mut window.state_mut().parts;
    let gpu = &parts.gpu.as_ref().unwrap().gpu;
    let first = &mut parts.model.materials.all[0];
    let mut read = first.read.part(first.material().clone(), None);
    read.uploaded = Some(Uploaded::too_large(gpu, read.material()));
    first.read = Arc::new(read);
    window.run_steps(6);
    assert_eq!(badges(&window), 3, "all panes are reduced alike");
    let after = pixels(&mut window, rect);
    assert!(after != before, "other texels are displayed");
    let far = after.pixels().zip(before.pixels()).filter(|(a, b)| a.0[0].abs_diff(b.0[0]) > 60).count();
    assert!(far * 5 < (rect.area() as usize), "it is the same material: {far} pixels differ");
    assert_eq!(losses(&mut window), expected);
}
