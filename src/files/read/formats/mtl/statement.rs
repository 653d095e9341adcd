//! Statements of an `.mtl`, taken apart.

use std::path::Path;

use crate::disk::open::NamedFile;

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

/// Whether a statement of this keyword names a picture.
pub(super) fn names_picture(key: &str) -> bool {
    key.starts_with("map_") || ["norm", "bump", "disp", "decal", "refl"].contains(&key)
}

pub(super) fn entries(text: &str) -> Vec<MtlEntry> {
    let mut all: Vec<MtlEntry> = Vec::new();
    for line in text.lines().map(str::trim) {
        let (key, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        match (key.to_lowercase(), all.last_mut()) {
            (key, _) if key.is_empty() || key.starts_with('#') => {}
            (key, _) if key == "newmtl" => {
                all.push(MtlEntry { name: rest.trim().to_owned(), lines: Vec::new() })
            }
            (key, Some(entry)) => entry.lines.push((key, rest.trim().to_owned())),
            (_, None) => {}
        }
    }
    all
}

/// The file that a statement names, and the options before it which change the look: an option has its values after it, and the rest is the
/// name, which may have spaces.
pub(super) fn file_and_options(rest: &str) -> (String, Vec<String>) {
    const OF_ONE: [&str; 9] =
        ["-blendu", "-blendv", "-boost", "-texres", "-clamp", "-cc", "-type", "-imfchan", "-bm"];
    let (mut rest, mut options) = (rest.trim(), Vec::new());
    let word = |text: &str| text.split(char::is_whitespace).next().unwrap_or_default().len();
    loop {
        let name = rest[..word(rest)].to_lowercase();
        let most = match name.as_str() {
            "-o" | "-s" | "-t" => 3,
            "-mm" => 2,
            one if OF_ONE.contains(&one) => 1,
            _ => return (rest.to_owned(), options),
        };
        let (mut values, mut after) = (Vec::new(), rest[name.len()..].trim_start());
        while values.len() < most && !after.is_empty() {
            let (value, following) = after.split_at(word(after));
            // Of three numbers the last two may be left out.
            if most == 3 && value.parse::<f32>().is_err() {
                break;
            }
            values.push(value);
            after = following.trim_start();
        }
        let are = |neutral: &[f32]| values.iter().zip(neutral).all(|(value, one)| value.parse() == Ok(*one));
        let is_neutral = match name.as_str() {
            "-bm" | "-s" => are(&[1.0; 3]),
            "-mm" => are(&[0.0, 1.0]),
            "-o" | "-t" => are(&[0.0; 3]),
            "-imfchan" => false,
            // About how a picture is sampled where it is magnified, or repeated.
            _ => true,
        };
        if !is_neutral {
            options.push(format!("{name} {}", values.join(" ")));
        }
        rest = after;
    }
}

/// The file beside that of the material, or of a path of its own; of a path of another machine the file of the same name, if that is there.
pub(super) fn named_file(name: &str, mtl: &Path) -> NamedFile {
    let slashed = name.replace('\\', "/");
    let last = slashed.rsplit('/').next().unwrap_or_default();
    let named = NamedFile::within(name, mtl);
    let others = [&*slashed, last].map(|name| NamedFile::within(name, mtl));
    if named.exists() { named } else { others.into_iter().find(NamedFile::exists).unwrap_or(named) }
}
