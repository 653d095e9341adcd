//! A panic in a frame: the window closes as at a normal exit, and what it was is reported.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::*;

#[test]
#[cfg_attr(not(has_adapter), ignore = "no graphics adapter")]
fn a_panic_in_a_panel_closes_the_window_and_draws_no_frame_again() {
    let mut window = built_in();
    // What a frame asks for is asked for within the panels.
    let is_planted = Arc::new(AtomicBool::new(true));
    let planted = is_planted.clone();
    window.ctx.set_request_repaint_callback(move |_| {
        assert!(!planted.swap(false, Ordering::SeqCst), "a planted fault");
    });
    window.key_press(egui::Key::E);
    window.step();
    assert!(!is_planted.load(Ordering::SeqCst), "the fault was met");
    assert!(window.state().has_crashed());
    let exposure = window.state().model.view.exposure_ev;
    let commands = &window.output().viewport_output[&egui::ViewportId::ROOT].commands;
    assert!(commands.contains(&egui::ViewportCommand::Close), "{commands:?}");
    window.key_press(egui::Key::E);
    window.step();
    assert_eq!(window.state().model.view.exposure_ev, exposure, "no frame is drawn after it");
}
