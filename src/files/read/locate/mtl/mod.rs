//! Materials of a Wavefront `.mtl`: their statements, and the files that these name.

mod statement;

use std::path::Path;

use crate::disk::open::NamedFile;
use crate::disk::{lfs, memory};
use crate::error::Error;
use crate::read::located::mtl::{BUMPS, LocatedMtl, MtlEntry, MtlTexture, NORMALS};
use crate::read::located::picture::{LocatedPicture, PictureSource};
use crate::read::names::Label;
use crate::read::options::{ReadOptions, Role};
use crate::read::record::Subject;

use statement::{Texture, entries};

/// Locates material number `exemplar` of the file `path`.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::Memory`], [`Error::NotAMaterial`] without a material, [`Error::NoSuchExemplar`].
pub(super) fn locate(path: &Path, options: &ReadOptions) -> Result<LocatedMtl, Error> {
    let bytes = NamedFile::by_user(path).bytes()?;
    lfs::refuse_pointer(path, &bytes)?;
    let _reserved = memory::reserve(bytes_of(&bytes), || format!("the statements of {}", path.display()))?;
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
    Ok(LocatedMtl {
        path: path.to_owned(),
        textures: textures(path, &entry, packed),
        packed,
        is_by_blender: text.starts_with("# Blender"),
        entry,
        materials: (names, index),
    })
}

/// The memory that the statements of a file take at most.
fn bytes_of(text: &[u8]) -> u64 {
    /// Keyword and rest of a line, with room to grow, in bytes.
    const LINE: u64 = 192;
    // The text with its lines joined, and the texts of all statements.
    let lines = text.iter().filter(|byte| **byte == b'\n').count() as u64 + 1;
    4 * text.len() as u64 + LINE * lines
}

/// The statement of a picture of roughness and metallic: one of its own, or `map_Ks` by the name of its file or by the `bsdf` of
/// nvdiffrec.
fn packed(entry: &MtlEntry) -> Option<(&'static str, Role)> {
    let has = |key: &str| entry.lines.iter().any(|(k, _)| k == key);
    let orm = Role::OcclusionRoughnessMetallic;
    let own = [("map_orm", orm), ("map_rma", Role::RoughnessMetallicOcclusion)];
    let specular = entry.lines.iter().find(|(key, _)| key == "map_ks");
    let named = |rest: &str| {
        let file = Texture::of(rest).file;
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
        let texture = Texture::of(line(key)?);
        let file = texture.named_file(path);
        let source = PictureSource::File(file.clone());
        let picture = LocatedPicture { source, subject: Subject::Map(role) };
        let Texture { file: named, channel, unused: unused_options } = texture;
        Some(MtlTexture { key, named, file: file.path().to_owned(), picture, channel, unused_options })
    };
    keys.into_iter().filter_map(texture).collect()
}
