//! Statements of an `.mtl`, taken apart.

use std::path::Path;

use crate::disk::open::NamedFile;
use crate::read::located::mtl::MtlEntry;

/// The materials of an .mtl.
pub(super) fn entries(text: &str) -> Vec<MtlEntry> {
    let mut all: Vec<MtlEntry> = Vec::new();
    for line in text.replace("\\\r\n", " ").replace("\\\n", " ").lines() {
        let line = line.trim();
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

/// A picture as a statement names it.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Texture {
    pub file: String,
    /// The one channel that is wanted; 3 is alpha.
    pub channel: Option<usize>,
    /// Options that change the look, and are not used.
    pub unused: Vec<String>,
}

impl Texture {
    /// Options with their values come first; the rest is the name, which may have spaces.
    pub(super) fn of(mut rest: &str) -> Self {
        let mut texture = Self::default();
        while let Some((name, values, after)) = option(rest) {
            let numbers: Vec<f32> = values.iter().filter_map(|v| v.parse().ok()).collect();
            let neutral = match name.as_str() {
                "-imfchan" => {
                    texture.channel = ["r", "g", "b", "m"].iter().position(|letter| *letter == values[0]);
                    texture.channel.is_some()
                }
                "-bm" => numbers == [1.0],
                "-mm" => numbers == [0.0, 1.0],
                "-o" | "-t" => numbers.iter().all(|v| *v == 0.0),
                "-s" => numbers.iter().all(|v| *v == 1.0),
                // About how a picture is sampled where it is magnified, or repeated.
                _ => true,
            };
            if !neutral {
                texture.unused.push(format!("{name} {}", values.join(" ")));
            }
            rest = after;
        }
        texture.file = rest.trim().to_owned();
        texture
    }

    /// The file beside that of the material, or of a path of its own; of a path of another machine the file of the same
    /// name, if that is there.
    pub(super) fn named_file(&self, mtl: &Path) -> NamedFile {
        let slashed = self.file.replace('\\', "/");
        let last = slashed.rsplit('/').next().unwrap_or_default();
        let named = NamedFile::within(&self.file, mtl);
        let others = [&*slashed, last].map(|name| NamedFile::within(name, mtl));
        if named.exists() { named } else { others.into_iter().find(NamedFile::exists).unwrap_or(named) }
    }
}

/// The option at the beginning of `rest`, in lower case, its values, and what follows; `None` at a file name.
fn option(rest: &str) -> Option<(String, Vec<&str>, &str)> {
    let word = |text: &str| text.trim_start().split(char::is_whitespace).next().unwrap_or_default().len();
    let rest = rest.trim_start();
    let (name, mut after) = rest.split_at(word(rest));
    let (name, most) = match name.to_lowercase() {
        n if ["-blendu", "-blendv", "-boost", "-texres", "-clamp", "-cc", "-bm", "-imfchan", "-type"]
            .contains(&n.as_str()) =>
        {
            (n, 1)
        }
        n if n == "-mm" => (n, 2),
        n if ["-o", "-s", "-t"].contains(&n.as_str()) => (n, 3),
        _ => return None,
    };
    let mut values = Vec::new();
    while values.len() < most {
        let trimmed = after.trim_start();
        let (value, following) = trimmed.split_at(word(trimmed));
        // Of three numbers the last two may be left out.
        if value.is_empty() || (most == 3 && value.parse::<f32>().is_err()) {
            break;
        }
        values.push(value);
        after = following;
    }
    (!values.is_empty()).then_some((name, values, after))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_come_before_a_name_that_may_have_spaces() {
        let file = |text| Texture::of(text).file;
        assert_eq!(file("old wall.png"), "old wall.png");
        assert_eq!(file(" -bm 1.0 -clamp on  old wall.png "), "old wall.png");
        assert_eq!(file("-s 2 2 1001.png"), "1001.png");
        assert_eq!(file("-o 0.5 -imfchan g 2k.png"), "2k.png");
        assert_eq!(file("-wall.png"), "-wall.png");
        assert_eq!(file("-bm"), "-bm");
        let texture = Texture::of("-S 2 1 -mm 0 1 -bm 0.5 -imfchan g a.png");
        assert_eq!(
            (texture.channel, texture.unused),
            (Some(1), vec!["-s 2 1".to_owned(), "-bm 0.5".to_owned()])
        );
    }

    #[test]
    fn a_material_is_what_follows_its_name() {
        let all = entries("# made\nKd 1\nnewmtl old  wall\n\tmap_Kd a\\\n b.png\n\nnewmtl b\nKd 0 0 0");
        assert_eq!(all.iter().map(|e| e.name.as_str()).collect::<Vec<_>>(), ["old  wall", "b"]);
        assert_eq!(all[0].lines, [("map_kd".to_owned(), "a  b.png".to_owned())]);
    }
}
