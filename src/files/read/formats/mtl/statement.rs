//! Statements of an `.mtl`, taken apart, and the pictures that they name.

use std::path::{Path, PathBuf};

use crate::disk::open::NamedFile;
use crate::disk::{memory, refuse_pointer};
use crate::error::Error;
use crate::read::names::Label;
use crate::read::options::{ReadOptions, Role};
use crate::read::stored::Picture;

/// Statements for normals, the plainest first; those of `bump` may also hold heights.
pub(super) const NORMALS: [&str; 2] = ["norm", "map_kn"];
pub(super) const BUMPS: [&str; 2] = ["map_bump", "bump"];

/// A material of an `.mtl`, its pictures located.
#[derive(Debug)]
pub(in crate::read) struct Mtl {
    pub(super) path: PathBuf,
    pub(super) entry: MtlEntry,
    /// The pictures of the entry that are read.
    pub(super) textures: Vec<MtlTexture>,
    /// The statement of a picture of roughness and metallic.
    pub(super) packed: Option<(&'static str, Role)>,
    pub(super) is_by_blender: bool,
    /// The names of all materials of the file, and which of them this is.
    pub(super) materials: (Vec<String>, usize),
}

impl Mtl {
    /// Locates material number `exemplar` of the file `path`.
    ///
    /// # Errors
    /// [`Error::Unreadable`], [`Error::Memory`], [`Error::NotAMaterial`] without a material, [`Error::NoSuchExemplar`].
    pub(in crate::read) fn locate(path: &Path, options: &ReadOptions) -> Result<Self, Error> {
        let bytes = NamedFile::by_user(path).bytes()?;
        refuse_pointer(path, &bytes)?;
        let _reserved =
            memory::reserve(bytes_of(&bytes), || format!("the statements of {}", path.display()))?;
        let text = String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes));
        let mut all = entries(&text);
        let index = options.exemplar_of(all.len(), path)?;
        let names: Vec<_> = all.iter().map(|entry| entry.name.clone()).collect();
        if all.is_empty() {
            return Err(Error::NotAMaterial {
                path: path.to_owned(),
                expected: "a material (newmtl NAME)".to_owned(),
                found: "none".to_owned(),
                remedy: "export the model with its materials".to_owned(),
            });
        }
        let entry = all.swap_remove(index);
        let packed = packed(&entry);
        Ok(Self {
            path: path.to_owned(),
            textures: textures(path, &entry, packed),
            packed,
            is_by_blender: text.starts_with("# Blender"),
            entry,
            materials: (names, index),
        })
    }

    pub(in crate::read) fn name(&self) -> &str {
        &self.entry.name
    }

    /// Every file that may be decoded.
    pub(in crate::read) fn files(&self) -> Vec<NamedFile> {
        self.textures.iter().filter_map(|texture| texture.picture.file().cloned()).collect()
    }
}

/// The memory that the statements of a file take at most.
fn bytes_of(text: &[u8]) -> u64 {
    /// Keyword and rest of a line, with room to grow, in bytes.
    const LINE: u64 = 192;
    // The text with its lines joined, and the texts of all statements.
    let lines = text.iter().filter(|byte| **byte == b'\n').count() as u64 + 1;
    4 * text.len() as u64 + LINE * lines
}

/// A material: its statements, each a keyword in lower case and the rest of its line.
#[derive(Debug)]
pub(super) struct MtlEntry {
    pub name: String,
    pub lines: Vec<(String, String)>,
}

/// A picture that a statement names.
#[derive(Debug)]
pub(super) struct MtlTexture {
    /// The keyword of the statement.
    pub key: &'static str,
    pub named: NamedTexture,
    /// The file that is there: beside the `.mtl`, or as named.
    pub picture: Picture,
}

/// Whether a statement of this keyword names a picture.
pub(super) fn names_picture(key: &str) -> bool {
    /// Statements that name pictures although they do not begin with `map_`.
    const PICTURES: [&str; 5] = ["norm", "bump", "disp", "decal", "refl"];
    key.starts_with("map_") || PICTURES.contains(&key)
}

/// The materials of an .mtl.
fn entries(text: &str) -> Vec<MtlEntry> {
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
pub(super) struct NamedTexture {
    pub file: String,
    /// The one channel that is wanted; 3 is alpha.
    pub channel: Option<usize>,
    /// Options that change the look, and are not used.
    pub unused: Vec<String>,
}

impl NamedTexture {
    /// Options with their values come first; the rest is the name, which may have spaces.
    fn of(mut rest: &str) -> Self {
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
    fn named_file(&self, mtl: &Path) -> NamedFile {
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

/// The statement of a picture of roughness and metallic: one of its own, or `map_Ks` by the name of its file or by the `bsdf` of
/// nvdiffrec.
fn packed(entry: &MtlEntry) -> Option<(&'static str, Role)> {
    let has = |key: &str| entry.lines.iter().any(|(k, _)| k == key);
    let orm = Role::OcclusionRoughnessMetallic;
    let own = [("map_orm", orm), ("map_rma", Role::RoughnessMetallicOcclusion)];
    let specular = entry.lines.iter().find(|(key, _)| key == "map_ks");
    let named = |rest: &str| {
        let file = NamedTexture::of(rest).file;
        let stem = Path::new(&file).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Label::of(&stem).is_some_and(|label| label.role == Role::OcclusionRoughnessMetallic)
    };
    let lone = has("map_kd") && !has("map_pr") && !has("map_pm");
    let is_specular = lone && specular.is_some_and(|(_, rest)| has("bsdf") || named(rest));
    own.into_iter().find(|(key, _)| has(key)).or(is_specular.then_some(("map_ks", orm)))
}

/// The pictures that are read of a material, and the maps that they are read as.
fn textures(path: &Path, entry: &MtlEntry, packed: Option<(&'static str, Role)>) -> Vec<MtlTexture> {
    let line = |key: &str| entry.lines.iter().find(|(k, _)| k == key).map(|(_, rest)| rest);
    let normal = NORMALS.into_iter().chain(BUMPS).find(|key| line(key).is_some());
    let specular = (line("map_pm").is_none() && packed.is_none()).then_some("map_ks");
    let keys = [
        (Some("map_kd"), Role::Diffuse),
        (Some("map_pr"), Role::Roughness),
        (Some("map_pm"), Role::Metallic),
        (specular, Role::Specular),
        (packed.map(|(key, _)| key), packed.map_or(Role::Specular, |(_, role)| role)),
        (normal, Role::Normal),
    ];
    let texture = |(key, role): (Option<&'static str>, Role)| {
        let key = key?;
        let named = NamedTexture::of(line(key)?);
        let picture = Picture::of_file(named.named_file(path), role);
        Some(MtlTexture { key, named, picture })
    };
    keys.into_iter().filter_map(texture).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_come_before_a_name_that_may_have_spaces() {
        let file = |text| NamedTexture::of(text).file;
        assert_eq!(file("old wall.png"), "old wall.png");
        assert_eq!(file(" -bm 1.0 -clamp on  old wall.png "), "old wall.png");
        assert_eq!(file("-s 2 2 1001.png"), "1001.png");
        assert_eq!(file("-o 0.5 -imfchan g 2k.png"), "2k.png");
        assert_eq!(file("-wall.png"), "-wall.png");
        assert_eq!(file("-bm"), "-bm");
        let texture = NamedTexture::of("-S 2 1 -mm 0 1 -bm 0.5 -imfchan g a.png");
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
