//! The scenes that a named convention samples: mean losses against those of the authors' own samplers.

use glam::DVec3;
use rayon::prelude::*;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::grammar::{Description, Point};
use svbrdf_core::model::named_conventions as named;
use svbrdf_core::model::scene::{Kind, Scene, sample};
use svbrdf_files::arrays::Arrays;
use svbrdf_needs::needs;

use super::peers::{SIDE, convention, file, point};

/// The named conventions whose authors' code samples scenes.
const SAMPLERS: [(&str, &str); 6] = [
    ("guided-2020", "deschaintre_guided_2020"),
    ("matfuse-2024", "matfuse"),
    ("material-palette-2024", "material_palette"),
    ("multi-image-2019", "deschaintre_multi_2019"),
    ("single-image-2018", "deschaintre_single_2018"),
    ("svbrdf-estimation-2022", "mworchel"),
];
/// Scenes of each kind, with a few texels of each: more than the 2,000 of the authors, whose error is then most of both.
const SCENES: usize = 6_000;
/// Enough to see another sampler.
const FEW: usize = 2_000;
const TEXELS: usize = 24;

/// The mean loss over `scenes`, and its standard error.
fn mean(described: &Description, materials: &Arrays, scenes: &[Scene]) -> [f64; 2] {
    let epsilon = described.loss.epsilon.unwrap_or(0.0);
    let of_scene = |(number, scene): (usize, &Scene)| {
        let is_near = scene.kind == Kind::Near;
        // Evenly over all texels, others in each scene.
        let texels = (0..TEXELS).map(|i| (i * 997 + number * 331) % (SIDE * SIDE));
        let radiances = |which: &str| -> Vec<f64> {
            let radiance = |texel: usize| {
                let grid = &described.terms.grid;
                let at = grid.position(texel % SIDE, texel / SIDE, SIDE, SIDE);
                let [view, light] = [scene.view, scene.light].map(DVec3::from);
                let (light, view) = grid.vectors(at, light, view, is_near);
                let ends = Point {
                    light: light.to_array(),
                    view: view.to_array(),
                    ..point(materials, which, texel)
                };
                described.terms.radiance(&ends, is_near)
            };
            texels.clone().flat_map(radiance).collect()
        };
        described.loss.norm.of(&radiances("a_"), &radiances("b_"), epsilon).unwrap()
    };
    let losses: Vec<f64> = scenes.par_iter().enumerate().map(|(i, scene)| of_scene((i, scene))).collect();
    let count = losses.len() as f64;
    let mean = losses.iter().sum::<f64>() / count;
    let variance = losses.iter().map(|loss| (loss - mean).powi(2)).sum::<f64>() / (count - 1.0);
    [mean, (variance / count).sqrt()]
}

/// How far the mean of 6 near-field scenes for 3 distant ones is from that of the authors, in standard errors of both.
fn off(name: &str, peer: &str, count: usize, change: impl Fn(&mut Convention)) -> f64 {
    let (described, peer, materials) = (convention(name), file(peer), file("materials"));
    let own = named::all().iter().find(|own| own.name == name).unwrap();
    let mut sampled = Convention::try_from(own).unwrap();
    change(&mut sampled);
    let scenes = sample(1, count, count, &sampled);
    let [near, distant] = [&scenes[..count], &scenes[count..]].map(|of| mean(&described, &materials, of));
    let share = if name == "matfuse-2024" { 0.0 } else { 2.0 / 3.0 };
    let own = share * near[0] + (1.0 - share) * distant[0];
    let error = (share * near[1]).hypot((1.0 - share) * distant[1]);
    let (expected, theirs) = (peer["sampler_mean"].values[0], peer["sampler_se"].values[0]);
    let off = (own - expected) / error.hypot(theirs);
    println!("{name:24} {own:.5} +- {error:.5}, theirs {expected:.5} +- {theirs:.5}: {off:+.2}");
    off.abs()
}

#[needs(shared)]
fn means_over_sampled_scenes_are_those_of_the_authors_own_samplers() {
    for (name, peer) in SAMPLERS {
        assert!(off(name, peer, SCENES, |_| ()) < 4.0, "{name}");
    }
}

#[needs(shared)]
fn another_sampler_is_seen() {
    for (name, peer) in SAMPLERS {
        let flatter = |convention: &mut Convention| convention.u1_max = 0.5;
        assert!(off(name, peer, FEW, flatter) > 4.0, "{name}");
    }
}
