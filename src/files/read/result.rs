//! A material that was read: the record of how, reports on its maps, and the storage of its values, for its diagnosis.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::Serialize;

use svbrdf_core::material::{Mask, Material};

use crate::disk::memory::Reserved;
use crate::error::{Error, Guess};
use crate::read::options::{NormalY, ReadOptions, Role, Roughness};
use crate::read::raster::{Raster, Samples, measure, step};
use crate::read::record::{Assumption, Certainty, Note, What};
use crate::read::storage::Storage;
use crate::read::stored::{StoredMap, StoredMaterial};

/// A material, and how it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Read<T> {
    pub material: Material<T>,
    /// Which texels are opaque, where the alpha of a map is a mask: 0 or 1 nearly everywhere.
    pub mask: Option<Mask>,
    /// The assumptions, each with its reason.
    pub assumptions: Vec<Assumption>,
    /// Other things that were noticed.
    pub notes: Vec<Note>,
    /// The files that were read, each once, for watching. None for a material from memory.
    pub files: Vec<PathBuf>,
    /// A report on each map as stored.
    pub maps: Vec<MapContent>,
    /// The options that it was read with: those of the caller and of the sidecar file.
    pub options: ReadOptions,
    /// The memory of the material. It counts towards the limit while this lives.
    pub memory: Arc<Reserved>,
}

impl<T> Read<T> {
    /// Notes and assumptions, a line each.
    pub fn messages(&self) -> impl Iterator<Item = String> {
        self.notes.iter().map(ToString::to_string).chain(self.assumptions.iter().map(ToString::to_string))
    }

    /// The names of the materials of a file of several, and which of them this is, from 0: without
    /// [`ReadOptions::exemplar`] the default.
    pub fn materials(&self) -> Option<(&[String], usize)> {
        self.notes.iter().find_map(|note| match note {
            Note::Materials { names, index } => Some((names.as_slice(), *index)),
            _ => None,
        })
    }

    /// The assumptions whose alternatives are as plausible.
    pub fn unsure(&self) -> impl Iterator<Item = &Assumption> {
        self.assumptions.iter().filter(|a| a.certainty == Certainty::Unsure)
    }

    /// Refuses guesses; `path` is the material that was read.
    ///
    /// A material passes that is read as the user, a specification, or the names of files, layers and formats specify:
    /// nothing is unsure, the interpretation of no value rests on a measurement of pixels alone, and nothing that changes
    /// the look is ignored.
    ///
    /// # Errors
    /// [`Error::Guessed`].
    pub fn refuse_guesses(&self, path: &Path) -> Result<(), Error> {
        let guessed = self.assumptions.iter().filter(|a| a.is_guess());
        let assumptions = guessed.map(|a| Guess { text: a.to_string(), key: a.what.key() });
        let changing = self.notes.iter().filter(|note| note.changes_look());
        let ignored = changing.map(|note| Guess { text: note.to_string(), key: None });
        match assumptions.chain(ignored).collect::<Vec<_>>() {
            guesses if guesses.is_empty() => Ok(()),
            guesses => Err(Error::Guessed { path: path.to_owned(), guesses }),
        }
    }

    /// The readings of its values and the steps of its maps. A map that comes from several files has the largest step of these.
    pub fn storage(&self) -> Storage {
        let chosen = |what| self.assumptions.iter().find(|a| a.what == what).map(|a| a.chosen.as_str());
        let encoding = |what| chosen(what).and_then(|name| name.parse().ok());
        let step = |of: &dyn Fn(Role) -> bool| {
            self.maps.iter().filter(|map| of(map.map)).map(|map| step(map.depth)).fold(0.0, f64::max)
        };
        let colours = encoding(What::Albedo);
        let has_specular = self.maps.iter().any(|map| map.map == Role::Specular);
        let off_unit = |note: &Note| if let Note::NormalLengths(off) = note { Some(*off) } else { None };
        let is_colour = |role| matches!(role, Role::Diffuse | Role::Base | Role::Metallic);
        Storage {
            colours,
            specular: if has_specular { encoding(What::Specular) } else { colours },
            base_colour: !has_specular,
            off_unit: self.notes.iter().find_map(off_unit).unwrap_or(0.0),
            normal_down: chosen(What::NormalY) == Some(NormalY::Down.name()),
            roughness: chosen(What::Roughness).and_then(|name| name.parse().ok()).unwrap_or(Roughness::R),
            // Assumed only where diffuse is not scaled.
            unscaled: self.assumptions.iter().any(|assumption| assumption.what == What::Energy),
            steps: [
                step(&|role| role == Role::Normal),
                step(&is_colour),
                step(&|role| if has_specular { role == Role::Specular } else { is_colour(role) }),
                step(&|role| role == Role::Roughness),
            ],
        }
    }
}

/// One map as stored.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(rename = "StoredMap"))]
pub struct MapContent {
    /// The map, such as "normal" or "base".
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub map: Role,
    pub file: PathBuf,
    /// Layer, channel or tile within the file; may be empty.
    pub part: String,
    /// (width, height) in texels.
    pub size: [usize; 2],
    /// How a sample is stored: "8-bit", "half".
    pub depth: &'static str,
    pub channels: usize,
    /// Least and largest finite sample; codes as fractions of the largest code.
    pub range: [f64; 2],
    /// Share of the samples, in [0, 1], that are 1 or more.
    pub clipped: f64,
    /// Whether every texel is the same.
    pub constant: bool,
    /// Share of the texels, in [0, 1], that are the same as their right neighbour.
    pub flat: f64,
    /// Share of the texels that are not unit vectors; only of normal maps.
    pub non_unit: Option<f64>,
    /// The curl correlation, near 1 where green points up and near -1 where it points down; only of normal maps that
    /// have slopes.
    pub curl: Option<f64>,
    /// Median of the least channel; only of specular maps.
    pub specular_median: Option<f64>,
}

impl fmt::Display for MapContent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [width, height] = self.size;
        let [low, high] = self.range;
        write!(f, "{:<12} {}", self.map.name(), self.file.display())?;
        if !self.part.is_empty() {
            write!(f, ", {}", self.part)?;
        }
        let channels = if self.channels == 1 { "channel" } else { "channels" };
        write!(
            f,
            ": {width} x {height}, {}, {} {channels}, {low:.4} to {high:.4}",
            self.depth, self.channels
        )?;
        if self.constant {
            write!(f, ", constant")?;
        } else if self.flat > 0.0 {
            write!(f, ", {:.1}% flat", 100.0 * self.flat)?;
        }
        if self.clipped > 0.0 {
            write!(f, ", {:.1}% at 1", 100.0 * self.clipped)?;
        }
        if let Some(share) = self.non_unit {
            write!(f, ", {:.1}% not of length 1, normalized", 100.0 * share)?;
        }
        if let Some(curl) = self.curl {
            write!(f, ", curl correlation {curl:+.2}")?;
        }
        if let Some(median) = self.specular_median {
            let of = if self.channels == 1 { "" } else { " of the least channel" };
            write!(f, ", median{of} {median:.3}")?;
        }
        Ok(())
    }
}

pub(super) fn reports(found: &StoredMaterial) -> Vec<MapContent> {
    found.sources().into_iter().map(|(map, source)| report(map, source)).collect()
}

fn report(map: Role, source: &StoredMap) -> MapContent {
    let raster = &source.raster;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut clipped, mut count) = (0, 0);
    for channel in &raster.channels {
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in raster.sampled().map(|i| channel.at(i)).filter(|v| v.is_finite()) {
            least = least.min(value);
            most = most.max(value);
            clipped += usize::from(value >= 1.0);
            count += 1;
        }
        (low, high) = (low.min(least), high.max(most));
    }
    let [non_unit, curl] = if map == Role::Normal { of_normals(raster) } else { [None; 2] };
    MapContent {
        map,
        file: source.file.clone(),
        part: source.part.clone(),
        size: raster.size(),
        depth: raster.depth,
        channels: raster.channels.len(),
        range: [low, high].map(|x| if x.is_finite() { x } else { 0.0 }),
        clipped: f64::from(clipped as u32) / f64::from(count.max(1) as u32),
        constant: raster.channels.iter().all(Samples::is_constant),
        flat: flat(raster),
        non_unit,
        curl,
        specular_median: (map == Role::Specular).then(|| measure::specular_median(raster)),
    }
}

/// Share of the texels that are not unit vectors, and the curl correlation.
fn of_normals(raster: &Raster) -> [Option<f64>; 2] {
    let unsigned = measure::normal_score(raster);
    // Codes of integers are never read as signed numbers.
    let signed = if raster.is_float() { measure::signed_normal_score(raster) } else { 0.0 };
    let vector = |index| raster.rgb(index).map(|c| if signed > unsigned { c } else { 2.0 * c - 1.0 });
    let curl = measure::curl(raster.width, raster.height, vector);
    [Some(1.0 - unsigned.max(signed)), curl]
}

/// Share of the texels that are the same as their right neighbour.
fn flat(raster: &Raster) -> f64 {
    let inside = raster.sampled().filter(|i| i % raster.width + 1 < raster.width);
    let same = |i: usize| raster.channels.iter().all(|channel| channel.at(i) == channel.at(i + 1));
    let (count, flat) = inside.fold((0u32, 0u32), |(count, flat), i| (count + 1, flat + u32::from(same(i))));
    f64::from(flat) / f64::from(count.max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_those_of_the_reading_that_is_used() {
        // As stored, the vectors have length 1; read as codes of numbers from -1 to 1, as integers are, a length of 0.41.
        let short = [128u8, 128, 180].repeat(8);
        let channels = Samples::interleaved(short, 3);
        let raster = Raster { width: 4, height: 2, channels, ..Raster::constant("test", &[0.0]) };
        assert_eq!(of_normals(&raster)[0], Some(1.0));
        let floats = [0.5, 0.5, std::f32::consts::FRAC_1_SQRT_2].map(|value| Samples::floats(vec![value; 8]));
        let raster =
            Raster { width: 4, height: 2, channels: floats.into(), ..Raster::constant("test", &[0.0]) };
        assert_eq!(of_normals(&raster)[0], Some(0.0), "numbers of floats may be stored as they are");
    }

    #[test]
    fn flat_texels_equal_their_right_neighbour_in_every_channel() {
        let raster = |values: &[f32]| {
            let channels = vec![Samples::floats(values.to_vec())];
            Raster { width: 4, height: 2, channels, ..Raster::constant("test", &[0.0]) }
        };
        assert_eq!(flat(&raster(&[1.0; 8])), 1.0);
        assert_eq!(flat(&raster(&[1.0, 1.0, 2.0, 3.0, 3.0, 2.0, 2.0, 2.0])), 0.5);
    }
}
