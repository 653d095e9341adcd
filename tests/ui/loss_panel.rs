//! The loss panel.

use svbrdf::loss::{self, LossParams};
use svbrdf::material::Material;
use svbrdf::progress::Progress;
use svbrdf::samples;

use super::*;

#[test]
fn the_loss_button_yields_the_number_that_the_core_gives() {
    let Some(mut window) = built_in() else { return };
    window.get_by_label("Auto").click();
    window.run_steps(3);
    press(&mut window, egui::Key::Escape);
    window.get_by_role_and_label(egui::accesskit::Role::SpinButton, "Seed").click();
    window.run_steps(2);
    window.get_by_role_and_label(egui::accesskit::Role::SpinButton, "Seed").type_text("7");
    press(&mut window, egui::Key::Enter);
    assert_eq!(window.state().settings.loss.seed, 7);
    assert_eq!(window.state().losses(), None, "the loss of another seed is no loss of this one");
    window.get_by_label("Compute loss").click();
    window.run_steps(2);
    wait(&mut window, "the loss", |app| app.losses().is_some());
    let samples = samples::load::<f32>().unwrap();
    let predictions: Vec<&Material<f32>> = samples.predictions.iter().map(|r| &r.material).collect();
    let params = LossParams { seed: 7, ..LossParams::default() };
    let expected = loss::losses_f32(
        &samples.ground_truth.material,
        &predictions,
        &params.scenes().unwrap(),
        &params.convention,
        &Progress::default(),
    )
    .unwrap();
    assert_eq!(window.state().losses().unwrap(), expected);
    for loss in &expected {
        let [mean, error, interval] = loss.estimate.texts();
        window.get_by_label(&format!("{mean} +- {error}"));
        window.get_by_label(&interval);
    }
}

#[test]
fn auto_computes_again_when_the_convention_changes() {
    let Some(mut window) = built_in() else { return };
    wait(&mut window, "the first loss", |app| app.losses().is_some());
    let before = window.state().losses().unwrap()[0].estimate.mean;
    window.get_by_role_and_label(egui::accesskit::Role::ComboBox, "Convention").click();
    window.run_steps(4);
    window.get_by_label("guided-2020").click();
    window.run_steps(4);
    assert_eq!(window.state().state.convention, "guided-2020");
    wait(&mut window, "the second loss", |app| app.losses().is_some());
    assert!(window.state().losses().unwrap()[0].estimate.mean > before);
}
