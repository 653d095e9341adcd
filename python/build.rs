//! Writes the parts of the package that follow from the schemas of reports: their types, and the functions of analyses.

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::{Map, Value};
use svbrdf_evaluate::schema;

const TYPES: &str = r#""""The types of reports: the keys of their JSON."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from ._report import Record, Report
from ._scenes import Scene
"#;
const ANALYSES: &str = r#""""The analyses that each have one question."""
from typing import Literal

from . import _core, _reports
from ._asked import Asked, Predictions, Scenes, own_json
from ._material import Material, Source
from ._progress import Report as Progress
"#;
/// The command line alone has this report: the package has `Material.assumptions` and `Material.notes`.
const OF_COMMAND_LINE: &str = "info";
/// The package has a class with arrays and a function with further arguments for these.
const OF_PACKAGE: [&str; 2] = ["MapReport", "metrics"];
/// Arguments by the groups of scene options.
const SCENES: [(&str, &[(&str, &str)]); 4] = [
    ("seed", &[("seed", "int")]),
    ("target_error", &[("target_error", "float")]),
    ("sampled", &[("near", "int"), ("distant", "int"), ("sampler", r#"Literal["random", "sobol"]"#)]),
    ("list", &[("scenes", "Scenes")]),
];

type Parts = Map<String, Value>;

#[allow(clippy::disallowed_methods, reason = "a build script writes into its own package")]
fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    let (mut classes, mut functions) = (BTreeMap::new(), BTreeMap::new());
    for name in schema::names().filter(|name| *name != OF_COMMAND_LINE) {
        let schema = serde_json::to_value(schema::named(name))?;
        let parts = schema["$defs"].as_object().cloned().unwrap_or_default();
        let title = text(&schema["title"]);
        classes.insert(title.to_owned(), class(title, &schema, &parts, "Report"));
        for (part, described) in parts.iter().filter(|(part, _)| *part != "Scene") {
            if described["properties"].is_object() {
                classes.insert(part.clone(), class(part, described, &parts, "Record"));
            }
        }
        if schema["x-analysis"].is_object() && !OF_PACKAGE.contains(&name) {
            functions.insert(name.to_owned(), function(name, &schema));
        }
    }
    let folder = Path::new(&std::env::var("CARGO_MANIFEST_DIR")?).join("package/svbrdf");
    for (file, head, items) in [("_reports.py", TYPES, classes), ("_analyses.py", ANALYSES, functions)] {
        let names: Vec<_> = items.keys().filter(|name| !OF_PACKAGE.contains(&name.as_str())).collect();
        let items: String = items.values().map(String::as_str).collect();
        fs::write(folder.join(file), format!("{head}\n__all__ = {names:?}\n{items}"))?;
    }
    Ok(())
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

fn members(value: &Value) -> impl Iterator<Item = (&String, &Value)> {
    value.as_object().into_iter().flatten()
}

/// The class of an object; keys that it may lack come last.
fn class(name: &str, schema: &Value, parts: &Parts, base: &str) -> String {
    let is_required =
        |key: &String| schema["required"].as_array().is_some_and(|all| all.contains(&key[..].into()));
    let doc = |schema: &Value| text(&schema["description"]).replace("null", "None");
    let mut class = format!("\n\nclass {name}({base}):\n    \"\"\"{}\"\"\"\n\n", doc(schema));
    for required in [true, false] {
        for (key, described) in members(&schema["properties"]).filter(|(key, _)| is_required(key) == required)
        {
            let mut kinds = kinds(described, parts);
            kinds.extend((!required).then(|| "None".to_owned()));
            let _ = writeln!(class, "    {key}: {}", union(kinds));
            if described["description"].is_string() {
                let _ = writeln!(class, "    \"\"\"{}\"\"\"", doc(described));
            }
        }
    }
    class
}

/// Types joined by `|`: words in one `Literal`, None at the end.
fn union(mut kinds: Vec<String>) -> String {
    kinds.sort_by_key(|kind| if kind == "None" { 2 } else { usize::from(kind.starts_with('"')) });
    kinds.dedup();
    let is_word = |kind: &&String| kind.starts_with('"');
    let words: Vec<&str> = kinds.iter().filter(is_word).map(String::as_str).collect();
    let words = (!words.is_empty()).then(|| format!("Literal[{}]", words.join(", ")));
    let (none, types): (Vec<_>, Vec<_>) =
        kinds.iter().filter(|kind| !is_word(kind)).cloned().partition(|kind| kind == "None");
    types.into_iter().chain(words).chain(none).collect::<Vec<_>>().join(" | ")
}

/// Every type of a schema; words are in quotation marks.
fn kinds(schema: &Value, parts: &Parts) -> Vec<String> {
    let all = |schemas: &Value| -> Vec<String> {
        schemas.as_array().into_iter().flatten().flat_map(|one| kinds(one, parts)).collect()
    };
    if let Some((_, name)) = text(&schema["$ref"]).rsplit_once('/') {
        let part = &parts[name];
        return if part["properties"].is_object() { vec![name.to_owned()] } else { kinds(part, parts) };
    }
    if let Some(choices) = ["anyOf", "oneOf"].iter().find(|choices| schema[**choices].is_array()) {
        return all(&schema[*choices]);
    }
    if let Some(words) = schema["enum"].as_array() {
        return words.iter().map(Value::to_string).collect();
    }
    if schema["const"].is_string() {
        return vec![schema["const"].to_string()];
    }
    match &schema["type"] {
        Value::Array(names) => names.iter().map(|name| kind(text(name), schema, parts)).collect(),
        name => vec![kind(text(name), schema, parts)],
    }
}

fn kind(name: &str, schema: &Value, parts: &Parts) -> String {
    let of = |schema: &Value| union(kinds(schema, parts));
    match name {
        "string" => "str".to_owned(),
        "integer" => "int".to_owned(),
        "number" => "float".to_owned(),
        "boolean" => "bool".to_owned(),
        "null" => "None".to_owned(),
        "object" => format!("Mapping[str, {}]", of(&schema["additionalProperties"])),
        "array" => match schema["minItems"].as_u64() {
            Some(count) if schema["items"]["$ref"].is_null() => {
                format!("tuple[{}]", vec![of(&schema["items"]); count as usize].join(", "))
            }
            _ => format!("tuple[{}, ...]", of(&schema["items"])),
        },
        _ => "Any".to_owned(),
    }
}

/// The function of an analysis.
fn function(name: &str, schema: &Value) -> String {
    let (analysis, report) = (&schema["x-analysis"], text(&schema["title"]));
    let (mut parameters, mut given, mut options, mut docs) =
        (String::new(), String::new(), String::new(), String::new());
    for (key, option) in members(&analysis["options"]["properties"]) {
        let kind = kind(text(&option["type"]), option, &Parts::new());
        let _ = writeln!(parameters, "    {key}: {kind} = {},", option["default"]);
        let _ = write!(options, r#""{key}": {key}, "#);
        let _ = write!(docs, "`{key}`: {}. ", text(&option["description"]));
    }
    let groups = analysis["scenes"].as_array().into_iter().flatten();
    let scenes = groups.flat_map(|group| SCENES.iter().filter(move |(name, _)| group == name));
    for (key, kind) in scenes.flat_map(|(_, arguments)| *arguments) {
        let _ = writeln!(parameters, "    {key}: {kind} | None = None,");
        let _ = write!(given, r#""{key}": {key}, "#);
    }
    let [about, details, doing] = ["about", "details", "doing"].map(|key| text(&analysis[key]));
    let about = about.replace("Prints", "Computes");
    format!(
        r#"

def {name}(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
{parameters}    convention: str = "printed",
    progress: bool | Progress = False,
) -> _reports.{report}:
    """{about}.

    {details}

    {docs}The other args and errors are those of `svbrdf.loss`.
    """
    asked = Asked(ground_truth, predictions, {{{given}}}, convention)
    return asked.answer(_reports.{report}, _core.analysis, "{doing}", progress, "{name}", own_json({{{options}}}))
"#
    )
}
