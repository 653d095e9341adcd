//! The loss panel: the numbers of one go, and what belongs to them.

mod differences;
mod on_the_way;
mod tabs;

use svbrdf_core::loss::{Comparison, Outcome, Request, Sampling};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::progress::Progress;
use svbrdf_files::samples;

use super::*;

/// What the core gives for the built-in predictions.
fn expected(sampling: &Sampling) -> Outcome {
    let samples = samples::load::<f32>().unwrap();
    let predictions: Vec<&Material<f32>> = samples.predictions.iter().map(|r| &r.material).collect();
    let comparison = Comparison::new(&samples.ground_truth.material, &predictions, PRINTED).unwrap();
    comparison.run(&Request::Scenes(*sampling), &Progress::default()).unwrap()
}

/// Types `text` into the number called `name`.
fn enter(window: &mut Window<'_>, name: &str, text: &str) {
    let number = egui::accesskit::Role::SpinButton;
    window.get_by_role_and_label(number, name).click();
    window.run_steps(2);
    window.get_by_role_and_label(number, name).type_text(text);
    press(window, egui::Key::Enter);
}

#[needs(adapter)]
#[test]
fn the_loss_button_yields_the_number_that_the_core_gives() {
    let mut window = by_scenes();
    window.get_by_label("Auto").click();
    window.run_steps(3);
    press(&mut window, egui::Key::Escape);
    enter(&mut window, "Seed", "7");
    assert_eq!(window.state().parts.model.settings.loss.seed, 7);
    assert_eq!(window.state().losses(), None, "the loss of another seed is no loss of this one");
    window.get_by_label("Compute loss").click();
    window.run_steps(2);
    wait(&mut window, "the loss", |app| app.losses().is_some());
    let expected = expected(&Sampling { seed: 7, ..Sampling::default() }).losses;
    assert_eq!(window.state().losses().unwrap(), expected);
    for loss in &expected {
        let [low, high] = loss.estimate.interval95.unwrap();
        window.get_by_label(&format!("{:.2}", loss.estimate.mean));
        let half = 0.5 * (high - low);
        let half = if half < 0.1 { format!("±{half:.4}") } else { format!("±{half:.2}") };
        assert!(window.query_all_by_label(&half).next().is_some(), "no {half}");
    }
    // Intervals of about ±20% have one digit more than their means.
    let [low, high] = expected[0].estimate.interval95.unwrap();
    window.get_by_label(&format!("[{low:.3}, {high:.3}]"));
}

#[needs(adapter)]
#[test]
fn many_scenes_end_with_the_bits_of_one_go() {
    let mut window = by_scenes();
    enter(&mut window, "Near-field scenes", "60");
    enter(&mut window, "Distant scenes", "31");
    wait(&mut window, "the loss", |app| app.losses().is_some());
    let expected = expected(&Sampling { near: 60, distant: 31, ..Sampling::default() }).losses;
    assert_eq!(window.state().losses().unwrap(), expected);
    window.get_by_label_contains("from 60 + 31 scenes in");
}

#[needs(adapter)]
#[test]
fn auto_computes_again_when_the_convention_changes() {
    let mut window = by_scenes();
    wait(&mut window, "the first loss", |app| app.losses().is_some());
    let before = window.state().losses().unwrap()[0].estimate.mean;
    window.get_by_role_and_label(egui::accesskit::Role::ComboBox, "Convention").click();
    window.run_steps(4);
    window.get_by_label("guided-2020").click();
    window.run_steps(4);
    assert_eq!(window.state().parts.model.view.convention, "guided-2020");
    wait(&mut window, "the second loss", |app| app.losses().is_some());
    assert!(window.state().losses().unwrap()[0].estimate.mean > before);
}

#[needs(adapter)]
#[test]
fn copy_puts_on_the_clipboard_what_the_command_line_prints() {
    let mut window = by_scenes();
    wait(&mut window, "the loss", |app| app.losses().is_some());
    window.get_by_label("Copy losses").click();
    let mut copied = String::new();
    for _ in 0..4 {
        window.step();
        for command in &window.output().platform_output.commands {
            if let egui::OutputCommand::CopyText(text) = command {
                copied.clone_from(text);
            }
        }
    }
    let output = crate::surroundings::command(program())
        .args(["loss", "--near", "6", "--distant", "3"])
        .output()
        .unwrap();
    assert_eq!(copied, String::from_utf8(output.stdout).unwrap());
    assert!(copied.contains("wrong roughness - blurred normals"), "{copied}");
}

/// The program `svbrdf` of the same build: cargo gives its path to the tests of its own package only.
fn program() -> std::path::PathBuf {
    let test = std::env::current_exe().unwrap();
    let program =
        test.parent().unwrap().with_file_name("svbrdf").with_extension(std::env::consts::EXE_EXTENSION);
    assert!(program.is_file(), "{} is missing: `cargo test --workspace` builds it", program.display());
    program
}
