//! The loss panel: the numbers of one go, and what belongs to them.

mod differences;
mod on_the_way;
mod tabs;

use svbrdf_core::loss::{Comparison, Loss, Request, Sampling};
use svbrdf_core::progress::Progress;

use super::materials::{losses, materials};
use super::*;

/// What the core gives for the built-in predictions.
fn expected(sampling: &Sampling) -> Vec<Loss> {
    losses(&Request::Scenes(*sampling))
}

#[needs(adapter)]
fn the_loss_button_yields_the_number_that_the_core_gives() {
    let mut window = by_scenes();
    click(&mut window, "Auto");
    press(&mut window, egui::Key::Escape);
    enter(&mut window, "Seed", "7");
    assert_eq!(window.state().parts.model.settings.loss.seed, 7);
    assert_eq!(window.state().losses(), None, "the loss of another seed is no loss of this one");
    click(&mut window, "Compute loss");
    wait(&mut window, "the loss", |app| app.losses().is_some());
    let expected = expected(&Sampling { seed: 7, ..Sampling::default() });
    assert_eq!(window.state().losses().unwrap(), expected);
    for loss in &expected {
        let [low, high] = loss.estimate.interval95.unwrap();
        window.get_by_label(&format!("{:.2}", loss.estimate.mean));
        let half = 0.5 * (high - low);
        let half = if half < 0.1 { format!("±{half:.4}") } else { format!("±{half:.2}") };
        assert!(has(&window, &half), "no {half}");
    }
    // Intervals of about ±20% have one digit more than their means.
    let [low, high] = expected[0].estimate.interval95.unwrap();
    window.get_by_label(&format!("[{low:.3}, {high:.3}]"));
}

/// The picker has all that have a name; what the grammar alone renders is drawn and computed, too.
#[needs(adapter)]
fn a_convention_of_the_grammar_is_drawn_and_has_the_loss_of_the_core() {
    let mut window = by_scenes();
    for name in ["gltf-viewer", "svbrdf-estimation-2022"] {
        choose(&mut window, "Convention", name);
        wait(&mut window, "the loss", |app| app.losses().is_some());
        let convention = window.state().parts.model.view.convention();
        assert!(convention.name == name && convention.member.is_some());
        let materials = materials();
        let predictions: Vec<_> = materials[1..].iter().collect();
        let comparison = Comparison::new(&materials[0], &predictions, convention).unwrap();
        let expected = comparison.run(&Request::default(), &Progress::default()).unwrap().losses;
        assert_eq!(window.state().losses().unwrap(), expected, "{name}");
    }
    assert!(window.state().parts.jobs.gpu.as_ref().unwrap().take_fault().is_none());
}

#[needs(adapter)]
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
pub fn program() -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let program =
        test.parent().unwrap().with_file_name("svbrdf").with_extension(std::env::consts::EXE_EXTENSION);
    assert!(program.is_file(), "{} is missing: `cargo test --workspace` builds it", program.display());
    program
}
