//! Wavefront `.mtl`: pictures and factors of a material, with the extension for roughness (`Pr`) and metallic (`Pm`).

mod statement;

use std::fs;
use std::path::Path;

use crate::error::Error;
use crate::files::read::assumption::{Assumption, Certainty, What};
use crate::files::read::decode;
use crate::files::read::interpret::detect::{NORMAL_AT_LEAST, normal_score};
use crate::files::read::locate::names::{Label, Role};
use crate::files::read::options::{Albedo, NormalY, ReadOptions};
use crate::files::read::stored::{Found, Hint, Pictures, Source};
use crate::progress::Progress;
use statement::{Entry, Texture, entries, is_picture};

/// Statements for normals, the plainest first; those of `bump` may also hold heights.
const NORMALS: [&str; 2] = ["norm", "map_kn"];
const BUMPS: [&str; 2] = ["map_bump", "bump"];

/// Reads material number `exemplar` of the file `path`.
///
/// # Errors
/// As `read`.
pub fn open(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<Found, Error> {
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
        return Err(Error::NotAMaterial {
            path: path.to_owned(),
            expected: "a material with textures".to_owned(),
            found: format!("{} (number {index} of {}) without one", entry.name, all.len()),
            remedy: "choose another with --exemplar".to_owned(),
        });
    }
    progress.begin(6);
    let mut reading = Reading {
        path,
        entry,
        progress,
        of_blender: text.starts_with("# Blender"),
        used: Vec::new(),
        spaces: Vec::new(),
        assumptions: Vec::new(),
        notes: Vec::new(),
    };
    let pictures = reading.pictures()?;
    reading.say_unused();
    let Reading { assumptions, notes, spaces, .. } = reading;
    let mut found = pictures.into_found(path, entry.name.clone(), "the statements of the .mtl", options)?;
    found.files.push(path.to_owned());
    found.files.sort();
    found.files.dedup();
    let space = |map: &str| spaces.iter().find(|(whose, _)| *whose == map).map(|(_, space)| *space);
    let hint = |space| {
        let why = if space == Albedo::Srgb {
            "colours beside an .mtl are sRGB by custom"
        } else {
            "floats are linear"
        };
        (space, why.to_owned(), Certainty::Likely)
    };
    found.hints.albedo = space("diffuse").map(hint);
    found.hints.specular = space("specular").map(hint);
    found.hints.normal_y = found.normal.as_ref().and_then(|source| named_y(&source.file));
    let layout = Assumption::new(What::Layout, "MTL", "the file names its textures", Certainty::Sure);
    found.assumptions.insert(0, layout);
    found.assumptions.extend(assumptions);
    found.notes.splice(0..0, notes);
    if all.len() > 1 {
        let count = all.len();
        found.notes.push(format!(
            "The .mtl holds {count} materials; this is number {index} from 0. Another: --exemplar."
        ));
    }
    Ok(found)
}

/// What the name of a normal map says of its y.
fn named_y(file: &Path) -> Hint<NormalY> {
    let name = file.file_name()?.to_string_lossy();
    let y = Label::of(&file.file_stem()?.to_string_lossy())?.normal_y?;
    Some((y, format!("{name} is called so"), Certainty::Sure))
}

/// The material `entry` while it is read.
struct Reading<'a> {
    path: &'a Path,
    entry: &'a Entry,
    progress: &'a Progress,
    of_blender: bool,
    /// Keywords that have been made use of.
    used: Vec<&'a str>,
    /// How each map of colours is stored.
    spaces: Vec<(&'static str, Albedo)>,
    assumptions: Vec<Assumption>,
    notes: Vec<String>,
}

impl<'a> Reading<'a> {
    fn pictures(&mut self) -> Result<Pictures, Error> {
        let mut pictures = Pictures::default();
        let colour = self.colour("map_kd", "kd", "diffuse")?;
        let packed = self.is_packed();
        let roughness = self.value("map_pr", "pr", "roughness")?;
        let specular = if packed { self.load(&["map_ks"], "packed roughness and metallic")? } else { None };
        let metallic = if self.has("map_pm") || !self.has("map_ks") {
            self.value("map_pm", "pm", "metallic")?
        } else {
            None
        };
        let is_metallic = packed || metallic.is_some();
        if let Some(packed) = specular {
            let why = "nvdiffrec writes it so beside map_Kd";
            let layout = "map_Ks is occlusion | roughness | metallic";
            self.assumptions.push(Assumption::new(What::Layout, layout, why, Certainty::Likely));
            pictures.add(Role::OcclusionRoughnessMetallic, packed);
        } else if !is_metallic && self.has("map_ks") {
            let specular = self.colour("map_ks", "ks", "specular")?;
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

    /// Whether specular is occlusion, roughness and metallic: so its name says, or the `bsdf` of nvdiffrec.
    fn is_packed(&self) -> bool {
        let specular = self.entry.lines.iter().find(|(key, _)| key == "map_ks");
        let named = |rest: &str| {
            let file = Texture::of(rest).file;
            let stem = Path::new(&file).file_stem().unwrap_or_default().to_string_lossy().into_owned();
            Label::of(&stem).is_some_and(|label| label.role == Role::OcclusionRoughnessMetallic)
        };
        let lone = self.has("map_kd") && !self.has("map_pr") && !self.has("map_pm");
        lone && specular.is_some_and(|(_, rest)| self.has("bsdf") || named(rest))
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

    /// The factor beside a picture of colours, said.
    fn beside(&mut self, key: &str, what: &str) -> Result<[f32; 3], Error> {
        const ALONE: [f32; 3] = [1.0; 3];
        let Some(factor) = self.factor(key)?.filter(|f| *f != ALONE) else { return Ok(ALONE) };
        if factor == [0.0; 3] {
            self.notes.push(format!("{key} 0 is not used: nothing would be left of the {what} map."));
            return Ok(ALONE);
        }
        if self.of_blender {
            self.notes.push(format!(
                "{key} {factor:?} is not used: Blender, which wrote it, takes the picture alone."
            ));
            return Ok(ALONE);
        }
        let chosen = format!("{what} times {factor:?}");
        let why = format!(
            "{key} is a factor by the definition of MTL; some programs take the picture alone (--map)"
        );
        self.assumptions.push(Assumption::new(What::Values, chosen, why, Certainty::Unsure));
        Ok(factor)
    }

    fn colour(&mut self, map: &str, key: &str, what: &'static str) -> Result<Option<Source>, Error> {
        match self.load(&[map], what)? {
            Some(source) => {
                let space = if source.raster.is_float() { Albedo::Linear } else { Albedo::Srgb };
                self.spaces.push((what, space));
                Ok(Some(source.times(self.beside(key, what)?, space)))
            }
            None => {
                self.spaces.push((what, Albedo::Srgb));
                let white = Source::constant(self.path, &[1.0; 3]);
                Ok(self.factor(key)?.map(|factor| white.times(factor, Albedo::Srgb)))
            }
        }
    }

    /// A picture, or a value where there is none.
    fn value(&mut self, map: &str, key: &str, what: &str) -> Result<Option<Source>, Error> {
        match self.load(&[map], what)? {
            Some(source) => Ok(Some(source)),
            None => Ok(self.factor(key)?.map(|factor| Source::constant(self.path, &factor[..1]))),
        }
    }

    /// The roughness of the highlight that Blinn and Phong's exponent `Ns` makes.
    fn by_exponent(&mut self) -> Option<Source> {
        let exponent: f32 = self.line(&["ns"])?.parse().ok().filter(|n: &f32| n.is_finite() && *n >= 0.0)?;
        let roughness = (2.0 / (exponent + 2.0)).powf(0.25);
        let why = format!(
            "there is neither map_Pr nor Pr; the highlight of Ns {exponent} is as wide: r = (2 / (Ns + 2))^(1/4)"
        );
        let chosen = format!("roughness {roughness:.3}");
        self.assumptions.push(Assumption::new(What::Missing, chosen, why, Certainty::Unsure));
        Some(Source::constant(self.path, &[roughness]))
    }

    fn normal(&mut self) -> Result<Option<Source>, Error> {
        if let Some(normal) = self.load(&NORMALS, "normal")? {
            return Ok(Some(normal));
        }
        let Some(bump) = self.load(&BUMPS, "normal")? else { return Ok(None) };
        if bump.raster.is_float() || normal_score(&bump.raster) >= NORMAL_AT_LEAST {
            return Ok(Some(bump));
        }
        self.notes.push(format!("{} is not used: it holds heights, not normals.", bump.file.display()));
        Ok(None)
    }

    /// The picture that the first of the statements `keys` names.
    fn load(&mut self, keys: &[&str], what: &str) -> Result<Option<Source>, Error> {
        self.progress.step()?;
        let Some(rest) = self.line(keys) else { return Ok(None) };
        let texture = Texture::of(rest);
        let file = texture.path(self.path);
        let Texture { file: said, channel, unused } = texture;
        if file != self.path.with_file_name(&said) {
            self.notes.push(format!("{said} is not there; {} is taken.", file.display()));
        }
        let (mut raster, notes) = decode::decode_one(&file, &format!("{what} map"))?;
        self.notes.push(format!("The {what} map is {}.", file.display()));
        self.notes.extend(notes);
        if !unused.is_empty() {
            self.notes.push(format!("Of the {what} map {} is not used.", unused.join(", ")));
        }
        match channel {
            Some(3) => {
                raster = raster.alpha.clone().map_or_else(|| raster.channel(0), |alpha| raster.of(alpha))
            }
            Some(channel) => raster = raster.channel(channel),
            None => {}
        }
        Ok(Some(Source { raster, file, part: String::new() }))
    }

    fn say_unused(&mut self) {
        let (mut pictures, mut others): (Vec<_>, Vec<_>) = (Vec::new(), Vec::new());
        for (key, rest) in self.entry.lines.iter().filter(|(key, _)| !self.used.contains(&key.as_str())) {
            if is_picture(key) {
                pictures.push(format!("{key} {rest}"))
            } else {
                others.push(format!("{key} {rest}"))
            }
        }
        self.notes.extend(pictures.into_iter().map(|picture| format!("{picture} is not used.")));
        if !others.is_empty() {
            self.notes.push(format!("Of the .mtl is not used: {}.", others.join(", ")));
        }
    }
}
