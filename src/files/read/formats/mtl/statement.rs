//! Statements of an `.mtl`, taken apart.

use std::path::Path;

use crate::disk::open::NamedFile;

/// Options before the name of a picture, each with the most values that it has, and those that change nothing. Without such, it is about
/// how a picture is sampled where it is magnified, or repeated; a channel always changes something.
const OPTIONS: [(&str, usize, &[f32]); 13] = [
    ("-o", 3, &[0.0; 3]),
    ("-s", 3, &[1.0; 3]),
    ("-t", 3, &[0.0; 3]),
    ("-mm", 2, &[0.0, 1.0]),
    ("-bm", 1, &[1.0]),
    ("-imfchan", 1, &[f32::NAN]),
    ("-blendu", 1, &[]),
    ("-blendv", 1, &[]),
    ("-boost", 1, &[]),
    ("-texres", 1, &[]),
    ("-clamp", 1, &[]),
    ("-cc", 1, &[]),
    ("-type", 1, &[]),
];

/// A material: its statements, each a keyword in lower case and the rest of its line.
#[derive(Debug)]
pub(super) struct MtlEntry {
    pub name: String,
    pub lines: Vec<(String, String)>,
}

impl MtlEntry {
    pub(super) fn line(&self, key: &str) -> Option<&str> {
        self.lines.iter().find(|(k, _)| k == key).map(|(_, rest)| rest.as_str())
    }
}

/// The memory that the statements of a file take at most.
pub(super) fn bytes_of(text: &[u8]) -> u64 {
    /// Keyword and rest of a line, with room to grow, in bytes.
    const LINE: u64 = 192;
    let lines = text.iter().filter(|byte| **byte == b'\n').count() as u64 + 1;
    4 * text.len() as u64 + LINE * lines
}

pub(super) fn entries(text: &str) -> Vec<MtlEntry> {
    let mut all: Vec<MtlEntry> = Vec::new();
    for line in text.lines().map(str::trim) {
        let (key, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let (key, rest) = (key.to_lowercase(), rest.trim().to_owned());
        match all.last_mut() {
            _ if key.is_empty() || key.starts_with('#') => {}
            _ if key == "newmtl" => all.push(MtlEntry { name: rest, lines: Vec::new() }),
            Some(entry) => entry.lines.push((key, rest)),
            None => {}
        }
    }
    all
}

/// The file that a statement names, which may have spaces, and the options before it which change the look.
pub(super) fn file_and_options(rest: &str) -> (&str, Vec<String>) {
    fn first(text: &str) -> (&str, &str) {
        text.split_at(text.find(char::is_whitespace).unwrap_or(text.len()))
    }
    let (mut rest, mut options) = (rest.trim(), Vec::new());
    let known = |rest: &str| OPTIONS.iter().find(|(name, ..)| first(rest).0.eq_ignore_ascii_case(name));
    while let Some((name, most, neutral)) = known(rest) {
        let (mut values, mut after) = (Vec::new(), first(rest).1.trim_start());
        // Of three numbers the last two may be left out.
        let is_value = |text: &str| !text.is_empty() && (*most < 3 || first(text).0.parse::<f32>().is_ok());
        while values.len() < *most && is_value(after) {
            let (value, following) = first(after);
            values.push(value);
            after = following.trim_start();
        }
        if !values.iter().zip(*neutral).all(|(value, one)| value.parse() == Ok(*one)) {
            options.push(format!("{name} {}", values.join(" ")));
        }
        rest = after;
    }
    (rest, options)
}

/// Finds a file that an MTL names: by its path, relative to the MTL or absolute. If nothing is there, as with a path of another machine,
/// the file of the same name beside the MTL is taken.
pub(super) fn named_file(name: &str, mtl: &Path) -> NamedFile {
    let slashed = name.replace('\\', "/");
    let last = slashed.rsplit('/').next().unwrap_or_default();
    let named = NamedFile::within(name, mtl);
    let others = [&*slashed, last].map(|name| NamedFile::within(name, mtl));
    if named.exists() { named } else { others.into_iter().find(NamedFile::exists).unwrap_or(named) }
}
