//! Random members of the grammar: their structure is found from rounded and from noisy radiances.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt as _, SeedableRng as _};

use svbrdf_core::model::grammar::RendererTerms;
use svbrdf_core::model::grammar::words::{
    Alpha, Denominator, Distribution, Falloff, Fresnel, K, Maps, NormalY, Normals, Shadowing, Transfer,
    Weight,
};
use svbrdf_evaluate::conform::VerdictKind;

use super::{Stored, judged, points};

/// RendererTerms that are right, or cannot be told: floors and factors are not among them.
const STRUCTURE: [&str; 12] = [
    "material",
    "alpha",
    "normal_y",
    "D",
    "G",
    "k",
    "F",
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

/// How many of the members `seeds` are right, have no name, and have a wrong one.
fn counted(stored: Stored, seeds: std::ops::Range<u64>) -> [usize; 3] {
    let points = points();
    let mut counts = [0; 3];
    for seed in seeds {
        let terms = member(seed);
        let exact: Vec<[f64; 3]> = points.iter().map(|point| terms.radiance(point, true)).collect();
        let mut asked = terms;
        if matches!(stored, Stored::Srgb) {
            asked.output.transfer = Transfer::Srgb;
        }
        let metallic = terms.material.material == Maps::Metallic;
        let verdict = judged(&points, stored.of(&exact, seed), Some(metallic), &asked);
        let wrong: Vec<String> = verdict
            .differences
            .iter()
            .filter(|difference| STRUCTURE.contains(&difference.term.key.as_str()))
            .map(|difference| format!("{:?}", difference.term))
            .collect();
        let which = match verdict.kind {
            VerdictKind::Unknown => 1,
            _ if wrong.is_empty() => 0,
            _ => 2,
        };
        if which > 0 {
            println!("{stored:?}, seed {seed}: {:?}, {wrong:?}", verdict.kind);
        }
        counts[which] += 1;
    }
    counts
}

const ALL: [Stored; 5] = [Stored::Double, Stored::Single, Stored::Half, Stored::Srgb, Stored::Noise(0.03)];

#[test]
fn random_members_are_found_from_rounded_and_noisy_radiances() {
    for stored in ALL {
        assert_eq!(counted(stored, 0..6), [6, 0, 0], "{stored:?}");
    }
}

/// `cargo test --release --test main -- conform::random --ignored --nocapture` prints the table of docs/conventions.md.
#[ignore = "takes minutes; docs/conventions.md has its command and its result"]
#[test]
fn two_hundred_random_members() {
    for stored in ALL.into_iter().chain([Stored::Noise(0.01), Stored::Noise(0.1)]) {
        let [right, unknown, wrong] = counted(stored, 0..200);
        println!("{stored:?}: {right} right, {unknown} without a name, {wrong} wrong");
        assert_eq!(wrong, 0, "{stored:?}");
        assert!(right >= 190, "{stored:?}: {right}");
    }
}

#[test]
fn a_member_is_not_taken_for_another() {
    let points = points();
    let terms = member(0);
    let mut other = terms;
    other.specular.f = if terms.specular.f == Fresnel::Fifth { Fresnel::Base2 } else { Fresnel::Fifth };
    let exact = points.iter().map(|point| terms.radiance(point, true)).collect();
    let metallic = terms.material.material == Maps::Metallic;
    let verdict = judged(&points, exact, Some(metallic), &other);
    assert_eq!(verdict.kind, VerdictKind::Differs);
    assert_eq!(verdict.differences.len(), 1, "{:?}", verdict.differences);
    assert_eq!(verdict.differences[0].term.key, "F");
}
