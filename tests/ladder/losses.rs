//! Losses on each rung: in f32 as it is written and by the kernel at every instruction set, against f64.

use svbrdf_core::error::Error;
use svbrdf_core::loss::{Backend, Comparison, Fused, Plain, Request, Sampling};
use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::brdf::Texel;
use svbrdf_core::model::convention::{self, Convention, GUIDED_2020, PRINTED};
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;

use super::rungs::levels;
use crate::support::losses::losses;
use crate::support::tolerance::{
    LOSS_EXTREME, LOSS_LEAST, LOSS_PEAK, LOSS_RANDOM, LOSS_SIMILAR, LOSS_SMALL, LOSS_SUM_F64,
};

/// Numbers in [0, 1), always the same ones (xorshift).
pub struct Numbers(u32);

impl Numbers {
    pub fn of(seed: u32) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9) | 1)
    }

    pub fn next(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        (self.0 >> 8) as f32 / (1u32 << 24) as f32
    }
}

/// A material of random texels with normals within `tilt` of +z and a roughness in [`least`, 1).
pub fn random(seed: u32, [width, height]: [usize; 2], tilt: f32, least: f32) -> Material<f32> {
    let mut numbers = Numbers::of(seed);
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

fn uniform(normal: [f32; 3], roughness: f32, diffuse: f32, specular: f32) -> Material<f32> {
    let specular = [specular, 0.5 * specular, 0.0];
    let texel = Texel { normal: normal.into(), diffuse: [diffuse; 3], specular, roughness };
    Material::uniform("uniform", 9, 9, &texel).unwrap()
}

/// The material with other planes.
fn changed(material: &Material<f32>, change: impl Fn(&mut Planes<f32>)) -> Material<f32> {
    let mut planes = material.planes().clone();
    change(&mut planes);
    Material::new("changed", material.width(), material.height(), planes).unwrap()
}

pub fn scenes(near: usize, distant: usize, convention: &Convention) -> Vec<Scene> {
    Sampling { near, distant, seed: 7, ..Sampling::default() }.scenes(convention).unwrap()
}

pub fn distant(view: [f64; 3], light: [f64; 3]) -> Scene {
    Scene { kind: Kind::Distant, view, light }
}

pub fn near(view: [f64; 3], light: [f64; 3]) -> Scene {
    Scene { kind: Kind::Near, view, light }
}

/// The rungs in f32.
pub fn rungs() -> Vec<(&'static str, Box<dyn Backend<f32>>)> {
    let plain: Box<dyn Backend<f32>> = Box::new(Plain);
    let kernel =
        levels().into_iter().map(|(name, level)| (name, Box::new(Fused { level: Some(level) }) as _));
    [("f32", plain)].into_iter().chain(kernel).collect()
}

/// The relative error of a loss and the largest one of a scene; an error where they are above the bounds or not numbers.
pub fn compare(got: &[f64], want: &[f64], bounds: [f64; 2]) -> Result<[f64; 2], String> {
    let mean = |of: &[f64]| of.iter().sum::<f64>() / of.len() as f64;
    let off = |got: f64, want: f64| (got - want).abs() / want.max(LOSS_LEAST);
    let of_mean = off(mean(got), mean(want));
    let of_scene = got.iter().zip(want).map(|(g, w)| off(*g, *w)).fold(0.0, f64::max);
    let is_sane = got.iter().all(|x| x.is_finite() && *x >= 0.0) && got.len() == want.len();
    if of_mean <= bounds[0] && of_scene <= bounds[1] && is_sane {
        return Ok([of_mean, of_scene]);
    }
    Err(format!(
        "relative error {of_mean:e} of the loss, {of_scene:e} of a scene; got {got:?}, want {want:?}"
    ))
}

/// The loss of each scene in f64.
fn in_f64([a, b]: [&Material<f32>; 2], scenes: &[Scene], c: &Convention) -> Vec<f64> {
    losses::<f64>(&Plain, &a.cast(), &[&b.cast()], scenes, c).unwrap().remove(0).per_scene
}

fn on(rung: &dyn Backend<f32>, [a, b]: [&Material<f32>; 2], scenes: &[Scene], c: &Convention) -> Vec<f64> {
    losses(rung, a, &[b], scenes, c).unwrap().remove(0).per_scene
}

/// Materials, scenes and a convention, and the bounds of the relative errors of the loss and of a scene.
struct Case {
    what: String,
    pair: [Material<f32>; 2],
    scenes: Vec<Scene>,
    convention: Convention,
    bounds: [f64; 2],
}

fn cases() -> Vec<Case> {
    let mut all = Vec::new();
    let mut case = |what: String, pair, scenes, convention, bounds| {
        all.push(Case { what, pair, scenes, convention, bounds });
    };
    let up = [0.0, 0.0, 1.0];
    let size = [9, 9];
    for c in convention::ALL {
        for least in [1.0 / 255.0, 0.05] {
            let pair = [1, 2].map(|seed| random(seed, [71, 53], 0.5, least));
            case(format!("r >= {least}"), pair, scenes(12, 6, &c), c, LOSS_RANDOM);
        }
        // Normals within four widths a = r^2 of the half vector.
        let smooth = |seed| changed(&random(seed, [256, 64], 6e-5, 0.0), |p| p.roughness.fill(1.0 / 255.0));
        let peaks = vec![distant(up, up), distant([0.6, 0.0, 0.8], [-0.6, 0.0, 0.8])];
        case("peak".into(), [smooth(6), smooth(7)], peaks, c, LOSS_PEAK);
        let extreme = [
            distant(up, up),
            distant([0.6, 0.0, 0.8], [-0.6, 0.0, 0.8]),
            distant([1.0, 0.0, 1e-3], [0.0, 1.0, 1e-6]),
            distant([1.0, 0.0, 1e-3], [0.0, 1.0, 2e-9]),
            near(up, [0.3, 0.2, 1e-6]),
            near([0.0, 0.0, 1e8], [1e8, 0.0, 1e3]),
            near([-0.3, 0.1, 0.01], [0.3, 0.2, 0.01]),
        ];
        for (what, other) in [
            ("mirror", uniform([0.0, 0.0, 1.0], 0.0, 0.0, 1.0)),
            ("black", uniform([0.0, 0.0, 1.0], 0.0, 0.0, 0.0)),
            ("white", uniform([0.0, 0.0, 1.0], 1.0, 1.0, 0.0)),
            ("grazing", uniform([1.0, 0.0, 1e-3], 0.0, 1.0, 1.0)),
            ("in the plane", uniform([1.0, 0.0, 1e-9], 0.0, 1.0, 1.0)),
            ("from behind", uniform([0.0, 0.0, -1.0], 0.3, 1.0, 1.0)),
        ] {
            let rough = uniform([0.0, 0.0, 1.0], 0.5, 0.5, 0.5);
            case(what.into(), [rough, other], extreme.to_vec(), c, LOSS_EXTREME);
        }
        // Ill-conditioned: finite and not negative is all that can be asked.
        let mut hard: Vec<_> =
            [1e-3, 1e-5, 1e-7, 2e-9].map(|z| distant([1.0, 0.0, z], [-1.0, 0.0, z])).to_vec();
        hard.extend([1e-3, 1e-7, 1e-9, 1e-18, 1e9].map(|z| near([0.0, 0.0, z], [0.0, 0.0, z])));
        let mirror = uniform([0.0, 0.0, 1.0], 0.0, 1.0, 1.0);
        case(
            "opposite and touching".into(),
            [random(8, size, 0.9, 0.0), mirror],
            hard,
            c,
            [f64::INFINITY; 2],
        );
    }
    let gt = random(3, [64, 64], 0.3, 0.1);
    let rougher = changed(&gt, |p| p.roughness.iter_mut().for_each(|r| *r = (*r + 0.01).min(1.0)));
    case("similar".into(), [gt, rougher], scenes(6, 3, &PRINTED), PRINTED, LOSS_SIMILAR);
    for size in SIZES {
        let pair = [4, 5].map(|seed| random(seed, size, 0.4, 0.2));
        case(format!("{size:?}"), pair, scenes(4, 3, &PRINTED), PRINTED, LOSS_SMALL);
    }
    all
}

/// Sizes that no vector divides.
pub const SIZES: [[usize; 2]; 7] = [[1, 1], [7, 3], [129, 1], [1, 129], [127, 1], [2049, 1], [45, 91]];

#[test]
fn every_rung_is_as_close_to_f64_as_its_case_allows() {
    let rungs = rungs();
    for Case { what, pair, scenes, convention: c, bounds } in cases() {
        let pair = pair.each_ref();
        let want = in_f64(pair, &scenes, &c);
        for (name, rung) in &rungs {
            match compare(&on(&**rung, pair, &scenes, &c), &want, bounds) {
                Ok([mean, scene]) => {
                    println!("{what}, {}, {name}: loss {mean:.1e}, scene {scene:.1e}", c.name)
                }
                Err(problem) => panic!("{what}, {}, {name}: {problem}", c.name),
            }
        }
    }
}

#[test]
fn planted_faults_are_seen_on_every_rung() {
    let pair = [15, 16].map(|seed| random(seed, [40, 40], 0.4, 0.1));
    let [gt, prediction] = pair.each_ref();
    let scenes = scenes(6, 3, &PRINTED);
    let want = in_f64([gt, prediction], &scenes, &PRINTED);
    let swapped: Vec<_> = scenes.iter().map(|s| Scene { view: s.light, light: s.view, ..*s }).collect();
    let faults = [
        ("a swapped sign", changed(prediction, |p| p.normal[1].iter_mut().for_each(|y| *y = -*y))),
        ("a wrong channel", changed(prediction, |p| p.specular.swap(0, 2))),
        ("one wrong roughness", changed(prediction, |p| p.roughness[1599] *= 0.5)),
        ("one wrong pixel", changed(prediction, |p| p.diffuse[1][800] = 0.0)),
    ];
    for (name, rung) in rungs() {
        let held = |b: &Material<f32>, scenes: &[Scene], c: &Convention| {
            compare(&on(&*rung, [gt, b], scenes, c), &want, LOSS_RANDOM)
        };
        held(prediction, &scenes, &PRINTED).expect(name);
        for (what, fault) in &faults {
            held(fault, &scenes, &PRINTED).expect_err(what);
        }
        held(prediction, &swapped, &PRINTED).expect_err("light and view swapped");
        for other in &convention::ALL[1..] {
            held(prediction, &scenes, other).expect_err(other.name);
        }
    }
    compare(&[f64::NAN; 9], &want, LOSS_RANDOM).expect_err("NaN");
    compare(&want[1..], &want, LOSS_RANDOM).expect_err("a scene missing");
}

/// The sum over texels and channels, written out.
#[test]
fn a_loss_in_f64_is_the_mean_of_the_logarithms_of_its_renderings() {
    for size in SIZES {
        let pair = [9, 10].map(|seed| random(seed, size, 0.5, 0.0).cast::<f64>());
        let scene = near([0.1, 0.2, 2.0], [-0.5, 0.4, 1.5]);
        let [a, b] = pair.each_ref().map(|material| {
            let image =
                svbrdf_core::render::render(material, &scene, &PRINTED, &Progress::default()).unwrap();
            assert_eq!([image.width, image.height], size);
            image.pixels.into_iter().flatten().map(|r| (r + PRINTED.epsilon).ln()).collect::<Vec<_>>()
        });
        let sum: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).abs()).sum();
        let got = losses(&Plain, &pair[0], &[&pair[1]], &[scene], &PRINTED).unwrap()[0].estimate.mean;
        let expected = sum / a.len() as f64;
        assert!((got - expected).abs() <= LOSS_SUM_F64 * expected, "{size:?}");
    }
}

#[test]
fn equal_materials_have_no_loss_and_a_loss_is_symmetric() {
    let (x, y) = (random(9, [130, 7], 0.9, 0.0), random(8, [130, 7], 0.9, 0.0));
    let scenes = scenes(6, 3, &PRINTED);
    for (name, rung) in rungs() {
        let of = |x, y| on(&*rung, [x, y], &scenes, &PRINTED);
        assert_eq!(of(&x, &x), [0.0; 9], "{name}");
        assert!(of(&x, &y)[0] > 0.0 && of(&x, &y) == of(&y, &x), "{name}");
    }
}

#[test]
fn neither_threads_nor_batches_change_a_bit() {
    let gt = random(12, [200, 150], 0.5, 0.0);
    let predictions = [random(13, [200, 150], 0.5, 0.0), random(14, [200, 150], 0.5, 0.1), gt.clone()];
    let scenes = scenes(50, 30, &GUIDED_2020);
    for (name, rung) in rungs() {
        // The plain rung takes long.
        let scenes = if name == "f32" { &scenes[47..53] } else { &scenes };
        let of =
            |predictions: &[_], scenes: &[_]| losses(&*rung, &gt, predictions, scenes, &GUIDED_2020).unwrap();
        let all: Vec<_> = predictions.iter().collect();
        let together = of(&all, scenes);
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            assert_eq!(pool.install(|| of(&all, scenes)), together, "{name}, {threads} threads");
        }
        for (prediction, together) in predictions.iter().zip(together) {
            let alone = of(&[prediction], scenes).remove(0).per_scene;
            assert_eq!(together.per_scene, alone, "{name}: predictions together and alone");
            let one_by_one = scenes.iter().step_by(9).map(|s| of(&[prediction], &[*s])[0].estimate.mean);
            assert!(one_by_one.eq(alone.into_iter().step_by(9)), "{name}: scenes together and alone");
        }
    }
}

#[test]
fn some_texels_are_a_part_of_all() {
    let pair = [19, 20].map(|seed| random(seed, [67, 41], 0.5, 0.05));
    let exact = pair.each_ref().map(|material| material.cast::<f64>());
    let (scenes, progress) = (scenes(6, 3, &PRINTED), Progress::default());
    let all: Vec<usize> = (0..67 * 41).collect();
    // Out of order, one twice, no multiple of a vector.
    let some: Vec<usize> = (0..200).map(|i| i * 1009 % (67 * 41)).chain([5, 5, 2746]).collect();
    let exact = Comparison::new(&exact[0], &[&exact[1]], PRINTED).unwrap();
    let want = Plain.scene_losses(&exact, &scenes, Some(&some), &progress).unwrap().remove(0);
    for (name, rung) in rungs() {
        let of = |texels: &[usize]| {
            let comparison = Comparison::new(&pair[0], &[&pair[1]], PRINTED).unwrap();
            rung.scene_losses(&comparison, &scenes, Some(texels), &progress).unwrap().remove(0)
        };
        assert_eq!(of(&all), on(&*rung, pair.each_ref(), &scenes, &PRINTED), "{name}: all of them listed");
        compare(&of(&some), &want, LOSS_RANDOM).expect(name);
        compare(&of(&some[1..]), &want, LOSS_RANDOM).expect_err("one texel missing");
    }
}

#[test]
fn what_cannot_be_computed_is_an_error() {
    let (gt, other) = (random(17, [4, 4], 0.1, 0.1), random(18, [4, 5], 0.1, 0.1));
    let progress = Progress::default();
    assert!(matches!(Comparison::new(&gt, &[&other], PRINTED), Err(Error::SizesDiffer { .. })));
    let listed = Request::Listed(scenes(1, 1, &PRINTED));
    let run = |predictions: &[_], request: &_| {
        Comparison::new(&gt, predictions, PRINTED)
            .unwrap()
            .run(request, &progress)
            .map(|outcome| outcome.losses)
    };
    assert!(matches!(run(&[&gt], &Request::Listed(Vec::new())), Err(Error::SceneCount { count: 0, .. })));
    assert_eq!(run(&[], &listed).unwrap(), []);
    progress.cancel();
    assert!(matches!(run(&[&gt], &listed), Err(Error::Cancelled)));
}
