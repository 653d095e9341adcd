//! The encoding that this program writes into its pictures.

use super::material::{Inferred, StoredMaterial};
use crate::read::options::{Albedo, Energy, NormalY, Role, Roughness};
use crate::read::record::{Certainty, StorageConvention};

/// How the maps of a picture that this program wrote are stored.
#[derive(Clone, Debug)]
pub(crate) struct WrittenEncoding {
    diffuse: Albedo,
    specular: Albedo,
    roughness: Roughness,
    normal_y: NormalY,
    energy: Energy,
}

impl WrittenEncoding {
    /// The encoding of a text as in `diffuse linear, specular linear, roughness r, normal y up, energy scaled`.
    pub(crate) fn of(text: &str) -> Option<Self> {
        let mut parts = text.split(", ");
        let mut next = |key: &str| parts.next()?.strip_prefix(key)?.strip_prefix(' ').map(str::to_owned);
        Some(Self {
            diffuse: next("diffuse")?.parse().ok()?,
            specular: next("specular")?.parse().ok()?,
            roughness: next("roughness")?.parse().ok()?,
            normal_y: next("normal y")?.parse().ok()?,
            energy: next("energy")?.parse().ok()?,
        })
    }
}

impl StoredMaterial {
    /// Takes the encoding of these maps from what their file states.
    pub(crate) fn specify(&mut self, encoding: &WrittenEncoding, roles: &[Role]) {
        fn sure<T>(value: T) -> Inferred<T> {
            Some((value, StorageConvention::NativeText.into(), Certainty::Sure))
        }
        for role in roles {
            match role {
                Role::Diffuse => {
                    self.inferred.albedo = sure(encoding.diffuse);
                    self.inferred.energy = sure(encoding.energy);
                }
                Role::Specular => self.inferred.specular = sure(encoding.specular),
                Role::Roughness => self.inferred.roughness = sure(encoding.roughness),
                Role::Normal => self.inferred.normal_y = sure(encoding.normal_y),
                _ => (),
            }
        }
    }
}
