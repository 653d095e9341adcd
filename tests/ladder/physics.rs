//! Physical properties of any material, light and view: reciprocity, bounds, limits, a distribution that is normalized.

use glam::DVec3;

use svbrdf_core::loss::Plain;
use svbrdf_core::material::Material;
use svbrdf_core::math::real::{Real, Vec3, Vector as _};
use svbrdf_core::model::brdf::{self, Model, Texel};
use svbrdf_core::model::convention::{self, Convention, GUIDED_2020, PRINTED};
use svbrdf_core::model::scene::{Kind, Scene, sample};
use svbrdf_core::progress::Progress;
use svbrdf_core::render::simd::{Level, render_at};

use super::losses::{Numbers, random};
use super::rungs::levels;
use crate::support::losses::losses;
use crate::support::tolerance::{NORMALIZATION, RECIPROCITY};

/// A unit vector at least `least_z` above the plane.
fn direction(numbers: &mut Numbers, least_z: f64) -> DVec3 {
    let z = least_z + (1.0 - least_z) * f64::from(numbers.next());
    let phi = std::f64::consts::TAU * f64::from(numbers.next());
    let rho = (1.0 - z * z).sqrt();
    DVec3::new(rho * phi.cos(), rho * phi.sin(), z)
}

/// The worst relative change, in units of u, of what `reflected` gives when light and view are swapped.
fn asymmetry<T: Real>(reflected: impl Fn(&Texel<T>, Vec3<T>, Vec3<T>) -> [T; 3]) -> f64 {
    let mut numbers = Numbers::of(1);
    let mut worst = 0.0f64;
    for _ in 0..20_000 {
        let normal = direction(&mut numbers, 0.3).cast();
        let mut number = || T::of(f64::from(numbers.next()));
        let mut color = || [number(), number(), number()];
        let (diffuse, specular) = (color(), color());
        let texel = Texel { normal, diffuse, specular, roughness: number() };
        let [l, v] = [(); 2].map(|()| direction(&mut numbers, 0.01).cast::<Vec3<T>>());
        for (there, back) in reflected(&texel, l, v).into_iter().zip(reflected(&texel, v, l)) {
            let (there, back) = (there.f64(), back.f64());
            worst = worst.max((there - back).abs() / there.max(back));
        }
    }
    worst / (T::epsilon().f64() / 2.0)
}

#[test]
fn swapping_light_and_view_changes_the_rendering_but_not_the_reflectance() {
    let (double, single) = (Model::<f64>::from(&PRINTED), Model::<f32>::from(&PRINTED));
    let f64s = asymmetry(|texel, l, v| brdf::reflectance(&double, texel, l, v));
    let f32s = asymmetry(|texel, l, v| brdf::reflectance(&single, texel, l, v));
    println!("reciprocity: worst {f64s:.1} u in f64, {f32s:.1} u in f32");
    assert!(f64s <= RECIPROCITY && f32s <= RECIPROCITY);
    assert!(asymmetry(|texel, l, v| brdf::render(&double, texel, l, v)) > RECIPROCITY);
}

#[test]
fn the_length_of_a_direction_does_not_matter_or_is_refused() {
    let [material, prediction] = [3, 4].map(|seed| random(seed, [3, 3], 0.5, 0.1).cast::<f64>());
    let (view, light) = (DVec3::new(0.6, 0.0, 0.8), DVec3::new(-0.36, 0.48, 0.8));
    let loss = |length: f64| {
        let scaled = |direction: DVec3| (length * direction).to_array();
        let scene = Scene { kind: Kind::Distant, view: scaled(view), light: scaled(light) };
        let losses = losses(&Plain, &material, &[&prediction], &[scene], &PRINTED);
        losses.map(|losses| losses[0].estimate.mean).map_err(|error| error.to_string())
    };
    let unit = loss(1.0).unwrap();
    for length in [1e9, 1e3, 1e-18, 1e-100, 1e-150, 1e-153] {
        assert!((loss(length).unwrap() / unit - 1.0).abs() < 1e-12, "{length:e}");
    }
    for length in [1e-154, 1e-162, 1e-200, 1e-320] {
        assert!(loss(length).is_err_and(|error| error.contains("too short for a direction")), "{length:e}");
    }
}

/// Lower and farther lights and views than those of the table of extremes.
#[test]
fn heights_near_0_and_great_distances_stay_finite_and_never_turn_negative_in_f32() {
    let heights = [1e-30, 1e-12, 1e-6, 1e-3, 0.5, 1.0_f32];
    let sides = [[1.0, 0.0], [-1.0, 0.0], [-0.6, 0.8_f32]];
    let along =
        sides.iter().flat_map(|[x, y]| heights.map(|z| glam::Vec3::new(x * (1.0 - z), y * (1.0 - z), z)));
    let directions: Vec<glam::Vec3> =
        along.flat_map(|w| [1e-3, 1.0, 1e9_f32].map(|length| w * length)).collect();
    let normals = [[0.0, 0.0, 1.0], [1.0, 0.0, 1e-3], [0.6, 0.0, -0.8], [-0.6, 0.64, 0.48_f32]];
    for (convention, normal) in convention::ALL.iter().flat_map(|c| normals.map(|n| (c, n))) {
        let model = Model::<f32>::from(convention);
        let normal = glam::Vec3::from(normal).normalize();
        for (roughness, [d, s]) in [0.0, 1e-6, 1e-4, 1.0 / 255.0, 1.0]
            .iter()
            .flat_map(|r| [[0.0, 1.0], [1.0, 0.0]].map(|ds| (*r, ds)))
        {
            let texel = Texel { normal, diffuse: [d; 3], specular: [s; 3], roughness };
            for (l, v) in directions.iter().flat_map(|l| directions.iter().map(move |v| (*l, *v))) {
                let radiance = brdf::render(&model, &texel, l, v);
                let is_fine = radiance.iter().all(|x| x.is_finite() && *x >= 0.0);
                assert!(is_fine, "{}: {texel:?}, l {l:?}, v {v:?} give {radiance:?}", convention.name);
            }
        }
    }
}

#[test]
fn the_loss_grows_with_the_perturbation_of_each_map() {
    let [truth, other] = [5, 6].map(|seed| random(seed, [24, 24], 0.5, 0.05).cast::<f64>());
    for map in 0..4 {
        let perturbed = [0.01, 0.02, 0.05, 0.1, 0.2, 0.4].map(|t| {
            let mix = |a: &mut Vec<f64>, b: &[f64]| a.iter_mut().zip(b).for_each(|(a, b)| *a += (b - *a) * t);
            let (mut planes, b) = (truth.planes().clone(), other.planes());
            let three =
                |a: &mut [Vec<f64>; 3], b: &[Vec<f64>; 3]| a.iter_mut().zip(b).for_each(|(a, b)| mix(a, b));
            match map {
                0 => three(&mut planes.normal, &b.normal),
                1 => three(&mut planes.diffuse, &b.diffuse),
                2 => three(&mut planes.specular, &b.specular),
                _ => mix(&mut planes.roughness, &b.roughness),
            }
            Material::new("perturbed", 24, 24, planes).unwrap()
        });
        let scenes = sample(7, 4, 2, &PRINTED);
        let losses = losses(&Plain, &truth, &perturbed.each_ref(), &scenes, &PRINTED).unwrap();
        let means: Vec<f64> = losses.iter().map(|loss| loss.estimate.mean).collect();
        assert!(means[0] > 0.0 && means.is_sorted_by(|a, b| a < b), "map {map}: {means:?}");
    }
}

/// From the roughest surface to the floor of `printed`.
const ROUGHNESS: [f64; 9] = [1.0, 0.7, 0.5, 0.2, 0.1, 0.03, 0.01, 1e-3, 1e-4];

/// The integral of D(n.h) (n.h) over the hemisphere of h, for half vectors in a plane through the normal z.
///
/// With u = ln tan(theta), the measure cos(theta) dh is 2 pi sin^2(theta) cos^2(theta) du. The trapezoid rule converges exponentially.
fn integral(roughness: f64, d: impl Fn(DVec3) -> f64) -> f64 {
    /// Step of u; the integrand falls as the square of exp(-|u - its centre|): beyond this reach, below 1e-8 of its maximum.
    const STEP: f64 = 0.25;
    const REACH: f64 = 10.0;
    let width = (roughness * roughness).ln();
    let count = ((2.0 * REACH - width) / STEP).ceil() as usize;
    let node = |i: usize| {
        let t = (width - REACH + STEP * i as f64).exp();
        let cosine = 1.0 / t.hypot(1.0);
        let sine = t * cosine;
        STEP * std::f64::consts::TAU * (sine * cosine).powi(2) * d(DVec3::new(sine, 0.0, cosine))
    };
    (0..count).map(node).sum()
}

/// The largest distance of an integral from 1, over all roughnesses.
fn worst(d: impl Fn(f64, DVec3) -> f64) -> f64 {
    let off = ROUGHNESS.into_iter().map(|r| (integral(r, |h| d(r, h)) - 1.0).abs());
    off.fold(0.0, |worst, off| if off.is_nan() { f64::INFINITY } else { worst.max(off) })
}

fn as_written<T: Real>(convention: &Convention, roughness: f64, h: DVec3) -> f64 {
    let a = T::of(roughness) * T::of(roughness);
    brdf::distribution(&Model::from(convention), DVec3::Z.cast(), h.cast(), a).f64()
}

/// D from the radiance of a texel whose reflectance at l = v = h is G D / 4: F is 1, and nothing is diffuse.
fn simd(level: Level, roughness: f64, h: DVec3) -> f64 {
    let white =
        Texel { normal: glam::Vec3::Z, diffuse: [0.0; 3], specular: [1.0; 3], roughness: roughness as f32 };
    let material = Material::uniform("white", 1, 1, &white).unwrap();
    let scene = Scene { kind: Kind::Distant, view: h.to_array(), light: h.to_array() };
    let image = render_at(level, &material, &scene, &PRINTED, &Progress::default()).unwrap();
    let k = 0.5 * roughness * roughness;
    let g = 1.0 / (h.z * (1.0 - k) + k);
    4.0 * f64::from(image.pixels[0][0]) / (g * g)
}

#[test]
fn the_distribution_integrates_to_1() {
    let mut all = vec![
        ("f64", worst(|r, h| as_written::<f64>(&PRINTED, r, h))),
        ("f32", worst(|r, h| as_written::<f32>(&PRINTED, r, h))),
    ];
    all.extend(levels().into_iter().map(|(name, level)| (name, worst(|r, h| simd(level, r, h)))));
    println!("D is off by {all:?}");
    assert!(all.iter().all(|(_, off)| *off <= NORMALIZATION), "{all:?}");
    let planted = [
        ("a factor slightly off", worst(|r, h| (1.0 + 2e-5) * as_written::<f64>(&PRINTED, r, h))),
        ("a floor", worst(|r, h| as_written::<f64>(&GUIDED_2020, r, h))),
        (
            "nothing at grazing angles",
            worst(|r, h| if h.z < 0.1 { 0.0 } else { as_written::<f64>(&PRINTED, r, h) }),
        ),
    ];
    assert!(planted.iter().all(|(_, off)| *off > NORMALIZATION), "{planted:?}");
}
