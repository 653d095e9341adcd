//! Scenes that are printed, and read again.

use serde_json::{Value, json};

use super::{assert_has, assert_refused, folder, losses_as_json, succeed};

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
    assert_has(&table, &["6 near-field and 3 distant scenes, listed"]);
}

#[test]
fn scenes_have_names_in_every_command_that_takes_scenes() {
    let folder = folder();
    let at = folder.path();
    for (lights, count, text) in [
        ("flash", 1, "1 near-field and 0 distant scenes: flash at the camera, distance 2.414, field"),
        ("flash --fov 90", 1, "flash at the camera, distance 1.000, field of view 90.0 degrees"),
        ("flash-9", 9, "scenes: flash at the camera in nine positions (MaterialGAN)"),
        ("hemisphere", 128, "128 near-field and 0 distant scenes: lights on the hemisphere"),
    ] {
        let losses = losses_as_json(at, &format!("gt.png a.png --lights {lights}"));
        assert_eq!(losses["scenes"].as_array().unwrap().len(), count, "{lights}");
        for command in ["loss", "blame", "metrics", "scenes"] {
            let table = succeed(at, &format!("{command} gt.png a.png --lights {lights}"));
            assert_has(&table, &[text]);
        }
        succeed(at, &format!("map gt.png a.png -o map.csv --lights {lights}"));
    }
    // A strip has a column for each of them.
    let [named, one] = ["--lights flash-9", ""].map(|scenes| {
        succeed(at, &format!("strip gt.png a.png -o strip.png --columns rendering {scenes}"));
        image::open(at.join("strip.png")).unwrap().width()
    });
    assert!(named > one, "{named} and {one}");
    // Those of the papers are the default.
    let loss = |lights: &str| succeed(at, &format!("loss gt.png a.png{lights}"));
    assert_eq!(loss(" --lights papers"), loss(""));
    assert_ne!(loss(" --lights flash"), loss(""));
    let refused = [
        ("strip gt.png a.png -o strip.png --lights papers", 64, "use flash, flash-9 or hemisphere"),
        ("strip gt.png a.png -o strip.png --lights flash --view 0,0,2", 64, "--view"),
        ("loss gt.png a.png --lights flash --near 3", 64, "leave out --near"),
        ("loss gt.png a.png --lights flash-9 --fov 30", 64, "leave out --fov"),
        ("loss gt.png a.png --lights flash --scenes one.json", 64, "cannot be used with"),
        ("loss gt.png a.png --lights flash --fov 180", 64, "179"),
    ];
    assert_refused(at, &refused);
}
