//! Sessions with random values, a panic in a frame, a lost device.

use serde_json::Value;

use super::*;

/// Sessions of the usual run.
const SESSIONS: u64 = 40;

/// The places of all values that contain no others.
fn leaves(value: &Value, place: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(all) => all.iter().for_each(|(key, one)| leaves(one, &format!("{place}/{key}"), found)),
        Value::Array(all) => {
            all.iter().enumerate().for_each(|(index, one)| leaves(one, &format!("{place}/{index}"), found));
        }
        _ => found.push(place.to_owned()),
    }
}

/// A session with one or two values replaced: a number mostly by another number.
fn damaged(session: &Value, random: &mut ChaCha8Rng) -> Value {
    let numbers = [0.0, -0.0, -1.0, 0.5, 1e-30, 1e9, -1e9, 1e39, 1e308].map(|number| json!(number));
    let long = "\u{202e}".repeat(300);
    let others = json!([0, -1, 4_294_967_296_u64, i64::MIN, u64::MAX, true, null, [], {}, "", long]);
    let (mut damaged, mut places) = (session.clone(), Vec::new());
    leaves(session, "", &mut places);
    let is_number = |place: &&String| session.pointer(place).is_some_and(Value::is_f64);
    let of_numbers: Vec<_> = places.iter().filter(is_number).cloned().collect();
    for _ in 0..=below(random, 2) {
        let is_other = below(random, 3) == 0;
        let (places, replacements) = if is_other {
            (&places, others.as_array().unwrap().as_slice())
        } else {
            (&of_numbers, &numbers[..])
        };
        if let Some(value) = damaged.pointer_mut(&places[below(random, places.len())]) {
            *value = replacements[below(random, replacements.len())].clone();
        }
    }
    damaged
}

#[needs(adapter)]
fn sessions_of_random_values_open_or_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = built_in();
    let whole: Value = serde_json::from_str(
        &window.model().session().text(&folder.path().join("s.svbrdf-session.json")).unwrap(),
    )
    .unwrap();
    let (mut opened, mut random) = (0, ChaCha8Rng::seed_from_u64(30));
    for number in 0..SESSIONS {
        let path = folder.path().join(format!("{number}.svbrdf-session.json"));
        let text = damaged(&whole, &mut random).to_string();
        std::fs::write(&path, &text).unwrap();
        match Session::read(&path) {
            Ok(_) => opened += 1,
            Err(error) => assert!(error.to_string().contains(path.to_str().unwrap()), "{error}"),
        }
        drop_files(&mut window, [path]);
        window.run_steps(2);
        wait(&mut window, "the session", |app| !app.is_reading());
        assert!(!window.state().has_crashed(), "{text}");
        if number % 10 == 0 {
            window.render().unwrap();
        }
    }
    // Neither comparator is idle: some are opened, and some are refused.
    assert!((5..SESSIONS - 5).contains(&opened), "{opened} of {SESSIONS} sessions can be read");
}

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
