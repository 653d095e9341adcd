//! The page of a ranking: names are data.

use serde_json::json;

use svbrdf_core::loss::Request;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_evaluate::dataset::{DatasetReading, DatasetReport, DatasetSettings, Mark, Pick, Remark, Source};
use svbrdf_evaluate::metrics::MetricSelection;
use svbrdf_evaluate::report::Compared;
use svbrdf_evaluate::robust::{RobustReport, Scores};
use svbrdf_files::convention::ChosenConvention;
use svbrdf_page::ranking;

use super::noise;
use crate::rank::result;

const HOSTILE: &str = "</td></script><img src=x onerror=window.hit=1><!--\"'>{{sections}}\u{202e}";
/// When the page can be read.
pub const READY: &str = "document.readyState === 'complete' && location.protocol === 'file:'";

/// A ranking of two methods over five materials.
pub fn page() -> String {
    let losses = [("m10", 0.1, Some(0.25)), ("m9", 0.2, Some(0.31)), (HOSTILE, 0.3, None)];
    let losses = losses.into_iter().chain([("a", 0.15, Some(0.28)), ("b", 0.12, Some(0.26))]);
    let results = losses.clone().enumerate().map(|(index, (material, ours, theirs))| {
        let mut result = result(index, &[("ours", Some(ours)), (HOSTILE, theirs)]);
        result.material = material.to_owned();
        for one in &mut result.predictions {
            let mark = Mark { hypothesis: HOSTILE.to_owned(), value: json!(1), share: 0.5, remedy: None };
            one.marks = Some(if one.method == "ours" { vec![mark] } else { Vec::new() });
            one.path = HOSTILE.to_owned();
            one.error = one.error.take().map(|_| HOSTILE.to_owned());
            one.reading = vec![Remark { doubt: Some(HOSTILE.to_owned()), text: HOSTILE.to_owned() }];
        }
        result
    });
    let methods = ["ours", HOSTILE].map(|name| (Some(name.to_owned()), HOSTILE.into()));
    let source = Source::folders(HOSTILE.into(), methods.to_vec());
    let request = Request::Accuracy { target: 0.01, seed: 0 };
    let settings = DatasetSettings::new(source, ChosenConvention::default(), request, &[]);
    let settings = DatasetSettings {
        materials: losses.map(|(material, ..)| material.to_owned()).collect(),
        methods: ["ours", HOSTILE].map(str::to_owned).to_vec(),
        metrics: Some(MetricSelection::default()),
        diagnose: true,
        ..settings
    };
    let report = DatasetReport::new(settings, DatasetReading::default(), results.collect(), Pick::Fixed);
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
