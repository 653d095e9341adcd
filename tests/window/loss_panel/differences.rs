//! Which prediction is better, and whether that is known.

use svbrdf::loss::Estimate;
use svbrdf::model::sampler::Sampler;

use super::*;

/// The difference of the built-in predictions' losses, second less first, and with `swapped` first less second.
fn difference(swapped: bool) -> String {
    let params = LossParams::default();
    let losses = expected(&params);
    let (first, second) = (&losses[1].per_scene, &losses[0].per_scene);
    let (first, second) = if swapped { (second, first) } else { (first, second) };
    let scenes = params.scenes().unwrap();
    let [mean, error, _] = Estimate::of_difference(Sampler::Random, &scenes, first, second).texts();
    format!("{mean} +- {error}")
}

#[test]
fn the_difference_to_the_chosen_prediction_has_its_sign_its_error_and_its_verdict() {
    let Some(mut window) = built_in() else { return };
    wait(&mut window, "the loss", |app| app.losses().is_some());
    window.get_by_label("2 wrong roughness less 1 blurred normals");
    window.get_by_label("better");
    window.get_by_label(&difference(false));
    // The planted fault: the difference of the other order is not what is shown.
    assert!(window.query_by_label(&difference(true)).is_none());
    press(&mut window, egui::Key::Num2);
    window.get_by_label("1 blurred normals less 2 wrong roughness");
    window.get_by_label("worse");
    window.get_by_label(&difference(true));
    assert!(window.query_by_label(&difference(false)).is_none());
}

#[test]
fn what_cannot_be_told_apart_is_said_so() {
    let Some(mut window) = built_in() else { return };
    enter(&mut window, "Near-field scenes", "2");
    enter(&mut window, "Distant scenes", "2");
    wait(&mut window, "the loss", |app| app.losses().is_some());
    window.get_by_label("not told apart");
    assert!(window.query_by_label("better").is_none());
}
