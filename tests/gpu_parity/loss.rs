//! Algorithm 1 on the device against f64 on the CPU.

use std::sync::LazyLock;

use svbrdf_core::error::Error;
use svbrdf_core::loss::{Comparison, Loss, Plain, Request};
use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::convention::{self, Convention, GUIDED_2020, PRINTED};
use svbrdf_core::model::grammar::words::Norm;
use svbrdf_core::model::named_conventions as named;
use svbrdf_core::model::scene::{self, Kind, Scene};
use svbrdf_core::progress::Progress;
use svbrdf_files::samples;
use svbrdf_gpu::GpuLosses;
use svbrdf_needs::needs;

use crate::golden_loss;
use crate::support::gpu::{bumpy, gpu};
use crate::support::losses::losses;
use crate::support::tolerance::{GPU_LOSS, GPU_LOSS_SCENE, GRAMMAR_GPU_LOSS, GRAMMAR_GPU_SQUARE};

/// The loss on the adapter of the tests.
fn on_gpu() -> &'static GpuLosses {
    static LOSSES: LazyLock<GpuLosses> = LazyLock::new(|| GpuLosses::new(gpu()).expect("the loss compiles"));
    &LOSSES
}

fn of(
    ground_truth: &Material<f32>,
    predictions: &[&Material<f32>],
    scenes: &[Scene],
    convention: &Convention,
) -> Vec<Loss> {
    losses(on_gpu(), ground_truth, predictions, scenes, convention).expect("the loss is computed")
}

fn scenes(near: usize, distant: usize, convention: &Convention) -> Vec<Scene> {
    scene::sample(7, near, distant, convention)
}

fn in_f64(
    ground_truth: &Material<f32>,
    predictions: &[&Material<f32>],
    scenes: &[Scene],
    convention: &Convention,
) -> Vec<Loss> {
    let predictions: Vec<Material<f64>> = predictions.iter().map(|p| p.cast()).collect();
    let predictions: Vec<_> = predictions.iter().collect();
    losses(&Plain, &ground_truth.cast(), &predictions, scenes, convention).expect("computed in f64")
}

/// The largest relative errors of a mean and of a scene; an error where one is above its bound.
fn compare(got: &[Loss], mean: f64, per_scene: &[f64]) -> Result<[f64; 2], String> {
    let [got] = got else { return Err(format!("one loss, not {}", got.len())) };
    // 0 must be 0; what is not a number is infinitely wrong.
    let off = |got: f64, want: f64| {
        let off = if got == want { 0.0 } else { (got - want).abs() / want };
        if off.is_nan() { f64::INFINITY } else { off }
    };
    if got.per_scene.len() != per_scene.len() {
        return Err(format!("{} scenes, not {}", got.per_scene.len(), per_scene.len()));
    }
    let scenes = got.per_scene.iter().zip(per_scene).map(|(g, w)| off(*g, *w));
    let worst = [off(got.estimate.mean, mean), scenes.fold(0.0, f64::max)];
    if worst[0] <= GPU_LOSS && worst[1] <= GPU_LOSS_SCENE {
        return Ok(worst);
    }
    Err(format!("relative error {:e} of the loss, {:e} of a scene", worst[0], worst[1]))
}

fn larger(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].max(b[0]), a[1].max(b[1])]
}

#[needs(adapter)]
#[test]
fn losses_of_the_built_in_materials_are_those_of_f64_in_every_convention() {
    let samples = samples::load::<f32>().expect("built in");
    let ground_truth = &samples.ground_truth.material;
    let mut worst = [0.0; 2];
    for convention in convention::ALL {
        let scenes = scenes(3, 2, &convention);
        for prediction in &samples.predictions {
            let prediction = &prediction.material;
            let want = in_f64(ground_truth, &[prediction], &scenes, &convention).remove(0);
            let got = of(ground_truth, &[prediction], &scenes, &convention);
            assert_eq!(got[0].prediction, prediction.name());
            let off = compare(&got, want.estimate.mean, &want.per_scene)
                .unwrap_or_else(|e| panic!("{}, {}: {e}", prediction.name(), convention.name));
            worst = larger(worst, off);
        }
    }
    println!("worst relative errors: loss {:e}, scene {:e}", worst[0], worst[1]);
}

/// The largest relative errors of a mean and of a scene of a convention of the grammar.
fn of_grammar(name: &str) -> [f64; 2] {
    let convention: Convention = name.parse().unwrap();
    let samples = samples::load::<f32>().expect("built in");
    let (ground_truth, prediction) = (&samples.ground_truth.material, &samples.predictions[0].material);
    let scenes = scenes(3, 2, &convention);
    let want = in_f64(ground_truth, &[prediction], &scenes, &convention).remove(0);
    let got = of(ground_truth, &[prediction], &scenes, &convention).remove(0);
    let off = |got: f64, want: f64| (got / want - 1.0).abs();
    let per_scene = got.per_scene.iter().zip(&want.per_scene).map(|(g, w)| off(*g, *w)).fold(0.0, f64::max);
    let mut other = convention;
    other.epsilon *= 1.001;
    if convention.norm() == Norm::LogL1 {
        let faulty = of(ground_truth, &[prediction], &scenes, &other).remove(0);
        assert!(off(faulty.estimate.mean, want.estimate.mean) > GRAMMAR_GPU_LOSS[0], "a planted fault");
    }
    [off(got.estimate.mean, want.estimate.mean), per_scene]
}

#[needs(adapter)]
#[test]
fn losses_in_the_conventions_of_the_grammar_are_those_of_f64() {
    for described in &named::all()[convention::ALL.len()..] {
        let [mean, scene] = of_grammar(&described.name);
        println!("{}: relative errors: loss {mean:.1e}, scene {scene:.1e}", described.name);
        let most = if described.loss.norm == Norm::Mse { GRAMMAR_GPU_SQUARE } else { GRAMMAR_GPU_LOSS };
        assert!(mean < most[0] && scene < most[1], "{}: {mean:e}, {scene:e}", described.name);
    }
}

#[needs(adapter, shared)]
#[test]
fn losses_are_the_golden_ones() {
    let mut worst = [0.0; 2];
    for case in golden_loss::cases() {
        let [ground_truth, prediction] =
            ["ground_truth", "prediction"].map(|key| golden_loss::material::<f32>(&case[key]));
        let scenes: Vec<Scene> = serde_json::from_value(case["scenes"].clone()).expect("scenes");
        for convention in convention::ALL {
            let golden = golden_loss::expected(&case, &convention).unwrap_or_else(|e| panic!("{e}"));
            let got = of(&ground_truth, &[&prediction], &scenes, &convention);
            let off = compare(&got, golden.loss, &golden.per_scene)
                .unwrap_or_else(|e| panic!("{}, {}: {e}", prediction.name(), convention.name));
            worst = larger(worst, off);
        }
    }
    println!("worst relative errors: loss {:e}, scene {:e}", worst[0], worst[1]);
}

/// `bumpy` with another roughness and other colours.
fn changed(width: usize, height: usize) -> Material<f32> {
    let bumpy = bumpy(width, height);
    let Planes { normal, diffuse: [r, g, b], specular, roughness } = bumpy.planes().clone();
    let roughness = roughness.iter().map(|r| 0.1 + 0.8 * r).collect();
    let planes = Planes { normal, diffuse: [b, r, g], specular, roughness };
    Material::new("changed", width, height, planes).expect("valid")
}

#[needs(adapter)]
#[test]
fn odd_sizes_are_summed_to_the_last_texel() {
    // The last two are one texel more than a block, and more than a band.
    for [width, height] in [[1, 1], [7, 3], [3, 7], [129, 1], [1, 129], [17, 241], [1049, 1001]] {
        let (ground_truth, prediction) = (bumpy(width, height), changed(width, height));
        let scenes = scenes(1, 1, &PRINTED);
        let want = in_f64(&ground_truth, &[&prediction], &scenes, &PRINTED).remove(0);
        let got = of(&ground_truth, &[&prediction], &scenes, &PRINTED);
        compare(&got, want.estimate.mean, &want.per_scene)
            .unwrap_or_else(|e| panic!("{width} x {height}: {e}"));
    }
}

#[needs(adapter)]
#[test]
fn equal_materials_have_no_loss_at_all() {
    for convention in convention::ALL {
        let material = bumpy(65, 67);
        let scenes = scenes(4, 3, &convention);
        let loss = of(&material, &[&material], &scenes, &convention).remove(0);
        assert_eq!((loss.estimate.mean, loss.estimate.standard_error), (0.0, Some(0.0)));
        assert!(loss.per_scene.iter().all(|&scene| scene == 0.0));
    }
}

#[needs(adapter)]
#[test]
fn mirrors_and_grazing_lights_have_finite_losses() {
    let uniform = |roughness, specular| {
        let texel = svbrdf_core::model::brdf::Texel {
            normal: glam::Vec3::Z,
            diffuse: [0.0; 3],
            specular: [specular; 3],
            roughness,
        };
        Material::uniform("uniform", 9, 9, &texel).expect("valid")
    };
    let scene = |kind, light| Scene { kind, view: [0.0, 0.0, 1.0], light };
    let scenes = [
        scene(Kind::Near, [0.0, 0.0, 1.0]),
        scene(Kind::Near, [0.9, 0.9, 1e-6]),
        scene(Kind::Distant, [1.0, 0.0, 1e-6]),
    ];
    for [a, b] in [[0.0, 1.0], [0.0, 0.0], [1.0, 0.0]] {
        let (ground_truth, prediction) = (uniform(a, 1.0), uniform(b, 0.5));
        let loss = of(&ground_truth, &[&prediction], &scenes, &PRINTED).remove(0);
        assert!(loss.per_scene.iter().all(|x| x.is_finite() && *x >= 0.0), "{loss:?}");
    }
}

#[needs(adapter)]
#[test]
fn the_same_bits_come_out_every_time() {
    let (ground_truth, prediction) = (bumpy(200, 100), changed(200, 100));
    let scenes = scenes(6, 3, &PRINTED);
    let once = || of(&ground_truth, &[&prediction], &scenes, &PRINTED);
    let first = once();
    assert!((0..5).all(|_| once() == first));
}

#[needs(adapter)]
#[test]
fn several_predictions_have_the_losses_that_each_has_alone() {
    let (ground_truth, other, scenes) = (bumpy(90, 70), changed(90, 70), scenes(3, 2, &PRINTED));
    // More than one pass takes.
    let predictions = [&other, &ground_truth, &other, &other, &ground_truth, &other];
    let together = of(&ground_truth, &predictions, &scenes, &PRINTED);
    assert_eq!(together.len(), predictions.len());
    for (prediction, loss) in predictions.into_iter().zip(&together) {
        let alone = of(&ground_truth, &[prediction], &scenes, &PRINTED);
        assert_eq!(&alone[0], loss);
    }
    assert!(of(&ground_truth, &[], &scenes, &PRINTED).is_empty());
}

#[needs(adapter)]
#[test]
fn many_scenes_have_the_losses_that_each_has_alone() {
    let (ground_truth, prediction) = (bumpy(5, 4), changed(5, 4));
    // More than one step takes.
    let scenes = scenes(2000, 100, &PRINTED);
    let loss = of(&ground_truth, &[&prediction], &scenes, &PRINTED).remove(0);
    for i in [0, 1, 1999, 2000, 2047, 2048, 2099] {
        let alone = of(&ground_truth, &[&prediction], &scenes[i..=i], &PRINTED);
        assert_eq!(alone[0].per_scene, [loss.per_scene[i]], "scene {i}");
    }
}

#[needs(adapter)]
#[test]
fn a_cancelled_loss_ends_at_its_next_step() {
    let (ground_truth, prediction) = (bumpy(8, 8), changed(8, 8));
    let scenes = scenes(6000, 0, &PRINTED);
    let progress = Progress::default();
    let comparison = Comparison::new(&ground_truth, &[&prediction], PRINTED).expect("of one size");
    let comparison = comparison.on(on_gpu());
    let run = || comparison.run(&Request::Listed(scenes.clone()), &progress);
    run().expect("not cancelled yet");
    let (done, total) = progress.counts();
    assert!(done == total && total > 2, "{done} of {total}");
    progress.cancel();
    assert!(matches!(run(), Err(Error::Cancelled)));
    assert_eq!(progress.counts().0, 1);
}

#[needs(adapter)]
#[test]
fn what_cannot_be_computed_is_refused_as_on_the_cpu() {
    let (material, other) = (bumpy(8, 8), bumpy(8, 9));
    let refused = |prediction, scenes: &[Scene]| {
        losses(on_gpu(), &material, &[prediction], scenes, &PRINTED).expect_err("refused")
    };
    let fine = scenes(1, 0, &PRINTED);
    let below = Scene { light: [0.0, 0.0, -1.0], ..fine[0] };
    assert!(matches!(refused(&other, &fine), Error::SizesDiffer { .. }));
    assert!(matches!(refused(&material, &[below]), Error::UnusableScene { .. }));
    assert!(matches!(refused(&material, &[]), Error::SceneCount { .. }));
}

#[needs(adapter)]
#[test]
fn the_comparison_of_losses_goes_red_on_planted_faults() {
    let (ground_truth, prediction) = (bumpy(64, 48), changed(64, 48));
    let scenes = scenes(3, 2, &PRINTED);
    let want = in_f64(&ground_truth, &[&prediction], &scenes, &PRINTED).remove(0);
    let against = |gt: &Material<f32>, prediction: &Material<f32>, scenes: &[Scene], convention| {
        let got = of(gt, &[prediction], scenes, convention);
        compare(&got, want.estimate.mean, &want.per_scene)
    };
    let faulty = |change: fn(&mut Planes<f32>)| {
        let mut planes = prediction.planes().clone();
        change(&mut planes);
        let faulty = Material::new("faulty", 64, 48, planes).expect("valid");
        against(&ground_truth, &faulty, &scenes, &PRINTED)
    };
    faulty(|_| ()).expect("no fault");
    faulty(|p| p.roughness.swap(100, 2000)).expect_err("two texels swapped");
    faulty(|p| p.roughness.iter_mut().for_each(|r| *r *= 1.001)).expect_err("a roughness slightly off");
    faulty(|p| p.normal[1].iter_mut().for_each(|y| *y = -*y)).expect_err("normals +Y down");
    faulty(|p| p.diffuse.swap(0, 1)).expect_err("channels swapped");
    faulty(|p| p.diffuse[2][64 * 48 - 1] = 0.0).expect_err("the last texel off");
    against(&prediction, &prediction, &scenes, &PRINTED).expect_err("the wrong ground truth");
    against(&ground_truth, &prediction, &scenes[1..], &PRINTED).expect_err("a scene missing");
    against(&ground_truth, &prediction, &scenes, &GUIDED_2020).expect_err("another convention");
    let mut swapped = scenes.clone();
    swapped.swap(0, 1);
    against(&ground_truth, &prediction, &swapped, &PRINTED).expect_err("scenes swapped");
}
