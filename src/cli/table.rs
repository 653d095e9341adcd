//! Tables of text and CSV, and the lines above them.

use std::io;

use svbrdf::error::Error;
use svbrdf::files::session::Session;
use svbrdf::loss::{Estimate, Sampling, Texels};
use svbrdf::material::Material;
use svbrdf::model::convention::Convention;
use svbrdf::model::sampler::Sampler;
use svbrdf::model::scene::{Kind, Scene};

use super::{exit, materials};

/// Lines of aligned columns, the first to the left, the others to the right.
pub fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |c| {
        rows.iter().filter_map(|row| row.get(c)).map(|cell: &String| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let cell = |(c, cell): (usize, &String)| match c {
        0 => format!("{cell:<w$}", w = widths[0]),
        _ => format!("  {cell:>w$}", w = widths[c]),
    };
    let line =
        |row: &Vec<String>| row.iter().enumerate().map(cell).collect::<String>().trim_end().to_owned() + "\n";
    rows.iter().map(line).collect()
}

/// A CSV table with a heading (RFC 4180).
///
/// # Errors
/// [`Error::Unwritable`], which a table in memory does not give.
pub fn csv(rows: impl IntoIterator<Item = Vec<String>>) -> Result<String, Error> {
    let written = || -> io::Result<String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        rows.into_iter().try_for_each(|row| writer.write_record(row))?;
        let bytes = writer.into_inner().map_err(csv::IntoInnerError::into_error)?;
        String::from_utf8(bytes).map_err(io::Error::other)
    };
    written().map_err(exit::unwritable)
}

/// A JSON object with its last line break.
///
/// # Errors
/// [`Error::Unwritable`], which an object in memory does not give.
pub fn json(object: &impl serde::Serialize) -> Result<String, Error> {
    let text = serde_json::to_string_pretty(object).map_err(|problem| exit::unwritable(problem.into()))?;
    Ok(text + "\n")
}

/// What is compared: the lines above a table.
pub fn heading(what: &str, ground_truth: &Material<f32>, convention: &Convention) -> String {
    let ([width, height], name) = (ground_truth.size(), ground_truth.name());
    format!(
        "{what} against {name}, {width} x {height} texels\nconvention {}, epsilon {}\n",
        convention.name, convention.epsilon
    )
}

/// The scenes: a line above a table.
pub fn scenes_line(sampling: Option<&Sampling>, scenes: &[Scene]) -> String {
    let count = |kind| scenes.iter().filter(|scene| scene.kind == kind).count();
    let counts = format!("{} near-field and {} distant scenes", count(Kind::Near), count(Kind::Distant));
    let Some(sampling) = sampling else { return counts + " from a file\n" };
    let sampler = if sampling.sampler == Sampler::Sobol { ", scrambled Sobol" } else { "" };
    let texels = match sampling.texels {
        Texels::All => String::new(),
        Texels::Sampled(count) => format!(", {count} random texels per scene"),
    };
    format!("{counts}, seed {}{sampler}{texels}\n", sampling.seed)
}

/// Standard error, and the ends of the interval; empty where they are unknown.
pub fn errors(estimate: &Estimate) -> [String; 3] {
    let [low, high] = [0, 1].map(|end| estimate.interval95.map(|interval| interval[end]));
    [estimate.standard_error, low, high].map(|value| value.map_or(String::new(), |value| value.to_string()))
}

/// Refuses a ground truth without predictions. A session file has its own.
///
/// # Errors
/// [`Error::Usage`]; those of reading a session.
pub fn check_predictions(materials: &materials::MaterialArgs) -> Result<(), Error> {
    match &materials.ground_truth {
        Some(path) if Session::is_named(path) && Session::read(path)?.materials.len() > 1 => Ok(()),
        Some(path) if materials.predictions.is_empty() => Err(Error::Usage(format!(
            "there is no prediction to compare with {}; give one or more after it",
            path.display()
        ))),
        _ => Ok(()),
    }
}

/// A LaTeX table for the package booktabs.
pub fn latex(columns: &str, heading: &str, rows: &str) -> String {
    format!(
        "\\begin{{tabular}}{{{columns}}}\n\\toprule\n{heading} \\\\\n\\midrule\n{rows}\\bottomrule\n\\end{{tabular}}\n"
    )
}

/// A number in bold, where it is among the best.
pub fn bold(number: &str, best: bool) -> String {
    if best { format!("\\textbf{{{number}}}") } else { number.to_owned() }
}

/// Text with the characters that LaTeX treats in a special way escaped.
pub fn escaped(text: &str) -> String {
    let one = |c: char| match c {
        '&' | '%' | '$' | '#' | '_' | '{' | '}' => format!("\\{c}"),
        '~' => "\\textasciitilde{}".to_owned(),
        '^' => "\\textasciicircum{}".to_owned(),
        '\\' => "\\textbackslash{}".to_owned(),
        _ => c.to_string(),
    };
    text.chars().map(one).collect()
}
