//! Whole renderings on each rung in f32, texel by texel, against f64.

use svbrdf_core::error::Error;
use svbrdf_core::image::Image;
use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::Model;
use svbrdf_core::model::convention::{self, Convention, PRINTED};
use svbrdf_core::model::scene::Scene;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::simd::render_at;
use svbrdf_core::render::{render, render_f32};

use super::losses::{SIZES, distant, near, random, scenes};
use super::rungs::levels;
use crate::support::points::error_bound;
use crate::support::tolerance::{RENDERING_ULPS, SIMD_ULPS};

type Render = Box<dyn Fn(&Material<f32>, &Scene, &Convention) -> Image<f32>>;

/// A rung with the ulps of its bound.
struct Rung(&'static str, f64, Render);

/// f32 as it is written, every instruction set, and the adapter where there is one.
fn rungs() -> Vec<Rung> {
    let plain: Render = Box::new(|m, s, c| render(m, s, c, &Progress::default()).unwrap());
    let kernel = |(name, level)| -> Rung {
        Rung(
            name,
            SIMD_ULPS,
            Box::new(move |m, s, c| render_at(level, m, s, c, &Progress::default()).unwrap()),
        )
    };
    let all = [Rung("f32", RENDERING_ULPS, plain)].into_iter().chain(levels().into_iter().map(kernel));
    all.chain(adapter()).collect()
}

#[cfg(feature = "viewer")]
fn adapter() -> Option<Rung> {
    use crate::support::gpu::{gpu_f32, shaded};

    svbrdf_needs::has!(f32_adapter).then(|| {
        let shader: Render = Box::new(|m, s, c| shaded(gpu_f32(), m, s, c).read_back(gpu_f32()).unwrap());
        Rung("WGSL", RENDERING_ULPS, shader)
    })
}

#[cfg(not(feature = "viewer"))]
fn adapter() -> Option<Rung> {
    None
}

/// The largest error as a share of its bound where every texel is as close to f64 as its condition allows; else the texel that is farthest
/// beyond its bound, or one that is no radiance.
fn compare(
    image: &Image<f32>,
    material: &Material<f32>,
    scene: &Scene,
    c: &Convention,
    ulps: f64,
) -> Result<f64, String> {
    let (exact, model, rays) = (material.cast::<f64>(), Model::from(c), scene.rays::<f64>());
    let want = render(&exact, scene, c, &Progress::default()).unwrap();
    let width = material.width();
    assert_eq!((image.width, image.height, image.pixels.len()), (want.width, want.height, want.pixels.len()));
    let (mut worst, mut problem) = (0.0_f64, String::new());
    for (i, (got, want)) in image.pixels.iter().zip(&want.pixels).enumerate() {
        let (w_l, w_v) = rays.from_texel(exact.grid().position(i % width, i / width));
        let bounds = error_bound(&model, &exact.texel(i), w_l, w_v, ulps);
        for ((got, want), bound) in got.iter().map(|&got| f64::from(got)).zip(want).zip(bounds) {
            if !got.is_finite() || got < 0.0 || !want.is_finite() {
                return Err(format!("texel {i}: got {got}, expected {want}"));
            }
            let error = (got - want).abs();
            if error > worst * bound {
                worst = error / bound;
                problem =
                    format!("texel {i}: got {got:e}, expected {want:e}, error {error:e}, bound {bound:e}");
            }
        }
    }
    if worst <= 1.0 { Ok(worst) } else { Err(problem) }
}

fn check(what: &str, material: &Material<f32>, scenes: &[Scene]) {
    for (Rung(name, ulps, render), c) in rungs().iter().flat_map(|rung| convention::ALL.map(|c| (rung, c))) {
        let mut worst: f64 = 0.0;
        for scene in scenes {
            match compare(&render(material, scene, &c), material, scene, &c, *ulps) {
                Ok(share) => worst = worst.max(share),
                Err(problem) => panic!("{what}, {}, {name}, {scene:?}: {problem}", c.name),
            }
        }
        println!("{what}, {}, {name}: {worst:.2} of the bound", c.name);
    }
}

#[test]
fn every_texel_is_as_close_to_f64_as_its_condition_allows() {
    let mut all = scenes(6, 4, &PRINTED);
    all.extend([
        distant([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]),
        distant([0.6, 0.0, 0.8], [-0.6, 0.0, 0.8]),
        distant([1.0, 0.0, 1e-3], [0.0, 1.0, 1e-6]),
        near([0.0, 0.0, 2.5], [0.4, 0.5, 1.2]),
        near([0.3, 0.2, 1e-3], [0.3, 0.2, 0.01]),
        near([0.0, 0.0, 1e8], [1e8, 0.0, 1e3]),
    ]);
    check("random", &random(21, [83, 41], 0.5, 1.0 / 255.0), &all);
    for size in SIZES {
        check(&format!("{size:?}"), &random(23, size, 0.4, 0.2), &scenes(1, 1, &PRINTED));
    }
}

#[test]
fn threads_change_no_bit_of_a_picture() {
    let material = random(24, [200, 150], 0.5, 0.0);
    for (scene, render) in
        scenes(1, 1, &PRINTED).iter().flat_map(|s| [render::<f32>, render_f32].map(|r| (s, r)))
    {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| render(&material, scene, &PRINTED, &Progress::default())).unwrap()
        };
        let one = with(1);
        assert!([2, 5].into_iter().all(|threads| with(threads) == one), "{scene:?}");
    }
}

/// A change of an image of 24 x 24 texels.
type Change = fn(&mut Vec<[f32; 3]>);

const FAULTS: [(&str, Change); 11] = [
    ("two texels swapped", |pixels| pixels.swap(17, 18)),
    ("epsilon added to a texel", |pixels| pixels[575][1] += 0.01),
    ("a wrong channel", |pixels| pixels[300].swap(0, 2)),
    ("NaN", |pixels| pixels[3][0] = f32::NAN),
    ("infinity", |pixels| pixels[3][0] = f32::INFINITY),
    ("negative, though within the bound", |pixels| pixels[3][0] = -1e-30),
    ("a swapped sign", |pixels| pixels[3] = pixels[3].map(|x| -x)),
    ("a factor of 1/4 that is 0.26", |pixels| pixels.iter_mut().flatten().for_each(|x| *x *= 1.04)),
    ("rows flipped", |pixels| *pixels = pixels.chunks(24).rev().flatten().copied().collect()),
    ("columns flipped", |pixels| pixels.chunks_mut(24).for_each(|row| row.reverse())),
    ("transposed", |pixels| *pixels = (0..24 * 24).map(|i| pixels[i % 24 * 24 + i / 24]).collect()),
];

#[test]
fn planted_faults_are_seen_on_every_rung() {
    let (material, scene) = (random(25, [24, 24], 0.4, 0.1), near([-0.5, 0.25, 1.5], [0.9, 0.8, 0.3]));
    let swapped = Scene { view: scene.light, light: scene.view, ..scene };
    for Rung(name, ulps, render) in rungs() {
        let held = |image: &Image<f32>| compare(image, &material, &scene, &PRINTED, ulps);
        let good = render(&material, &scene, &PRINTED);
        held(&good).expect(name);
        for (what, change) in FAULTS {
            let mut faulty = good.clone();
            change(&mut faulty.pixels);
            held(&faulty).expect_err(what);
        }
        held(&render(&material, &swapped, &PRINTED)).expect_err("light and view swapped");
        for other in &convention::ALL[1..] {
            held(&render(&material, &scene, other)).expect_err(other.name);
        }
    }
}

#[test]
fn a_picture_that_cannot_be_rendered_is_an_error() {
    let (material, progress) = (random(26, [4, 4], 0.1, 0.1), Progress::default());
    let unusable = render_f32(&material, &near([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]), &PRINTED, &progress);
    assert!(matches!(unusable, Err(Error::UnusableScene { .. })));
    progress.cancel();
    let cancelled = render_f32(&material, &scenes(1, 0, &PRINTED)[0], &PRINTED, &progress);
    assert!(matches!(cancelled, Err(Error::Cancelled)));
}
