//! The conventions that have a name, in the grammar; and conventions of the grammar as losses are computed by them.

use std::str::FromStr;
use std::sync::{LazyLock, Mutex, PoisonError};

use super::convention::{self, Convention, GUIDED_2020, Member, PRINTED};
use super::grammar::words::Norm;
use super::grammar::{Description, LossTerms, RendererTerms, SceneTerms};
use crate::error::Error;

/// The texts of those that are not the first authors'.
const TEXTS: [&str; 5] = [
    include_str!("grammar/conventions/svbrdf-estimation-2022.toml"),
    include_str!("grammar/conventions/material-palette-2024.toml"),
    include_str!("grammar/conventions/matfuse-2024.toml"),
    include_str!("grammar/conventions/materialgan-2020.toml"),
    include_str!("grammar/conventions/gltf-viewer.toml"),
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

/// One of [`all`], as losses are computed by it.
impl FromStr for Convention {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        static ALL: LazyLock<Vec<Convention>> =
            LazyLock::new(|| all().iter().filter_map(|described| described.try_into().ok()).collect());
        let known = || ALL.iter().map(|known| known.name).collect::<Vec<_>>().join(", ");
        let found = ALL.iter().find(|known| known.name == name);
        found.copied().ok_or_else(|| Error::unknown_name("convention", name, known()))
    }
}

/// What differs from [`PRINTED`]: one line.
pub fn summary(described: &Description) -> String {
    let printed = Description::from(&PRINTED);
    let is_floor = |key: &str| key.ends_with("_min") || key.ends_with("_eps") || key == "nh_clamped";
    let mut parts: Vec<String> = Vec::new();
    let all = described.terms.differences(&printed.terms);
    let words = all.iter().filter(|difference| !is_floor(&difference.key));
    parts.extend(words.map(|difference| format!("{} {}", difference.key, difference.own)));
    if all.iter().any(|difference| is_floor(&difference.key)) {
        parts.push("other floors".to_owned());
    }
    if described.loss.epsilon.is_some_and(|epsilon| Some(epsilon) != printed.loss.epsilon) {
        parts.push(format!("epsilon {}", described.loss.epsilon.unwrap_or_default()));
    }
    if described.loss.norm != printed.loss.norm {
        parts.push(format!("norm {}", described.loss.norm));
    }
    if described.loss == printed.loss && parts.is_empty() {
        return "the algorithms as printed".to_owned();
    }
    if described.scenes != printed.scenes && !described.scenes.is_empty() {
        parts.push("other scenes".to_owned());
    }
    parts.join(", ")
}

/// The convention as it is computed: Algorithm 3 with its limits.
impl From<&Convention> for Description {
    fn from(c: &Convention) -> Self {
        let mut terms = RendererTerms::BASE;
        terms.material.r_min = c.roughness_floor;
        // The released codes that clamp n.h clip maps to [0, 1], too, where the kernel gets no others.
        (terms.specular.nh_clamped, terms.material.clip_maps) = (c.clamp_n_dot_h, c.clamp_n_dot_h);
        terms.specular.d_den_min = c.d_floor;
        terms.specular.g_den_min = c.g_floor;
        terms.light.lz = Some(c.light_z_floor);
        terms.light.factor = c.intensity;
        let u1 = [c.u1_min, c.u1_max];
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

/// A convention that losses are computed by. Without scenes it samples those of `printed`; without a norm it is log L1 with an epsilon
/// of 0.01.
impl TryFrom<&Description> for Convention {
    type Error = Error;

    fn try_from(described: &Description) -> Result<Self, Error> {
        let is_same = |c: &&Self| {
            let own = Description::from(*c);
            (own.terms, own.loss, &own.scenes) == (described.terms, described.loss, &described.scenes)
                && c.name == described.name
        };
        if let Some(known) = convention::ALL.iter().find(is_same) {
            return Ok(*known);
        }
        let mut c = Self {
            name: interned_name(&described.name),
            epsilon: described.loss.epsilon.unwrap_or(PRINTED.epsilon),
            ..PRINTED
        };
        let mut has_near = described.scenes.is_empty();
        for scenes in &described.scenes {
            match scenes {
                SceneTerms::Mirror {
                    u1,
                    mu: 0.5,
                    sigma_view: 0.75,
                    sigma_light,
                    shift: [-1.0, 1.0],
                    shift_z,
                    ..
                } => {
                    has_near = true;
                    [c.u1_min, c.u1_max] = *u1;
                    (c.light_distance_sigma, c.shift_z) = (*sigma_light, *shift_z);
                }
                SceneTerms::Distant { u1, .. } | SceneTerms::UnitDistance { u1, .. } => {
                    [c.u1_min, c.u1_max] = *u1
                }
                other => {
                    let problem = format!(
                        "[[scenes]]: expected mirror scenes with mu = 0.5, sigma_view = 0.75 and shift = [-1, 1], and distant ones, \
                        found {other:?}; leave the scenes out, and list them in a file"
                    );
                    return Err(Error::BadConvention { problem });
                }
            }
        }
        if !(0.0..1.0).contains(&c.u1_max) || !(0.0..=c.u1_max).contains(&c.u1_min) {
            let problem =
                format!("[[scenes]] u1: expected 0 <= low <= high < 1, found [{}, {}]", c.u1_min, c.u1_max);
            return Err(Error::BadConvention { problem });
        }
        let terms = described.terms;
        let differences = |model: &Self| terms.differences(&Description::from(model).terms).len();
        let nearest = if differences(&GUIDED_2020) < differences(&PRINTED) { &GUIDED_2020 } else { &PRINTED };
        c.member = Some(interned(Member { terms, norm: described.loss.norm, has_near, nearest }));
        Ok(c)
    }
}

/// The member, kept for the time of the process: conventions are copied everywhere, and few are read.
fn interned(member: Member) -> &'static Member {
    static KEPT: Mutex<Vec<&'static Member>> = Mutex::new(Vec::new());
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = kept.iter().find(|known| ***known == member) {
        return known;
    }
    let new: &'static Member = Box::leak(Box::new(member));
    kept.push(new);
    new
}

fn interned_name(name: &str) -> &'static str {
    static KEPT: Mutex<Vec<&'static str>> = Mutex::new(Vec::new());
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = kept.iter().find(|known| **known == name) {
        return known;
    }
    let new: &'static str = Box::leak(name.to_owned().into_boxed_str());
    kept.push(new);
    new
}
