//! The page of a ranking: names are data.

use std::collections::BTreeMap;

use serde_json::json;

use svbrdf_core::loss::Request;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_evaluate::dataset::{
    DatasetReading, DatasetReport, DatasetSettings, KnownLoss, Mark, MaterialResult, Method, Pick,
    PredictionResult, Remark, Source,
};
use svbrdf_evaluate::metrics::MetricSelection;
use svbrdf_evaluate::report::Compared;
use svbrdf_evaluate::robust::{RobustReport, Scores};
use svbrdf_files::convention::ChosenConvention;
use svbrdf_page::ranking;

use super::noise;

const HOSTILE: &str = "</td></script><img src=x onerror=window.hit=1><!--\"'>{{sections}}\u{202e}";
/// When the page can be read.
pub const READY: &str = "document.readyState === 'complete' && location.protocol === 'file:'";

fn prediction(method: &str, loss: Result<f64, &str>) -> PredictionResult {
    let known = |loss: f64| KnownLoss {
        loss,
        standard_error: 0.01,
        interval95: [loss - 0.02, loss + 0.02],
        scenes: 500,
    };
    let mark = Mark { hypothesis: HOSTILE.to_owned(), value: json!(1), share: 0.5, remedy: None };
    let marks = Some(if method == "ours" { vec![mark] } else { Vec::new() });
    let metrics = BTreeMap::from([("normal_angle_mean".to_owned(), 12.5)]);
    PredictionResult {
        method: method.to_owned(),
        sample: 0,
        path: HOSTILE.to_owned(),
        known: loss.ok().map(known),
        error: loss.err().map(str::to_owned),
        reading: vec![Remark { doubt: Some(HOSTILE.to_owned()), text: HOSTILE.to_owned() }],
        metrics,
        marks,
    }
}

/// A ranking of two methods over five materials.
pub fn page() -> String {
    let names = ["m10", "m9", HOSTILE, "a", "b"];
    let ours = [0.1, 0.2, 0.3, 0.15, 0.12];
    let theirs = [Ok(0.25), Ok(0.31), Err(HOSTILE), Ok(0.28), Ok(0.26)];
    let results = (0..5).map(|index| MaterialResult {
        index,
        material: names[index].to_owned(),
        seed: 0,
        reading: Vec::new(),
        floor: None,
        predictions: vec![prediction("ours", Ok(ours[index])), prediction(HOSTILE, theirs[index])],
    });
    let method = |name: &str| Method { name: name.to_owned(), path: HOSTILE.into() };
    let settings = DatasetSettings {
        source: Source::Folders {
            ground_truths: HOSTILE.into(),
            methods: vec![method("ours"), method(HOSTILE)],
        },
        convention: ChosenConvention::default(),
        scenes: Request::Accuracy { target: 0.01, seed: 0 }.into(),
        seed: 0,
        materials: names.map(str::to_owned).to_vec(),
        methods: vec!["ours".to_owned(), HOSTILE.to_owned()],
        common: false,
        protocol: None,
        metrics: Some(MetricSelection::default()),
        diagnose: true,
    };
    let reading = DatasetReading::default();
    let report = DatasetReport::new(settings, reading, results.collect(), Pick::Fixed);
    ranking(&report, &[], Some(&robust()))
}

/// A pair of methods that changes sides.
fn robust() -> RobustReport {
    let answered = |question: &str, scores: [f64; 2]| {
        let interval =
            |a: usize, b: usize| Some([scores[a] - scores[b] - 0.01, scores[a] - scores[b] + 0.01]);
        Scores::new(question.to_owned(), scores.into(), interval)
    };
    let answers = [answered("printed", [0.1, 0.3]), answered("epsilon 0.1", [0.3, 0.1])];
    let compared = Compared::new(&noise(1), &PRINTED);
    RobustReport::of_answers(compared, Vec::new(), &["ours", HOSTILE].map(str::to_owned), &answers)
}

#[test]
fn names_add_no_elements_to_a_ranking() {
    let html = page();
    assert_eq!(html.matches("svbrdf rank --dataset").count(), 1, "the command stands once: {html}");
    let count = |text: &str| html.matches(text).count();
    assert_eq!([count("<script"), count("</script"), count("<img"), count("<tbody")], [0, 0, 0, 3]);
    assert!(count("&lt;/td&gt;&lt;/script&gt;") >= 5, "{html}");
    assert!(
        html.contains("not compared") && html.contains("ours (0.1740) has losses of 5 materials"),
        "{html}"
    );
}
