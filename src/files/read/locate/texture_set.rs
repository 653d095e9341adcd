//! Texture sets of Minecraft: `NAME.texture_set.json` names the pictures of colour, of metalness, emission and roughness, and of
//! normals or heights, or states constants.

use std::path::{Path, PathBuf};

use serde_json::{Map, Value};

use crate::disk::lfs;
use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::located::binding::LocatedBinding;
use crate::read::located::set::{LabelledFile, LocatedSet, SetFiles};
use crate::read::located::{Candidate, Located};
use crate::read::names::{Label, listing};
use crate::read::options::Role;
use crate::read::record::{Note, Unused};

/// How the names of these files end.
const END: &str = ".texture_set.json";
/// The key of what a file declares.
const KEY: &str = "minecraft:texture_set";
/// The keys of maps, and the maps. Subsurface scattering, in alpha, is not modelled.
const MAPS: [(&str, Role); 4] = [
    ("color", Role::Base),
    ("metalness_emissive_roughness", Role::MetallicEmissiveRoughness),
    ("metalness_emissive_roughness_subsurface", Role::MetallicEmissiveRoughness),
    ("normal", Role::Normal),
];
/// Metalness, emission and roughness where nothing is declared.
const DEFAULT: [f32; 3] = [0.0, 0.0, 1.0];
/// The extensions of pictures, the first that is there.
const EXTENSIONS: [&str; 4] = ["tga", "png", "jpg", "jpeg"];

/// Whether `path` is named as a texture set.
pub(super) fn is_named(path: &Path) -> bool {
    path.file_name().is_some_and(|name| name.to_string_lossy().to_lowercase().ends_with(END))
}

/// Locates the material of the texture set `path`.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::BadImage`] where it is no texture set, [`Error::NotAMaterial`] where a picture is absent.
pub(super) fn locate(path: &Path) -> Result<Located, Error> {
    let invalid = |found: String| Error::BadImage {
        path: path.to_owned(),
        problem: format!("expected a texture set (an object after {KEY}), found {found}"),
        remedy: "correct it".to_owned(),
    };
    let text = NamedFile::by_user(path).text()?;
    lfs::refuse_pointer(path, text.as_bytes())?;
    let document: Value = serde_json::from_str(&text).map_err(|e| invalid(e.to_string()))?;
    let declared = document.get(KEY).and_then(Value::as_object).ok_or_else(|| invalid("none".to_owned()))?;
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let (mut files, mut bound) = (SetFiles::default(), Vec::new());
    for (key, role) in MAPS {
        match declared.get(key) {
            None => {}
            Some(Value::String(name)) if !name.starts_with('#') => {
                let label = Label { role, word: key.replace('_', ""), stem: Vec::new(), normal_y: None };
                files.files.push(LabelledFile { file: picture(path, folder, key, name)?, label });
            }
            Some(value) => {
                let values = numbers(value).ok_or_else(|| invalid(format!("{value} after {key}")))?;
                bound.extend(constants(role, values));
            }
        }
    }
    if !files.files.iter().any(|file| file.label.role.has_roughness())
        && bound.iter().all(|one| one.role == Role::Base)
    {
        bound.extend(constants(Role::MetallicEmissiveRoughness, DEFAULT));
    }
    if let Some(Value::String(name)) = declared.get("heightmap") {
        files.notes.push(Note::Unused { what: name.clone(), why: Unused::Heights });
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let set = LocatedSet {
        path: path.to_owned(),
        folder: folder.to_owned(),
        name: name[..name.len() - END.len()].to_owned(),
        listing: named(declared),
        files,
        has_renderings: false,
        listed_by: Some(path.to_owned()),
    };
    Ok(Located { bound, ..Located::new([Candidate::Set(set)]) })
}

/// The picture of this name, relative to `folder`.
fn picture(path: &Path, folder: &Path, key: &str, name: &str) -> Result<String, Error> {
    let files = EXTENSIONS.map(|extension| format!("{name}.{extension}"));
    let found = files.iter().find(|file| folder.join(PathBuf::from(file)).is_file());
    found.cloned().ok_or_else(|| Error::NotAMaterial {
        path: path.to_owned(),
        expected: format!("the picture of {key}: {}", files.join(", ")),
        found: "none of them".to_owned(),
        remedy: "put it beside the texture set".to_owned(),
    })
}

/// Codes of 8 bits as numbers, from `[r, g, b]` or `"#rrggbb"`, each with or without alpha.
fn numbers(value: &Value) -> Option<[f32; 3]> {
    let codes: Vec<f64> = match value {
        Value::Array(all) => all.iter().map(Value::as_f64).collect::<Option<_>>()?,
        Value::String(text) => {
            let digits = text.strip_prefix('#').filter(|digits| digits.is_ascii())?;
            // Of four, alpha comes first.
            let digits = if digits.len() == 8 { &digits[2..] } else { digits };
            let pairs = digits.as_bytes().chunks(2).map(|pair| std::str::from_utf8(pair).ok());
            pairs.map(|pair| u8::from_str_radix(pair?, 16).ok().map(f64::from)).collect::<Option<_>>()?
        }
        _ => return None,
    };
    let [r, g, b] = *codes.first_chunk::<3>()?;
    let is_code = |code: &f64| (0.0..=255.0).contains(code);
    [r, g, b].iter().all(is_code).then(|| [r, g, b].map(|code| (code / 255.0) as f32))
}

/// The constants of a map.
fn constants(role: Role, values: [f32; 3]) -> Vec<LocatedBinding> {
    let of = |role: Role, values: &[f32]| LocatedBinding::constant(role, values);
    match role {
        Role::Base => vec![of(role, &values)],
        Role::Normal => Vec::new(),
        _ => vec![of(Role::Metallic, &values[..1]), of(Role::Roughness, &values[2..])],
    }
}

/// What the texture set names, for messages.
fn named(declared: &Map<String, Value>) -> String {
    listing(&declared.iter().map(|(key, value)| format!("{key} {value}")).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_are_codes_or_hexadecimal() {
        let of = |text: &str| numbers(&serde_json::from_str(text).unwrap());
        assert_eq!(of("[0, 51, 255]"), Some([0.0, 0.2, 1.0]));
        assert_eq!(of("[0, 51, 255, 9]"), Some([0.0, 0.2, 1.0]));
        assert_eq!(of("\"#0033ff\""), Some([0.0, 0.2, 1.0]));
        assert_eq!(of("\"#900033ff\""), Some([0.0, 0.2, 1.0]));
        for wrong in ["[1, 2]", "\"#12\"", "\"#gggggg\"", "7", "[300, 0, 0]", "\"#\u{e9}\""] {
            assert_eq!(of(wrong), None, "{wrong}");
        }
    }
}
