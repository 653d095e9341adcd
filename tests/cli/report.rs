//! `svbrdf report`: the page and its file. `tests/page` opens it in a browser.

use std::fs;

use super::*;

/// The data of the figure.
fn data(page: &str) -> Value {
    let start = page.find(r#"id="data">"#).unwrap() + r#"id="data">"#.len();
    let end = start + page[start..].find("</script>").unwrap();
    serde_json::from_str(&page[start..end]).unwrap()
}

/// The page that `report` writes.
fn page(folder: &Path, args: &str) -> String {
    succeed(folder, &format!("report {args} -o r.html"));
    text_of(folder, "r.html")
}

#[test]
fn a_report_has_the_numbers_of_loss_and_blame() {
    let folder = folder();
    let options = "gt.png a.png b.png --target-error 2% --seed 3 --convention guided-2020";
    let page = page(folder.path(), options);
    let [losses, shares] =
        ["loss", "blame"].map(|command| json_of(folder.path(), &format!("{command} {options}")));
    let attributed = shares["attributions"].as_array().unwrap().iter();
    let shapley =
        attributed.flat_map(|one| one["maps"].as_array().unwrap().iter().map(|map| &map["shapley"]["mean"]));
    let numbers = losses["results"].as_array().unwrap().iter().map(|result| &result["loss"]).chain(shapley);
    for number in numbers {
        assert_has(&page, &[&format!("{:.6}", number.as_f64().unwrap())]);
    }
    let command = format!("<pre><code>svbrdf report {options} -o r.html</code></pre>");
    assert_has(&page, &["convention guided-2020", "seed 3", &command]);
    assert_eq!(page.matches("data-scene=").count(), 6);
}

#[test]
fn a_prediction_without_an_error_and_a_material_alone_have_a_page() {
    let folder = folder();
    let of_pair = page(folder.path(), "gt.png gt.png --target-error 30%");
    assert!(of_pair.contains("gt 0.000") && !of_pair.contains("NaN"));
    let alone = page(folder.path(), "gt.png");
    assert!(alone.contains("Repeating the numbers") && !alone.contains("Rendering loss"));
}

#[test]
fn a_report_of_a_session_begins_as_it_was_saved_and_has_its_losses_unless_an_accuracy_is_specified() {
    let folder = folder();
    let at = folder.path();
    let scene = json!({"kind": "distant", "view": [0.0, 0.1, 1.0], "light": [0.5, 0.5, 1.0]});
    let session = json!({
        "svbrdf-session": 1, "convention": "multi-image-2019", "scene": scene, "exposure": 1.5,
        "materials": [{"path": "gt.png"}, {"path": "a.png"}],
        "window": {"loss": {"ask": "Scenes", "near": 5, "distant": 2, "seed": 4},
            "view": {"quantity": "Roughness", "difference": true, "layout": "Wipe", "prediction": 7, "wipe": 0.25}},
    });
    fs::write(at.join("s.svbrdf-session.json"), session.to_string()).unwrap();
    let data = data(&page(at, "s.svbrdf-session.json --figure"));
    let start = &data["start"];
    assert_eq!([&start["scene"], &start["exposure"]], [&scene, &json!(1.5)]);
    assert_eq!(json!([start["quantity"], start["difference"]]), json!(["roughness", true]));
    assert_eq!(json!([start["layout"], start["prediction"], start["wipe"]]), json!(["wipe", 0, 0.25]));
    assert_eq!(data["epsilon"], json!(0.1));
    for options in ["", "--seed 9"] {
        let page = page(at, &format!("s.svbrdf-session.json {options}"));
        let losses = losses_as_json(at, &format!("s.svbrdf-session.json {options}"));
        let loss = format!("{:.6}", losses["results"][0]["loss"].as_f64().unwrap());
        assert_has(&page, &[&loss, "5 near-field and 2 distant"]);
    }
    assert!(!page(at, "s.svbrdf-session.json --target-error 20%").contains("5 near-field and 2 distant"));
}

#[test]
fn a_figure_begins_with_the_light_of_the_options_and_has_no_findings() {
    let folder = folder();
    let page = page(folder.path(), "gt.png a.png --figure --light 0.1,0.2,1 --distant");
    assert_eq!(data(&page)["start"]["scene"]["light"], json!([0.1, 0.2, 1.0]));
    assert!(page.contains(r#"id="canvas""#) && !page.contains("<h1>") && !page.contains("<h2"));
}
