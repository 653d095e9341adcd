//! Which prediction is better, and whether that is known.

use super::*;

/// Mean and standard error of the second built-in prediction's loss minus the first one's, over 6 + 3 independent
/// scenes: written out from the losses per scene, with near-field and distant scenes as two strata.
fn expected_difference() -> [f64; 2] {
    let losses = expected(&Sampling::default()).losses;
    let per_scene = losses[1].per_scene.iter().zip(&losses[0].per_scene);
    let differences: Vec<f64> = per_scene.map(|(second, first)| second - first).collect();
    let all = differences.len() as f64;
    let (near, distant) = differences.split_at(6);
    let variance = [near, distant].map(|stratum| {
        let count = stratum.len() as f64;
        let mean = stratum.iter().sum::<f64>() / count;
        let spread = stratum.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (count - 1.0);
        (count / all).powi(2) * spread / count
    });
    [differences.iter().sum::<f64>() / all, (variance[0] + variance[1]).sqrt()]
}

/// Whether a label such as "-0.123456 +- 0.001234" gives these numbers, to the digits that it has.
fn gives(label: &str, expected: [f64; 2]) -> bool {
    let numbers = label.split(" +- ").map(|n| n.trim().parse::<f64>().unwrap());
    numbers.zip(expected).all(|(number, expected)| (number - expected).abs() <= 0.6e-6)
}

/// The difference in the panel: the last of its numbers with an error.
fn difference(window: &Window<'_>) -> String {
    window.query_all_by_label_contains(" +- ").filter_map(|node| node.value()).next_back().unwrap()
}

#[test]
#[cfg_attr(not(has_adapter), ignore = "no graphics adapter")]
fn the_difference_to_the_chosen_prediction_has_its_sign_its_error_and_its_verdict() {
    let mut window = built_in();
    wait(&mut window, "the loss", |app| app.losses().is_some());
    let [mean, error] = expected_difference();
    window.get_by_label("2 wrong roughness - 1 blurred normals");
    window.get_by_label("better");
    let label = difference(&window);
    assert!(gives(&label, [mean, error]), "{label}, expected {mean} +- {error}");
    // Planted faults: the other sign, a mean or an error that is slightly off.
    for wrong in [[-mean, error], [mean + 2e-6, error], [mean, error - 2e-6]] {
        assert!(!gives(&label, wrong), "{label} is not {wrong:?}");
    }
    press(&mut window, egui::Key::Num2);
    window.get_by_label("1 blurred normals - 2 wrong roughness");
    window.get_by_label("worse");
    let label = difference(&window);
    assert!(gives(&label, [-mean, error]), "{label}, expected {} +- {error}", -mean);
}

#[test]
#[cfg_attr(not(has_adapter), ignore = "no graphics adapter")]
fn what_cannot_be_told_apart_is_said_so() {
    let mut window = built_in();
    enter(&mut window, "Near-field scenes", "2");
    enter(&mut window, "Distant scenes", "2");
    wait(&mut window, "the loss", |app| app.losses().is_some());
    window.get_by_label("no significant difference");
    assert!(window.query_by_label("better").is_none());
}
