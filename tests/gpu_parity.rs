//! The shaders against their Rust twins: numbers first, then renderings, then what a window shows.
#![cfg(feature = "viewer")]

mod adapter;
mod display;
mod drafts;
mod plane;

use glam::DVec3;

use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::{self, Model, Texel};
use svbrdf_core::model::convention::{self, Convention, PRINTED};
use svbrdf_core::model::scene::{self, Kind, Scene};
use svbrdf_gpu::Gpu;
use svbrdf_needs::needs;

use crate::support::compare::{Worst, compare_rgb_with};
use crate::support::gpu::{bumpy, gpu, gpu_f32};
use crate::support::points::{Point, error_bound, exact, points};
use crate::support::tolerance::{POINT_ULPS, RENDERING_ULPS};

const SEED: u64 = 1;
const COUNT: usize = 200_000;

/// The radiances of points in f64, and their bounds.
struct InF64 {
    convention: Convention,
    expected: Vec<[f64; 3]>,
    bounds: Vec<[f64; 3]>,
}

impl InF64 {
    /// Bounds are those of `ulps`.
    fn new(convention: Convention, points: &[Point], ulps: f64) -> Self {
        let model = Model::from(&convention);
        let of = |(texel, w_l, w_v): (Texel<f64>, DVec3, DVec3)| {
            (brdf::render(&model, &texel, w_l, w_v), error_bound(&model, &texel, w_l, w_v, ulps))
        };
        let (expected, bounds) = points.iter().map(exact).map(of).unzip();
        Self { convention, expected, bounds }
    }

    fn compare(&self, got: &[[f32; 3]]) -> Result<Worst, String> {
        compare_rgb_with(got, &self.expected, |index, channel, _| self.bounds[index][channel])
            .map_err(|e| format!("{}: {e}", self.convention.name))
    }
}

fn probe(gpu: &Gpu, convention: &Convention, points: &[Point]) -> Vec<[f32; 3]> {
    gpu.probe(&Model::from(convention), points).expect("the probe runs")
}

#[needs(adapter)]
#[test]
fn the_shader_agrees_with_f64_at_random_and_extreme_points() {
    let gpu = gpu();
    let points = points(SEED, COUNT);
    for convention in convention::ALL {
        let in_f64 = InF64::new(convention, &points, POINT_ULPS);
        let worst = in_f64.compare(&probe(gpu, &convention, &points)).unwrap_or_else(|e| panic!("{e}"));
        println!("{}: worst share of the bound {:.3}", convention.name, worst.share);
    }
}

#[test]
fn the_bound_is_tight_at_ordinary_points() {
    let model = Model::from(&PRINTED);
    let mut shares: Vec<f64> = points(SEED, 10_000)
        .iter()
        .map(exact)
        .map(|(t, l, v)| (brdf::render(&model, &t, l, v), error_bound(&model, &t, l, v, POINT_ULPS)))
        .filter(|(value, _)| value[0] > 0.0)
        .map(|(value, bound)| bound[0] / value[0])
        .collect();
    shares.sort_by(f64::total_cmp);
    let [median, ninetieth] = [shares[shares.len() / 2], shares[shares.len() * 9 / 10]];
    println!("relative bound: median {median:.1e}, 90th percentile {ninetieth:.1e}");
    assert!(median < 2e-5);
}

#[needs(adapter)]
#[test]
fn the_comparison_with_f64_goes_red_on_planted_faults() {
    let gpu = gpu();
    let points = points(SEED, 2_000);
    let in_f64 = InF64::new(PRINTED, &points, POINT_ULPS);
    let faulty = |change: fn(&mut Point)| {
        let mut changed = points.clone();
        changed.iter_mut().for_each(change);
        in_f64.compare(&probe(gpu, &PRINTED, &changed))
    };
    faulty(|_| ()).expect("no fault");
    faulty(|(_, l, v)| std::mem::swap(l, v)).expect_err("light and view swapped");
    faulty(|(t, _, _)| t.roughness = t.roughness.sqrt()).expect_err("alpha = r");
    faulty(|(t, _, _)| t.roughness *= 1.0001).expect_err("a roughness slightly off");
    faulty(|(t, _, _)| t.normal.y = -t.normal.y).expect_err("normals +Y down");
    faulty(|(t, _, _)| t.specular.swap(0, 2)).expect_err("channels swapped");
    faulty(|(t, _, _)| t.diffuse[1] *= 1.0001).expect_err("a diffuse albedo slightly off");
    faulty(|(_, _, v)| v[0] += 0.001).expect_err("a view slightly off");
    let got = probe(gpu, &convention::GUIDED_2020, &points);
    in_f64.compare(&got).expect_err("another convention");
}

/// The texels and directions of a rendering, as the f32 CPU path has them.
fn points_of(material: &Material<f32>, scene: &Scene) -> Vec<Point> {
    let (width, height) = (material.width(), material.height());
    let rays = scene.rays::<f32>();
    let point = |index: usize| {
        let c = material.grid().position(index % width, index / width);
        let (w_l, w_v) = rays.from_texel(c);
        (material.texel(index), w_l.to_array(), w_v.to_array())
    };
    (0..width * height).map(point).collect()
}

/// Scenes of both kinds, and lights in a corner, so that no flip or transposition goes unseen.
fn scenes(convention: &Convention) -> Vec<Scene> {
    let corner = Scene { kind: Kind::Near, view: [-0.5, 0.25, 1.5], light: [0.9, 0.8, 0.3] };
    let mut scenes = scene::sample(SEED, 3, 2, convention);
    scenes.push(corner);
    scenes
}

#[needs(f32_adapter)]
#[test]
fn renderings_agree_with_the_cpu_texel_by_texel() {
    let gpu = gpu_f32();
    let mut worst = 0.0_f64;
    for [width, height] in [[33, 33], [64, 40], [17, 50], [1, 5], [5, 1], [1, 1]] {
        let material = bumpy(width, height);
        for convention in convention::ALL {
            for scene in scenes(&convention) {
                let image = gpu.render(&material, &scene, &convention).expect("rendered");
                assert_eq!([image.width, image.height], [width, height]);
                let points = points_of(&material, &scene);
                let held = InF64::new(convention, &points, RENDERING_ULPS)
                    .compare(&image.pixels)
                    .unwrap_or_else(|e| panic!("{width} x {height}, {scene:?}: {e}"));
                worst = worst.max(held.share);
            }
        }
    }
    println!("worst share of the bound {worst:.3}");
}

#[needs(f32_adapter)]
#[test]
fn a_rendering_larger_than_one_band_of_reading_back_is_whole() {
    let gpu = gpu_f32();
    let (width, height) = (1030, 1100);
    let scene = Scene { kind: Kind::Near, view: [0.0, 0.0, 2.0], light: [0.5, 0.2, 0.8] };
    let material = bumpy(width, height);
    let image = gpu.render(&material, &scene, &PRINTED).expect("rendered");
    let points = points_of(&material, &scene);
    InF64::new(PRINTED, &points, RENDERING_ULPS).compare(&image.pixels).unwrap_or_else(|e| panic!("{e}"));
}

#[needs(f32_adapter)]
#[test]
fn the_comparison_of_renderings_goes_red_on_a_flipped_or_transposed_grid() {
    let gpu = gpu_f32();
    let side = 24;
    let scene = Scene { kind: Kind::Near, view: [-0.5, 0.25, 1.5], light: [0.9, 0.8, 0.3] };
    let image = gpu.render(&bumpy(side, side), &scene, &PRINTED).expect("rendered");
    let points = points_of(&bumpy(side, side), &scene);
    let planted = |from: fn(usize, usize, usize) -> usize| {
        let pixels: Vec<[f32; 3]> =
            (0..side * side).map(|i| image.pixels[from(i % side, i / side, side)]).collect();
        InF64::new(PRINTED, &points, RENDERING_ULPS).compare(&pixels)
    };
    planted(|column, row, side| row * side + column).expect("no fault");
    planted(|column, row, side| (side - 1 - row) * side + column).expect_err("rows flipped");
    planted(|column, row, side| row * side + side - 1 - column).expect_err("columns flipped");
    planted(|column, row, side| column * side + row).expect_err("transposed");
    planted(|column, row, side| row * side + (column + 1).min(side - 1)).expect_err("shifted");
}
