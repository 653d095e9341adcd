//! A panic in a frame, a lost device.

use super::*;

/// Loses the device of the window, of which the driver tells when it is asked.
fn lose_device(window: &mut Window<'_>) {
    let gpu = &window.state().parts.gpu.as_ref().unwrap().gpu;
    gpu.lose();
    assert_eq!([gpu.loss(), gpu.loss_by_now()].map(|loss| loss.is_some()), [false, true]);
}

#[needs(adapter)]
fn nothing_is_drawn_where_the_device_is_lost_within_the_frame() {
    let guard = CrashGuard::default();
    let mut window = guarded_window(ViewerOptions::default(), guard.clone(), 1.0);
    let gpu = window.state().parts.gpu.as_ref().unwrap().gpu.clone();
    window.input_mut().dropped_files.push(Arc::new(Dropped::LostDevice(gpu)));
    window.step();
    assert!(window.output().shapes.is_empty());
    let error = guard.outcome(Ok(Ok(()))).unwrap_err().to_string();
    assert!(error.contains("the graphics device was lost"), "{error}");
}

#[needs(adapter)]
fn hardware_that_is_there_again_is_used_once_the_window_is_idle() {
    let guard = CrashGuard::default();
    let mut window = guarded_window(ViewerOptions::default(), guard.clone(), 1.0);
    window.state().hardware.store(true, std::sync::atomic::Ordering::Relaxed);
    let moved = egui::Event::PointerMoved(egui::pos2(9.0, 9.0));
    for (pause, event, is_left) in [(1.0, None, false), (100.0, Some(moved), false), (100.0, None, true)] {
        let now = window.ctx.input(|i| i.time);
        window.input_mut().time = Some(now + pause);
        window.input_mut().events.extend(event);
        window.step();
        assert_eq!(guard.loss().is_some(), is_left, "after {pause} s");
    }
    let commands = &window.output().viewport_output[&egui::ViewportId::ROOT].commands;
    assert!(commands.contains(&egui::ViewportCommand::Close), "{commands:?}");
    let loss = guard.loss().unwrap();
    assert!(loss.reason.is_none() && loss.session.unwrap().materials.len() == 3);
}

#[needs(adapter)]
fn a_panic_or_a_lost_device_closes_the_window_with_its_reason_and_no_frame_is_drawn_after_it() {
    type End = fn(&mut Window<'_>);
    let ends: [(End, &str); 2] = [
        (|window| window.input_mut().dropped_files.push(Arc::new(Dropped::Panic)), "a planted fault"),
        (lose_device, "the graphics device was lost (no reason was given)"),
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
        let exposure = window.view().exposure_ev;
        window.key_press(egui::Key::E);
        window.step();
        assert_eq!(window.view().exposure_ev, exposure);
        drop(window);
        let session = guard.loss().map(|loss| loss.session.unwrap());
        assert_eq!(session.is_some(), reason.contains("lost"), "a restart goes on with the session");
        assert!(session.is_none_or(|session| session.materials.len() == 3 && session.exposure == exposure));
        let error = guard.outcome(Ok(Ok(()))).unwrap_err().to_string();
        assert!(error.contains(reason), "{error}");
    }
}
