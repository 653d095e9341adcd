//! Diffuse and specular from the maps of a workflow.

use rayon::prelude::*;

use crate::files::read::assumption::{Assumption, Certainty, What};
use crate::files::read::options::{Energy, ReadOptions, Reflectance};
use crate::files::read::preset::Preset;
use crate::files::read::reason::Reason;
use crate::files::read::stored::{StoredMap, StoredMaterial};
use crate::math::real::Real;

/// The reflectance of dielectrics where the map of its level is 1.
const MOST_DIELECTRIC: f64 = 0.08;

/// The linear planes of the reflectance.
pub(crate) struct Maps<T> {
    /// Diffuse, or the base colour where there is `metallic`.
    pub colour: [Vec<T>; 3],
    pub specular: Option<[Vec<T>; 3]>,
    pub metallic: Option<Vec<T>>,
    /// The reflectance of dielectrics, 1 for 0.08.
    pub level: Option<Vec<T>>,
}

impl<T: Real> Maps<T> {
    /// Diffuse and specular.
    pub(crate) fn separated(
        self,
        size: [usize; 2],
        found: &mut StoredMaterial,
        options: &ReadOptions,
    ) -> ([Vec<T>; 3], [Vec<T>; 3]) {
        let Self { colour, specular, metallic, level } = self;
        let dielectric = options.dielectric.unwrap_or(Reflectance::DIELECTRIC);
        let reflectance =
            |i: usize| level.as_ref().map_or(dielectric.value(), |level| MOST_DIELECTRIC * level[i].f64());
        match (metallic, specular) {
            (Some(metallic), _) => {
                from_base(colour, &metallic, reflectance, options.preset == Some(Preset::MatFusion))
            }
            (None, Some(specular)) => (colour, specular),
            (None, None) => {
                if level.is_none() {
                    found.assumptions.push(missing_specular(options.dielectric));
                }
                let plane: Vec<T> = (0..size[0] * size[1]).map(|i| T::of(reflectance(i))).collect();
                (colour, [plane.clone(), plane.clone(), plane])
            }
        }
    }
}

fn missing_specular(given: Option<Reflectance>) -> Assumption {
    match given {
        Some(dielectric) => Assumption::given(What::Missing, format!("specular {dielectric}")),
        None => {
            let chosen = format!("specular {}", Reflectance::DIELECTRIC);
            Assumption::new(What::Missing, chosen, Reason::NoSpecularMap, Certainty::Likely)
        }
    }
}

/// What a map of the specular level is read as.
pub(crate) fn level_assumed(source: &StoredMap) -> Assumption {
    let why = Reason::SpecularLevel { file: source.file.clone() };
    Assumption::new(What::Specular, "0.08 times the level", why, Certainty::Likely)
}

/// d = b (1 - m) and s = f (1 - m) + b m, or s = f + b m where the reflectance f is `added`.
fn from_base<T: Real>(
    mut base: [Vec<T>; 3],
    metallic: &[T],
    reflectance: impl Fn(usize) -> f64 + Sync,
    added: bool,
) -> ([Vec<T>; 3], [Vec<T>; 3]) {
    let specular = base.each_mut().map(|plane| {
        let pairs = plane.par_iter_mut().zip(metallic).enumerate();
        pairs
            .map(|(i, (value, &m))| {
                let (b, m) = (value.f64(), m.f64());
                *value = T::of(b * (1.0 - m));
                let share = if added { 1.0 } else { 1.0 - m };
                T::of((reflectance(i) * share + b * m).min(1.0))
            })
            .collect()
    });
    (base, specular)
}

/// d / (1 - s), at most 1, where the renderer that these maps were made for does not scale diffuse by (1 - s).
pub(crate) fn unscale_diffuse<T: Real>(
    diffuse: &mut [Vec<T>; 3],
    specular: &[Vec<T>; 3],
    found: &mut StoredMaterial,
    options: &ReadOptions,
) {
    let hint = found.inferred.energy.take();
    let energy = options.energy.or(hint.as_ref().map(|h| h.0));
    if energy != Some(Energy::Unscaled) {
        return;
    }
    let mut clamped = 0;
    for (d, s) in diffuse.iter_mut().flatten().zip(specular.iter().flatten()) {
        let (value, left) = (d.f64(), 1.0 - s.f64());
        clamped += usize::from(value > left);
        *d = if value >= left { T::of(f64::from(value > 0.0)) } else { T::of(value / left) };
    }
    let chosen = "diffuse not scaled by (1 - specular): d / (1 - s) is used";
    found.assumptions.push(match (options.energy, hint) {
        (None, Some((_, why, certainty))) => Assumption::new(What::Energy, chosen, why, certainty),
        _ => Assumption::given(What::Energy, chosen),
    });
    if clamped > 0 {
        let why = Reason::MoreThanAllLight { count: clamped };
        found.assumptions.push(Assumption::new(What::Values, "diffuse 1", why, Certainty::Unsure));
    }
}
