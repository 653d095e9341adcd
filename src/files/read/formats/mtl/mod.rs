//! Materials of a Wavefront `.mtl`: maps out of its pictures and factors, with the extension for roughness (`Pr`) and
//! metallic (`Pm`).

mod statement;

use std::path::Path;

use svbrdf_core::progress::Progress;

use crate::error::Error;
use crate::read::names::Label;
use crate::read::options::{Albedo, NormalY, ReadOptions, Role};
use crate::read::raster::channel_spread;
use crate::read::raster::measure::{NORMAL_AT_LEAST, normal_score};
use crate::read::record::{Assumption, Certainty, Note, Reason, StorageConvention, Unused, What};
use crate::read::stored::{DecodedPicture, Inferred, MapsByRole, StoredMap, StoredMaterial, decoded, notice};

pub(in crate::read) use statement::Mtl;
use statement::{BUMPS, NORMALS, NamedTexture, names_picture};

/// Channels of a gray picture differ by no more: compression and rounding.
const GRAY: f64 = 12.0 / 255.0;

impl Mtl {
    /// Reads its maps; each picture is one step of `progress`.
    ///
    /// # Errors
    /// [`Error::NotAMaterial`] where maps are missing, [`Error::BadImage`] where a factor is no number; those of its pictures.
    pub(in crate::read) fn read(
        self,
        options: &ReadOptions,
        progress: &Progress,
    ) -> Result<StoredMaterial, Error> {
        let pictures = decoded(self.textures.iter().map(|texture| &texture.picture), progress)?;
        let mut statements = MtlMaps {
            mtl: &self,
            pictures: &pictures,
            used: Vec::new(),
            spaces: Vec::new(),
            assumptions: Vec::new(),
            notes: Vec::new(),
        };
        let maps = statements.recognized()?;
        statements.note_unused();
        let MtlMaps { assumptions, notes, spaces, .. } = statements;
        let name = self.entry.name.clone();
        let mut found = maps.material(&self.path, name, "the statements of the .mtl", options)?;
        found.add_file(self.path.clone());
        let space = |map: Role| spaces.iter().find(|(whose, _)| *whose == map).map(|(_, space)| *space);
        let hint = |space| {
            let is_srgb = space == Albedo::Srgb;
            let why = if is_srgb { StorageConvention::MtlColours } else { StorageConvention::Floats };
            (space, why.into(), Certainty::Likely)
        };
        found.inferred.albedo = space(Role::Diffuse).map(hint);
        found.inferred.specular = space(Role::Specular).map(hint);
        found.inferred.normal_y = found.normal.as_ref().and_then(|source| named_y(&source.file));
        let layout = Assumption::new(What::Layout, "MTL", StorageConvention::ListedTextures, Certainty::Sure);
        found.assumptions.insert(0, layout);
        found.assumptions.extend(assumptions);
        found.notes.splice(0..0, notes);
        found.note_document(Vec::new(), self.materials.clone());
        notice(&mut found, &pictures, |_| true);
        Ok(found)
    }
}

/// The direction of y in the name of a normal map.
fn named_y(file: &Path) -> Inferred<NormalY> {
    let name = file.file_name()?.to_string_lossy().into_owned();
    let y = Label::of(&file.file_stem()?.to_string_lossy())?.normal_y?;
    Some((y, Reason::FileName { file: name }, Certainty::Sure))
}

/// The statements of a material while its maps are recognized.
struct MtlMaps<'a> {
    mtl: &'a Mtl,
    pictures: &'a [DecodedPicture],
    /// Keywords that have been used.
    used: Vec<&'a str>,
    /// How each map of colours is stored.
    spaces: Vec<(Role, Albedo)>,
    assumptions: Vec<Assumption>,
    notes: Vec<Note>,
}

impl<'a> MtlMaps<'a> {
    /// The maps of the statements.
    fn recognized(&mut self) -> Result<MapsByRole, Error> {
        let mut maps = MapsByRole::default();
        let colour = self.colour("map_kd", "kd", Role::Diffuse)?;
        let packed = self.mtl.packed;
        let packed = packed.and_then(|(key, role)| Some((key, role, self.picture(&[key], role)?)));
        let is_packed = packed.is_some();
        // A picture of its own, or without a packed one a number, too.
        let is_stated = |this: &Self, map: &str| !is_packed || this.has(map);
        let roughness = match is_stated(self, "map_pr") {
            true => self.value("map_pr", "pr", Role::Roughness)?,
            false => None,
        };
        let metallic = match is_stated(self, "map_pm") && (self.has("map_pm") || !self.has("map_ks")) {
            true => self.value("map_pm", "pm", Role::Metallic)?,
            false => None,
        };
        let is_metallic = is_packed || metallic.is_some();
        if let Some((key, role, source)) = packed {
            if key == "map_ks" {
                let why = StorageConvention::NvdiffrecPacking;
                let layout = "map_Ks is occlusion | roughness | metallic";
                self.assumptions.push(Assumption::new(What::Layout, layout, why, Certainty::Likely));
            }
            maps.add(role, source);
        } else if !is_metallic && self.has("map_ks") {
            let specular = self.colour("map_ks", "ks", Role::Specular)?;
            specular.into_iter().for_each(|source| maps.add(Role::Specular, source));
        }
        if let Some(metallic) = metallic {
            maps.add(Role::Metallic, metallic);
        }
        if let Some(colour) = colour {
            maps.add(if is_metallic { Role::Base } else { Role::Diffuse }, colour);
        }
        let roughness = if is_packed { roughness } else { roughness.or_else(|| self.by_exponent()) };
        if let Some(roughness) = roughness {
            maps.add(Role::Roughness, roughness);
        }
        if let Some(normal) = self.normal() {
            maps.add(Role::Normal, normal);
        }
        Ok(maps)
    }

    fn has(&self, key: &str) -> bool {
        self.mtl.entry.lines.iter().any(|(k, _)| k == key)
    }

    /// The keyword and the rest of the first line of one of `keys`, which counts as used from now on.
    fn used(&mut self, keys: &[&str]) -> Option<&'a (String, String)> {
        let lines = &self.mtl.entry.lines;
        let line = keys.iter().find_map(|key| lines.iter().find(|(k, _)| k == key))?;
        self.used.push(&line.0);
        Some(line)
    }

    /// One or three numbers.
    fn factor(&mut self, key: &str) -> Result<Option<[f32; 3]>, Error> {
        let Some((_, rest)) = self.used(&[key]) else { return Ok(None) };
        let numbers: Option<Vec<f32>> = rest.split_whitespace().map(|word| word.parse().ok()).collect();
        match numbers.as_deref() {
            Some([all]) => Ok(Some([*all; 3])),
            Some([r, g, b]) => Ok(Some([*r, *g, *b])),
            _ => Err(Error::BadImage {
                path: self.mtl.path.clone(),
                problem: format!(
                    "{}: expected one or three numbers after {key}, found `{rest}`",
                    self.mtl.entry.name
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
        if self.mtl.is_by_blender {
            self.notes.push(Note::Unused { what: format!("{key} {factor:?}"), why: Unused::Blender });
            return Ok(ALONE);
        }
        let chosen = format!("{} times {factor:?}", map.name());
        let why = Reason::MtlFactor { key: key.to_owned() };
        self.assumptions.push(Assumption::new(What::Values, chosen, why, Certainty::Unsure));
        Ok(factor)
    }

    fn colour(&mut self, map: &str, key: &str, role: Role) -> Result<Option<StoredMap>, Error> {
        match self.picture(&[map], role) {
            Some(source) => {
                let space = if source.raster.is_float() { Albedo::Linear } else { Albedo::Srgb };
                self.spaces.push((role, space));
                Ok(Some(source.times(self.beside(key, role)?, space)))
            }
            None => {
                self.spaces.push((role, Albedo::Srgb));
                let white = StoredMap::constant(&self.mtl.path, &[1.0; 3]);
                Ok(self.factor(key)?.map(|factor| white.times(factor, Albedo::Srgb)))
            }
        }
    }

    /// A picture, or a value where there is none.
    fn value(&mut self, map: &str, key: &str, role: Role) -> Result<Option<StoredMap>, Error> {
        match self.picture(&[map], role) {
            Some(source) => Ok(Some(source)),
            None => Ok(self.factor(key)?.map(|factor| StoredMap::constant(&self.mtl.path, &factor[..1]))),
        }
    }

    /// The roughness of the highlight that Blinn and Phong's exponent `Ns` makes.
    fn by_exponent(&mut self) -> Option<StoredMap> {
        let exponent: f32 =
            self.used(&["ns"])?.1.parse().ok().filter(|n: &f32| n.is_finite() && *n >= 0.0)?;
        let roughness = (2.0 / (exponent + 2.0)).powf(0.25);
        let why = Reason::Exponent(exponent);
        let chosen = format!("roughness {roughness:.3}");
        self.assumptions.push(Assumption::new(What::Missing, chosen, why, Certainty::Unsure));
        Some(StoredMap::constant(&self.mtl.path, &[roughness]))
    }

    fn normal(&mut self) -> Option<StoredMap> {
        if let Some(normal) = self.picture(&NORMALS, Role::Normal) {
            return Some(normal);
        }
        let bump = self.picture(&BUMPS, Role::Normal)?;
        if bump.raster.is_float() || normal_score(&bump.raster) >= NORMAL_AT_LEAST {
            return Some(bump);
        }
        let what = bump.file.display().to_string();
        let is_gray = channel_spread(&bump.raster.channels) <= GRAY;
        let why = if is_gray { Unused::Heights } else { Unused::NotNormals };
        self.notes.push(Note::Unused { what, why });
        None
    }

    /// The picture that the first of the statements `keys` names.
    fn picture(&mut self, keys: &[&str], map: Role) -> Option<StoredMap> {
        let key = self.used(keys)?.0.as_str();
        let place = self.mtl.textures.iter().position(|texture| texture.key == key)?;
        let NamedTexture { file: named, channel, unused } = &self.mtl.textures[place].named;
        let DecodedPicture { map: StoredMap { mut raster, file, .. }, notes, .. } =
            self.pictures[place].clone();
        if file != self.mtl.path.with_file_name(named) {
            self.notes.push(Note::Substituted { file: named.clone(), by: file.clone() });
        }
        self.notes.push(Note::MapFile { map, file: file.display().to_string() });
        self.notes.extend(notes);
        if !unused.is_empty() {
            self.notes.push(Note::OptionsUnused { map, options: unused.clone() });
        }
        match *channel {
            Some(3) => {
                raster = raster.alpha.clone().map_or_else(|| raster.channel(0), |alpha| raster.of(alpha))
            }
            Some(channel) => raster = raster.channel(channel),
            None => {}
        }
        Some(StoredMap { raster, file, part: String::new() })
    }

    fn note_unused(&mut self) {
        let (mut pictures, mut others): (Vec<_>, Vec<_>) = (Vec::new(), Vec::new());
        for (key, rest) in self.mtl.entry.lines.iter().filter(|(key, _)| !self.used.contains(&key.as_str())) {
            if names_picture(key) {
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
