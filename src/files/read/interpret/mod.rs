//! Interpretation: from stored samples to linear values. Each choice made here is recorded as an assumption.

mod colours;
mod decide;
mod maps;
mod normals;
mod values;

use std::path::PathBuf;

use svbrdf_core::math::real::Real;

use crate::error::Error;
use crate::read::gather::Evidences;
use crate::read::options::{Energy, ReadOptions, Role};
use crate::read::record::{Assumption, Certainty, Note, Reason, What};
use crate::read::stored::{Inferred, StoredMap, StoredMaterial};

use maps::{colour_planes, gray_plane, roughness_encoding, roughness_plane};
use values::Clamped;

/// The maps of a material in linear values and one size, and the record of how they were read.
#[derive(Debug)]
pub(super) struct LinearMaterial<T> {
    pub name: String,
    /// (width, height) in texels.
    pub size: [usize; 2],
    /// The normals, not yet of unit length, y up.
    pub normal: [Vec<T>; 3],
    /// Diffuse, or the base colour where there is `metallic`.
    pub colour: [Vec<T>; 3],
    pub specular: Option<[Vec<T>; 3]>,
    pub metallic: Option<Vec<T>>,
    /// The reflectance of dielectrics, 1 for 0.08.
    pub level: Option<Vec<T>>,
    pub roughness: Vec<T>,
    /// Whether diffuse is scaled by (1 - specular), where the files tell.
    pub energy: Inferred<Energy>,
    pub assumptions: Vec<Assumption>,
    pub notes: Vec<Note>,
    pub files: Vec<PathBuf>,
}

/// Interprets the stored maps of `found` by the `options`, the files and the gathered `evidence`; each map is dropped
/// once it is linear.
///
/// # Errors
/// [`Error::NotFinite`] at NaN and infinity, [`Error::MapSizesDiffer`] where maps have another shape,
/// [`Error::NotAMaterial`] where the normal map is gray.
pub(super) fn interpret<T: Real>(
    mut found: StoredMaterial,
    evidence: Evidences,
    options: &ReadOptions,
) -> Result<LinearMaterial<T>, Error> {
    let Evidences { colours, heights } = evidence;
    note_alpha(&mut found);
    refuse_two_channels(&found)?;
    let size = found.common_size()?;
    values::check(&mut found, options)?;
    let [colour_encoding, specular_encoding] = colours::encodings(&mut found, colours, options);
    let roughness_encoding = roughness_encoding(&mut found, options);
    let normal = match found.normal.take() {
        Some(source) => normals::planes(source, &mut found, heights, options, size)?,
        None => normals::flat(&mut found, size),
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
    let StoredMaterial { name, inferred, assumptions, notes, files, .. } = found;
    let energy = inferred.energy;
    Ok(LinearMaterial {
        name,
        size,
        normal,
        colour,
        specular,
        metallic,
        level,
        roughness,
        energy,
        assumptions,
        notes,
        files,
    })
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
