//! `svbrdf photo`.

use serde_json::{Value, json};

use super::pictures::image_of_exr;
use super::{assert_has, assert_holds, assert_refused, folder, json_of, rows_of, succeed};

const SCENE: &str = "--view 0,0,2 --light 0.5,0.5,1";

fn names(report: &Value) -> Vec<&str> {
    report["results"].as_array().unwrap().iter().map(|one| one["material"].as_str().unwrap()).collect()
}

#[test]
fn the_right_material_comes_first_with_the_factor_of_the_exposure() {
    let folder = folder();
    let at = folder.path();
    succeed(at, &format!("render gt.png -o photo.exr {SCENE}"));
    succeed(at, &format!("render gt.png -o photo.png --exposure -1 {SCENE}"));
    let floats = json_of(at, &format!("photo photo.exr b.png a.png gt.png {SCENE}"));
    assert_eq!(names(&floats), ["gt", "a", "b"]);
    let [right, wrong] = [0, 1].map(|k| &floats["results"][k]);
    assert_eq!((&right["factor"], &right["log"], &right["rmse"]), (&1.0.into(), &0.0.into(), &0.0.into()));
    assert!(wrong["log"].as_f64().unwrap() > 0.0);
    let text = succeed(at, &format!("photo photo.png gt.png a.png {SCENE} --falloff --transfer srgb"));
    assert_has(
        &text,
        &[
            "differences from photo.png, 8 x 8 pixels, sRGB as specified, falloff of the light divided out",
            "near scene: view (0.000, 0.000, 2.000), light (0.500, 0.500, 1.000)",
            "convention printed, epsilon 0.01",
        ],
    );
    // The differences as numbers and colours.
    let printed = json_of(at, &format!("photo photo.exr a.png {SCENE} -o log.exr"));
    let values = image_of_exr(&at.join("log.exr")).pixels.concat();
    let mean = values.iter().map(|value| f64::from(*value)).sum::<f64>() / values.len() as f64;
    let expected = printed["results"][0]["log"].as_f64().unwrap();
    assert!((mean / expected - 1.0).abs() < 1e-6 && expected > 0.0, "{mean}, {expected}");
    succeed(at, &format!("photo photo.exr a.png b.png {SCENE} -o log.png"));
    assert_eq!(image::open(at.join("log.png")).unwrap().width(), 8 + 4 + 8);
    assert_holds(at, "log.png", &["log difference from the photograph g", "svbrdf:factors"]);

    // Two photographs, of which the second is half as bright: one factor for both.
    let scene = json!({"kind": "near", "view": [0, 0, 2], "light": [0.5, 0.5, 1]});
    let listed = ["photo.png", "dark.png"].map(|file| json!({"file": file, "scene": scene}));
    succeed(at, &format!("render gt.png -o dark.png --exposure -2 {SCENE}"));
    std::fs::write(at.join("capture.json"), json!({"photographs": listed}).to_string()).unwrap();
    let found = json_of(at, "photo capture.json b.png gt.png");
    std::fs::write(at.join("scenes.json"), found.to_string()).unwrap();
    assert_eq!(names(&found)[0], "gt");
    let logs = [0, 1].map(|k| found["results"][0]["photographs"][k]["log"].as_f64().unwrap());
    assert!(logs[0] + logs[1] > 0.3, "{logs:?}");
    // The JSON is a scene file.
    succeed(at, "loss gt.png a.png --scenes scenes.json");
    let rows = rows_of(at, "photo . gt.png a.png");
    assert_eq!((rows.len(), rows[1]["photographs"].as_str(), rows[1]["falloff"].as_str()), (2, "2", "false"));
    assert_refused(
        at,
        &[
            ("photo photo.png gt.png", 64, "give --view X,Y,Z and --light X,Y,Z"),
            ("photo photo.png gt.png big.png --view 0,0,2 --light 0,0,2 -o out.png", 1, "sizes differ"),
            ("photo photo.png gt.png --view 0,0,2 --light 0,0,2 -o out.txt", 64, "extension"),
            ("photo text.png gt.png --view 0,0,2 --light 0,0,2", 1, "photograph: expected PNG"),
            ("photo capture.json gt.png --light 0,0,2", 64, "leave out --light"),
            ("photo . gt.png -o out.png", 64, "a single photograph are written; leave out --output"),
        ],
    );
}
