//! `svbrdf schema`. The JSON of every report is checked against it in Python, by `python/tests/test_schemas.py`.

use serde_json::Value;
use svbrdf_evaluate::schema;

use super::{fail, folder, succeed};

#[test]
fn a_schema_is_printed_and_an_unknown_name_lists_the_known_ones() {
    let folder = folder();
    let printed = |args: &str| -> Value { serde_json::from_str(&succeed(folder.path(), args)).unwrap() };
    let all = printed("schema");
    for name in schema::names() {
        let schema = printed(&format!("schema {name}"));
        assert!(schema["description"].is_string() && schema == all[name], "{name}");
    }
    assert_eq!(printed("schema loss")["properties"]["target_reached"]["type"][1], "null");
    let stderr = fail(folder.path(), "schema losses", 64);
    assert!(stderr.contains("'losses'") && stderr.contains("loss, rank, diagnose"), "{stderr}");
}
