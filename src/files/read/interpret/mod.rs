//! Interpretation: from stored samples to the linear planes of a material, by its workflow. Each choice made here is recorded as an assumption.

mod colours;
mod evidence;
mod heights;
mod normals;
mod values;

use std::path::PathBuf;

use rayon::prelude::*;

use svbrdf_core::material::{Mask, Material, Planes};
use svbrdf_core::math::real::Real;

use crate::disk::inputs;
use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::decode::{self, Layer};
use crate::read::options::{Energy, Preset, ReadOptions, Reflectance, Role};
use crate::read::record::{Assumption, Certainty, Note, Reason, Subject, What};
use crate::read::stored::{StoredMap, StoredMaterial};

use values::{Clamped, colour_planes, gray_plane, roughness_encoding, roughness_plane};

/// The material of the stored maps of `found`, by the `options`, the files and their pixels; each map is dropped once it is linear.
pub(super) fn interpret<T: Real>(
    found: &mut StoredMaterial,
    options: &ReadOptions,
) -> Result<Material<T>, Error> {
    note_alpha(found);
    refuse_two_channels(found)?;
    let size = found.common_size()?;
    values::check(found, options)?;
    let [colour_encoding, specular_encoding] = colours::encodings(found, options);
    let roughness_encoding = roughness_encoding(found, options);
    let normal = normals::planes(found, options, size)?;
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
    let (diffuse, specular) = separated(colour, specular, metallic, level, options, &mut found.assumptions);
    let mut planes = Planes { normal, diffuse, specular, roughness };
    if options.flip_v == Some(true) {
        mirror(&mut planes, size[0]);
        let mirrored = "Row 0 is the lowest row, as specified: the material is mirrored.";
        found.notes.push(Note::Told(mirrored.to_owned()));
    }
    Ok(Material::new(found.name.as_str(), size[0], size[1], planes)?)
}

/// The share of the samples of a mask that are neither 0 nor 1, at most: those at its border.
const BORDER: f64 = 0.05;
/// The share of empty texels from which on a mask is one that somebody meant.
const EMPTY: f64 = 0.25;

/// Which texels are opaque, where the alpha of a map is a mask.
pub(super) fn mask(found: &mut StoredMaterial, options: &ReadOptions) -> Option<Mask> {
    let size = found.colour.raster.size();
    let is_mask = |alpha: &Vec<f32>| {
        let between = alpha.iter().filter(|value| (0.02..0.98).contains(*value)).count();
        between as f64 <= BORDER * alpha.len() as f64
    };
    let (map, alpha) = found.sources().into_iter().find_map(|(map, source)| {
        let alpha = source.raster.alpha.as_ref().filter(|_| source.raster.size() == size)?;
        Some((map, alpha.decoded::<f32>(|value| value))).filter(|(_, alpha)| is_mask(alpha))
    })?;
    let mask = mask_of(&alpha, size, options)?;
    let empty = mask.kept().iter().filter(|is_opaque| !**is_opaque).count() as f64 / alpha.len() as f64;
    if (EMPTY..1.0).contains(&empty) {
        found.notes.push(Note::MaskInAlpha { map, empty });
    }
    Some(mask)
}

/// The mask of samples, at least half.
fn mask_of(samples: &[f32], size: [usize; 2], options: &ReadOptions) -> Option<Mask> {
    let kept = samples.iter().map(|value| *value >= 0.5);
    let is_mirrored = options.flip_v == Some(true);
    let rows = |kept: Vec<bool>| kept.rchunks(size[0]).flatten().copied().collect();
    Mask::new(size, if is_mirrored { rows(kept.collect()) } else { kept.collect() })
}

/// Reads a mask from the picture `file`, any that opens as a map: texels of at least half of its white, or in its alpha where it has one.
/// Its rows are those of a material that is read by `options`. `None`: none is.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::BadImage`].
pub fn read_mask(file: &NamedFile, options: &ReadOptions) -> Result<Option<Mask>, Error> {
    let (Layer { raster, .. }, _) = decode::one(file, Subject::Picture)?;
    inputs::protect(file.path());
    let samples = raster.alpha.as_ref().or(raster.channels.first());
    let values: Vec<f32> = samples.map(|samples| samples.decoded(|value| value)).unwrap_or_default();
    Ok(mask_of(&values, raster.size(), options))
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
        let name = map.name();
        found.notes.push(Note::Told(format!("The {name} map is partly transparent; its alpha is ignored.")));
        // Colours of EXR are multiplied by their alpha.
        if is_float && map.is_colour() {
            let why = Reason::measured(format!(
                "the {} map has an alpha below 1, and EXR multiplies colours by it",
                map.name()
            ));
            found.assumptions.push(Assumption::new(What::Values, "as stored", why, Certainty::Unsure));
        }
    }
}

/// Refuses colours of two channels, such as an EXR without B: nothing tells the third.
fn refuse_two_channels(found: &StoredMaterial) -> Result<(), Error> {
    let sources = found.sources();
    match sources.iter().find(|(role, source)| role.is_colour() && source.raster.channels.len() == 2) {
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
    let file = map.file.display();
    let why = Reason::measured(format!("{file} is named so, and the principled model takes 0.04 at 0.5"));
    Assumption::new(What::Specular, "0.08 times the level", why, Certainty::Likely)
}

/// The reflectance of dielectrics where the map of its level is 1.
const MOST_DIELECTRIC: f64 = 0.08;

type Colour<T> = [Vec<T>; 3];

/// Diffuse and specular of linear maps of one size: `colour` is diffuse, or the base colour where there is `metallic`, `level` the
/// reflectance of dielectrics, 1 for 0.08. The choices that are made here are recorded.
fn separated<T: Real>(
    colour: Colour<T>,
    specular: Option<Colour<T>>,
    metallic: Option<Vec<T>>,
    level: Option<Vec<T>>,
    options: &ReadOptions,
    assumptions: &mut Vec<Assumption>,
) -> (Colour<T>, Colour<T>) {
    let dielectric = options.dielectric.unwrap_or(Reflectance::DIELECTRIC);
    let reflectance =
        |i: usize| level.as_ref().map_or(dielectric.value(), |level| MOST_DIELECTRIC * level[i].f64());
    let (mut diffuse, specular) = match (metallic, specular) {
        (Some(metallic), _) => {
            from_base(colour, metallic, reflectance, options.preset == Some(Preset::MatFusion))
        }
        (None, Some(specular)) => (colour, specular),
        (None, None) => {
            if level.is_none() {
                assumptions.push(missing_specular(options.dielectric));
            }
            let plane = |_| (0..colour[0].len()).into_par_iter().map(|i| T::of(reflectance(i))).collect();
            let specular = [0, 1, 2].map(plane);
            (colour, specular)
        }
    };
    unscale_diffuse(&mut diffuse, &specular, options, assumptions);
    (diffuse, specular)
}

fn missing_specular(given: Option<Reflectance>) -> Assumption {
    match given {
        Some(dielectric) => Assumption::given(What::Missing, format!("specular {dielectric}")),
        None => {
            let chosen = format!("specular {}", Reflectance::DIELECTRIC);
            let why = Reason::measured("there is no specular map; most dielectrics have it");
            Assumption::new(What::Missing, chosen, why, Certainty::Likely)
        }
    }
}

/// d = b (1 - m) and s = f (1 - m) + b m, or s = f + b m where the reflectance f is `added`.
///
/// Diffuse takes the place of the base colour, and a channel of specular that of metallic.
fn from_base<T: Real>(
    mut base: Colour<T>,
    mut metallic: Vec<T>,
    reflectance: impl Fn(usize) -> f64 + Sync,
    added: bool,
) -> (Colour<T>, Colour<T>) {
    const CHUNK: usize = 1 << 14;
    let [mut red, mut green] = [0; 2].map(|_| vec![T::zero(); metallic.len()]);
    let diffuse = base.each_mut().map(|plane| plane.par_chunks_mut(CHUNK));
    let specular = [&mut red, &mut green, &mut metallic].map(|plane| plane.par_chunks_mut(CHUNK));
    let ([d0, d1, d2], [s0, s1, s2]) = (diffuse, specular);
    let chunks = d0.zip(d1).zip(d2).zip(s0.zip(s1).zip(s2)).enumerate();
    chunks.for_each(|(number, (((d0, d1), d2), ((s0, s1), s2)))| {
        let separate = |index: usize, m: f64, value: &mut T| {
            let b = value.f64();
            *value = T::of(b * (1.0 - m));
            let share = if added { 1.0 } else { 1.0 - m };
            T::of((reflectance(number * CHUNK + index) * share + b * m).min(1.0))
        };
        let texels = d0.iter_mut().zip(d1).zip(d2).zip(s0.iter_mut().zip(s1).zip(s2)).enumerate();
        for (index, (((d0, d1), d2), ((s0, s1), s2))) in texels {
            let m = s2.f64();
            [*s0, *s1, *s2] = [d0, d1, d2].map(|value| separate(index, m, value));
        }
    });
    (base, [red, green, metallic])
}

/// d / (1 - s), at most 1, where the renderer that these maps were made for does not scale diffuse by (1 - s).
fn unscale_diffuse<T: Real>(
    diffuse: &mut [Vec<T>; 3],
    specular: &[Vec<T>; 3],
    options: &ReadOptions,
    assumptions: &mut Vec<Assumption>,
) {
    if options.energy != Some(Energy::Unscaled) {
        return;
    }
    let mut clamped = 0;
    for (d, s) in diffuse.iter_mut().flatten().zip(specular.iter().flatten()) {
        let (value, left) = (d.f64(), 1.0 - s.f64());
        clamped += usize::from(value > left);
        *d = if value >= left { T::of(f64::from(value > 0.0)) } else { T::of(value / left) };
    }
    let chosen = "diffuse not scaled by (1 - specular): d / (1 - s) is used";
    assumptions.push(Assumption::given(What::Energy, chosen));
    if clamped > 0 {
        let why = Reason::measured(format!(
            "{clamped} samples of diffuse and specular would reflect more light than arrives"
        ));
        assumptions.push(Assumption::new(What::Values, "diffuse 1", why, Certainty::Unsure));
    }
}

/// Top and bottom exchanged, and the normals with them.
fn mirror<T: Real>(planes: &mut Planes<T>, width: usize) {
    let Planes { normal, diffuse, specular, roughness } = planes;
    normal[1].iter_mut().for_each(|y| *y = -*y);
    for plane in normal.iter_mut().chain(diffuse).chain(specular).chain([roughness]) {
        let height = plane.len() / width;
        for row in 0..height / 2 {
            let (above, below) = plane.split_at_mut((height - 1 - row) * width);
            above[row * width..(row + 1) * width].swap_with_slice(&mut below[..width]);
        }
    }
}
