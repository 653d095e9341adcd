//! The loss panel: numbers, differences, progress, cancelling, and a list of many predictions.

use svbrdf_core::loss::{Loss, Sampling};

use super::*;

/// What the core gives for the built-in predictions.
fn expected(sampling: &Sampling) -> Vec<Loss> {
    losses(&Request::Scenes(*sampling))
}

#[needs(adapter)]
fn the_loss_is_the_number_that_the_core_gives() {
    let mut window = by_scenes();
    enter(&mut window, "Seed", "7");
    assert_eq!(window.model().settings.loss.seed, 7);
    wait(&mut window, "the loss", |app| app.losses().is_some());
    let expected = expected(&Sampling { seed: 7, ..Sampling::default() });
    assert_eq!(window.losses().unwrap(), expected);
    for (index, loss) in expected.iter().enumerate() {
        let [low, high] = loss.estimate.interval95.unwrap();
        window.get_by_label(&format!("{:.3}", loss.estimate.mean));
        let title = window
            .get_by_label(&format!("Title {}  {}", index + 1, loss.prediction))
            .accesskit_node()
            .value();
        assert_eq!(title, Some(format!("loss {:.3}", loss.estimate.mean)));
        let half = 0.5 * (high - low);
        let half = if half < 0.1 { format!("±{half:.4}") } else { format!("±{half:.2}") };
        assert!(has(&window, &half), "no {half}");
    }
    // As many digits as the command line has, and one more in intervals.
    let [low, high] = expected[0].estimate.interval95.unwrap();
    window.get_by_label(&format!("[{low:.4}, {high:.4}]"));
}

/// The picker has all that have a name; what the grammar alone renders is drawn and computed, too.
#[needs(adapter)]
fn a_convention_of_the_grammar_is_drawn_and_has_the_loss_of_the_core() {
    let mut window = by_scenes();
    for name in ["gltf-viewer", "svbrdf-estimation-2022"] {
        choose(&mut window, "Convention", name);
        wait(&mut window, "the loss", |app| app.losses().is_some());
        let convention = window.view().convention();
        assert!(convention.name == name && convention.member.is_some());
        let materials = materials();
        let predictions: Vec<_> = materials[1..].iter().collect();
        let comparison = Comparison::new(&materials[0], &predictions, convention).unwrap();
        let expected = comparison.run(&Request::default(), &Progress::default()).unwrap().losses;
        assert_eq!(window.losses().unwrap(), expected, "{name}");
    }
    assert!(window.jobs().gpu.as_ref().unwrap().take_fault().is_none());
}

/// The program `svbrdf` of the same build: cargo gives its path to the tests of its own package only.
pub fn program() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let program =
        test.parent().unwrap().with_file_name("svbrdf").with_extension(std::env::consts::EXE_EXTENSION);
    assert!(program.is_file(), "{} is missing: `cargo test --workspace` builds it", program.display());
    program
}

/// Whether a label such as "-0.117" gives this number, to the digits that it has.
fn gives(label: &str, expected: f64) -> bool {
    let digits = label.split('.').nth(1).unwrap().len() as i32;
    (label.parse::<f64>().unwrap() - expected).abs() <= 0.501 * 10_f64.powi(-digits)
}

/// The difference in the panel, whose verdict is this: the number with a sign.
fn difference(window: &Window<'_>, verdict: &str) -> String {
    let text = window.get_by_label_contains(verdict).value().unwrap();
    text.split(' ').next().unwrap().replace('\u{2212}', "-")
}

#[needs(adapter)]
fn the_difference_to_the_chosen_prediction_has_its_sign_and_its_verdict() {
    let mut window = by_scenes();
    wait(&mut window, "the loss", |app| app.losses().is_some());
    // Over 6 + 3 independent scenes, from the losses per scene.
    let losses = expected(&Sampling::default());
    let per_scene = losses[1].per_scene.iter().zip(&losses[0].per_scene);
    let mean = per_scene.map(|(second, first)| second - first).sum::<f64>() / 9.0;
    window.get_by_label("vs 1");
    let label = difference(&window, "\u{2193} better");
    assert!(gives(&label, mean), "{label}, expected {mean}");
    // Planted faults: the other sign, a mean that is off by more than half a digit.
    assert!(!gives(&label, -mean) && !gives(&label, mean * 1.2), "{label}");
    press(&mut window, egui::Key::Num2);
    window.get_by_label("vs 2");
    let label = difference(&window, "\u{2191} worse");
    assert!(gives(&label, -mean), "{label}, expected {}", -mean);
}

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
    for loss in window.losses().unwrap() {
        let [low, high] = loss.estimate.interval95.unwrap();
        let share = 0.5 * (high - low) / loss.estimate.mean;
        assert!(share <= 0.06, "{} is known to {share} only", loss.prediction);
        assert!(loss.per_scene.len() > 9, "+-6% of these takes more than 9 scenes");
    }
    assert!(!has(&window, "Not within"));

    click(&mut window, "Time");
    enter(&mut window, "Time", "20");
    assert_eq!(window.model().settings.loss.time_ms, 20);
    wait(&mut window, "the loss", |app| app.losses().is_some());
    assert!(window.losses().unwrap()[0].estimate.interval95.is_some());
}

#[needs(adapter)]
fn a_long_loss_tightens_and_keeps_what_was_reached_until_a_newer_one_is_there() {
    let mut window = by_scenes();
    start_a_long_one(&mut window);
    let error = |window: &Window<'_>| {
        let first = shown(window).swap_remove(0);
        let mut ends = first.trim_matches(['[', ']']).split(", ").map(|end| end.parse::<f64>().unwrap());
        let [low, high] = [(); 2].map(|()| ends.next().unwrap());
        100.0 * (high - low) / (high + low)
    };
    let start = error(&window);
    // The first that is seen may be below 5% already.
    wait_in(&mut window, "an error below 5%", |window| error(window) < start.min(5.0));
    click(&mut window, "Cancel loss");
    window.get_by_label_contains("Cancelled: ±");
    assert_eq!(window.losses(), None, "a cancelled loss is not the one that was asked for");
    let kept = shown(&window);
    assert_eq!(kept.len(), 1, "the interval of the chosen prediction");
    rest(&mut window, 5);
    assert_eq!(shown(&window), kept, "nothing goes on after the end");
    click(&mut window, "Compute loss");
    see(&mut window, "refining, ");
    // A change starts again, and a newer request supersedes a running one.
    enter(&mut window, "Near-field scenes", "90000");
    see(&mut window, "refining, ");
    press(&mut window, egui::Key::Escape);
    window.get_by_label_contains("Cancelled: ±");
    enter(&mut window, "Near-field scenes", "80000");
    see(&mut window, "refining, ");
    enter(&mut window, "Near-field scenes", "60");
    enter(&mut window, "Distant scenes", "31");
    wait(&mut window, "the newer loss", |app| app.losses().is_some());
    let expected = expected(&Sampling { near: 60, distant: 31, ..Sampling::default() });
    assert_eq!(window.losses().unwrap(), expected);
    window.get_by_label_contains("from 60 + 31 scenes in");
    assert!(!has(&window, "Cancelled"));
}

#[needs(adapter)]
fn of_many_predictions_every_one_is_reached_by_keys_and_named_by_what_differs() {
    let folder = tempfile::tempdir().unwrap();
    let names = (0..14).map(|i| format!("a_long_name_of_an_experiment_seed_{i:03}.png"));
    let paths = ["gt.png".to_owned()].into_iter().chain(names).map(|name| folder.path().join(name));
    let mut window = on_files(paths.inspect(|path| soak::write(path, 0)));
    wait(&mut window, "all of them", |app| app.names().len() == 15);
    wait(&mut window, "the loss", |app| app.losses().is_some());
    for expected in [13, 12] {
        press_with(&mut window, Modifiers::COMMAND, egui::Key::ArrowUp);
        assert_eq!(window.view().display.prediction, expected);
    }
    assert!(has(&window, "4  \u{2026}003"), "names end with what differs");
    let displayed = window.displayed();
    let titles: Vec<_> =
        displayed.contents().into_iter().map(|one| displayed.names_of(one, 9)[0].clone()).collect();
    assert_eq!(titles[0], "GROUND TRUTH  gt");
    assert!((1..15).all(|i| titles[i] == format!("{i}  \u{2026}{:03}", i - 1)), "so do titles: {titles:?}");
}

#[needs(adapter)]
fn copy_puts_on_the_clipboard_what_the_command_line_prints() {
    let mut window = by_scenes();
    wait(&mut window, "the loss", |app| app.losses().is_some());
    window.get_by_label("Copy losses").click();
    let copied = commands(&mut window).into_iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text),
        _ => None,
    });
    let copied = copied.expect("a text is copied");
    let output = crate::surroundings::command(program())
        .args(["loss", "--near", "6", "--distant", "3"])
        .output()
        .unwrap();
    assert_eq!(copied, String::from_utf8(output.stdout).unwrap());
    assert!(copied.contains("wrong roughness - blurred normals"), "{copied}");
}

/// Lengths that the code of a convention renders, and this program does not.
#[needs(adapter)]
fn losses_of_stored_normals_of_another_length_have_a_note() {
    let folder = tempfile::tempdir().unwrap();
    let paths = ["gt.png", "a.png"].map(|name| folder.path().join(name));
    write_packed(&paths[0], 8, |_, _, _| [150, 140, 180]);
    write_packed(&paths[1], 8, |_, _, _| [150, 150, 180]);
    let mut window = on_files(paths);
    let has_note =
        |window: &Window<'_>| window.query_all_by_label_contains("normals as stored").next().is_some();
    wait(&mut window, "the loss", |app| app.losses().is_some());
    assert!(!has_note(&window));
    choose(&mut window, "Convention", "svbrdf-estimation-2022");
    see(&mut window, "normals as stored");
}
