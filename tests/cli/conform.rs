//! `svbrdf conform` and `svbrdf conventions`.

use std::path::Path;

use serde_json::Value;
use svbrdf_core::model::grammar::Description;
use svbrdf_core::model::named_conventions as named;
use svbrdf_core::progress::Progress;
use svbrdf_files::arrays::{self, Array};

use super::{fail, folder, json_of, run_in, succeed, text};
use crate::conform::{arrays as arrays_of, points, single};

/// Writes what the convention `name` renders at the probe points.
fn answered(path: &Path, name: &str) {
    let convention = named::all().iter().find(|convention| convention.name == name).unwrap();
    let radiance = |point| single(convention.terms.radiance(point, true));
    let exact: Vec<[f64; 3]> = points().iter().map(radiance).collect();
    arrays::write(path, &arrays_of(&exact), &Progress::default()).unwrap();
}

#[test]
fn the_verdict_is_printed_first_and_is_the_exit_code() {
    let folder = folder();
    answered(&folder.path().join("a.npz"), "svbrdf-estimation-2022");
    let stdout = succeed(folder.path(), "conform a.npz --convention svbrdf-estimation-2022");
    assert!(stdout.starts_with("The renderer conforms to `svbrdf-estimation-2022`."), "{stdout}");
    let output = run_in(folder.path(), "conform a.npz --write-convention mine.toml");
    assert_eq!(output.status.code(), Some(1));
    let stdout = text(&output.stdout);
    assert!(stdout.starts_with("As `printed`, but "), "{stdout}");
    assert!(stdout.contains("It renders as `svbrdf-estimation-2022` does."), "{stdout}");
    assert!(text(&output.stderr).contains("does not conform to printed"), "{output:?}");
    let mine: Description =
        std::fs::read_to_string(folder.path().join("mine.toml")).unwrap().parse().unwrap();
    assert_eq!(mine.terms.light.factor, 50.0);
    succeed(folder.path(), "conform a.npz --convention mine.toml");
}

#[test]
fn json_names_the_renderer_and_each_difference() {
    let folder = folder();
    answered(&folder.path().join("a.npz"), "gltf-viewer");
    let json = json_of(folder.path(), "conform a.npz --convention gltf-viewer --workflow metallic");
    assert_eq!(json["verdict"], "conforms");
    assert_eq!(json["renderer"]["specular"]["G"], "smith_correlated");
    assert_eq!(json["differences"].as_array().unwrap().len(), 0);
}

#[test]
fn an_answer_without_its_arrays_is_an_error() {
    let folder = folder();
    let stderr = fail(folder.path(), "conform none.npz", 1);
    assert!(stderr.contains("none.npz"), "{stderr}");
    succeed(folder.path(), "conform --points probe.npz");
    let stderr = fail(folder.path(), "conform probe.npz", 1);
    assert!(stderr.contains("expected the array `radiance`"), "{stderr}");
    let mut short = arrays::read(&folder.path().join("probe.npz")).unwrap();
    short.insert("radiance".to_owned(), Array::new(&[3, 3], vec![1.0; 9]));
    arrays::write(&folder.path().join("short.npz"), &short, &Progress::default()).unwrap();
    let stderr = fail(folder.path(), "conform short.npz", 1);
    assert!(stderr.contains("`radiance`: expected 392 x 3 values"), "{stderr}");
    let stderr = fail(folder.path(), "conform short.npz --convention printes", 64);
    assert!(stderr.contains("printes") && stderr.contains("material-palette-2024"), "{stderr}");
}

#[test]
fn a_convention_is_printed_as_it_is_read() {
    let folder = folder();
    let list = succeed(folder.path(), "conventions");
    for convention in named::all() {
        assert!(list.contains(&convention.name), "{list}");
        let text = succeed(folder.path(), &format!("conventions {}", convention.name));
        assert_eq!(text.parse::<Description>().unwrap(), *convention, "{text}");
    }
    std::fs::write(folder.path().join("bad.toml"), "[specular]\nG = \"smit\"\n").unwrap();
    let stderr = fail(folder.path(), "conventions bad.toml", 1);
    assert!(stderr.contains("smit") && stderr.contains("smith_correlated"), "{stderr}");
    std::fs::write(folder.path().join("bad.toml"), "[material]\nr_min = -1.0\n").unwrap();
    let stderr = fail(folder.path(), "conventions bad.toml", 1);
    assert!(stderr.contains("[material] r_min") && stderr.contains("-1"), "{stderr}");
}

#[test]
fn a_loss_and_a_page_take_any_convention_of_the_grammar() {
    let folder = folder();
    let loss = |args: &str| -> f64 {
        let text =
            succeed(folder.path(), &format!("loss gt.png a.png --near 2 --distant 1 --format json {args}"));
        let json: Value = serde_json::from_str(&text).unwrap();
        json["results"][0]["loss"].as_f64().unwrap()
    };
    let text = succeed(folder.path(), "conventions svbrdf-estimation-2022");
    std::fs::write(folder.path().join("mine.toml"), text.replace("\"1-F\"", "\"1\"")).unwrap();
    let [printed, other, mine] =
        ["", "--convention svbrdf-estimation-2022", "--convention mine.toml"].map(loss);
    assert!(printed > 0.0 && other > 0.0 && printed != other && mine != other, "{printed}, {other}, {mine}");
    let text = succeed(folder.path(), "loss gt.png a.png --near 2 --convention material-palette-2024");
    assert!(text.contains("convention material-palette-2024, epsilon 0.1"), "{text}");
    succeed(folder.path(), "report gt.png a.png -o r.html --convention mine.toml");
    let page = std::fs::read_to_string(folder.path().join("r.html")).unwrap();
    let drawn = ["printed", "guided-2020"].map(|name| page.contains(&format!(r#""drawn":"{name}""#)));
    assert!(drawn[0] != drawn[1], "the page says what it draws");
    let text = succeed(folder.path(), "map gt.png a.png -o m.png --near 2 --convention matfuse-2024");
    assert!(text.contains("mean squared difference of each texel"), "{text}");
    let text = succeed(folder.path(), "conventions matfuse-2024").replace("\"mse\"", "\"rmse\"");
    std::fs::write(folder.path().join("root.toml"), text).unwrap();
    let stderr = fail(folder.path(), "map gt.png a.png -o n.png --near 2 --convention root.toml", 1);
    assert!(
        stderr.contains("does not have the renderer or the norm of the convention root.toml"),
        "{stderr}"
    );
}
