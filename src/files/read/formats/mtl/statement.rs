//! The statements of an `.mtl`, taken apart.

use std::path::{Path, PathBuf};

use crate::files::read::locate::names::{Label, Role};
use crate::files::read::note::Subject;

/// Statements that name pictures although they do not begin with `map_`.
const PICTURES: [&str; 5] = ["norm", "bump", "disp", "decal", "refl"];

/// Statements for normals, the plainest first; those of `bump` may also hold heights.
pub(super) const NORMALS: [&str; 2] = ["norm", "map_kn"];
pub(super) const BUMPS: [&str; 2] = ["map_bump", "bump"];

/// A material: its statements, each a keyword in lower case and the rest of its line.
pub(super) struct MtlEntry {
    pub name: String,
    pub lines: Vec<(String, String)>,
}

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

/// Whether a statement of this keyword names a picture.
pub(super) fn is_picture(key: &str) -> bool {
    key.starts_with("map_") || PICTURES.contains(&key)
}

/// Whether specular is occlusion, roughness and metallic: so its name says, or the `bsdf` of nvdiffrec.
pub(super) fn is_packed(entry: &MtlEntry) -> bool {
    let has = |key: &str| entry.lines.iter().any(|(k, _)| k == key);
    let specular = entry.lines.iter().find(|(key, _)| key == "map_ks");
    let named = |rest: &str| {
        let file = Texture::of(rest).file;
        let stem = Path::new(&file).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Label::of(&stem).is_some_and(|label| label.role == Role::OcclusionRoughnessMetallic)
    };
    let lone = has("map_kd") && !has("map_pr") && !has("map_pm");
    lone && specular.is_some_and(|(_, rest)| has("bsdf") || named(rest))
}

/// The pictures that are read of a material, and what they are expected to be.
pub(super) fn listed(path: &Path, entry: &MtlEntry) -> Vec<(PathBuf, Subject)> {
    let line = |key: &str| entry.lines.iter().find(|(k, _)| k == key).map(|(_, rest)| rest);
    let normal = NORMALS.into_iter().chain(BUMPS).find(|key| line(key).is_some()).unwrap_or_default();
    let specular = if line("map_pm").is_none() { "map_ks" } else { "" };
    let keys = [
        ("map_kd", Role::Diffuse),
        ("map_pr", Role::Roughness),
        ("map_pm", Role::Metallic),
        (specular, if is_packed(entry) { Role::OcclusionRoughnessMetallic } else { Role::Specular }),
        (normal, Role::Normal),
    ];
    let picture = |(key, role)| Some((Texture::of(line(key)?).path(path), Subject::Map(role)));
    keys.into_iter().filter_map(picture).collect()
}

/// What a statement says about a picture.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Texture {
    pub file: String,
    /// The one channel that is wanted; 3 is alpha.
    pub channel: Option<usize>,
    /// Options that change what is seen, and are not obeyed here.
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
    pub(super) fn path(&self, mtl: &Path) -> PathBuf {
        let folder = mtl.parent().unwrap_or(Path::new(""));
        let slashed = self.file.replace('\\', "/");
        let last = slashed.rsplit('/').next().unwrap_or_default();
        let named = folder.join(&self.file);
        let others = [folder.join(&slashed), folder.join(last)];
        if named.exists() { named } else { others.into_iter().find(|other| other.is_file()).unwrap_or(named) }
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
