//! Scenes that are printed, and read again.

use serde_json::{Value, json};

use super::{fail, folder, losses_as_json, succeed};

#[test]
fn scenes_that_were_printed_can_be_read_again() {
    let folder = folder();
    let drawn = losses_as_json(folder.path(), "gt.png a.png --near 6 --distant 3 --seed 9 --precision f64");
    std::fs::write(folder.path().join("drawn.json"), drawn.to_string()).unwrap();
    let read = losses_as_json(folder.path(), "gt.png a.png --scenes drawn.json --precision f64");
    // Listed scenes name no distribution: their interval comes from themselves.
    assert_eq!((&read["interval95_from"], &drawn["interval95_from"]), (&json!("scenes"), &json!("pilot")));
    let without_interval = |json: &Value| {
        let mut results = json["results"].clone();
        for result in results.as_array_mut().unwrap() {
            assert!(result.as_object_mut().unwrap().remove("interval95").is_some(), "{json}");
        }
        results
    };
    assert_eq!(without_interval(&read), without_interval(&drawn));
    assert_eq!(read["scenes"], drawn["scenes"]);
    assert_eq!((&read["seed"], &read["near"]), (&Value::Null, &json!(6)));
    let table = succeed(folder.path(), "loss gt.png a.png --scenes drawn.json");
    assert!(table.contains("6 near-field and 3 distant scenes, listed"), "{table}");
}

#[test]
fn scenes_have_names_in_every_command_that_takes_scenes() {
    let folder = folder();
    let at = folder.path();
    for (lights, count, text) in [
        (
            "flash",
            1,
            "1 near-field and 0 distant scenes: flash at the camera, distance 2.414, field of view 45.0 degrees",
        ),
        ("flash --fov 90", 1, "flash at the camera, distance 1.000, field of view 90.0 degrees"),
        (
            "flash-9",
            9,
            "9 near-field and 0 distant scenes: flash at the camera in nine positions (MaterialGAN)",
        ),
        ("hemisphere", 128, "128 near-field and 0 distant scenes: lights on the hemisphere"),
    ] {
        let losses = losses_as_json(at, &format!("gt.png a.png --lights {lights}"));
        assert_eq!(losses["scenes"].as_array().unwrap().len(), count, "{lights}");
        for command in ["loss", "blame", "metrics", "scenes"] {
            let table = succeed(at, &format!("{command} gt.png a.png --lights {lights}"));
            assert!(table.contains(text), "{command}: {table}");
        }
        succeed(at, &format!("map gt.png a.png -o map.csv --lights {lights}"));
    }
    // The same scenes as of a file.
    let nine = succeed(at, "loss gt.png a.png --lights flash-9 --format json");
    std::fs::write(at.join("nine.json"), nine).unwrap();
    let [of_file, named] = ["--scenes nine.json", "--lights flash-9"].map(|scenes| {
        losses_as_json(at, &format!("gt.png a.png {scenes}"))["results"][0]["loss"].as_f64().unwrap()
    });
    assert!((of_file / named - 1.0).abs() < 1e-12);
    // A strip has a column for each of them.
    let [of_file, named, one] = ["--scenes nine.json", "--lights flash-9", ""].map(|scenes| {
        succeed(at, &format!("strip gt.png a.png -o strip.png --columns rendering {scenes}"));
        image::open(at.join("strip.png")).unwrap().to_rgb8()
    });
    let unequal = of_file.iter().zip(named.iter()).filter(|(a, b)| a.abs_diff(**b) > 1).count();
    assert_eq!((of_file.dimensions(), unequal), (named.dimensions(), 0));
    assert!(named.width() > one.width(), "{} and {}", named.width(), one.width());
    let problem = fail(at, "strip gt.png a.png -o strip.png --lights papers", 64);
    assert!(problem.contains("use flash, flash-9 or hemisphere"), "{problem}");
    fail(at, "strip gt.png a.png -o strip.png --lights flash --view 0,0,2", 64);
    fail(at, "strip gt.png a.png -o strip.png --lights flash-9 --fov 30", 64);
    // Those of the papers are the default.
    let loss = |lights: &str| succeed(at, &format!("loss gt.png a.png{lights}"));
    assert_eq!(loss(" --lights papers"), loss(""));
    assert_ne!(loss(" --lights flash"), loss(""));
    for wrong in
        ["flash --near 3", "flash-9 --seed 1", "hemisphere --texels 4", "flash-9 --fov 30", "papers --fov 30"]
    {
        let problem = fail(at, &format!("loss gt.png a.png --lights {wrong}"), 64);
        assert!(problem.contains("leave out --"), "{problem}");
    }
    let problem = fail(at, "loss gt.png a.png --lights flash --scenes one.json", 64);
    assert!(problem.contains("cannot be used with"), "{problem}");
    fail(at, "loss gt.png a.png --lights flash --fov 180", 64);
}
