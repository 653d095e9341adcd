//! `svbrdf conform` and `svbrdf conventions`.

use std::path::Path;

use serde_json::Value;
use svbrdf_core::model::grammar::Description;
use svbrdf_core::model::named_conventions as named;
use svbrdf_core::progress::Progress;
use svbrdf_files::arrays::{self, Array};

use super::{fail, folder, run_in, succeed, text};
use crate::conform::{Stored, points};

/// Writes what the convention `name` renders at the probe points.
fn answered(path: &Path, name: &str, stored: Stored) {
    let convention = named::all().iter().find(|convention| convention.name == name).unwrap();
    let exact: Vec<[f64; 3]> = points().iter().map(|point| convention.terms.radiance(point, true)).collect();
    arrays::write(path, &crate::conform::arrays(&stored.of(&exact, 1)), &Progress::default()).unwrap();
}

#[test]
fn points_are_at_most_400() {
    let folder = folder();
    succeed(folder.path(), "conform --points probe.npz");
    let points = arrays::read(&folder.path().join("probe.npz")).unwrap();
    assert!((300..=400).contains(&points["normal"].shape[0]), "{:?}", points["normal"].shape);
    for name in
        ["diffuse", "specular", "roughness", "base_color", "metallic", "light", "view", "picture_normal"]
    {
        assert!(points.contains_key(name), "{name}");
    }
}

#[test]
fn the_verdict_is_printed_first_and_is_the_exit_code() {
    let folder = folder();
    answered(&folder.path().join("a.npz"), "svbrdf-estimation-2022", Stored::Single);
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
    answered(&folder.path().join("a.npz"), "gltf-viewer", Stored::Half);
    let text =
        succeed(folder.path(), "conform a.npz --convention gltf-viewer --workflow metallic --format json");
    let json: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(
        (&json["verdict"], &json["renderer"]["specular"]["G"]),
        (&"conforms".into(), &"smith_correlated".into())
    );
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
    assert!(page.contains("vh_min") && !page.contains("light_z_floor"), "the page has another shader");
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

#[test]
fn a_renderer_that_writes_pictures_is_known_by_them() {
    let folder = folder();
    let at = folder.path();
    succeed(at, "conform --points probe");
    let stderr = fail(at, "conform --points probe", 1);
    assert!(stderr.contains("name a folder that is not there yet"), "{stderr}");
    let stderr = fail(at, "conform probe", 1);
    assert!(stderr.contains("expected 0/radiance.exr or 0/radiance.png, found neither"), "{stderr}");
    let scenes = std::fs::read_to_string(at.join("probe/scenes.json")).unwrap();
    let scenes: Value = serde_json::from_str(&scenes).unwrap();
    for (number, scene) in scenes["scenes"].as_array().unwrap().iter().enumerate() {
        let of = |end: &str| {
            let numbers = scene[end].as_array().unwrap().iter().map(|x| x.as_f64().unwrap().to_string());
            numbers.collect::<Vec<_>>().join(",")
        };
        let (view, light) = (of("view"), of("light"));
        let maps = "--read workflow=specular,normal-y=up,albedo=linear";
        for folder in ["probe", "display"] {
            std::fs::create_dir_all(at.join(format!("{folder}/{number}"))).unwrap();
            let output =
                format!("-o {folder}/{number}/radiance.{}", if folder == "probe" { "exr" } else { "png" });
            succeed(at, &format!("render probe/{number} --view={view} --light={light} {output} {maps}"));
        }
    }
    let stdout = succeed(at, "conform probe --workflow diffuse");
    assert!(stdout.starts_with("The renderer conforms to `printed`."), "{stdout}");
    // A picture for a screen, of 8 bits.
    let output = run_in(at, "conform display --workflow diffuse");
    let stdout = text(&output.stdout);
    let expected = "As `printed`, but clip is [0, 1], not none and transfer is srgb, not linear.";
    assert!(output.status.code() == Some(1) && stdout.starts_with(expected), "{output:?}");
}
