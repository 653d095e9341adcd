//! Random members of the grammar: their structure is found.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use svbrdf_core::model::grammar::RendererTerms;
use svbrdf_core::model::grammar::words::{
    Alpha, Denominator, Distribution, Falloff, Fresnel, FresnelCosine, K, Maps, NormalY, Normals, Shadowing,
    Weight,
};
use svbrdf_evaluate::conform::{TermGap, VerdictKind};

use super::{judged, points, single};

/// Terms that are right, or cannot be told: floors and factors are not among them.
const STRUCTURE: [&str; 13] = [
    "material",
    "alpha",
    "normal_y",
    "D",
    "G",
    "k",
    "F",
    "F_of",
    "diffuse",
    "falloff",
    "collocated",
    "spot",
    "transfer",
];

fn pick<T: Copy>(random: &mut ChaCha8Rng, of: &[T]) -> T {
    of[random.random_range(0..of.len())]
}

fn member(seed: u64) -> RendererTerms {
    let random = &mut ChaCha8Rng::seed_from_u64(seed);
    let mut terms = RendererTerms::BASE;
    let (m, s) = (&mut terms.material, &mut terms.specular);
    m.material = pick(random, &[Maps::Diffuse, Maps::Diffuse, Maps::Metallic]);
    m.alpha = pick(random, &[Alpha::Square, Alpha::Square, Alpha::Linear]);
    m.normal = pick(random, &[Normals::Unit, Normals::Stored]);
    m.normal_y = pick(random, &NormalY::ALL);
    s.d = pick(random, &Distribution::ALL);
    let shadowings = [
        (Shadowing::Schlick, K::HalfAlpha),
        (Shadowing::Schlick, K::HalfSquare),
        (Shadowing::Schlick, K::Direct),
        (Shadowing::Smith, K::HalfAlpha),
        (Shadowing::Correlated, K::HalfAlpha),
        (Shadowing::None, K::HalfAlpha),
    ];
    (s.g, s.k) = pick(random, &shadowings);
    s.f = pick(random, &Fresnel::ALL);
    terms.diffuse.diffuse = match m.material {
        Maps::Metallic => pick(
            random,
            &[Weight::One, Weight::Metallic, Weight::FresnelMetallic, Weight::DielectricMetallic],
        ),
        _ => pick(random, &[Weight::One, Weight::Specular, Weight::Fresnel]),
    };
    terms.light.lz = pick(random, &[None, Some(0.0), Some(1e-3)]);
    terms.light.falloff = pick(random, &Falloff::ALL);
    terms.light.factor = (random.random::<f64>() * 4.0 - 1.0).exp();
    if random.random_bool(0.5) {
        m.r_min = pick(random, &[1e-3, 1e-2, 0.045, 0.08]);
    }
    if random.random_bool(0.4) {
        s.d_den_min = pick(random, &[1e-6, 1e-4, 1e-3]);
    }
    if random.random_bool(0.3) {
        s.nv_min = pick(random, &[1e-4, 1e-3, 1e-2]);
        s.nl_min = s.nv_min;
    }
    if random.random_bool(0.2) {
        (s.denominator, s.den_add) = (Denominator::Both, pick(random, &[1e-4, 1e-3]));
    }
    terms
}

#[test]
fn random_members_are_found_in_float64_and_float32() {
    let points = points();
    for seed in 0..12 {
        let terms = member(seed);
        let metallic = terms.material.material == Maps::Metallic;
        for stored in [|rgb| rgb, single] {
            let radiance = points.iter().map(|point| stored(terms.radiance(point, true))).collect();
            let verdict = judged(&points, radiance, Some(metallic), &terms);
            let is_wrong = |one: &&TermGap| STRUCTURE.contains(&one.term.as_str());
            let wrong: Vec<_> = verdict.differences.iter().filter(is_wrong).collect();
            assert_ne!(verdict.kind, VerdictKind::Unknown, "seed {seed}");
            assert!(wrong.is_empty(), "seed {seed}: {wrong:?}");
        }
    }
}

#[test]
fn a_member_is_not_taken_for_another() {
    let points = points();
    let mut asked = member(0);
    asked.specular.f = Fresnel::Fifth;
    let metallic = asked.material.material == Maps::Metallic;
    for (term, f, f_of) in [
        ("F", Fresnel::Base2, FresnelCosine::Half),
        ("F_of", Fresnel::Fifth, FresnelCosine::View),
        ("F_of", Fresnel::Fifth, FresnelCosine::NormalHalf),
    ] {
        let mut terms = asked;
        (terms.specular.f, terms.specular.f_of) = (f, f_of);
        let exact = points.iter().map(|point| terms.radiance(point, true)).collect();
        let verdict = judged(&points, exact, Some(metallic), &asked);
        assert_eq!(verdict.kind, VerdictKind::Differs, "{:?}", terms.specular.f_of);
        let differing: Vec<_> = verdict.differences.iter().map(|one| one.term.as_str()).collect();
        assert_eq!(differing, [term]);
    }
}
