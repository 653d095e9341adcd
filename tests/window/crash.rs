//! The end of a window: a panic in a frame, or a lost device.

use super::*;

/// A dropped file whose path nobody survives.
#[derive(Debug)]
struct Planted;

impl egui::DroppedFile for Planted {
    fn path(&self) -> &Path {
        panic!("a planted fault")
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        panic!("a planted fault")
    }
}

#[needs(adapter)]
fn a_panic_or_a_lost_device_closes_the_window_with_its_reason_and_no_frame_is_drawn_after_it() {
    type End = fn(&mut Window<'_>);
    let ends: [(End, &str); 2] = [
        (|window| window.input_mut().dropped_files.push(Arc::new(Planted)), "a planted fault"),
        (|window| window.state().parts.gpu.as_ref().unwrap().gpu.lose(), "the graphics device was lost ("),
    ];
    for (end, reason) in ends {
        let guard = CrashGuard::default();
        let mut window = guarded_window(ViewerOptions::default(), guard.clone(), 1.0);
        assert!(!guard.has_crashed());
        end(&mut window);
        window.step();
        let output = window.output();
        assert!(output.shapes.is_empty() || reason.contains("planted"), "nothing is drawn on a lost device");
        let commands = &output.viewport_output[&egui::ViewportId::ROOT].commands;
        assert!(commands.contains(&egui::ViewportCommand::Close), "{commands:?}");
        let exposure = window.state().parts.model.view.exposure_ev;
        window.key_press(egui::Key::E);
        window.step();
        assert_eq!(window.state().parts.model.view.exposure_ev, exposure);
        drop(window);
        let session = guard.loss().map(|loss| loss.session.unwrap());
        assert_eq!(session.is_some(), reason.contains("lost"), "a restart goes on with the session");
        assert!(session.is_none_or(|session| session.materials.len() == 3 && session.exposure == exposure));
        let error = guard.outcome(Ok(Ok(()))).unwrap_err().to_string();
        assert!(error.contains(reason), "{error}");
    }
}
