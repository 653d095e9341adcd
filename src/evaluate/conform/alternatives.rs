//! Renderers that differ from another in one term.

use svbrdf_core::model::grammar::RendererTerms;
use svbrdf_core::model::grammar::words::{
    Alpha, Denominator, Distribution, F90, Falloff, Fresnel, FresnelCosine, K, Maps, NormalY, Normals,
    Shadowing, Weight,
};

/// The values of a floor that are tried before it is refined.
const LADDER: [f64; 16] =
    [1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 3e-3, 1e-2, 2e-2, 4.5e-2, 6e-2, 8e-2, 0.1, 0.2];

/// Exponents of the cone of a flash that are tried.
pub const SPOTS: [f64; 8] = [0.0, 1.0, 2.0, 4.0, 5.0, 8.0, 10.0, 16.0];

/// Sets one number of a renderer.
pub type SetNumber = fn(&mut RendererTerms, f64);

/// Every number that is a floor or is added to something, and where it is 0 in [`RendererTerms::BASE`].
const FLOORS: [SetNumber; 22] = [
    |t, x| t.material.r_min = x,
    |t, x| t.material.vec_eps = x,
    |t, x| t.specular.d_den_min = x,
    |t, x| t.specular.d_add = x,
    |t, x| t.specular.d_den2_min = x,
    |t, x| t.specular.nl_min = x,
    |t, x| t.specular.nv_min = x,
    |t, x| t.specular.nh_min = x,
    |t, x| t.specular.vh_min = x,
    |t, x| (t.specular.nl_min, t.specular.nv_min) = (x, x),
    |t, x| {
        (t.specular.nl_min, t.specular.nv_min) = (x, x);
        (t.specular.nh_min, t.specular.vh_min) = (x, x);
    },
    |t, x| t.specular.k_add = x,
    |t, x| t.specular.k_min = x,
    |t, x| t.specular.g_den_min = x,
    |t, x| t.specular.g_add = x,
    |t, x| t.specular.v_den_min = x,
    |t, x| t.specular.den_add = x,
    |t, x| (t.specular.denominator, t.specular.den_add) = (Denominator::Both, x),
    |t, x| t.light.cos_min = x,
    |t, x| t.light.falloff_add = x,
    |t, x| t.light.lz = Some(x),
    |t, x| t.specular.front_min = Some(x),
];

/// Largest values that are tried.
const CAPS: [(SetNumber, &[f64]); 3] = [
    (|t, x| t.material.r_max = x, &[1.0]),
    (|t, x| t.specular.dot_max = x, &[1.0, 0.9999, 0.999, 0.99]),
    (|t, x| t.specular.d_cap = x, &[65_464.327_389_802_3, 65504.0, 1e4, 1e3, 100.0]),
];

/// The kinds of shadowing, with k.
const SHADOWINGS: [(Shadowing, K); 8] = [
    (Shadowing::Schlick, K::HalfAlpha),
    (Shadowing::Schlick, K::HalfSquare),
    (Shadowing::Schlick, K::Direct),
    (Shadowing::Smith, K::HalfAlpha),
    (Shadowing::Correlated, K::HalfAlpha),
    (Shadowing::SmithBeckmann, K::HalfAlpha),
    (Shadowing::None, K::HalfAlpha),
    (Shadowing::Lambda, K::HalfAlpha),
];

/// The renderer with each other choice of a word.
pub fn of_words(terms: &RendererTerms) -> Vec<RendererTerms> {
    let mut all = Vec::new();
    let mut add = |change: &dyn Fn(&mut RendererTerms)| {
        let mut changed = *terms;
        change(&mut changed);
        if changed != *terms {
            all.push(changed);
        }
    };
    Alpha::ALL.iter().for_each(|x| add(&|t| t.material.alpha = *x));
    Normals::ALL.iter().for_each(|x| add(&|t| t.material.normal = *x));
    NormalY::ALL.iter().for_each(|x| add(&|t| t.material.normal_y = *x));
    Distribution::ALL.iter().for_each(|x| add(&|t| t.specular.d = *x));
    SHADOWINGS.iter().for_each(|(g, k)| add(&|t| (t.specular.g, t.specular.k) = (*g, *k)));
    for f in Fresnel::ALL {
        FresnelCosine::ALL.iter().for_each(|of| add(&|t| (t.specular.f, t.specular.f_of) = (f, *of)));
    }
    F90::ALL.iter().for_each(|x| add(&|t| t.specular.f90 = *x));
    weights(terms.material.material).iter().for_each(|x| add(&|t| t.diffuse.diffuse = *x));
    Falloff::ALL.iter().for_each(|x| add(&|t| t.light.falloff = *x));
    [None, Some(0.0), Some(1e-3)].iter().for_each(|lz| add(&|t| t.light.lz = *lz));
    SPOTS.iter().for_each(|x| add(&|t| t.light.spot = *x));
    for yes in [false, true] {
        add(&|t| t.material.clip_maps = yes);
        add(&|t| t.material.flip_below = yes);
        add(&|t| t.specular.d_xi = yes);
        add(&|t| t.specular.nh_clamped = yes);
        add(&|t| t.light.collocated = yes);
        Denominator::ALL.iter().for_each(|x| {
            add(&|t| (t.specular.denominator, t.specular.spec_cosine) = (*x, yes));
        });
    }
    all
}

/// The numbers that are tried, each with its setter.
pub fn of_numbers() -> impl Iterator<Item = (SetNumber, f64)> {
    let floors = FLOORS.iter().flat_map(|set| LADDER.iter().map(|value| (*set, *value)));
    floors.chain(CAPS.iter().flat_map(|(set, values)| values.iter().map(|value| (*set, *value))))
}

/// The renderer without one of its numbers.
pub fn without_numbers(terms: &RendererTerms) -> Vec<RendererTerms> {
    let base = RendererTerms::BASE;
    let differences = terms.differences(&base).into_iter();
    let numbers = differences
        .filter(|one| one.own.parse::<f64>().is_ok() && !matches!(one.key.as_str(), "lz" | "spot"));
    // Divided by l.z, a cone of exponent 1 is none.
    let mut even = *terms;
    (even.light.lz, even.light.spot) = (None, 0.0);
    let numbers = numbers.map(|one| terms.with(&one.section, &one.key, &base));
    numbers.chain((even != *terms).then_some(even)).collect()
}

/// The weights of diffuse that a workflow has.
pub fn weights(maps: Maps) -> &'static [Weight] {
    match maps {
        Maps::Diffuse | Maps::Dielectric => &[Weight::Specular, Weight::Fresnel, Weight::One, Weight::Zero],
        Maps::Metallic => &[
            Weight::Metallic,
            Weight::DielectricMetallic,
            Weight::FresnelMetallic,
            Weight::One,
            Weight::Fresnel,
            Weight::Specular,
            Weight::Zero,
        ],
    }
}
