//! Gathering: the evidence of pixels about the values of a material, its own and that of its neighbours, before any of
//! them is interpreted.

mod colours;
mod heights;
mod log_odds;
pub(super) mod map_report;
mod neighbours;

use crate::read::options::{ReadOptions, Roughness};
use crate::read::record::Evidence;
use crate::read::stored::{StoredMap, StoredMaterial};
pub(super) use heights::HeightEvidence;
pub(super) use log_odds::{PRIOR, SURE};
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
    Evidences { colours: colours(found, options), heights: heights::evidence(found, options) }
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
