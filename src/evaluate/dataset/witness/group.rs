//! Samples of the materials that decide, and what they say by themselves.

use svbrdf_core::material::Material;
use svbrdf_core::statistics::median;
use svbrdf_files::read::{Albedo, Assumption, Certainty, Ground, Read, Storage, What};

/// Texels of a material that are looked at.
const TEXELS: usize = 1024;
/// The most that the pixels of one material say for or against linear colours, as log odds.
const MOST: f64 = 4.0;
/// What customs say, as log odds of linear: colours of integers are encoded, but some research codes store them linear, as those do that have
/// this order of tiles.
const ENCODED: f64 = -2.0;
const RESEARCH: f64 = -1.1;
const ORDER: f64 = 1.1;
/// Darker than this, as stored, is black.
const BLACK: f64 = 0.02;
/// The logarithm of a usual albedo, and of a usual specular, and their standard deviations over materials.
const USUAL: [[f64; 2]; 2] = [[-1.61, 1.1], [-3.0, 0.8]];

/// A method with the pairs that can be compared.
pub(super) struct Group<'a> {
    pub(super) method: &'a str,
    pub(super) pairs: &'a [[Sampled; 2]],
}

/// Texels of a material, and how it was read by itself.
pub(super) struct Sampled {
    pub(super) texels: Material<f32>,
    pub(super) storage: Storage,
    /// Of diffuse or base colour, and of specular.
    pub(super) own: [Own; 2],
}

/// What the files of a material say about the encoding of a colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Own {
    /// `None` where it is not known.
    pub(super) encoding: Option<Albedo>,
    /// The log odds of linear by the kind of the files, which is the same for all of a method.
    pub(super) custom: f64,
    /// Those by the pixels.
    pub(super) pixels: f64,
    /// Whether a person, a format or a file states it, and nothing else decides.
    pub(super) is_stated: bool,
}

impl Sampled {
    pub(super) fn of(material: &Material<f32>, read: &Read<f32>) -> Self {
        let [width, height] = material.size();
        let step = (width * height).div_ceil(TEXELS) | 1;
        let texels: Vec<usize> = (0..width * height).step_by(step).collect();
        let storage = read.storage();
        let texels = material.gathered(&texels, [texels.len(), 1]);
        let planes = [&texels.planes().diffuse, &texels.planes().specular];
        let own = [(What::Albedo, storage.colours), (What::Specular, storage.specular)];
        let own = std::array::from_fn(|colour| {
            let (what, encoding) = own[colour];
            let assumption = read.assumptions.iter().find(|one| one.what == what);
            Own {
                pixels: by_pixels(planes[colour], encoding, USUAL[colour]),
                ..Own::of(assumption, encoding)
            }
        });
        Self { texels, storage, own }
    }
}

impl Own {
    fn of(assumption: Option<&Assumption>, encoding: Option<Albedo>) -> Self {
        let custom = assumption.and_then(|assumption| match assumption.why.ground() {
            Ground::Deschaintre => Some(ORDER),
            _ if assumption.certainty >= Certainty::Sure => None,
            Ground::Weighed { .. } => Some(RESEARCH),
            Ground::Convention => Some(ENCODED),
            _ => None,
        });
        let is_known = matches!(encoding, Some(Albedo::Linear | Albedo::Srgb));
        let is_stated = custom.is_none() || !is_known;
        Self { encoding, custom: custom.unwrap_or(0.0), pixels: 0.0, is_stated }
    }
}

/// The log odds that a colour is stored linear, by its median where the logarithms of what materials reflect have this mean and deviation.
fn by_pixels(planes: &[Vec<f32>; 3], encoding: Option<Albedo>, [mean, deviation]: [f64; 2]) -> f64 {
    let stored = |value: &f32| f64::from(Storage::encode(encoding, *value));
    let mut values: Vec<f64> = planes.iter().flatten().map(stored).filter(|stored| *stored > BLACK).collect();
    let Some(median) = median(&mut values) else { return 0.0 };
    let density = |log: f64| -0.5 * ((log - mean) / deviation).powi(2);
    (density(median.ln()) - density(2.2 * median.ln())).clamp(-MOST, MOST)
}
