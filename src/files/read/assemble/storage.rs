//! Storage of a material that was read, for its diagnosis.

use crate::changes::{Storage, StoredEncoding};

use super::read::Read;
use crate::read::options::{Albedo, NormalY, Role, Roughness};
use crate::read::record::What;

impl<T> Read<T> {
    /// The readings of its values and the steps of its maps. A map that comes from several files has the largest step of these.
    pub fn storage(&self) -> Storage {
        let chosen = |what| self.assumptions.iter().find(|a| a.what == what).map(|a| a.chosen.as_str());
        let transfer = |what| chosen(what).map_or(StoredEncoding::Unknown, transfer);
        let step = |of: &dyn Fn(Role) -> bool| {
            self.maps.iter().filter(|map| of(map.map)).map(|map| step(map.depth)).fold(0.0, f64::max)
        };
        let colours = transfer(What::Albedo);
        let has_specular = self.maps.iter().any(|map| map.map == Role::Specular);
        let is_colour = |role| matches!(role, Role::Diffuse | Role::Base | Role::Metallic);
        Storage {
            colours,
            specular: if has_specular { transfer(What::Specular) } else { colours },
            base_colour: !has_specular,
            normal_down: chosen(What::NormalY) == Some(NormalY::Down.name()),
            roughness: chosen(What::Roughness).filter(|name| *name != Roughness::R.name()).map(str::to_owned),
            // Assumed only where diffuse is not scaled.
            unscaled: self.assumptions.iter().any(|assumption| assumption.what == What::Energy),
            steps: [
                step(&|role| role == Role::Normal),
                step(&is_colour),
                step(&|role| if has_specular { role == Role::Specular } else { is_colour(role) }),
                step(&|role| role == Role::Roughness),
            ],
        }
    }
}

fn transfer(name: &str) -> StoredEncoding {
    match name.parse() {
        Ok(Albedo::Linear) => StoredEncoding::Linear,
        Ok(Albedo::Srgb) => StoredEncoding::Srgb,
        Ok(Albedo::Gamma22) => StoredEncoding::Gamma22,
        Ok(Albedo::Log) => StoredEncoding::Other,
        Err(_) => StoredEncoding::Unknown,
    }
}

/// The distance between two stored values; halves have 11 bits at 1, floats count as exact.
fn step(depth: &str) -> f64 {
    match depth {
        "8-bit" => 1.0 / 255.0,
        "16-bit" => 1.0 / 65_535.0,
        "half" => 1.0 / 2048.0,
        _ => 0.0,
    }
}
