//! Which prediction is better, and whether that is known.

use super::*;

/// Mean of the second built-in prediction's loss minus the first one's, over 6 + 3 independent scenes, written out from the
/// losses per scene.
fn expected_difference() -> f64 {
    let losses = expected(&Sampling::default());
    let per_scene = losses[1].per_scene.iter().zip(&losses[0].per_scene);
    let differences: Vec<f64> = per_scene.map(|(second, first)| second - first).collect();
    differences.iter().sum::<f64>() / differences.len() as f64
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
    let mean = expected_difference();
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
