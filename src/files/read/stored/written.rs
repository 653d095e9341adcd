//! The encoding that this program writes into its pictures.

use super::material::{Inferred, StoredMaterial};
use crate::read::options::transfer::written;
use crate::read::options::{Albedo, NormalY, Role, Roughness};
use crate::read::record::{Certainty, Reason};

/// How colours are stored by the text that this program wrote into a picture.
pub(crate) fn written_albedo(text: &str) -> Option<Albedo> {
    [Albedo::Linear, Albedo::Srgb].into_iter().find(|albedo| text == written(*albedo))
}

impl StoredMaterial {
    /// Takes the encoding of these maps, whose colours are stored as `albedo`, from what their files state.
    pub(crate) fn specify(&mut self, albedo: Albedo, roles: &[Role]) {
        fn sure<T>(value: T) -> Inferred<T> {
            Some((value, Reason::NATIVE_TEXT, Certainty::Sure))
        }
        for role in roles {
            match role {
                Role::Diffuse => self.inferred.albedo = sure(albedo),
                Role::Specular => self.inferred.specular = sure(albedo),
                Role::Roughness => self.inferred.roughness = sure(Roughness::R),
                Role::Normal => self.inferred.normal_y = sure(NormalY::Up),
                _ => (),
            }
        }
    }
}
