//! Scenes that are printed, and read again.

use serde_json::{Value, json};

use super::{folder, losses_as_json, succeed};

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
    assert!(table.contains("from a file"), "{table}");
}
