//! Gathering: the evidence of pixels about the values of a material, its own and that of its neighbours, before any of
//! them is interpreted.

mod colours;
mod log_odds;
pub(super) mod map_report;
mod neighbours;

use crate::files::read::options::ReadOptions;
use crate::files::read::record::evidence::Evidence;
use crate::files::read::stored::material::StoredMaterial;
pub(super) use log_odds::{PRIOR, SURE};

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
    },
}

/// The evidence about the colours of a material that is to be read with `options`.
pub(super) fn colours(found: &StoredMaterial, options: &ReadOptions) -> ColourEvidence {
    let inferred = &found.inferred;
    let is_known = inferred.albedo.is_some() && inferred.specular.is_some();
    match &found.specular {
        _ if options.albedo.is_some() || is_known => ColourEvidence::Specified,
        Some(specular) => {
            let roughness = options.roughness.or(inferred.roughness.as_ref().map(|known| known.0));
            colours::pair(&found.colour, specular, roughness)
        }
        None if inferred.albedo.is_some() => ColourEvidence::Specified,
        None => ColourEvidence::Alone(colours::alone(&found.colour.raster)),
    }
}
