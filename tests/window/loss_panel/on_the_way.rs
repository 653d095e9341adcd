//! Losses that are still being computed: progress, earlier values, cancelling.

use super::*;

/// Asks for far more scenes than a test can wait for, and waits for the first numbers.
fn start_a_long_one(window: &mut Window<'_>) {
    wait(window, "the first loss", |app| app.losses().is_some());
    enter(window, "Distant scenes", "50000");
    enter(window, "Near-field scenes", "100000");
    see(window, "refining, ");
}

/// The losses that the window shows, as it shows them.
fn shown(window: &Window<'_>) -> Vec<String> {
    let labels = window.query_all_by_label_contains("[").filter_map(|node| node.value());
    labels.filter(|text| text.starts_with('[')).collect()
}

#[needs(adapter)]
fn an_accuracy_is_asked_for_and_kept_and_a_time_gives_a_loss_with_its_interval() {
    let mut window = by_scenes();
    wait(&mut window, "the first loss", |app| app.losses().is_some());
    click(&mut window, "Accuracy");
    assert!(window.query_by_label("Distant scenes").is_none(), "no field that does not matter");
    enter(&mut window, "Accuracy", "6");
    wait(&mut window, "the loss", |app| app.losses().is_some());
    for loss in window.state().losses().unwrap() {
        let [low, high] = loss.estimate.interval95.unwrap();
        let share = 0.5 * (high - low) / loss.estimate.mean;
        assert!(share <= 0.06, "{} is known to {share} only", loss.prediction);
        assert!(loss.per_scene.len() > 9, "+-6% of these takes more than 9 scenes");
    }
    assert!(!has(&window, "Not within"));

    click(&mut window, "Time");
    enter(&mut window, "Time", "20");
    assert_eq!(window.state().parts.model.settings.loss.time_ms, 20);
    wait(&mut window, "the loss", |app| app.losses().is_some());
    assert!(window.state().losses().unwrap()[0].estimate.interval95.is_some());
}

#[needs(adapter)]
fn a_long_loss_tightens_and_cancelling_keeps_what_was_reached() {
    let mut window = by_scenes();
    start_a_long_one(&mut window);
    let error = |window: &Window<'_>| {
        let first = shown(window).swap_remove(0);
        let ends: Vec<f64> =
            first.trim_matches(['[', ']']).split(", ").map(|end| end.parse().unwrap()).collect();
        100.0 * (ends[1] - ends[0]) / (ends[1] + ends[0])
    };
    let mut errors = Vec::new();
    for _ in 0..600 {
        errors.push(error(&window));
        // The first that is seen may be below 5% already.
        if errors.last() < Some(&5.0) && errors.last() < errors.first() {
            break;
        }
        window.step();
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    errors.dedup();
    assert!(errors.len() > 1 && errors.last() < Some(&5.0), "the error in percent was {errors:?}");
    click(&mut window, "Cancel loss");
    window.get_by_label_contains("Cancelled: ±");
    assert_eq!(window.state().losses(), None, "a cancelled loss is not the one that was asked for");
    let kept = shown(&window);
    assert_eq!(kept.len(), 1, "the interval of the chosen prediction");
    rest(&mut window, 5);
    assert_eq!(shown(&window), kept, "nothing goes on after the end");
}

#[needs(adapter)]
fn escape_cancels_and_a_change_starts_again() {
    let mut window = by_scenes();
    start_a_long_one(&mut window);
    press(&mut window, egui::Key::Escape);
    window.get_by_label_contains("Cancelled: ±");
    click(&mut window, "Auto");
    enter(&mut window, "Near-field scenes", "12");
    enter(&mut window, "Distant scenes", "3");
    window.get_by_label_contains("Stale");
    click(&mut window, "Auto");
    wait(&mut window, "the loss", |app| app.losses().is_some());
    assert_eq!(window.state().losses().unwrap()[0].per_scene.len(), 15);
    assert!(!has(&window, "Cancelled"));
}

#[needs(adapter)]
fn a_newer_request_supersedes_a_running_one() {
    let mut window = by_scenes();
    start_a_long_one(&mut window);
    enter(&mut window, "Near-field scenes", "60");
    enter(&mut window, "Distant scenes", "31");
    wait(&mut window, "the newer loss", |app| app.losses().is_some());
    let expected = expected(&Sampling { near: 60, distant: 31, ..Sampling::default() });
    assert_eq!(window.state().losses().unwrap(), expected);
    window.get_by_label_contains("from 60 + 31 scenes in");
}
