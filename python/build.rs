//! Writes the parts of the package that follow from the schemas of reports: their types, and the functions of analyses.

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::{Map, Value};
use svbrdf_evaluate::analyses::{ANALYSES as DECLARED, AnyAnalysis};
use svbrdf_evaluate::report::{OptionValue, SCENE_OPTIONS};
use svbrdf_evaluate::schema;

const TYPES: &str = r#""""The types of reports: the keys of their JSON."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from ._report import Record, Report
from ._scenes import Scene
"#;
const ANALYSES: &str = r#""""The analyses of predictions of one ground truth: of the rendering loss (Algorithm 1), of its causes, and of metrics."""
from collections.abc import Sequence
from typing import Literal

from numpy.typing import ArrayLike

from . import _map, _reports
from ._arrays import Precision
from ._asked import Asked, Predictions, Scenes
from ._material import Material, Source
from ._progress import Report as Progress
"#;
/// The command line alone has these reports.
const OF_COMMAND_LINE: [&str; 3] = ["info", "photo", "conform"];
/// The package has a class with arrays for this.
const OF_PACKAGE: &str = "MapReport";
type Parts = Map<String, Value>;

#[allow(clippy::disallowed_methods, reason = "a build script writes into its own package")]
fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    let (mut classes, mut functions) = (BTreeMap::new(), BTreeMap::new());
    for name in schema::names().filter(|name| !OF_COMMAND_LINE.contains(name)) {
        let schema = serde_json::to_value(schema::named(name))?;
        let parts = schema["$defs"].as_object().cloned().unwrap_or_default();
        let title = text(&schema["title"]);
        classes.insert(title.to_owned(), class(title, &schema, &parts, "Report"));
        for (part, described) in parts.iter().filter(|(part, _)| *part != "Scene") {
            if described["properties"].is_object() {
                classes.insert(part.clone(), class(part, described, &parts, "Record"));
            }
        }
        if let Some(analysis) = DECLARED.iter().find(|analysis| analysis.name == name) {
            functions.insert(name.to_owned(), function(analysis, title));
        }
    }
    let folder = Path::new(&std::env::var("CARGO_MANIFEST_DIR")?).join("package/svbrdf");
    for (file, head, items) in [("_reports.py", TYPES, classes), ("_analyses.py", ANALYSES, functions)] {
        let names: Vec<_> = items.keys().filter(|name| *name != OF_PACKAGE).collect();
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

/// An argument: its name, what is passed on, its type with its default, and its description.
fn arguments(analysis: &AnyAnalysis) -> Vec<[String; 3]> {
    let own = analysis.options.iter().map(|option| {
        let kind = match option.value {
            OptionValue::Count(default) => format!("int = {default}"),
            OptionValue::Share(default) => format!("float = {default:?}"),
            OptionValue::Stops(default) => format!("float = {default:?}"),
            OptionValue::Words(_) => "Sequence[str] = ()".to_owned(),
        };
        [option.name.to_owned(), kind, format!("{}.", option.about)]
    });
    own.chain(analysis.scenes.iter().map(|name| of_scenes(name))).collect()
}

/// The same of an option of scenes or precision.
fn of_scenes(name: &str) -> [String; 3] {
    let (kind, unit) = match name {
        "near" | "distant" | "seed" => ("int", ""),
        "sampler" => (r#"Literal["random", "sobol"]"#, ""),
        "scenes" => ("Scenes", ""),
        "texels" => (r#"int | Literal["all"]"#, ""),
        "target_error" => ("float", ", as a share of at most 0.1: 0.01 is 1%"),
        "time_budget" => ("float", ", in seconds"),
        _ => ("Precision", ""),
    };
    let declared = SCENE_OPTIONS.iter().find(|option| option[0] == name);
    let [_, about, open] = declared.unwrap_or(&["", "These scenes, or those of a file", ""]);
    let open = if open.is_empty() { String::new() } else { format!("; None: {open}") };
    let default = if name == "precision" { r#" = "f32""# } else { " | None = None" };
    let about = format!("{about}{unit}{open}.").replace(['{', '}'], "");
    [name.to_owned(), format!("{kind}{default}"), about]
}

/// What decides which texels are compared, as of [`arguments`]: all functions have the first.
const BESIDE: [[&str; 3]; 2] = [
    [
        "register",
        "str",
        "How predictions of another size lie on the ground truth, such as \"centre-crop\"; None: found by the maps, with a warning.",
    ],
    ["mask", "ArrayLike", "Height x width, true for the texels that are compared; None: all."],
];

/// The function of an analysis.
fn function(analysis: &AnyAnalysis, report: &str) -> String {
    let AnyAnalysis { name, about, details, example, doing, .. } = analysis;
    let (mut parameters, mut given, mut docs) = (String::new(), String::new(), String::new());
    for [name, kind, about] in arguments(analysis) {
        let _ = writeln!(parameters, "    {name}: {kind},");
        let _ = writeln!(docs, "        {name}: {about}");
        if name != "precision" {
            let _ = write!(given, r#""{name}": {name}, "#);
        }
    }
    for [name, kind, about] in &BESIDE[..=usize::from(analysis.paired)] {
        let _ = writeln!(parameters, "    {name}: {kind} | None = None,");
        let _ = writeln!(docs, "        {name}: {about}");
    }
    let beside = if analysis.paired { ", register=register, mask=mask" } else { ", register=register" };
    let about = about.replace("Prints", "Computes").replace("Writes", "Computes").replace(" to a file", "");
    let report = if report == OF_PACKAGE { format!("_map.{report}") } else { format!("_reports.{report}") };
    let details = details.replace("--", "");
    let example: String = example.lines().map(|line| format!("    {}\n", line.trim_start())).collect();
    let example = if example.is_empty() { example } else { example + "\n" };
    let precision = if analysis.scenes.contains(&"precision") { ", precision" } else { "" };
    format!(
        r#"

def {name}(
    ground_truth: Material | Source,
    predictions: Predictions,
    *,
{parameters}    convention: str = "printed",
    progress: bool | Progress = False,
) -> {report}:
    """{about}.

    {details}

    All cores work on it, without the lock of the interpreter, and Ctrl+C ends it. The result does not depend on the number of cores.

{example}    Args:
        ground_truth: A material, or the path of one.
        predictions: One or several materials or paths, of the same surface.
{docs}        convention: A name that `svbrdf conventions` lists, or the path of a .toml file.
        progress: True for a bar of tqdm, or a function of (steps done, steps in all).

    Raises:
        OSError: A file cannot be read.
        svbrdf.Error: A material or a scene cannot be used, the sizes differ, or an option has no such value or is not used.
        TypeError, ValueError: Another argument has a wrong type or makes no sense.
    """
    asked = Asked(ground_truth, predictions, {{{given}}}, convention{precision}{beside})
    return asked.answer({report}, "{name}", "{doing}", progress)
"#
    )
}
