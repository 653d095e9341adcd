//! Materials of a Wavefront `.mtl`: maps out of its pictures and numbers, with the extension for roughness (`Pr`) and metallic (`Pm`).

mod statement;

use std::path::{Path, PathBuf};

use svbrdf_core::progress::Progress;

use crate::disk::open::NamedFile;
use crate::disk::{memory, refuse_pointer};
use crate::error::Error;
use crate::read::names::Label;
use crate::read::options::{Albedo, NormalY, ReadOptions, Role};
use crate::read::raster::channel_spread;
use crate::read::raster::measure::{NORMAL_AT_LEAST, normal_score};
use crate::read::record::{Assumption, Certainty, Ground, Note, Reason, Unused, What};
use crate::read::stored::{Inferred, MapsByRole, Picture, StoredMap, StoredMaterial, decoded, notice};

use statement::{MtlEntry, bytes_of, entries, file_and_options, named_file};

/// Statements of pictures of normals, the plainest first; those of `bump` may also hold heights.
const NORMALS: [&str; 4] = ["norm", "map_kn", "map_bump", "bump"];
/// Channels of a gray picture differ by no more: compression and rounding.
const GRAY: f64 = 12.0 / 255.0;

const COLOURS: Reason = Reason::fixed(Ground::Convention, "colours of an .mtl are sRGB by convention");

/// A material of an `.mtl`, its pictures located.
#[derive(Debug)]
pub(in crate::read) struct Mtl {
    path: PathBuf,
    entry: MtlEntry,
    textures: Vec<MtlTexture>,
    /// The names of all materials of the file, and which of them this is.
    materials: (Vec<String>, usize),
}

/// A picture that a statement names.
#[derive(Debug)]
struct MtlTexture {
    key: &'static str,
    role: Role,
    /// Options before its name which change the look.
    options: Vec<String>,
    /// The file that is there: beside the `.mtl`, or as named.
    picture: Picture,
}

impl Mtl {
    /// Locates material number `exemplar` of the file `path`.
    pub(in crate::read) fn locate(path: &Path, options: &ReadOptions) -> Result<Self, Error> {
        let bytes = NamedFile::by_user(path).bytes()?;
        refuse_pointer(path, &bytes)?;
        let _reserved =
            memory::reserve(bytes_of(&bytes), || format!("the statements of {}", path.display()))?;
        let mut all =
            entries(&String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes)));
        let index = options.exemplar_of(all.len(), path)?;
        let names = all.iter().map(|entry| entry.name.clone()).collect();
        if all.is_empty() {
            return Err(Error::NotAMaterial {
                path: path.to_owned(),
                expected: "a material (newmtl NAME)".to_owned(),
                found: "none".to_owned(),
                remedy: "export the model with its materials".to_owned(),
            });
        }
        let entry = all.swap_remove(index);
        Ok(Self { path: path.to_owned(), textures: entry.textures(path), entry, materials: (names, index) })
    }

    pub(in crate::read) fn name(&self) -> &str {
        &self.entry.name
    }

    pub(in crate::read) fn files(&self) -> Vec<NamedFile> {
        self.textures.iter().filter_map(|texture| texture.picture.file().cloned()).collect()
    }

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
        let (mut maps, mut notes) = (MapsByRole::default(), Vec::new());
        for (texture, picture) in self.textures.iter().zip(&pictures) {
            let (map, file) = (picture.map.clone(), picture.map.file.display().to_string());
            if let Some(why) = texture.contradiction(&map) {
                notes.push(Note::Unused { what: file, why });
                continue;
            }
            notes.push(Note::MapFile { map: texture.role, file });
            if !texture.options.is_empty() {
                let (map, options) = (texture.role.name(), texture.options.join(", "));
                let unused = format!("Options of the {map} map that are not used: {options}.");
                notes.push(Note::Changed(unused));
            }
            maps.add(texture.role, map);
        }
        let numbers = self.add_numbers(&mut maps)?;
        notes.extend(self.unused(&numbers));
        let space = |roles: &[Role]| {
            let texture = self.textures.iter().position(|texture| roles.contains(&texture.role));
            let is_float = texture.is_some_and(|place| pictures[place].map.raster.is_float());
            Some(match is_float {
                true => (Albedo::Linear, Reason::FLOATS, Certainty::Likely),
                false => (Albedo::Srgb, COLOURS, Certainty::Likely),
            })
        };
        let (albedo, specular) = (space(&[Role::Diffuse, Role::Base]), space(&[Role::Specular]));
        let name = self.entry.name.clone();
        let mut found = maps.material(&self.path, name, "the statements of the .mtl", options)?;
        found.add_file(self.path.clone());
        found.is_mapped = true;
        (found.inferred.albedo, found.inferred.specular) = (albedo, specular);
        found.inferred.normal_y = found.normal.as_ref().and_then(|source| named_y(&source.file));
        let layout = Assumption::new(What::Layout, "MTL", Reason::LISTED, Certainty::Sure);
        found.assumptions.insert(0, layout);
        if self.entry.is_packed() {
            let why = Reason::measured("nvdiffrec writes it beside map_Kd");
            let chosen = "map_Ks is occlusion | roughness | metallic";
            found.assumptions.push(Assumption::new(What::Layout, chosen, why, Certainty::Likely));
        }
        found.notes.splice(0..0, notes);
        found.note_document(Vec::new(), self.materials);
        notice(&mut found, &pictures, |_| true);
        Ok(found)
    }

    /// Adds the maps that are stated as numbers alone; returns the keywords of their statements.
    fn add_numbers(&self, maps: &mut MapsByRole) -> Result<Vec<&'static str>, Error> {
        let has = |key: &str| self.entry.line(key).is_some();
        let is_packed = maps.has(Role::OcclusionRoughnessMetallic);
        let colour = if self.entry.is_metallic() { Role::Base } else { Role::Diffuse };
        let mut used = Vec::new();
        for (key, role, is_stated) in [
            ("kd", colour, !has("map_kd")),
            ("pr", Role::Roughness, !has("map_pr") && !is_packed),
            ("pm", Role::Metallic, !has("map_pm") && !has("map_ks")),
        ] {
            let factor = if is_stated { self.factor(key)? } else { None };
            let Some(factor) = factor else { continue };
            used.push(key);
            let map = match role.is_colour() {
                true => StoredMap::constant(&self.path, &[1.0; 3]).times(factor, Albedo::Srgb),
                false => StoredMap::constant(&self.path, &factor[..1]),
            };
            maps.add(role, map);
        }
        Ok(used)
    }

    /// One or three numbers.
    fn factor(&self, key: &str) -> Result<Option<[f32; 3]>, Error> {
        let Some(rest) = self.entry.line(key) else { return Ok(None) };
        let numbers: Option<Vec<f32>> = rest.split_whitespace().map(|word| word.parse().ok()).collect();
        match numbers.as_deref() {
            Some([all]) => Ok(Some([*all; 3])),
            Some([r, g, b]) => Ok(Some([*r, *g, *b])),
            _ => Err(Error::BadImage {
                path: self.path.clone(),
                problem: format!(
                    "{}: expected one or three numbers after {key}, found `{rest}`",
                    self.entry.name
                ),
                remedy: "write linear red, green and blue from 0 to 1".to_owned(),
            }),
        }
    }

    /// The note on the statements but those of the pictures and of these `numbers`.
    fn unused(&self, numbers: &[&str]) -> Option<Note> {
        let is_used = |key: &str| {
            // A Kd beside its picture is told with the options of that.
            let picture = if key == "kd" { "map_kd" } else { key };
            numbers.contains(&key) || self.textures.iter().any(|one| one.key == picture)
        };
        let left = self.entry.lines.iter().filter(|(key, _)| !is_used(key));
        let left = left.map(|(key, rest)| format!("{key} {rest}")).collect::<Vec<_>>().join(", ");
        (!left.is_empty()).then(|| Note::Told(format!("Statements of the .mtl that are not used: {left}.")))
    }
}

impl MtlEntry {
    /// Whether `map_Ks` holds roughness and metallic: by the name of its file, or by the `bsdf` of nvdiffrec.
    fn is_packed(&self) -> bool {
        let has = |key: &str| self.line(key).is_some();
        let is_named = |rest: &str| {
            let stem = Path::new(file_and_options(rest).0).file_stem().unwrap_or_default();
            Label::of(&stem.to_string_lossy())
                .is_some_and(|label| label.role == Role::OcclusionRoughnessMetallic)
        };
        has("map_kd")
            && !has("map_pr")
            && !has("map_pm")
            && self.line("map_ks").is_some_and(|rest| has("bsdf") || is_named(rest))
    }

    fn is_metallic(&self) -> bool {
        let has = |key: &str| self.line(key).is_some();
        self.is_packed() || has("map_pm") || (has("pm") && !has("map_ks"))
    }

    fn textures(&self, path: &Path) -> Vec<MtlTexture> {
        let specular = if self.is_packed() { Role::OcclusionRoughnessMetallic } else { Role::Specular };
        let is_specular = self.is_packed() || !self.is_metallic();
        let normal = NORMALS.into_iter().find(|key| self.line(key).is_some());
        let keys = [
            (Some("map_kd"), if self.is_metallic() { Role::Base } else { Role::Diffuse }),
            (Some("map_pr"), Role::Roughness),
            (Some("map_pm"), Role::Metallic),
            (is_specular.then_some("map_ks"), specular),
            (normal, Role::Normal),
        ];
        let texture = |(key, role): (Option<&'static str>, Role)| {
            let key = key?;
            let (named, mut options) = file_and_options(self.line(key)?);
            // A factor beside a picture of colours: some programs multiply, others use the picture alone.
            let factor = self.line("kd").filter(|_| key == "map_kd");
            let is_one = |rest: &&str| rest.split_whitespace().all(|number| number.parse() == Ok(1.0));
            options.extend(factor.filter(|rest| !is_one(rest)).map(|rest| format!("Kd {rest}")));
            Some(MtlTexture { key, role, options, picture: Picture::of_file(named_file(named, path), role) })
        };
        keys.into_iter().filter_map(texture).collect()
    }
}

impl MtlTexture {
    /// Why its pixels are not those of its map.
    fn contradiction(&self, map: &StoredMap) -> Option<Unused> {
        let may_be_heights = self.key.ends_with("bump") && !map.raster.is_float();
        if !may_be_heights || normal_score(&map.raster) >= NORMAL_AT_LEAST {
            return None;
        }
        let is_gray = channel_spread(&map.raster.channels) <= GRAY;
        Some(if is_gray { Unused::Heights } else { Unused::NotNormals })
    }
}

/// The direction of y in the name of a normal map.
fn named_y(file: &Path) -> Inferred<NormalY> {
    let why = Reason::stated(format!("{} is named so", file.file_name()?.to_string_lossy()));
    let y = Label::of(&file.file_stem()?.to_string_lossy())?.normal_y?;
    Some((y, why, Certainty::Sure))
}
