//! Interpretation: from stored samples to the linear planes of a material, by its workflow. Each choice made here is recorded as an assumption.

mod colours;
mod maps;
mod normals;
mod values;
mod workflow;

use std::path::PathBuf;

use svbrdf_core::material::Planes;
use svbrdf_core::math::real::Real;

use crate::error::Error;
use crate::read::gather::Evidences;
use crate::read::options::{ReadOptions, Role};
use crate::read::record::{Assumption, Certainty, Note, Reason, SpecifiedBy, What};
use crate::read::stored::{StoredMap, StoredMaterial};

use maps::{colour_planes, gray_plane, roughness_encoding, roughness_plane};
use values::Clamped;
use workflow::Reflection;

/// The size and the planes of the stored maps of `found`, by the `options`, the files and the gathered `evidence`; each map is dropped
/// once it is linear.
///
/// # Errors
/// [`Error::NotFinite`] at NaN and infinity, [`Error::MapSizesDiffer`] where maps have another shape,
/// [`Error::NotAMaterial`] where the normal map is gray.
pub(super) fn interpret<T: Real>(
    found: &mut StoredMaterial,
    evidence: Evidences,
    options: &ReadOptions,
) -> Result<([usize; 2], Planes<T>), Error> {
    let Evidences { colours, heights } = evidence;
    note_alpha(found);
    refuse_two_channels(found)?;
    let size = found.common_size()?;
    values::check(found, options)?;
    let [colour_encoding, specular_encoding] = colours::encodings(found, colours, options);
    let roughness_encoding = roughness_encoding(found, options);
    let normal = match found.normal.take() {
        Some(source) => normals::planes(source, found, heights, options, size)?,
        None => normals::flat(found, size),
    };
    let mut clamped = Clamped::default();
    let (colour, specular) = (found.colour.take(), found.specular.take());
    let notes = &mut found.notes;
    let colour = colour_planes(colour, colour_encoding, Role::Diffuse, size, &mut clamped, notes);
    let specular =
        specular.map(|map| colour_planes(map, specular_encoding, Role::Specular, size, &mut clamped, notes));
    let roughness = roughness_plane(found.roughness.take(), roughness_encoding, size, &mut clamped, notes);
    let metallic = found.metallic.take();
    let metallic = metallic.map(|map| gray_plane(map, Role::Metallic, size, &mut clamped, notes));
    let level = found.level.take().map(|map| {
        found.assumptions.push(level_assumed(&map));
        gray_plane(map, Role::SpecularLevel, size, &mut clamped, notes)
    });
    clamped.record(&mut found.assumptions);
    let maps = Reflection { colour, specular, metallic, level };
    let (energy, assumptions) = (found.inferred.energy.take(), &mut found.assumptions);
    let (diffuse, specular) = workflow::separated(maps, energy, options, assumptions);
    let mut planes = Planes { normal, diffuse, specular, roughness };
    if options.flip_v == Some(true) {
        workflow::mirror(&mut planes, size[0]);
        found.notes.push(Note::RowsFlipped { by: SpecifiedBy::Caller });
    }
    Ok((size, planes))
}

/// Notes the maps whose alpha is not used, also not by another map.
fn note_alpha(found: &mut StoredMaterial) {
    let holds_alpha = |file: &PathBuf| {
        found.sources().iter().any(|(_, source)| source.file == *file && source.part.ends_with("alpha"))
    };
    let is_noted = |(map, source): &(Role, &StoredMap)| {
        source.raster.alpha.is_some() && *map != Role::Normal && !holds_alpha(&source.file)
    };
    let maps: Vec<_> = found
        .sources()
        .into_iter()
        .filter(is_noted)
        .map(|(map, source)| (map, source.raster.is_float()))
        .collect();
    for (map, is_float) in maps {
        found.notes.push(Note::AlphaIgnored { map });
        // Colours of EXR are multiplied by their alpha.
        if is_float && is_colour(map) {
            let why = Reason::Premultiplied { map };
            found.assumptions.push(Assumption::new(What::Values, "as stored", why, Certainty::Unsure));
        }
    }
}

fn is_colour(map: Role) -> bool {
    matches!(map, Role::Base | Role::Diffuse | Role::Specular)
}

/// Refuses colours of two channels, such as an EXR without B: nothing tells the third.
fn refuse_two_channels(found: &StoredMaterial) -> Result<(), Error> {
    let sources = found.sources();
    match sources.iter().find(|(role, source)| is_colour(*role) && source.raster.channels.len() == 2) {
        None => Ok(()),
        Some((role, source)) => Err(Error::NotAMaterial {
            path: source.file.clone(),
            expected: format!("a {} map of one channel or three", role.name()),
            found: "one of two channels".to_owned(),
            remedy: "save it with red, green and blue".to_owned(),
        }),
    }
}

/// The reading of a map of the specular level.
fn level_assumed(map: &StoredMap) -> Assumption {
    let why = Reason::SpecularLevel { file: map.file.clone() };
    Assumption::new(What::Specular, "0.08 times the level", why, Certainty::Likely)
}
