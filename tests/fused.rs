//! The fused kernel against the plain loss in f64, at every instruction set that this machine has.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic: that is how it fails")]

mod extremes;
mod golden;
mod pictures;

use svbrdf_core::error::Error;
use svbrdf_core::loss::{Backend, Comparison, Fused, Plain, Request, Sampling};
use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::brdf::Texel;
use svbrdf_core::model::convention::{self, Convention};
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;
use svbrdf_core::render::simd::Level;

use crate::support::losses::losses;
use crate::support::tolerance;

/// Numbers in [0, 1), always the same ones (xorshift).
struct Numbers(u32);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        (self.0 >> 8) as f32 / (1u32 << 24) as f32
    }
}

/// A material of random texels with normals within `tilt` of +z and a roughness in [`least`, 1).
fn random(seed: u32, [width, height]: [usize; 2], tilt: f32, least: f32) -> Material<f32> {
    let mut numbers = Numbers(seed.wrapping_mul(0x9e37_79b9) | 1);
    let mut planes = Planes::default();
    for _ in 0..width * height {
        for axis in 0..2 {
            planes.normal[axis].push((numbers.next() - 0.5) * 2.0 * tilt);
        }
        planes.normal[2].push(1.0);
        for channel in 0..3 {
            planes.diffuse[channel].push(numbers.next());
            planes.specular[channel].push(numbers.next() * numbers.next());
        }
        planes.roughness.push(least + (1.0 - least) * numbers.next() * numbers.next());
    }
    Material::new(format!("random {seed}"), width, height, planes).unwrap()
}

fn uniform(normal: [f32; 3], roughness: f32, diffuse: f32, specular: f32, size: [usize; 2]) -> Material<f32> {
    let texel = Texel {
        normal: normal.into(),
        diffuse: [diffuse; 3],
        specular: [specular, 0.5 * specular, 0.0],
        roughness,
    };
    Material::uniform("uniform", size[0], size[1], &texel).unwrap()
}

fn scenes(near: usize, distant: usize, convention: &Convention) -> Vec<Scene> {
    Sampling { near, distant, seed: 7, ..Sampling::default() }.scenes(convention).unwrap()
}

/// The instruction sets to test; says which ones are missing.
fn levels() -> Vec<(&'static str, Level)> {
    let all = Level::all();
    for (name, level) in &all {
        if level.is_none() {
            eprintln!("NOT TESTED: this machine has no {name}");
        }
    }
    all.into_iter().filter_map(|(name, level)| Some((name, level?))).collect()
}

/// The fused loss with one instruction set.
fn at(level: Level) -> Fused {
    Fused { level: Some(level) }
}

/// (mean, per scene) of the fused loss.
fn fused(
    level: Level,
    gt: &Material<f32>,
    prediction: &Material<f32>,
    scenes: &[Scene],
    c: &Convention,
) -> (f64, Vec<f64>) {
    let loss = losses(&at(level), gt, &[prediction], scenes, c).unwrap().remove(0);
    (loss.estimate.mean, loss.per_scene)
}

/// (mean, per scene) of the plain loss in f64.
fn plain(
    gt: &Material<f32>,
    prediction: &Material<f32>,
    scenes: &[Scene],
    c: &Convention,
) -> (f64, Vec<f64>) {
    let loss = losses::<f64>(&Plain, &gt.cast(), &[&prediction.cast()], scenes, c).unwrap().remove(0);
    (loss.estimate.mean, loss.per_scene)
}

/// The relative error of the loss and the largest one of a scene; an error where they are above the bounds or not numbers.
fn compare(got: &(f64, Vec<f64>), want: &(f64, Vec<f64>), bounds: [f64; 2]) -> Result<[f64; 2], String> {
    let off = |got: f64, want: f64| (got - want).abs() / want.max(tolerance::FUSED_LEAST);
    let mean = off(got.0, want.0);
    let scene = got.1.iter().zip(&want.1).map(|(g, w)| off(*g, *w)).fold(0.0, f64::max);
    let sane = got.1.iter().all(|x| x.is_finite() && *x >= 0.0) && got.1.len() == want.1.len();
    if mean <= bounds[0] && scene <= bounds[1] && sane {
        return Ok([mean, scene]);
    }
    Err(format!("relative error {mean:e} of the loss, {scene:e} of a scene; got {got:?}, want {want:?}"))
}

/// Holds every instruction set against f64, and prints the worst errors.
fn check_all(
    what: &str,
    gt: &Material<f32>,
    prediction: &Material<f32>,
    scenes: &[Scene],
    c: &Convention,
    bounds: [f64; 2],
) {
    let want = plain(gt, prediction, scenes, c);
    for (name, level) in levels() {
        match compare(&fused(level, gt, prediction, scenes, c), &want, bounds) {
            Ok([mean, scene]) => println!("{what}, {}, {name}: loss {mean:.1e}, scene {scene:.1e}", c.name),
            Err(problem) => panic!("{what}, {}, {name}: {problem}", c.name),
        }
    }
}

const BOUNDS: [f64; 2] = [tolerance::FUSED_LOSS, tolerance::FUSED_SCENE];

#[test]
fn random_materials() {
    for c in &convention::ALL {
        for least in [1.0 / 255.0, 0.05] {
            let size = [71, 53];
            let (gt, prediction) = (random(1, size, 0.5, least), random(2, size, 0.5, least));
            check_all(&format!("r >= {least}"), &gt, &prediction, &scenes(12, 6, c), c, BOUNDS);
        }
    }
}

#[test]
fn similar_materials() {
    let c = &convention::PRINTED;
    let gt = random(3, [64, 64], 0.3, 0.1);
    let mut planes = gt.planes().clone();
    planes.roughness.iter_mut().for_each(|r| *r = (*r + 0.01).min(1.0));
    let prediction = Material::new("near", 64, 64, planes).unwrap();
    check_all("similar", &gt, &prediction, &scenes(6, 3, c), c, [tolerance::FUSED_SIMILAR; 2]);
}

#[test]
fn sizes_that_no_vector_divides() {
    let c = &convention::PRINTED;
    for size in [[1, 1], [7, 3], [129, 1], [1, 129], [127, 1], [2049, 1], [45, 91]] {
        let (gt, prediction) = (random(4, size, 0.4, 0.2), random(5, size, 0.4, 0.2));
        let bounds = [tolerance::FUSED_SCENE; 2];
        check_all(&format!("{size:?}"), &gt, &prediction, &scenes(4, 3, c), c, bounds);
    }
}

/// The plain loss, and the fused one at each instruction set.
fn backends() -> Vec<(&'static str, Box<dyn Backend<f32>>)> {
    let plain: Box<dyn Backend<f32>> = Box::new(Plain);
    let fused = levels().into_iter().map(|(name, level)| (name, Box::new(at(level)) as _));
    [("plain", plain)].into_iter().chain(fused).collect()
}

#[test]
fn equal_materials_have_no_loss_and_a_loss_is_symmetric() {
    let c = &convention::PRINTED;
    let (x, y) = (random(9, [130, 7], 0.9, 0.0), random(8, [130, 7], 0.9, 0.0));
    let scenes = scenes(6, 3, c);
    for (name, backend) in backends() {
        let of = |x, y| losses(&*backend, x, &[y], &scenes, c).unwrap().remove(0);
        assert_eq!((of(&x, &x).estimate.mean, of(&x, &x).per_scene), (0.0, vec![0.0; 9]), "{name}");
        assert!(of(&x, &y).estimate.mean > 0.0 && of(&x, &y).per_scene == of(&y, &x).per_scene, "{name}");
    }
}

#[test]
fn threads_change_no_bit() {
    let c = &convention::GUIDED_2020;
    let (gt, prediction) = (random(10, [200, 150], 0.5, 0.0), random(11, [200, 150], 0.5, 0.0));
    let (few, many) = (scenes(4, 2, c), scenes(50, 30, c));
    for (backend, scenes) in [(&Plain as &dyn Backend<f32>, &few), (&at(Level::best()), &many)] {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| losses(backend, &gt, &[&prediction], scenes, c).unwrap())
        };
        let one = with(1);
        for threads in [2, 3, 5] {
            assert_eq!(one, with(threads), "{threads} threads");
        }
    }
}

#[test]
fn batches_change_no_bit() {
    let c = &convention::PRINTED;
    let size = [61, 67];
    let gt = random(12, size, 0.5, 0.0);
    let predictions = [random(13, size, 0.5, 0.0), random(14, size, 0.5, 0.1), gt.clone()];
    let scenes = scenes(70, 20, c);
    for (name, backend) in backends() {
        let of = |predictions: &[_], scenes: &[_]| losses(&*backend, &gt, predictions, scenes, c).unwrap();
        let all: Vec<_> = predictions.iter().collect();
        for (prediction, together) in predictions.iter().zip(of(&all, &scenes)) {
            let alone = of(&[prediction], &scenes).remove(0).per_scene;
            assert_eq!(together.per_scene, alone, "{name}: predictions together and alone");
            let one_by_one = scenes.iter().map(|s| of(&[prediction], &[*s])[0].estimate.mean);
            assert!(one_by_one.eq(alone), "{name}: scenes together and alone");
        }
    }
}

#[test]
fn some_texels_are_a_part_of_all() {
    let c = &convention::PRINTED;
    let size = [67, 41];
    let (gt, prediction) = (random(19, size, 0.5, 0.05), random(20, size, 0.5, 0.05));
    let (scenes, progress) = (scenes(6, 3, c), Progress::default());
    let all: Vec<usize> = (0..67 * 41).collect();
    // Out of order, one twice, no multiple of a vector.
    let some: Vec<usize> = (0..200).map(|i| i * 1009 % (67 * 41)).chain([5, 5, 2746]).collect();
    let mean = |per_scene: Vec<f64>| (per_scene.iter().sum::<f64>() / per_scene.len() as f64, per_scene);
    let [exact_gt, exact_prediction]: [Material<f64>; 2] = [gt.cast(), prediction.cast()];
    let exact = Comparison::new(&exact_gt, &[&exact_prediction], *c).unwrap();
    let want = mean(Plain.scene_losses(&exact, &scenes, Some(&some), &progress).unwrap().remove(0));
    for (name, level) in levels() {
        let of = |texels: &[usize]| {
            let comparison = Comparison::new(&gt, &[&prediction], *c).unwrap();
            mean(at(level).scene_losses(&comparison, &scenes, Some(texels), &progress).unwrap().remove(0))
        };
        assert_eq!(of(&all), fused(level, &gt, &prediction, &scenes, c), "{name}: all of them listed");
        compare(&of(&some), &want, BOUNDS).unwrap();
        assert!(compare(&of(&some[1..]), &want, BOUNDS).is_err(), "{name}: one texel missing");
    }
}

#[test]
fn planted_faults_are_seen() {
    let c = &convention::PRINTED;
    let (gt, prediction) = (random(15, [40, 40], 0.4, 0.1), random(16, [40, 40], 0.4, 0.1));
    let scenes = scenes(6, 3, c);
    let want = plain(&gt, &prediction, &scenes, c);
    let got = |m: &Material<f32>, s: &[Scene], c: &Convention| fused(Level::best(), &gt, m, s, c);
    compare(&got(&prediction, &scenes, c), &want, BOUNDS).unwrap();

    let faulty = |change: fn(&mut Planes<f32>)| {
        let mut planes = prediction.planes().clone();
        change(&mut planes);
        Material::new("faulty", 40, 40, planes).unwrap()
    };
    let faults = [
        faulty(|p| p.normal[1].iter_mut().for_each(|y| *y = -*y)),
        faulty(|p| p.specular.swap(0, 2)),
        faulty(|p| p.roughness[1599] *= 0.5),
        faulty(|p| p.diffuse[1][800] = 0.0),
    ];
    for (i, fault) in faults.iter().enumerate() {
        assert!(compare(&got(fault, &scenes, c), &want, BOUNDS).is_err(), "fault {i}");
    }
    let swapped: Vec<_> = scenes.iter().map(|s| Scene { view: s.light, light: s.view, ..*s }).collect();
    assert!(compare(&got(&prediction, &swapped, c), &want, BOUNDS).is_err(), "light and view swapped");
    for other in &convention::ALL[1..] {
        assert!(compare(&got(&prediction, &scenes, other), &want, BOUNDS).is_err(), "{}", other.name);
    }
    assert!(compare(&(f64::NAN, vec![f64::NAN; 9]), &want, BOUNDS).is_err(), "NaN");
    assert!(compare(&(want.0, want.1[1..].to_vec()), &want, BOUNDS).is_err(), "a scene missing");
}

#[test]
fn what_cannot_be_computed_is_an_error() {
    let c = &convention::PRINTED;
    let (gt, other) = (random(17, [4, 4], 0.1, 0.1), random(18, [4, 5], 0.1, 0.1));
    let progress = Progress::default();
    assert!(matches!(Comparison::new(&gt, &[&other], *c), Err(Error::SizesDiffer { .. })));
    let listed = Request::Listed(scenes(1, 1, c));
    let run = |predictions: &[_], request: &_| {
        Comparison::new(&gt, predictions, *c).unwrap().run(request, &progress).map(|outcome| outcome.losses)
    };
    assert!(matches!(run(&[&gt], &Request::Listed(Vec::new())), Err(Error::SceneCount { count: 0, .. })));
    assert_eq!(run(&[], &listed).unwrap(), []);
    progress.cancel();
    assert!(matches!(run(&[&gt], &listed), Err(Error::Cancelled)));
}
