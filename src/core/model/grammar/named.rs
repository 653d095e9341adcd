//! The conventions that have a name, in the grammar.

use std::sync::LazyLock;

use super::words::Norm;
use super::{Description, LossTerms, SceneTerms, Terms};
use crate::model::convention::{self, Convention};

/// The texts of those that are not the first authors'.
const TEXTS: [&str; 5] = [
    include_str!("conventions/svbrdf-estimation-2022.toml"),
    include_str!("conventions/material-palette-2024.toml"),
    include_str!("conventions/matfuse-2024.toml"),
    include_str!("conventions/materialgan-2020.toml"),
    include_str!("conventions/gltf-viewer.toml"),
];

/// Every named convention, the default first.
pub fn all() -> &'static [Description] {
    static ALL: LazyLock<Vec<Description>> = LazyLock::new(|| {
        // A test reads each.
        let others = TEXTS.iter().filter_map(|text| text.parse().ok());
        convention::ALL.iter().map(Description::from).chain(others).collect()
    });
    &ALL
}

/// The convention as it is computed: Algorithm 3 with its limits.
impl From<&Convention> for Description {
    fn from(c: &Convention) -> Self {
        let mut terms = Terms::BASE;
        terms.material.r_min = c.roughness_floor;
        terms.specular.nh_clamped = c.clamp_n_dot_h;
        terms.specular.d_den_min = c.d_floor;
        terms.specular.g_den_min = c.g_floor;
        terms.light.lz = Some(c.light_z_floor);
        terms.light.factor = c.intensity;
        let u1 = [convention::U1_MIN, c.u1_max];
        let near = SceneTerms::Mirror {
            count: 6,
            u1,
            mu: 0.5,
            sigma_view: 0.75,
            sigma_light: c.light_distance_sigma,
            shift: [-1.0, 1.0],
            shift_z: c.shift_z,
        };
        Self {
            name: c.name.to_owned(),
            source: None,
            version: None,
            terms,
            loss: LossTerms { norm: Norm::LogL1, epsilon: Some(c.epsilon) },
            scenes: vec![near, SceneTerms::Distant { count: 3, u1 }],
        }
    }
}
