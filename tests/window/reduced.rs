//! Materials for which the adapter has no room: every n-th texel is displayed, and losses use all.

use svbrdf_viewer::jobs::reading::upload::Uploaded;

use super::*;

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
    window.state().losses().unwrap().iter().map(|loss| loss.estimate.mean).collect()
}

#[needs(adapter)]
fn a_material_for_which_there_is_no_room_is_displayed_reduced_with_a_badge_and_its_losses_are_whole() {
    let mut window = by_scenes();
    let (rect, expected) = (pane(&window, GROUND_TRUTH), losses(&mut window));
    let before = pixels(&mut window, rect);
    assert_eq!(badges(&window), 0);
    let parts = &mut window.state_mut().parts;
    let gpu = &parts.gpu.as_ref().unwrap().gpu;
    let first = &parts.model.materials.all[0];
    let uploaded = Uploaded::too_large(gpu, first.material());
    parts.jobs.uploads.add(first.id(), Some(Arc::new(uploaded)));
    window.run_steps(6);
    assert_eq!(badges(&window), 3, "all panes are reduced alike");
    let after = pixels(&mut window, rect);
    assert!(after != before, "other texels are displayed");
    let far = after.pixels().zip(before.pixels()).filter(|(a, b)| a.0[0].abs_diff(b.0[0]) > 60).count();
    assert!(far * 5 < (rect.area() as usize), "it is the same material: {far} pixels differ");
    assert_eq!(losses(&mut window), expected);
}
