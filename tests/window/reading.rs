//! Reading on the worker, files that change, undo of the set of materials, and messages.

use std::time::Duration;

use image::imageops::{FilterType, resize};

use super::materials::SIDE;
use super::*;

/// Writes the built-in ground truth as a strip, enlarged.
fn write(path: &Path, times: u32) {
    resize(&strip(), 4 * SIDE * times, SIDE * times, FilterType::Nearest).save(path).unwrap();
}

/// The time until the window wants to be drawn again.
fn repaint_delay(window: &Window<'_>) -> Duration {
    window.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay
}

#[needs(adapter)]
fn the_window_rests_while_it_reads_and_shows_the_first_material_before_the_second_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let paths: Vec<_> = (0..4).map(|i| folder.path().join(format!("m{i}.png"))).collect();
    paths.iter().for_each(|path| write(path, 4));
    let mut window = built_in();
    // The loss of the built-in pair is computed while it is shown.
    wait(&mut window, "the loss", |app| app.losses().is_some());
    open(&mut window, paths.clone());
    window.run_steps(2);
    let (mut first_alone, mut longest) = (false, Duration::ZERO);
    while window.is_reading() {
        window.step();
        first_alone |= window.names() == ["m0"];
        longest = longest.max(repaint_delay(&window));
        std::thread::sleep(Duration::from_millis(2));
    }
    assert!(first_alone, "all materials came at once");
    // Another frame is wanted when a material has been read, and otherwise for the progress bar.
    assert!(longest >= Duration::from_millis(100), "frames are wanted every {longest:?}");
    assert_eq!(window.names(), ["m0", "m1", "m2", "m3"]);
    // What is cancelled brings nothing more, and what has been read stays.
    edit(&mut window, |model| model.settings.tab = Tab::Files);
    open(&mut window, paths);
    wait(&mut window, "the first material", |app| app.names() == ["m0"]);
    click(&mut window, "Cancel reading");
    let kept = window.names();
    assert!(!window.is_reading() && kept.len() < 4, "{kept:?}");
    std::thread::sleep(Duration::from_secs(1));
    window.run_steps(3);
    assert_eq!((window.names(), window.messages()), (kept, Vec::new()));
}

/// A window on the files of a ground truth and one prediction.
fn window_of_files() -> (tempfile::TempDir, [PathBuf; 2], Window<'static>) {
    let folder = tempfile::tempdir().unwrap();
    let paths = ["gt.png", "p.png"].map(|name| folder.path().join(name));
    paths.iter().for_each(|path| write(path, 1));
    let window = on_files(paths.clone());
    (folder, paths, window)
}

#[needs(adapter)]
fn a_material_whose_file_is_broken_is_marked_until_it_is_whole_again() {
    let (_folder, paths, mut window) = window_of_files();
    edit(&mut window, |model| model.settings.watch = true);
    window.run_steps(3);
    let whole = std::fs::read(&paths[1]).unwrap();
    std::fs::write(&paths[1], &whole[..whole.len() / 2]).unwrap();
    wait(&mut window, "the error", |app| !app.messages().is_empty());
    assert!(window.problem(1).is_some_and(|text| text.contains("Not read again")));
    std::fs::write(&paths[1], &whole).unwrap();
    wait(&mut window, "the whole file", |app| app.problem(1).is_none());
    assert!(window.messages().is_empty(), "it is settled: {:?}", window.messages());
}

#[needs(adapter)]
fn messages_take_no_room_from_the_panes() {
    let mut window = built_in();
    let before = pane(&window, GROUND_TRUTH);
    for name in ["no/such/a.png", "no/such/b.png", "no/such/c.png"] {
        open(&mut window, [name.into()]);
        wait(&mut window, "the error", |app| app.messages().iter().any(|text| text.contains(name)));
    }
    assert_eq!(pane(&window, GROUND_TRUTH), before);
    let message = window.messages()[0].clone();
    click(&mut window, &format!("Dismiss: {message}"));
    assert_eq!(window.messages().len(), 2);
    click(&mut window, "Dismiss all");
    assert!(window.messages().is_empty());
}

#[needs(adapter)]
fn a_prediction_replaced_by_one_of_another_size_makes_its_loss_stale() {
    let (_folder, paths, mut window) = window_of_files();
    wait(&mut window, "the loss", |app| app.losses().is_some());
    let stale = |window: &Window<'_>| ["1 (stale)  p", "p  (stale)"].map(|text| has(window, text));
    assert_eq!(stale(&window), [false, false]);
    edit(&mut window, |model| model.settings.watch = true);
    window.run_steps(3);
    write(&paths[1], 2);
    wait(&mut window, "the refusal", |app| app.messages().iter().any(|text| text.starts_with("Not opened")));
    window.run_steps(3);
    assert_eq!(stale(&window), [true, true], "the loss and the pane are of a file that is no more");
    window.get_by_label("Stale: materials or settings have changed.");
    write(&paths[1], 1);
    wait(&mut window, "the file of the right size", |app| app.problem(1).is_none());
    wait(&mut window, "its loss", |app| app.losses().is_some());
    window.run_steps(3);
    assert_eq!(stale(&window), [false, false]);
}
