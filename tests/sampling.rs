//! Algorithm 2 and the scenes of Algorithm 1, tested as random numbers and as a function of the seed.

use std::f64::consts::TAU;

use glam::DVec3;
use statrs::distribution::{ContinuousCDF, Normal};

use svbrdf_core::material::Grid;
use svbrdf_core::model::convention::{self, Convention, PRINTED, SINGLE_IMAGE_2018};
use svbrdf_core::model::scene::{Kind, Scene, sample};

use crate::support::tolerance::{CHI_SQUARED_63, GEOMETRY_F64, GOLDEN_SCENES, KOLMOGOROV};

/// Scenes in a test of their distribution.
const COUNT: usize = 20_000;

/// The numbers that a scene is made of, each mapped to what should be uniform in [0, 1].
type Coordinates = Vec<(&'static str, Vec<f64>)>;

/// sin^2 of the polar angle, and the azimuth.
fn cosine_coordinates(w: DVec3, convention: &Convention) -> [f64; 2] {
    let u1 = (1.0 - w.z * w.z - 0.001) / (convention.u1_max - 0.001);
    [u1, (w.y.atan2(w.x) / TAU).rem_euclid(1.0)]
}

/// The cumulative probability of a log-normal distance.
fn distance_coordinate(distance: f64, sigma: f64) -> f64 {
    Normal::new(0.5, sigma).unwrap().cdf(distance.ln())
}

/// P_S, the direction and the distances of a near-field scene, recovered from its view and light alone.
fn near_coordinates(scene: &Scene, convention: &Convention) -> [f64; 6] {
    let raised = |p: [f64; 3]| DVec3::new(p[0], p[1], p[2] - convention.shift_z);
    let (view, light) = (raised(scene.view), raised(scene.light));
    // view = a (wx, wy, wz) + shift, light = b (-wx, -wy, wz) + shift
    let ratio = view.z / light.z;
    let shift = [view.x + ratio * light.x, view.y + ratio * light.y].map(|sum| sum / (1.0 + ratio));
    let w = view - DVec3::new(shift[0], shift[1], 0.0);
    let distance = w.length();
    let [u1, u2] = cosine_coordinates(w.normalize(), convention);
    let light_distance = distance_coordinate(distance / ratio, convention.light_distance_sigma);
    let [x, y] = shift.map(|s| (s + 1.0) / 2.0);
    [x, y, u1, u2, distance_coordinate(distance, 0.75), light_distance]
}

fn distant_coordinates(scene: &Scene, convention: &Convention) -> [f64; 4] {
    let of = |p: [f64; 3]| cosine_coordinates(DVec3::from(p), convention);
    let ([a, b], [c, d]) = (of(scene.view), of(scene.light));
    [a, b, c, d]
}

/// What the scenes drawn in `drawn` look like to someone who believes in `believed`.
fn coordinates(drawn: &Convention, believed: &Convention) -> [Coordinates; 2] {
    let scenes = sample(2026, COUNT, COUNT, drawn);
    let (near, distant) = scenes.split_at(COUNT);
    let near: Vec<_> = near.iter().map(|s| near_coordinates(s, believed)).collect();
    let distant: Vec<_> = distant.iter().map(|s| distant_coordinates(s, believed)).collect();
    let column = |name, i: usize| (name, near.iter().map(|c| c[i]).collect());
    let names = ["P_S.x", "P_S.y", "u1", "u2", "view distance", "light distance"];
    let near = names.into_iter().enumerate().map(|(i, name)| column(name, i)).collect();
    let column = |name, i: usize| (name, distant.iter().map(|c| c[i]).collect());
    let names = ["view u1", "view u2", "light u1", "light u2"];
    [near, names.into_iter().enumerate().map(|(i, name)| column(name, i)).collect()]
}

/// sqrt(n) times the largest distance between the empirical and the uniform distribution; infinite where a value
/// is none of [0, 1], but for rounding.
fn kolmogorov(values: &[f64]) -> f64 {
    if !values.iter().all(|u| (-GEOMETRY_F64..=1.0 + GEOMETRY_F64).contains(u)) {
        return f64::INFINITY;
    }
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len() as f64;
    let distance = |(i, u): (usize, &f64)| (u - i as f64 / n).max((i + 1) as f64 / n - u);
    n.sqrt() * sorted.iter().enumerate().map(distance).fold(0.0, f64::max)
}

/// Chi-squared of pairs over 8 x 8 cells, which all should hold as many.
fn chi_squared(xs: &[f64], ys: &[f64]) -> f64 {
    let cell = |u: f64| ((u * 8.0) as usize).min(7);
    let mut counts = [0.0; 64];
    for (x, y) in xs.iter().zip(ys) {
        counts[8 * cell(*x) + cell(*y)] += 1.0;
    }
    let expected = xs.len() as f64 / 64.0;
    counts.iter().map(|count| (count - expected).powi(2) / expected).sum()
}

/// The most conspicuous of the coordinates.
fn worst_kolmogorov(coordinates: &Coordinates) -> (f64, &'static str) {
    let each = coordinates.iter().map(|(name, values)| (kolmogorov(values), *name));
    each.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
}

#[test]
fn every_coordinate_of_a_scene_is_distributed_as_printed() {
    for convention in &convention::ALL {
        for coordinates in coordinates(convention, convention) {
            let (worst, name) = worst_kolmogorov(&coordinates);
            println!("{}: {worst:.2} at {name}", convention.name);
            assert!(worst < KOLMOGOROV, "{}, {name}: {worst}", convention.name);
        }
    }
}

#[test]
fn the_coordinates_of_a_scene_and_consecutive_scenes_are_independent() {
    let mut worst = 0.0f64;
    for coordinates in coordinates(&PRINTED, &PRINTED) {
        for (i, (first, xs)) in coordinates.iter().enumerate() {
            let pairs = coordinates[..i].iter().map(|(second, ys)| (*second, chi_squared(xs, ys)));
            let next = ("the next scene", chi_squared(&xs[1..], &xs[..COUNT - 1]));
            for (second, chi_squared) in pairs.chain([next]) {
                worst = worst.max(chi_squared);
                assert!(chi_squared < CHI_SQUARED_63, "{first}, {second}: {chi_squared}");
            }
        }
    }
    println!("worst chi-squared {worst:.1}");
}

#[test]
fn a_wrong_distribution_is_seen() {
    let believed = [
        ("light distance", Convention { light_distance_sigma: 0.75, ..PRINTED }),
        ("u1", Convention { u1_max: 0.9, ..PRINTED }),
    ];
    for (name, believed) in believed {
        let (worst, at) = worst_kolmogorov(&coordinates(&PRINTED, &believed)[0]);
        println!("planted fault in {name}: {worst:.1}");
        assert_eq!(at, name);
        assert!(worst > 2.0 * KOLMOGOROV, "{name}: {worst}");
    }
    let [near, _] = coordinates(&PRINTED, &PRINTED);
    let uniform_sine: Vec<f64> = near[2].1.iter().map(|u1| u1.sqrt()).collect();
    assert!(kolmogorov(&uniform_sine) > 2.0 * KOLMOGOROV);
    assert!(kolmogorov(&[f64::NAN]) > KOLMOGOROV && kolmogorov(&[1.5]) > KOLMOGOROV);
}

#[test]
fn dependent_coordinates_are_seen() {
    let [near, _] = coordinates(&PRINTED, &PRINTED);
    let (x, y) = (&near[0].1, &near[1].1);
    let leaning: Vec<f64> = x.iter().zip(y).map(|(x, y)| (0.1 * x + y).rem_euclid(1.0)).collect();
    let mixed: Vec<f64> = x.iter().zip(y).map(|(x, y)| if *y < 0.1 { *x } else { *y }).collect();
    assert!(chi_squared(x, &leaning) < CHI_SQUARED_63, "a rotation by x of a uniform y stays independent");
    assert!(chi_squared(x, &mixed) > 2.0 * CHI_SQUARED_63);
}

#[test]
fn light_and_view_stay_above_the_plane() {
    for convention in &convention::ALL {
        let least_z = (1.0 - convention.u1_max).sqrt();
        for scene in sample(3, 2_000, 2_000, convention) {
            assert_eq!(scene.check(), Ok(()));
            if scene.kind == Kind::Distant {
                assert!(scene.view[2] >= least_z && scene.light[2] >= least_z, "{scene:?}");
                let length = DVec3::from(scene.view).length();
                assert!((length - 1.0).abs() < GEOMETRY_F64, "{length}");
            }
        }
    }
}

#[test]
fn a_longer_draw_begins_with_a_shorter_one() {
    let long = sample(5, 10, 7, &PRINTED);
    assert_eq!(sample(5, 4, 0, &PRINTED), long[..4]);
    assert_eq!(sample(5, 0, 3, &PRINTED), long[10..13]);
    assert_eq!(sample(5, 10, 7, &PRINTED), long);
}

#[test]
fn seeds_and_scenes_differ() {
    let mut scenes: Vec<_> = (0..50).flat_map(|seed| sample(seed, 4, 4, &PRINTED)).collect();
    scenes.extend(sample(u64::MAX, 4, 4, &PRINTED));
    for (i, scene) in scenes.iter().enumerate() {
        assert!(!scenes[..i].contains(scene), "{scene:?} was drawn twice");
    }
}

#[test]
fn conventions_share_what_they_agree_on() {
    let (printed, released) = (sample(1, 1, 1, &PRINTED), sample(1, 1, 1, &SINGLE_IMAGE_2018));
    assert_eq!(printed[1], released[1], "Algorithm 2 is the same in both");
    assert_eq!(printed[0].view[..2], released[0].view[..2]);
    assert_ne!(printed[0].light, released[0].light);
}

/// The first near-field and the first distant scene of a seed: view and light each.
const GOLDEN: [(u64, [[f64; 3]; 4]); 2] = [
    (
        0,
        [
            [3.423239464648395, 1.1253822909476574, 2.297605362508335],
            [-0.9730855587561413, -0.6207175204472627, 1.0636998035049476],
            [-0.06320812310023939, -0.8449873774265221, 0.5310377248030439],
            [0.6362303418908377, -0.39511809114835206, 0.6626406613729271],
        ],
    ),
    (
        42,
        [
            [-0.11832196634178299, 0.40391903650753247, 0.8359708966134263],
            [0.662233849432867, 1.2079789498913422, 0.5174879744557196],
            [0.41159003188347165, 0.71542219974027, 0.5645925272025446],
            [0.3851757300721609, -0.5571816754732962, 0.7356549717633588],
        ],
    ),
];

#[test]
fn a_seed_names_the_same_scenes_for_ever() {
    for (seed, expected) in GOLDEN {
        let scenes = sample(seed, 1, 1, &PRINTED);
        let got: Vec<_> = scenes.iter().flat_map(|s| [s.view, s.light]).collect();
        for (got, expected) in got.as_flattened().iter().zip(expected.as_flattened()) {
            assert!(
                (got - expected).abs() <= GOLDEN_SCENES * expected.abs(),
                "{seed}: {got}, not {expected}"
            );
        }
    }
}

#[test]
fn the_texels_lie_where_linspace_puts_them_and_are_square() {
    let linspace = |count: usize, i: usize| -1.0 + 2.0 * i as f64 / (count - 1) as f64;
    for side in [2, 3, 5, 256, 511] {
        let grid = Grid { width: side, height: side };
        for i in 0..side {
            let [x, y, z] = grid.position::<DVec3>(i, i).to_array();
            let (expected, close) = (linspace(side, i), |a: f64, b: f64| (a - b).abs() <= GEOMETRY_F64);
            assert!(close(x, expected) && close(y, -expected) && z == 0.0, "{side}, {i}: {x}, {y}, {z}");
        }
    }
    let at = |width, height, i, j| Grid { width, height }.position::<DVec3>(i, j).to_array();
    assert_eq!([at(9, 5, 0, 0), at(9, 5, 8, 4)], [[-1.0, 0.5, 0.0], [1.0, -0.5, 0.0]]);
    // One column or row is in the middle.
    assert_eq!((at(1, 1, 0, 0), at(1, 3, 0, 0)[0]), ([0.0; 3], 0.0));
}
