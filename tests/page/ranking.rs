//! The page of a ranking: names are data, and headings sort.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use svbrdf_core::model::convention::PRINTED;
use svbrdf_evaluate::dataset::{
    DatasetReading, DatasetReport, DatasetSettings, KnownLoss, Mark, MaterialResult, Method, Pick,
    PredictionResult, Remark, Source,
};
use svbrdf_evaluate::metrics::MetricSelection;
use svbrdf_evaluate::report::Compared;
use svbrdf_evaluate::robust::{RobustReport, Scores};
use svbrdf_files::convention::ChosenConvention;
use svbrdf_needs::needs;
use svbrdf_page::ranking;

use super::browser::Page;
use super::noise;

const HOSTILE: &str = "</td></script><img src=x onerror=window.hit=1><!--\"'>{{sections}}\u{202e}";
/// When the page can be used.
pub const READY: &str = "document.querySelectorAll('[aria-sort]').length > 0";

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
        target_error: Some(0.01),
        scenes: None,
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
fn the_page_tells_whether_the_order_survives() {
    let html = page();
    let section = &html[html.find("id=\"robust\"").unwrap()..];
    let section = &section[..section.find("</section>").unwrap()];
    for text in [
        "depends on the question: it changes under epsilon 0.1",
        "-0.2100 to -0.1900 by default, 0.1900 to 0.2100 under epsilon 0.1",
        "<td>-1.00</td>",
    ] {
        assert!(section.contains(text), "{text}: {section}");
    }
}

#[test]
fn names_add_no_elements_to_a_ranking() {
    let html = page();
    let count = |text: &str| html.matches(text).count();
    assert_eq!([count("<script"), count("</script"), count("<img"), count("<tbody")], [1, 1, 0, 5]);
    assert!(count("&lt;/td&gt;&lt;/script&gt;") >= 5, "{html}");
    assert!(html.contains("<td>5</td><td>0</td></tr>"), "the marks of ours, and none of the other method");
    assert!(html.contains("<td>lacks materials</td>") && html.contains("<td>best</td>"));
    let names = html.matches(r#"<th scope="col">ours</th>"#).count();
    assert_eq!(names, 3, "metrics, marks and materials have a column for each method by its name");
    assert!(html.contains("not compared") && !html.contains("<td>worse</td>"));
}

#[needs(browser)]
fn a_click_on_a_heading_sorts_and_the_next_one_turns_it_around() {
    let mut page = Page::open_until(&page(), [1000, 900], READY);
    let names = |page: &mut Page| {
        let names = page.evaluate(
            "[...document.querySelectorAll('section[aria-labelledby=materials] tbody th')].map(e => e.textContent)",
        );
        let number = |name: &Value| {
            ["m10", "m9", "</td", "a", "b"].iter().position(|start| name.as_str().unwrap().starts_with(start))
        };
        names.as_array().unwrap().iter().map(|name| number(name).unwrap()).collect::<Vec<_>>()
    };
    let click = |page: &mut Page, column: usize| {
        page.evaluate(&format!(
            "document.querySelectorAll('section[aria-labelledby=materials] thead button')[{column}].click()"
        ));
    };
    assert_eq!(names(&mut page), [0, 1, 2, 3, 4]);
    click(&mut page, 0);
    assert_eq!(names(&mut page), [2, 3, 4, 1, 0], "m9 comes before m10");
    click(&mut page, 1);
    assert_eq!(names(&mut page), [0, 4, 3, 1, 2]);
    click(&mut page, 1);
    assert_eq!(names(&mut page), [2, 1, 3, 4, 0]);
    for sorted in [[0, 4, 3, 1, 2], [1, 3, 4, 0, 2]] {
        click(&mut page, 2);
        assert_eq!(names(&mut page), sorted, "what failed comes last");
    }
    let state = page.evaluate("[...document.querySelectorAll('section[aria-labelledby=materials] th[aria-sort]')].map(e => e.ariaSort)");
    assert_eq!(state, json!(["none", "none", "descending"]));
    let (requests, complaints) = page.traffic();
    assert!(
        requests.iter().all(|address| address.starts_with("file://")) && complaints.is_empty(),
        "{complaints:?}"
    );
    assert_eq!(page.evaluate("window.hit === undefined"), json!(true));
}
