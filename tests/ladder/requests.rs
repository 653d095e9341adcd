//! The same number everywhere: 20 requests whose losses every machine, instruction set and number of threads gives.
//!
//! Their inputs are made of integers and of +, -, * and /, which are the same to the bit everywhere. The golden numbers are those
//! of [`Plain`] in f64, which `golden_losses` holds against an independent implementation.

use std::sync::LazyLock;

use svbrdf_core::loss::{Backend, Comparison, Compute, Loss, Plain, Request, Sampling, Texels};
use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::convention::{ALL, Convention};
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::progress::Progress;

use super::losses::rungs;
use crate::support::tolerance::{REQUESTS_F32, REQUESTS_F64};

/// One request: materials, scenes, texels and a convention.
struct Case {
    size: [usize; 2],
    /// Greatest slope of the normals.
    tilt: f32,
    least_roughness: f32,
    sampling: Sampling,
    convention: Convention,
}

/// The losses of the cases.
const GOLDEN: [f64; 20] = [
    0.2865152903675635,
    0.3286404841438354,
    0.38745729187298794,
    0.5027352121135901,
    0.26295398999911795,
    0.26289101303823886,
    0.32595959067646696,
    0.5383753930733307,
    0.206417505418492,
    0.49074625612443795,
    0.33953694279825863,
    0.5276916948474613,
    0.21981613508481365,
    0.31200620468042983,
    0.09511171039706359,
    0.4600930141495987,
    0.2628447343267566,
    0.29504869601917105,
    0.31894826591797204,
    0.14183714396893687,
];

/// Numbers in [0, 1) in multiples of 2^-16, always the same ones.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 48) as f32 / 65536.0
    }
}

fn cases() -> Vec<Case> {
    let one = |index: usize| Case {
        size: [[16, 16], [61, 37], [5, 129], [96, 64], [1, 1]][index % 5],
        tilt: [0.0, 0.3, 1.5, 6.0][index % 4],
        least_roughness: [1.0 / 255.0, 0.05, 0.3][index % 3],
        sampling: Sampling {
            near: [6, 0, 16, 9][index % 4],
            distant: [3, 8, 0, 7][index % 4],
            seed: index as u64 * 1_000_003,
            sampler: if index % 7 < 3 { Sampler::Sobol } else { Sampler::Random },
            texels: if index % 6 == 5 { Texels::Sampled(100) } else { Texels::All },
        },
        convention: ALL[index % ALL.len()],
    };
    (0..GOLDEN.len()).map(one).collect()
}

/// A material of this case; the second differs from the first a little everywhere.
fn material(case: &Case, index: usize, number: usize) -> Material<f32> {
    let (mut numbers, mut changes) = (Numbers(index as u64), Numbers(1000 + index as u64));
    let mut near = |value: f32| if number == 0 { value } else { 0.75 * value + 0.25 * changes.next() };
    let mut planes = Planes::default();
    let [width, height] = case.size;
    for _ in 0..width * height {
        for axis in 0..2 {
            planes.normal[axis].push((near(numbers.next()) - 0.5) * 2.0 * case.tilt);
        }
        planes.normal[2].push(1.0);
        for channel in 0..3 {
            planes.diffuse[channel].push(near(numbers.next()));
            planes.specular[channel].push(near(numbers.next() * numbers.next()));
        }
        planes.roughness.push(case.least_roughness + (1.0 - case.least_roughness) * near(numbers.next()));
    }
    Material::new(format!("{number}"), width, height, planes).unwrap()
}

fn materials(case: &Case, index: usize) -> [Material<f32>; 2] {
    [0, 1].map(|number| material(case, index, number))
}

fn loss<T: Compute>(rung: &dyn Backend<T>, [truth, prediction]: [&Material<T>; 2], case: &Case) -> Loss {
    let comparison = Comparison::new(truth, &[prediction], case.convention).unwrap().on(rung);
    let outcome = comparison.run(&Request::Scenes(case.sampling), &Progress::default()).unwrap();
    outcome.losses.into_iter().next().unwrap()
}

/// The losses of all cases in f64, on as many threads as there are.
static IN_F64: LazyLock<Vec<Loss>> = LazyLock::new(|| {
    cases().iter().enumerate().map(|(index, case)| in_f64(&materials(case, index), case)).collect()
});

fn in_f64(materials: &[Material<f32>; 2], case: &Case) -> Loss {
    let exact = materials.each_ref().map(|material| material.cast::<f64>());
    loss(&Plain, exact.each_ref(), case)
}

fn error(got: &Loss, index: usize) -> f64 {
    ((got.estimate.mean - GOLDEN[index]) / GOLDEN[index]).abs()
}

#[test]
fn twenty_requests_give_the_golden_losses_on_every_rung() {
    let (mut worst, rungs) = ([0.0f64; 2], rungs());
    for (index, case) in cases().iter().enumerate() {
        let materials = materials(case, index);
        worst[0] = worst[0].max(error(&IN_F64[index], index));
        for (_, rung) in &rungs {
            worst[1] = worst[1].max(error(&loss(&**rung, materials.each_ref(), case), index));
        }
    }
    println!("worst: {:.1e} in f64, {:.1e} in f32", worst[0], worst[1]);
    assert!(worst[0] <= REQUESTS_F64 && worst[1] <= REQUESTS_F32, "{worst:?}");
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    for (index, case) in cases().iter().enumerate() {
        let materials = materials(case, index);
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| [in_f64(&materials, case), loss(f32::cpu(), materials.each_ref(), case)])
        };
        let expected = [IN_F64[index].clone(), loss(f32::cpu(), materials.each_ref(), case)];
        for threads in [1, 3, 8] {
            assert_eq!(with(threads), expected, "request {index}, {threads} threads");
        }
    }
}

#[test]
fn a_change_of_one_texel_by_a_millionth_is_seen() {
    let (index, cases) = (1, cases());
    let case = &cases[index];
    let [truth, prediction] = materials(case, index);
    let mut planes = prediction.planes().clone();
    planes.roughness[7] *= 1.0 + 1e-6;
    let planted = Material::new("planted", case.size[0], case.size[1], planes).unwrap();
    assert!(error(&in_f64(&[truth, planted], case), index) > REQUESTS_F64);
}
