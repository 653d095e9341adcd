//! The table of an analysis that has no section of its own: the other metrics.

use serde_json::json;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::analyses::AnyAnalysis;
use svbrdf_evaluate::report::{AnalysisInput, Cell, Reader};

use super::*;

#[needs(adapter)]
fn the_other_metrics_are_those_of_the_core_of_the_chosen_prediction() {
    let mut window = by_scenes();
    window.set_size(vec2(1200.0, 2400.0));
    tab(&mut window, "Why");
    for section in ["Would something trivial explain it?", "Which map", "Which scenes"] {
        click(&mut window, section);
    }
    let (request, materials) = (window.state().parts.model.settings.loss.listed_scenes(), materials());
    let rows = |prediction: usize| -> Vec<[String; 2]> {
        let metrics = AnyAnalysis::named("metrics").unwrap();
        let (ground_truth, predictions) = (&materials[0], vec![&materials[prediction]]);
        let input =
            AnalysisInput { ground_truth, predictions, convention: PRINTED, request: request.clone() };
        let table = metrics.run(&input, json!({}), &Progress::default()).unwrap().table(Reader::Person);
        table.rows.iter().map(|row| [0, 1].map(|column| Cell::text(&row[column]))).collect()
    };
    assert!(!has(&window, "rmse_roughness"), "it is folded at first");
    click(&mut window, "Other metrics");
    for (prediction, key) in [(1, egui::Key::Num1), (2, egui::Key::Num2)] {
        press(&mut window, key);
        let rows = rows(prediction);
        wait_in(&mut window, "the metrics", |window| has(window, &rows[0][1]));
        for text in rows.iter().flatten() {
            assert!(has(&window, text), "{text} of prediction {prediction} is not shown");
        }
    }
    assert_ne!(rows(1), rows(2), "a planted fault");
}
