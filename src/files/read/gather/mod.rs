//! Gathering: the evidence of pixels about the values of a material, its own and that of its neighbours, before any of
//! them is interpreted.

mod colours;
pub(super) mod map_report;
mod neighbours;

use std::path::PathBuf;

use crate::read::options::{NormalY, ReadOptions, Roughness};
use crate::read::raster::Raster;
use crate::read::record::{Certainty, Evidence, Subject};
use crate::read::stored::{StoredHeight, StoredMap, StoredMaterial};
use crate::read::{decode, measure};

pub(super) use colours::{PRIOR, SURE};
pub use neighbours::Neighbours;

/// The evidence about how colours are stored.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum ColourEvidence {
    /// Nothing was measured: options or files specify the encoding.
    Specified,
    /// Of a colour without specular; `None` where it looks like any other.
    Alone(Option<Evidence>),
    Pair {
        diffuse: Vec<Evidence>,
        specular: Vec<Evidence>,
        /// Those that were looked at.
        neighbours: Option<Neighbours>,
    },
}

/// The evidence about the values of a material.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Evidences {
    pub colours: ColourEvidence,
    pub heights: Option<HeightEvidence>,
}

impl Evidences {
    /// The neighbours that were looked at.
    pub(super) fn neighbours(&self) -> Option<&Neighbours> {
        match &self.colours {
            ColourEvidence::Pair { neighbours, .. } => neighbours.as_ref(),
            _ => None,
        }
    }
}

/// The evidence about a material that is to be read with `options`.
pub(super) fn evidences(found: &StoredMaterial, options: &ReadOptions) -> Evidences {
    Evidences { colours: colours(found, options), heights: heights(found, options) }
}

/// The evidence about the colours of a material that is to be read with `options`.
fn colours(found: &StoredMaterial, options: &ReadOptions) -> ColourEvidence {
    let inferred = &found.inferred;
    let is_known = inferred.albedo.is_some() && inferred.specular.is_some();
    match &found.specular {
        _ if options.albedo.is_some() || is_known => ColourEvidence::Specified,
        Some(specular) => {
            let roughness = options.roughness.or(inferred.roughness.as_ref().map(|known| known.0));
            pair(&found.colour, specular, roughness)
        }
        None if inferred.albedo.is_some() => ColourEvidence::Specified,
        None => ColourEvidence::Alone(colours::alone(&found.colour.raster)),
    }
}

/// The evidence about diffuse and specular, with that of neighbours where their own leaves the encoding open.
///
/// The two differ only where evidence about diffuse alone does. `roughness` is what the names declare it: glossiness is
/// how artists name it.
fn pair(diffuse: &StoredMap, specular: &StoredMap, roughness: Option<Roughness>) -> ColourEvidence {
    let prior = if roughness == Some(Roughness::Gloss) { Evidence::Prior } else { Evidence::Research };
    let mut common = vec![prior];
    if colours::is_jpeg(&diffuse.file) && colours::is_jpeg(&specular.file) {
        common.push(Evidence::Jpeg);
    }
    common.extend(colours::measured(&diffuse.raster, &specular.raster));
    let total: f64 = common.iter().map(|one| one.log_odds()).sum();
    let pictures = || [diffuse.file.clone(), specular.file.clone()];
    let neighbours = (total.abs() < SURE).then(|| Neighbours::of(pictures()));
    common.extend(neighbours.as_ref().and_then(Neighbours::evidence));
    let bright = colours::too_bright(&diffuse.raster, &specular.raster);
    let diffuse = common.iter().copied().chain(bright).collect();
    ColourEvidence::Pair { diffuse, specular: common, neighbours }
}

/// Least correlation of both slopes that tells a direction: of the sets of libraries that were measured 10 of 11 lie
/// above it, and all of them are right.
const TELLING: f64 = 0.15;
/// Below this curl correlation a map contradicts a name that states y up, above its opposite one that states y down.
const CONTRADICTS: f64 = 0.3;

/// The direction of y that the heights of a material show.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::read) struct HeightEvidence {
    pub file: PathBuf,
    /// Correlations of the slopes with x and with y of the normals.
    pub correlations: [f64; 2],
}

impl HeightEvidence {
    pub(in crate::read) fn y(&self) -> NormalY {
        let [x, y] = self.correlations;
        if x * y > 0.0 { NormalY::Up } else { NormalY::Down }
    }
}

/// The evidence of the heights of a material that is to be read with `options`.
fn heights(found: &StoredMaterial, options: &ReadOptions) -> Option<HeightEvidence> {
    let (normal, height) = (&found.normal.as_ref()?.raster, found.height.as_ref()?);
    let is_specified = options.normal_y.or(options.preset.and_then(|p| p.options().normal_y)).is_some();
    if is_specified || is_named(found, normal) {
        return None;
    }
    let (raster, file) = match height {
        StoredHeight::File(file) => {
            (decode::one(file, Subject::Picture).ok()?.0.raster, file.path().to_owned())
        }
        StoredHeight::Picture { raster, file } => (raster.clone(), file.clone()),
    };
    let correlations = measure::slope_correlations(normal, &raster)?;
    let is_telling = correlations.iter().all(|one| one.abs() >= TELLING);
    is_telling.then_some(HeightEvidence { file, correlations })
}

/// Whether a name or a specification states the direction, and the normals do not contradict it.
fn is_named(found: &StoredMaterial, normal: &Raster) -> bool {
    let Some((y, _, Certainty::Sure)) = &found.inferred.normal_y else { return false };
    let curl = measure::curl(normal.width, normal.height, |index| normal.rgb(index).map(|c| 2.0 * c - 1.0));
    !curl.is_some_and(|curl| if *y == NormalY::Up { curl < -CONTRADICTS } else { curl > CONTRADICTS })
}
