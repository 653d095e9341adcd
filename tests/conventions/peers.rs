//! Every peer of `../shared/peers/renderers`: its radiances, means and losses by the grammar.

use std::path::Path;

use glam::DVec3;
use svbrdf_core::model::grammar::words::{Norm, NormalY};
use svbrdf_core::model::grammar::{Description, LossTerms, Point, RendererTerms};
use svbrdf_core::model::named_conventions as named;
use svbrdf_files::arrays::{self, Array, Arrays};
use svbrdf_needs::needs;

pub const PEERS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/peers/renderers");

/// The convention of each, and its file.
const ALL: [(&str, &str); 19] = [
    ("chord-2025", "chord"),
    ("deepbasis-2023", "deepbasis"),
    ("diffmat-2022", "diffmat"),
    ("filament", "filament"),
    ("gltf-viewer", "gltf_viewer"),
    ("guided-2020", "deschaintre_guided_2020"),
    ("learnopengl", "learnopengl"),
    ("lookahead-2022", "lookahead"),
    ("luo-2024", "luo"),
    ("material-palette-2024", "material_palette"),
    ("materialgan-2020", "diff_renderer"),
    ("matfuse-2024", "matfuse"),
    ("matfusion-2023", "matfusion"),
    ("multi-image-2019", "deschaintre_multi_2019"),
    ("neuralmaterial-2021", "neuralmaterial"),
    ("nvdiffrec", "nvdiffrec"),
    ("single-image-2018", "deschaintre_single_2018"),
    ("svbrdf-estimation-2022", "mworchel"),
    ("threejs", "threejs"),
];

/// Largest relative error at the random points and of texels; near the highlight of r below 0.1, a code without a floor of D is
/// ill-conditioned.
const POINTS: f64 = 1e-9;
/// The row `r_1e-3_near_mirror`.
const NEAR_MIRROR: f64 = 1e-3;
const MEANS: f64 = 1e-12;

pub fn file(name: &str) -> Arrays {
    arrays::read(Path::new(&format!("{PEERS}/{name}.npz"))).unwrap()
}

pub fn convention(name: &str) -> Description {
    let text = std::fs::read_to_string(format!("{PEERS}/conventions/{name}.toml")).unwrap();
    let mut read: Description = text.parse().unwrap();
    // What its text has no key for.
    read.terms.grid.light_only_distant |= name == "chord-2025";
    if name == "nvdiffrec" {
        read.terms.light.cos_max = Some(f64::INFINITY);
    }
    read
}

pub fn triple(array: &Array, row: usize) -> [f64; 3] {
    std::array::from_fn(|c| array.values[3 * row + c])
}

/// Row `row` of arrays whose names begin with `prefix`; base colours are the diffuse ones.
pub fn point(of: &Arrays, prefix: &str, row: usize) -> Point {
    let three = |name: &str| triple(&of[&format!("{prefix}{name}")], row);
    Point {
        normal: three("n"),
        diffuse: three("d"),
        specular: three("s"),
        roughness: of[&format!("{prefix}r")].values[row],
        base_color: three("d"),
        metallic: of[&format!("{prefix}m")].values[row],
        light: [0.0; 3],
        view: [0.0; 3],
    }
}

/// The terms of the points, which the makers of the numbers gave other units for some.
fn terms_of_points(name: &str, terms: &RendererTerms) -> RendererTerms {
    let mut terms = *terms;
    if matches!(name, "chord-2025" | "diffmat-2022") {
        terms.material.normal_y = NormalY::Up;
    }
    if name == "diffmat-2022" {
        terms.light.intensity = [10.0; 3];
    }
    terms
}

fn relative(got: [f64; 3], expected: [f64; 3]) -> f64 {
    let off = |c: usize| {
        let off = (got[c] - expected[c]).abs();
        if off == 0.0 { 0.0 } else { off / expected[c].abs().max(f64::MIN_POSITIVE) }
    };
    // NaN is above all.
    [0, 1, 2].map(off).into_iter().fold(0.0, |most: f64, off| if most > off { most } else { off })
}

/// The worst relative error of random points, and of `r_1e-3_near_mirror`.
fn worst_of_points(name: &str, peer: &Arrays, terms: &RendererTerms) -> [f64; 2] {
    let points = file("points");
    let (mut random, mut extreme) = (0.0_f64, 0.0_f64);
    for row in 0..312 {
        let expected = triple(&peer["points"], row);
        if peer["valid"].values[row] == 0.0 || !expected.iter().all(|x| x.is_finite()) {
            continue;
        }
        let ends = Point {
            light: triple(&points["L"], row),
            view: triple(&points["V"], row),
            ..point(&points, "", row)
        };
        let error = relative(terms_of_points(name, terms).radiance(&ends, true), expected);
        if row < 300 { random = random.max(error) } else { extreme = extreme.max(error) }
    }
    [random, extreme]
}

pub const SIDE: usize = 32;

/// The radiances of a material in a scene.
fn rendering(terms: &RendererTerms, materials: &Arrays, which: &str, scene: usize) -> Vec<[f64; 3]> {
    let is_near = scene < 6;
    let (list, row) = if is_near { ("near", scene) } else { ("distant", scene - 6) };
    let ends = &materials[list].values[6 * row..6 * row + 6];
    let (view, light) = (DVec3::from_slice(&ends[..3]), DVec3::from_slice(&ends[3..]));
    let of = |texel: usize| {
        let at = terms.grid.position(texel % SIDE, texel / SIDE, SIDE, SIDE);
        let (light, view) = terms.grid.vectors(at, light, view, is_near);
        let point =
            Point { light: light.to_array(), view: view.to_array(), ..point(materials, which, texel) };
        terms.radiance(&point, is_near)
    };
    (0..SIDE * SIDE).map(of).collect()
}

/// The worst relative error of texels and of means.
fn worst_of_materials(peer: &Arrays, terms: &RendererTerms) -> [f64; 2] {
    let materials = file("materials");
    let (mut of_texels, mut of_means) = (0.0_f64, 0.0_f64);
    for which in ["a_", "b_"] {
        for scene in 0..9 {
            let rendered = rendering(terms, &materials, which, scene);
            for (i, place) in materials["texels"].values.chunks(2).enumerate() {
                let texel = place[0] as usize * SIDE + place[1] as usize;
                let expected = triple(&peer[&format!("{which}texels")], 24 * scene + i);
                of_texels = of_texels.max(relative(rendered[texel], expected));
            }
            let mean = std::array::from_fn(|c| {
                rendered.iter().map(|rgb| rgb[c]).sum::<f64>() / rendered.len() as f64
            });
            of_means = of_means.max(relative(mean, triple(&peer[&format!("{which}mean")], scene)));
        }
    }
    [of_texels, of_means]
}

/// The loss of the fixed scenes, where the norm is one value for value.
fn loss(description: &Description) -> Option<f64> {
    let materials = file("materials");
    let LossTerms { norm, epsilon } = description.loss;
    let of_scene = |scene: usize| {
        let [a, b] = ["a_", "b_"].map(|which| rendering(&description.terms, &materials, which, scene));
        norm.of(a.as_flattened(), b.as_flattened(), epsilon.unwrap_or(0.0))
    };
    let losses: Option<Vec<f64>> = (0..9).map(of_scene).collect();
    losses.map(|losses| losses.iter().sum::<f64>() / 9.0)
}

#[needs(shared)]
fn every_peer_is_met_by_the_grammar() {
    for (name, peer) in ALL {
        let (description, peer) = (convention(name), file(peer));
        let [random, extreme] = worst_of_points(name, &peer, &description.terms);
        let [texels, means] = worst_of_materials(&peer, &description.terms);
        println!(
            "{name:24} points {random:.1e}, extremes {extreme:.1e}, texels {texels:.1e}, means {means:.1e}"
        );
        assert!(random < POINTS && texels < POINTS && means < MEANS && extreme < NEAR_MIRROR, "{name}");
    }
}

#[needs(shared)]
fn losses_are_the_authors() {
    for (name, peer) in ALL {
        let description = convention(name);
        // The rest compares encoded or clipped pictures, or statistics of them.
        if description.loss.norm == Norm::LogL1 || name == "matfuse-2024" {
            let (got, expected) = (loss(&description).unwrap(), file(peer)["loss_fixed"].values[0]);
            println!("{name:24} {got:.15} {expected:.15}");
            assert!((got / expected - 1.0).abs() < MEANS, "{name}: {got}, expected {expected}");
        }
    }
}

#[needs(shared)]
fn a_planted_fault_is_seen_in_every_peer() {
    for (name, peer) in ALL {
        let (mut description, peer) = (convention(name), file(peer));
        description.terms.light.factor *= 1.0 + 1e-7;
        let [random, _] = worst_of_points(name, &peer, &description.terms);
        assert!(random > POINTS, "{name}: {random}");
    }
}

#[derive(serde::Deserialize)]
struct Subset {
    points: Vec<StoredPoint>,
    peers: std::collections::BTreeMap<String, Vec<Option<[f64; 3]>>>,
}

#[derive(Debug, serde::Deserialize)]
struct StoredPoint {
    normal: [f64; 3],
    light: [f64; 3],
    view: [f64; 3],
    diffuse: [f64; 3],
    specular: [f64; 3],
    roughness: f64,
    base_color: [f64; 3],
    metallic: f64,
}

/// 20 of the points with the radiances of the named conventions.
fn subset() -> Subset {
    serde_json::from_str(include_str!("peers.json")).unwrap()
}

/// The named conventions at 20 points, the last 4 extreme ones, without `../shared`.
#[test]
fn named_conventions_give_the_radiances_of_their_authors() {
    let subset = subset();
    let mut compared = 0;
    for description in named::all() {
        let Some(expected) = subset.peers.get(&description.name) else { continue };
        for (i, (point, expected)) in subset.points.iter().zip(expected).enumerate() {
            let StoredPoint { normal, light, view, diffuse, specular, roughness, base_color, metallic } =
                *point;
            let point = Point { normal, diffuse, specular, roughness, base_color, metallic, light, view };
            let Some(expected) = *expected else { continue };
            let got = description.terms.radiance(&point, true);
            let error = relative(got, expected);
            let most = if i < 16 { POINTS } else { NEAR_MIRROR };
            assert!(error < most, "{}: {point:?}: {got:?}, expected {expected:?}", description.name);
            compared += 1;
        }
    }
    assert!(compared > 100, "{compared}");
}
