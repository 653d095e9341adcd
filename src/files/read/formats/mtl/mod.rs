//! Wavefront `.mtl`: pictures and factors of a material, with the extension for roughness (`Pr`) and metallic (`Pm`).

mod statement;

use std::fs;
use std::path::Path;

use super::ahead::Ahead;
use crate::error::Error;
use crate::files::read::assumption::{Assumption, Certainty, What};
use crate::files::read::interpret::detect::{NORMAL_AT_LEAST, normal_score};
use crate::files::read::locate::names::{Label, Role};
use crate::files::read::note::{Note, Subject, Unused};
use crate::files::read::options::{Albedo, NormalY, ReadOptions};
use crate::files::read::pictures::Pictures;
use crate::files::read::reason::Reason;
use crate::files::read::storage_convention::StorageConvention;
use crate::files::read::stored::{Inferred, StoredMap, StoredMaterial};
use crate::progress::Progress;
use statement::{BUMPS, MtlEntry, NORMALS, Texture, entries, is_packed, is_picture, listed};

/// Reads material number `exemplar` of the file `path`.
///
/// # Errors
/// As `read`.
pub(crate) fn open(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<StoredMaterial, Error> {
    let bytes = fs::read(path).map_err(|source| Error::unreadable(path, source))?;
    let text = String::from_utf8_lossy(&bytes);
    let all = entries(&text);
    let index = options.exemplar_of(all.len(), path)?;
    let entry = all.get(index).ok_or_else(|| Error::NotAMaterial {
        path: path.to_owned(),
        expected: "a material (newmtl NAME)".to_owned(),
        found: "none".to_owned(),
        remedy: "export the model with its materials".to_owned(),
    })?;
    if !entry.lines.iter().any(|(key, _)| is_picture(key)) {
        return Err(Error::NoTextures {
            path: path.to_owned(),
            name: entry.name.clone(),
            exemplar: index,
            count: all.len(),
        });
    }
    let mut reading = MtlReading {
        path,
        entry,
        ahead: Ahead::of(listed(path, entry), progress)?,
        of_blender: text.starts_with("# Blender"),
        used: Vec::new(),
        spaces: Vec::new(),
        assumptions: Vec::new(),
        notes: Vec::new(),
    };
    let pictures = reading.pictures()?;
    reading.note_unused();
    let MtlReading { assumptions, notes, spaces, .. } = reading;
    let mut found = pictures.assemble(path, entry.name.clone(), "the statements of the .mtl", options)?;
    found.files.push(path.to_owned());
    found.files.sort();
    found.files.dedup();
    let space = |map: Role| spaces.iter().find(|(whose, _)| *whose == map).map(|(_, space)| *space);
    let hint = |space| {
        let why =
            if space == Albedo::Srgb { StorageConvention::MtlColours } else { StorageConvention::Floats };
        (space, why.into(), Certainty::Likely)
    };
    found.inferred.albedo = space(Role::Diffuse).map(hint);
    found.inferred.specular = space(Role::Specular).map(hint);
    found.inferred.normal_y = found.normal.as_ref().and_then(|source| named_y(&source.file));
    let layout = Assumption::new(What::Layout, "MTL", StorageConvention::ListedTextures, Certainty::Sure);
    found.assumptions.insert(0, layout);
    found.assumptions.extend(assumptions);
    found.notes.splice(0..0, notes);
    if all.len() > 1 {
        let names = all.iter().map(|entry| entry.name.clone()).collect();
        found.notes.push(Note::Materials { names, index });
    }
    Ok(found)
}

/// What the name of a normal map tells about its y.
fn named_y(file: &Path) -> Inferred<NormalY> {
    let name = file.file_name()?.to_string_lossy().into_owned();
    let y = Label::of(&file.file_stem()?.to_string_lossy())?.normal_y?;
    Some((y, Reason::FileName { file: name }, Certainty::Sure))
}

/// The material `entry` while it is read.
struct MtlReading<'a> {
    path: &'a Path,
    entry: &'a MtlEntry,
    ahead: Ahead,
    of_blender: bool,
    /// Keywords that have been made use of.
    used: Vec<&'a str>,
    /// How each map of colours is stored.
    spaces: Vec<(Role, Albedo)>,
    assumptions: Vec<Assumption>,
    notes: Vec<Note>,
}

impl<'a> MtlReading<'a> {
    fn pictures(&mut self) -> Result<Pictures, Error> {
        let mut pictures = Pictures::default();
        let colour = self.colour("map_kd", "kd", Role::Diffuse)?;
        let packed = is_packed(self.entry);
        let roughness = self.value("map_pr", "pr", Role::Roughness)?;
        let specular = if packed { self.load(&["map_ks"], Role::OcclusionRoughnessMetallic)? } else { None };
        let metallic = if self.has("map_pm") || !self.has("map_ks") {
            self.value("map_pm", "pm", Role::Metallic)?
        } else {
            None
        };
        let is_metallic = packed || metallic.is_some();
        if let Some(packed) = specular {
            let why = StorageConvention::NvdiffrecPacking;
            let layout = "map_Ks is occlusion | roughness | metallic";
            self.assumptions.push(Assumption::new(What::Layout, layout, why, Certainty::Likely));
            pictures.add(Role::OcclusionRoughnessMetallic, packed);
        } else if !is_metallic && self.has("map_ks") {
            let specular = self.colour("map_ks", "ks", Role::Specular)?;
            specular.into_iter().for_each(|source| pictures.add(Role::Specular, source));
        }
        if let Some(metallic) = metallic {
            pictures.add(Role::Metallic, metallic);
        }
        if let Some(colour) = colour {
            pictures.add(if is_metallic { Role::Base } else { Role::Diffuse }, colour);
        }
        let roughness = if packed { roughness } else { roughness.or_else(|| self.by_exponent()) };
        if let Some(roughness) = roughness {
            pictures.add(Role::Roughness, roughness);
        }
        if let Some(normal) = self.normal()? {
            pictures.add(Role::Normal, normal);
        }
        Ok(pictures)
    }

    fn has(&self, key: &str) -> bool {
        self.entry.lines.iter().any(|(k, _)| k == key)
    }

    /// The rest of the first line of one of `keys`, which count as used from now on.
    fn line(&mut self, keys: &[&str]) -> Option<&'a str> {
        let (key, rest) = keys.iter().find_map(|key| self.entry.lines.iter().find(|(k, _)| k == key))?;
        self.used.push(key);
        Some(rest)
    }

    /// One or three numbers.
    fn factor(&mut self, key: &str) -> Result<Option<[f32; 3]>, Error> {
        let Some(rest) = self.line(&[key]) else { return Ok(None) };
        let numbers: Option<Vec<f32>> = rest.split_whitespace().map(|word| word.parse().ok()).collect();
        match numbers.as_deref() {
            Some([all]) => Ok(Some([*all; 3])),
            Some([r, g, b]) => Ok(Some([*r, *g, *b])),
            _ => Err(Error::BadImage {
                path: self.path.to_owned(),
                problem: format!(
                    "{}: expected one or three numbers after {key}, found `{rest}`",
                    self.entry.name
                ),
                remedy: "write linear red, green and blue from 0 to 1".to_owned(),
            }),
        }
    }

    /// The factor beside a picture of colours, recorded.
    fn beside(&mut self, key: &str, map: Role) -> Result<[f32; 3], Error> {
        const ALONE: [f32; 3] = [1.0; 3];
        let Some(factor) = self.factor(key)?.filter(|f| *f != ALONE) else { return Ok(ALONE) };
        if factor == [0.0; 3] {
            let what = format!("{key} 0");
            self.notes.push(Note::Unused { what, why: Unused::FactorZero { map } });
            return Ok(ALONE);
        }
        if self.of_blender {
            self.notes.push(Note::Unused { what: format!("{key} {factor:?}"), why: Unused::Blender });
            return Ok(ALONE);
        }
        let chosen = format!("{} times {factor:?}", map.name());
        let why = Reason::MtlFactor { key: key.to_owned() };
        self.assumptions.push(Assumption::new(What::Values, chosen, why, Certainty::Unsure));
        Ok(factor)
    }

    fn colour(&mut self, map: &str, key: &str, role: Role) -> Result<Option<StoredMap>, Error> {
        match self.load(&[map], role)? {
            Some(source) => {
                let space = if source.raster.is_float() { Albedo::Linear } else { Albedo::Srgb };
                self.spaces.push((role, space));
                Ok(Some(source.times(self.beside(key, role)?, space)))
            }
            None => {
                self.spaces.push((role, Albedo::Srgb));
                let white = StoredMap::constant(self.path, &[1.0; 3]);
                Ok(self.factor(key)?.map(|factor| white.times(factor, Albedo::Srgb)))
            }
        }
    }

    /// A picture, or a value where there is none.
    fn value(&mut self, map: &str, key: &str, role: Role) -> Result<Option<StoredMap>, Error> {
        match self.load(&[map], role)? {
            Some(source) => Ok(Some(source)),
            None => Ok(self.factor(key)?.map(|factor| StoredMap::constant(self.path, &factor[..1]))),
        }
    }

    /// The roughness of the highlight that Blinn and Phong's exponent `Ns` makes.
    fn by_exponent(&mut self) -> Option<StoredMap> {
        let exponent: f32 = self.line(&["ns"])?.parse().ok().filter(|n: &f32| n.is_finite() && *n >= 0.0)?;
        let roughness = (2.0 / (exponent + 2.0)).powf(0.25);
        let why = Reason::Exponent(exponent);
        let chosen = format!("roughness {roughness:.3}");
        self.assumptions.push(Assumption::new(What::Missing, chosen, why, Certainty::Unsure));
        Some(StoredMap::constant(self.path, &[roughness]))
    }

    fn normal(&mut self) -> Result<Option<StoredMap>, Error> {
        if let Some(normal) = self.load(&NORMALS, Role::Normal)? {
            return Ok(Some(normal));
        }
        let Some(bump) = self.load(&BUMPS, Role::Normal)? else { return Ok(None) };
        if bump.raster.is_float() || normal_score(&bump.raster) >= NORMAL_AT_LEAST {
            return Ok(Some(bump));
        }
        let what = bump.file.display().to_string();
        self.notes.push(Note::Unused { what, why: Unused::Heights });
        Ok(None)
    }

    /// The picture that the first of the statements `keys` names.
    fn load(&mut self, keys: &[&str], map: Role) -> Result<Option<StoredMap>, Error> {
        let Some(rest) = self.line(keys) else { return Ok(None) };
        let texture = Texture::of(rest);
        let file = texture.path(self.path);
        let Texture { file: said, channel, unused } = texture;
        if file != self.path.with_file_name(&said) {
            self.notes.push(Note::Substituted { file: said, by: file.clone() });
        }
        let (mut raster, notes) = self.ahead.picture(&file, Subject::Map(map))?;
        self.notes.push(Note::MapFile { map, file: file.display().to_string() });
        self.notes.extend(notes);
        if !unused.is_empty() {
            self.notes.push(Note::OptionsUnused { map, options: unused });
        }
        match channel {
            Some(3) => {
                raster = raster.alpha.clone().map_or_else(|| raster.channel(0), |alpha| raster.of(alpha))
            }
            Some(channel) => raster = raster.channel(channel),
            None => {}
        }
        Ok(Some(StoredMap { raster, file, part: String::new() }))
    }

    fn note_unused(&mut self) {
        let (mut pictures, mut others): (Vec<_>, Vec<_>) = (Vec::new(), Vec::new());
        for (key, rest) in self.entry.lines.iter().filter(|(key, _)| !self.used.contains(&key.as_str())) {
            if is_picture(key) {
                pictures.push(format!("{key} {rest}"))
            } else {
                others.push(format!("{key} {rest}"))
            }
        }
        let unused = |what| Note::Unused { what, why: Unused::NotAMap };
        self.notes.extend(pictures.into_iter().map(unused));
        if !others.is_empty() {
            self.notes.push(Note::StatementsUnused(others));
        }
    }
}
