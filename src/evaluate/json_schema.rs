//! JSON Schema of a type, from its fields and their doc comments.

use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use schemars::{JsonSchema, Schema};
use serde_json::Value;

/// The schema of what is written, not of what could be read.
pub fn schema_of<T: JsonSchema>() -> Schema {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    settings.with_transform(RecursiveTransform(reworded)).into_generator().into_root_schema_for::<T>()
}

/// A doc comment for readers of JSON: on one line, with null in place of `None`.
fn reworded(schema: &mut Schema) {
    if let Some(Value::String(text)) = schema.get_mut("description") {
        *text = text.replace('\n', " ").replace("`None`", "null").replace("[`", "`").replace("`]", "`");
    }
}
