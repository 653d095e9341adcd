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

/// A number in a table of the page.
fn cell(value: &Value) -> String {
    let x = value.as_f64().unwrap();
    let decimals = if x == 0.0 { 3 } else { (3.0 - x.abs().log10().floor()).clamp(0.0, 8.0) as usize };
    format!("<td>{x:.decimals$}</td>").replace('-', "\u{2212}")
}

#[test]
fn a_report_has_the_numbers_of_loss_and_blame() {
    let folder = folder();
    let options = "gt.png a.png b.png --target-error 2% --seed 3 --convention guided-2020";
    let page = page(folder.path(), options);
    let [losses, shares] =
        ["loss", "blame"].map(|command| json_of(folder.path(), &format!("{command} {options}")));
    for result in losses["results"].as_array().unwrap() {
        assert!(page.contains(&cell(&result["loss"])), "{result}");
    }
    for attribution in shares["attributions"].as_array().unwrap() {
        for map in attribution["maps"].as_array().unwrap() {
            assert!(page.contains(&cell(&map["shapley"]["mean"])), "{map}");
        }
    }
    let command = format!("<pre><code>svbrdf report {options} -o r.html</code></pre>");
    assert_has(&page, &["convention guided-2020", "seed 3", &command]);
    assert_eq!(page.matches("data-scene=").count(), 6);
    assert_eq!(page.matches(r#"<svg class="directions""#).count(), 2);
}

#[test]
fn a_prediction_without_an_error_has_no_shares_and_a_material_alone_no_findings() {
    let folder = folder();
    let of_pair = page(folder.path(), "gt.png gt.png --target-error 30%");
    assert!(of_pair.matches("<td>&ndash;</td>").count() == 4 && !of_pair.contains("NaN"));
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
        assert_has(&page, &[&cell(&losses["results"][0]["loss"]), "5 near-field and 2 distant"]);
    }
    assert!(!page(at, "s.svbrdf-session.json --target-error 20%").contains("5 near-field and 2 distant"));
}

#[test]
fn a_figure_begins_with_the_layout_and_the_light_of_the_options() {
    let folder = folder();
    let page = page(folder.path(), "gt.png a.png --figure --layout wipe --light 0.1,0.2,1 --distant");
    let start = &data(&page)["start"];
    assert_eq!([&start["layout"], &start["scene"]["light"]], [&json!("wipe"), &json!([0.1, 0.2, 1.0])]);
    // The figure alone has no findings.
    assert!(page.contains(r#"id="canvas""#) && !page.contains("<h1>") && !page.contains("<h2"));
}

#[test]
fn maps_are_halved_until_the_file_fits_and_this_is_said() {
    let folder = folder();
    for (name, seed) in [("large.png", 1), ("other.png", 2)] {
        write_tiles(&folder.path().join(name), 256, |x, y| match x / 256 {
            0 => [128, 140, 250],
            1 => {
                let hash = (x + 256 * y + 65_536 * seed).wrapping_mul(2_654_435_761);
                [24, 16, 8].map(|shift| ((hash ^ hash >> 15).wrapping_mul(2_246_822_519) >> shift) as u8)
            }
            2 => [120; 3],
            _ => [12; 3],
        });
    }
    // The pictures alone have 600,000 bytes.
    let most = 800_000;
    let args = format!("report large.png other.png -o r.html --max-size {most}B --target-error 30%");
    let output = run_in(folder.path(), &args);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let page = fs::read(folder.path().join("r.html")).unwrap();
    assert!(page.len() <= most, "{} bytes", page.len());
    let data = data(&text_of(folder.path(), "r.html"));
    let side = data["materials"][0]["width"].as_u64().unwrap();
    assert!(side < 256 && data["materials"][1]["width"] == json!(side), "{side}");
    assert_has(text(&output.stderr), &[&format!("are reduced to {side} x {side} texels")]);
}

#[test]
fn a_size_that_no_report_has_is_refused_with_the_least() {
    let folder = folder();
    for args in ["report gt.png a.png -o r.html --target-error 30%", "report gt.png a.png -o r.html --figure"]
    {
        let error = fail(folder.path(), &format!("{args} --max-size 1"), 1);
        let least: u64 = error.split(' ').find_map(|word| word.parse().ok()).unwrap();
        assert_has(&error, &["--max-size", "limit of 1;"]);
        let length = || fs::metadata(folder.path().join("r.html")).unwrap().len();
        // The page has the command that makes it, with the size.
        succeed(folder.path(), &format!("{args} --max-size {}", least + 16));
        assert!(length() <= least + 16 && length() > least / 2, "{least}: {}", length());
        fs::remove_file(folder.path().join("r.html")).unwrap();
    }
}
