//! Whole images of the fused kernel against f64, texel by texel, and against the plain ones.

use svbrdf_core::image::Image;
use svbrdf_core::model::brdf::Model;
use svbrdf_core::render::simd::render_at;
use svbrdf_core::render::{render, render_f32};

use super::*;
use crate::support::compare::{Worst, compare_rgb_with};
use crate::support::points::error_bound;
use crate::support::tolerance::FUSED_ULPS;

fn at(level: Level, material: &Material<f32>, scene: &Scene, c: &Convention) -> Image<f32> {
    render_at(level, material, scene, c, &Progress::default()).unwrap()
}

/// Whether every texel is as close to f64 as its condition allows.
fn compare_to_f64(
    image: &Image<f32>,
    material: &Material<f32>,
    scene: &Scene,
    c: &Convention,
) -> Result<Worst, String> {
    let (exact, model, rays) = (material.cast::<f64>(), Model::from(c), scene.rays::<f64>());
    let want = render(&exact, scene, c, &Progress::default()).unwrap();
    let width = material.width();
    let bounds: Vec<_> = (0..want.pixels.len())
        .map(|i| {
            let (w_l, w_v) = rays.from_texel(exact.grid().position(i % width, i / width));
            error_bound(&model, &exact.texel(i), w_l, w_v, FUSED_ULPS)
        })
        .collect();
    assert_eq!((image.width, image.height), (want.width, want.height));
    compare_rgb_with(&image.pixels, &want.pixels, |i, channel, _| bounds[i][channel])
}

fn check(what: &str, material: &Material<f32>, scenes: &[Scene]) {
    for c in &convention::ALL {
        for (name, level) in levels() {
            let mut worst: f64 = 0.0;
            for scene in scenes {
                match compare_to_f64(&at(level, material, scene, c), material, scene, c) {
                    Ok(found) => worst = worst.max(found.share),
                    Err(problem) => panic!("{what}, {}, {name}, {scene:?}: {problem}", c.name),
                }
            }
            println!("{what}, {}, {name}: {worst:.2} of the bound", c.name);
        }
    }
}

/// Sampled scenes, and some with light and view where it matters.
fn all_scenes() -> Vec<Scene> {
    let mut all = scenes(6, 4, &convention::PRINTED);
    let distant = |view, light| Scene { kind: Kind::Distant, view, light };
    let near = |view, light| Scene { kind: Kind::Near, view, light };
    all.extend([
        distant([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]),
        distant([0.6, 0.0, 0.8], [-0.6, 0.0, 0.8]),
        distant([1.0, 0.0, 1e-3], [0.0, 1.0, 1e-6]),
        near([0.0, 0.0, 2.5], [0.4, 0.5, 1.2]),
        near([0.3, 0.2, 1e-3], [0.3, 0.2, 0.01]),
        near([0.0, 0.0, 1e8], [1e8, 0.0, 1e3]),
    ]);
    all
}

#[test]
fn every_texel_of_a_picture_is_as_close_to_f64_as_its_condition_allows() {
    check("random", &random(21, [83, 41], 0.5, 1.0 / 255.0), &all_scenes());
}

#[test]
fn pictures_of_sizes_that_no_vector_divides() {
    for size in [[1, 1], [7, 3], [129, 1], [1, 129], [127, 1], [2049, 1], [45, 91]] {
        check(&format!("{size:?}"), &random(23, size, 0.4, 0.2), &scenes(1, 1, &convention::PRINTED));
    }
}

#[test]
fn threads_change_no_bit_of_a_picture() {
    let material = random(24, [200, 150], 0.5, 0.0);
    let scenes = scenes(1, 1, &convention::PRINTED);
    for (scene, plain) in scenes.iter().flat_map(|scene| [(scene, false), (scene, true)]) {
        let render = if plain { render::<f32> } else { render_f32 };
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let picture = || render(&material, scene, &convention::PRINTED, &Progress::default());
            pool.install(picture).unwrap()
        };
        let one = with(1);
        assert!([2, 3, 5].into_iter().all(|threads| with(threads) == one), "{scene:?}");
    }
}

#[test]
fn faults_planted_in_a_picture_are_seen() {
    let c = &convention::PRINTED;
    let (material, scene) = (random(25, [40, 40], 0.4, 0.1), scenes(1, 0, c)[0]);
    let good = at(Level::best(), &material, &scene, c);
    compare_to_f64(&good, &material, &scene, c).unwrap();
    let planted = |change: fn(&mut Image<f32>)| {
        let mut faulty = good.clone();
        change(&mut faulty);
        compare_to_f64(&faulty, &material, &scene, c).is_err()
    };
    assert!(planted(|image| image.pixels.swap(17, 18)), "two texels swapped");
    assert!(planted(|image| image.pixels[1599][1] += 0.01), "epsilon added");
    assert!(planted(|image| image.pixels[800].swap(0, 2)), "red and blue swapped");
    assert!(planted(|image| image.pixels[3][0] = f32::NAN), "NaN");
    let swapped = Scene { view: scene.light, light: scene.view, ..scene };
    assert!(compare_to_f64(&at(Level::best(), &material, &swapped, c), &material, &scene, c).is_err());
    for other in &convention::ALL[1..] {
        let image = at(Level::best(), &material, &scene, other);
        assert!(compare_to_f64(&image, &material, &scene, c).is_err(), "{}", other.name);
    }
}

#[test]
fn a_picture_that_cannot_be_rendered_is_an_error() {
    let c = &convention::PRINTED;
    let (material, progress) = (random(26, [4, 4], 0.1, 0.1), Progress::default());
    let below = Scene { kind: Kind::Near, view: [0.0, 0.0, 1.0], light: [0.0, 0.0, -1.0] };
    let unusable = render_f32(&material, &below, c, &progress);
    assert!(matches!(unusable, Err(Error::UnusableScene { .. })));
    progress.cancel();
    let cancelled = render_f32(&material, &scenes(1, 0, c)[0], c, &progress);
    assert!(matches!(cancelled, Err(Error::Cancelled)));
}
