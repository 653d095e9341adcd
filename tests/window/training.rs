//! Training runs: the steps of one prediction.

use svbrdf_core::loss::Comparison;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::{ReadOptions, read};
use svbrdf_viewer::model::command::{MaterialsCommand, TrainingCommand};

use super::materials::SIDE;
use super::*;

/// The built-in ground truth as a strip, with a roughness that is off by `off`.
fn strip(off: u8) -> Vec<u8> {
    let mut picture = super::materials::strip();
    for (x, _, pixel) in picture.enumerate_pixels_mut() {
        if x / SIDE == 2 {
            pixel.0 = pixel.0.map(|value| value.saturating_add(off));
        }
    }
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

fn step(folder: &Path, number: u64) -> PathBuf {
    folder.join(format!("run/pred_step{number:06}.png"))
}

/// A window on a ground truth and the folder of a run of three steps, which come closer to it.
fn window_of_run() -> (tempfile::TempDir, Window<'static>) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("run")).unwrap();
    std::fs::write(folder.path().join("gt.png"), strip(0)).unwrap();
    for (number, off) in [(100, 90), (200, 60), (300, 30)] {
        std::fs::write(step(folder.path(), number), strip(off)).unwrap();
    }
    let mut window = on_files(["gt.png", "run"].map(|name| folder.path().join(name)));
    wait(&mut window, "the newest step", |app| app.names() == ["gt", "pred, step 300"]);
    (folder, window)
}

fn steps(app: &App) -> Vec<u64> {
    app.training_runs().into_iter().flat_map(|(_, steps, _)| steps).collect()
}

#[needs(adapter)]
#[test]
fn a_folder_of_steps_is_one_prediction_whose_steps_have_their_losses() {
    let (folder, mut window) = window_of_run();
    wait(&mut window, "the steps", |app| app.training_runs() == [(1, vec![100, 200, 300], 300)]);
    wait(&mut window, "the losses", |app| app.step_losses(1).iter().all(Option::is_some));
    let request = window.state().parts.model.settings.loss.request();
    let open = |path: &Path| -> Material<f32> {
        read(path, &ReadOptions::AUTO, &Progress::default()).unwrap().material
    };
    let truth = open(&folder.path().join("gt.png"));
    for (loss, number) in window.state().step_losses(1).into_iter().zip([100, 200, 300]) {
        let prediction = open(&step(folder.path(), number));
        let comparison = Comparison::new(&truth, &[&prediction], PRINTED).unwrap();
        let expected = comparison.run(&request, &Progress::default()).unwrap().losses[0].estimate;
        assert_eq!(loss, Some(Ok(expected)), "{number}");
    }
    press(&mut window, egui::Key::Comma);
    wait(&mut window, "the step before", |app| app.names() == ["gt", "pred, step 200"]);
    window.get_by_label("1 newer, of 3");
    press(&mut window, egui::Key::Period);
    press(&mut window, egui::Key::Period);
    wait(&mut window, "the newest step", |app| app.names() == ["gt", "pred, step 300"]);
    window.get_by_label("newest, of 3");
    let place = window.get_by_label("Keep").rect();
    apply(&mut window, TrainingCommand::Show { index: 1, number: 100 });
    wait(&mut window, "the first step", |app| app.names() == ["gt", "pred, step 100"]);
    // What a person is about to click on stays in its place while losses come.
    for _ in 0..20 {
        assert_eq!(window.get_by_label("Keep").rect(), place);
        window.step();
    }
    window.get_by_label("Keep").click();
    wait(&mut window, "the step alone", |app| app.names() == ["gt", "pred, step 100", "pred_step000100"]);
    assert!(window.state().messages().is_empty(), "{:?}", window.state().messages());
}

#[needs(adapter)]
#[test]
fn new_steps_appear_when_they_are_complete_and_are_shown_unless_the_person_went_back() {
    let (folder, mut window) = window_of_run();
    apply(&mut window, MaterialsCommand::SetWatch(true));
    wait(&mut window, "the steps", |app| steps(app) == [100, 200, 300]);
    let whole = strip(10);
    let started = std::time::Instant::now();
    std::fs::write(step(folder.path(), 400), &whole[..whole.len() / 2]).unwrap();
    // Long enough that a half of it stands still and is read.
    while started.elapsed() < std::time::Duration::from_millis(3500) {
        window.step();
        let app = window.state();
        assert_eq!(app.names(), ["gt", "pred, step 300"]);
        assert!(app.messages().is_empty() && app.problems() == [None, None], "{:?}", app.messages());
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert_eq!(steps(window.state()), [100, 200, 300, 400], "it was not looked at");
    std::fs::write(step(folder.path(), 400), &whole).unwrap();
    wait(&mut window, "the new step", |app| app.names() == ["gt", "pred, step 400"]);
    press(&mut window, egui::Key::Comma);
    wait(&mut window, "the step before", |app| app.names() == ["gt", "pred, step 300"]);
    std::fs::write(step(folder.path(), 500), strip(5)).unwrap();
    wait(&mut window, "the next step", |app| steps(app) == [100, 200, 300, 400, 500]);
    window.run_steps(20);
    assert_eq!(window.state().names(), ["gt", "pred, step 300"], "the person went back");
    apply(&mut window, TrainingCommand::Show { index: 1, number: 500 });
    wait(&mut window, "the newest step", |app| app.names() == ["gt", "pred, step 500"]);
    std::fs::write(folder.path().join("run/other_step000100.png"), strip(50)).unwrap();
    let expected = ["gt", "pred, step 500", "other, step 100"];
    wait(&mut window, "the new run", |app| app.names() == expected);
    assert!(window.state().messages().is_empty(), "{:?}", window.state().messages());
}

/// Where only an old step has stood still yet, the window does not go back to it.
#[needs(adapter)]
#[test]
fn a_young_step_that_is_shown_stays() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("run")).unwrap();
    let now = std::time::SystemTime::now();
    let second = std::time::Duration::from_secs(1);
    // The new step stays young until the window has looked at the folder.
    for (number, time) in [(100, now - 3600 * second), (200, now + 4 * second)] {
        let path = step(folder.path(), number);
        std::fs::write(&path, strip(50)).unwrap();
        std::fs::File::options().write(true).open(&path).unwrap().set_modified(time).unwrap();
    }
    std::fs::write(folder.path().join("gt.png"), strip(0)).unwrap();
    let mut window = on_files(["gt.png", "run"].map(|name| folder.path().join(name)));
    wait(&mut window, "the newest step", |app| app.names() == ["gt", "pred, step 200"]);
    wait(&mut window, "both steps", |app| {
        assert_eq!(app.names(), ["gt", "pred, step 200"]);
        steps(app) == [100, 200]
    });
    apply(&mut window, MaterialsCommand::SetWatch(true));
    window.run_steps(20);
    assert_eq!(window.state().names(), ["gt", "pred, step 200"]);
}
