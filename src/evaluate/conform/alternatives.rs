//! Renderers that differ from another in one term.

use svbrdf_core::model::grammar::RendererTerms;
use svbrdf_core::model::grammar::words::{
    Alpha, Denominator, Distribution, F90, Falloff, Fresnel, K, Maps, NormalY, Normals, Shadowing, Weight,
};

/// The values of a floor that are tried before it is refined.
const LADDER: [f64; 16] =
    [1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 3e-3, 1e-2, 2e-2, 4.5e-2, 6e-2, 8e-2, 0.1, 0.2];

/// Exponents of the cone of a flash that are tried.
pub const SPOTS: [f64; 8] = [0.0, 1.0, 2.0, 4.0, 5.0, 8.0, 10.0, 16.0];

/// Sets one number of a renderer.
pub type Set = fn(&mut RendererTerms, f64);

/// Every number that is a floor or is added to something, by its key, and where it is 0 in [`RendererTerms::BASE`].
pub const FLOORS: [(&str, Set); 21] = [
    ("r_min", |t, x| t.material.r_min = x),
    ("D_den_min", |t, x| t.specular.d_den_min = x),
    ("D_add", |t, x| t.specular.d_add = x),
    ("D_den2_min", |t, x| t.specular.d_den2_min = x),
    ("nl_min", |t, x| t.specular.nl_min = x),
    ("nv_min", |t, x| t.specular.nv_min = x),
    ("nh_min", |t, x| t.specular.nh_min = x),
    ("vh_min", |t, x| t.specular.vh_min = x),
    ("nl_min, nv_min", |t, x| (t.specular.nl_min, t.specular.nv_min) = (x, x)),
    ("nl_min, nv_min, nh_min, vh_min", |t, x| {
        (t.specular.nl_min, t.specular.nv_min) = (x, x);
        (t.specular.nh_min, t.specular.vh_min) = (x, x);
    }),
    ("k_add", |t, x| t.specular.k_add = x),
    ("k_min", |t, x| t.specular.k_min = x),
    ("G_den_min", |t, x| t.specular.g_den_min = x),
    ("G_add", |t, x| t.specular.g_add = x),
    ("V_den_min", |t, x| t.specular.v_den_min = x),
    ("den_add", |t, x| t.specular.den_add = x),
    ("den_add of 4nlnv", |t, x| (t.specular.denominator, t.specular.den_add) = (Denominator::Both, x)),
    ("cos_min", |t, x| t.light.cos_min = x),
    ("falloff_add", |t, x| t.light.falloff_add = x),
    ("lz", |t, x| t.light.lz = Some(x)),
    ("front_min", |t, x| t.specular.front_min = Some(x)),
];

/// Largest values that are tried.
const CAPS: [(&str, Set, &[f64]); 3] = [
    ("r_max", |t, x| t.material.r_max = x, &[1.0]),
    ("dot_max", |t, x| t.specular.dot_max = x, &[1.0, 0.9999, 0.999, 0.99]),
    ("D_cap", |t, x| t.specular.d_cap = x, &[65_464.327_389_802_3, 65504.0, 1e4, 1e3, 100.0]),
];

/// The kinds of shadowing, with k.
pub const SHADOWINGS: [(Shadowing, K); 8] = [
    (Shadowing::Schlick, K::HalfAlpha),
    (Shadowing::Schlick, K::HalfSquare),
    (Shadowing::Schlick, K::Direct),
    (Shadowing::Smith, K::HalfAlpha),
    (Shadowing::Correlated, K::HalfAlpha),
    (Shadowing::SmithBeckmann, K::HalfAlpha),
    (Shadowing::None, K::HalfAlpha),
    (Shadowing::Lambda, K::HalfAlpha),
];

/// Each choice of a word: the key, and the renderer with it.
pub fn of_words(terms: &RendererTerms) -> Vec<(&'static str, RendererTerms)> {
    let mut all = Vec::new();
    let mut add = |key, change: &dyn Fn(&mut RendererTerms)| {
        let mut changed = *terms;
        change(&mut changed);
        if changed != *terms {
            all.push((key, changed));
        }
    };
    Alpha::ALL.iter().for_each(|x| add("alpha", &|t| t.material.alpha = *x));
    Normals::ALL.iter().for_each(|x| add("normal", &|t| t.material.normal = *x));
    NormalY::ALL.iter().for_each(|x| add("normal_y", &|t| t.material.normal_y = *x));
    Distribution::ALL.iter().for_each(|x| add("D", &|t| t.specular.d = *x));
    for (g, k) in SHADOWINGS {
        let key = if g == Shadowing::Schlick && terms.specular.g == g { "k" } else { "G" };
        add(key, &|t| (t.specular.g, t.specular.k) = (g, k));
    }
    Denominator::ALL.iter().for_each(|x| add("denominator", &|t| t.specular.denominator = *x));
    Fresnel::ALL.iter().for_each(|x| add("F", &|t| t.specular.f = *x));
    F90::ALL.iter().for_each(|x| add("f90", &|t| t.specular.f90 = *x));
    weights(terms.material.material).iter().for_each(|x| add("diffuse", &|t| t.diffuse.diffuse = *x));
    Falloff::ALL.iter().for_each(|x| add("falloff", &|t| t.light.falloff = *x));
    for lz in [None, Some(0.0), Some(1e-3)] {
        add("lz", &|t| t.light.lz = lz);
    }
    SPOTS.iter().for_each(|x| add("spot", &|t| t.light.spot = *x));
    for yes in [false, true] {
        add("clip_maps", &|t| t.material.clip_maps = yes);
        add("flip_below", &|t| t.material.flip_below = yes);
        add("D_xi", &|t| t.specular.d_xi = yes);
        add("nh_clamped", &|t| t.specular.nh_clamped = yes);
        add("spec_cosine", &|t| t.specular.spec_cosine = yes);
        add("collocated", &|t| t.light.collocated = yes);
    }
    // The same without floors, and a usual one as it is written.
    add("denominator, spec_cosine", &|t| {
        (t.specular.denominator, t.specular.spec_cosine) = (Denominator::View, false);
    });
    add("denominator, spec_cosine", &|t| {
        (t.specular.denominator, t.specular.spec_cosine) = (Denominator::Light, false);
    });
    all
}

/// The numbers that are tried: the key, its setter, its values, and whether a larger value changes all that a smaller one does.
pub fn of_numbers() -> impl Iterator<Item = (&'static str, Set, &'static [f64], bool)> {
    let floors = FLOORS.iter().map(|(key, set)| (*key, *set, &LADDER[..], true));
    floors.chain(CAPS.iter().map(|(key, set, values)| (*key, *set, *values, false)))
}

/// The renderer without one of its numbers.
pub fn without_numbers(terms: &RendererTerms) -> Vec<(&'static str, RendererTerms)> {
    let (base, mut all) = (RendererTerms::BASE, Vec::new());
    let mut add = |key, change: &dyn Fn(&mut RendererTerms)| {
        let mut changed = *terms;
        change(&mut changed);
        if changed != *terms {
            all.push((key, changed));
        }
    };
    for (key, set) in
        FLOORS.iter().filter(|(key, _)| !matches!(*key, "lz" | "front_min" | "den_add of 4nlnv"))
    {
        add(*key, &|t| set(t, 0.0));
    }
    add("den_add", &|t| {
        (t.specular.den_add, t.specular.denominator) = (0.0, base.specular.denominator);
    });
    add("front_min", &|t| t.specular.front_min = None);
    add("r_max", &|t| t.material.r_max = base.material.r_max);
    add("dot_max", &|t| t.specular.dot_max = base.specular.dot_max);
    add("D_cap", &|t| t.specular.d_cap = base.specular.d_cap);
    all
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
