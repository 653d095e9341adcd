//! Physical properties of any material, light and view: reciprocity, bounds, limits.

mod albedo;
mod normalization;
mod plot;

use glam::DVec3;
use rand::rngs::ChaCha8Rng;
use rand::{Rng as _, SeedableRng as _};

use svbrdf_core::loss::Plain;
use svbrdf_core::material::{Material, Planes};
use svbrdf_core::math::real::{Real, Vec3, Vector as _};
use svbrdf_core::model::brdf::{self, Model, Texel};
use svbrdf_core::model::convention::{self, PRINTED};
use svbrdf_core::model::scene::{Kind, Scene, sample};
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render;

use crate::support::losses::losses;
use crate::support::tolerance::{LOSS_SUM_F64, RECIPROCITY};

/// Random numbers that are the same in every run.
struct Random(ChaCha8Rng);

impl Random {
    fn of_seed(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A unit vector at least `least_z` above the plane.
    fn direction(&mut self, least_z: f64) -> DVec3 {
        let z = self.between(least_z, 1.0);
        let phi = self.between(0.0, std::f64::consts::TAU);
        let rho = (1.0 - z * z).sqrt();
        DVec3::new(rho * phi.cos(), rho * phi.sin(), z)
    }

    fn texel<T: Real>(&mut self) -> Texel<T> {
        let mut color = || [(); 3].map(|()| T::of(self.between(0.0, 1.0)));
        let (diffuse, specular) = (color(), color());
        let roughness = T::of(self.between(0.0, 1.0));
        Texel { normal: self.direction(0.3).cast(), diffuse, specular, roughness }
    }

    fn material<T: Real>(&mut self, width: usize, height: usize) -> Material<T> {
        let texels: Vec<Texel<T>> = (0..width * height).map(|_| self.texel()).collect();
        let plane = |value: &dyn Fn(&Texel<T>) -> T| texels.iter().map(value).collect::<Vec<_>>();
        let planes = Planes {
            normal: [0, 1, 2].map(|c| plane(&|t| t.normal.to_array()[c])),
            diffuse: [0, 1, 2].map(|c| plane(&|t| t.diffuse[c])),
            specular: [0, 1, 2].map(|c| plane(&|t| t.specular[c])),
            roughness: plane(&|t| t.roughness),
        };
        Material::new("random", width, height, planes).unwrap()
    }
}

/// The worst relative change, in units of u, of what `reflected` gives when light and view are swapped.
fn asymmetry<T: Real>(reflected: impl Fn(&Texel<T>, Vec3<T>, Vec3<T>) -> [T; 3]) -> f64 {
    let mut random = Random::of_seed(1);
    let mut worst = 0.0f64;
    for _ in 0..20_000 {
        let texel = random.texel();
        let [l, v] = [(); 2].map(|()| random.direction(0.01).cast::<Vec3<T>>());
        for (there, back) in reflected(&texel, l, v).into_iter().zip(reflected(&texel, v, l)) {
            let (there, back) = (there.f64(), back.f64());
            worst = worst.max((there - back).abs() / there.max(back));
        }
    }
    worst / (T::epsilon().f64() / 2.0)
}

#[test]
fn swapping_light_and_view_does_not_change_the_reflectance() {
    let f64s = asymmetry(|texel, l, v| brdf::reflectance(&Model::<f64>::from(&PRINTED), texel, l, v));
    let f32s = asymmetry(|texel, l, v| brdf::reflectance(&Model::<f32>::from(&PRINTED), texel, l, v));
    println!("reciprocity: worst {f64s:.1} u in f64, {f32s:.1} u in f32");
    assert!(f64s <= RECIPROCITY && f32s <= RECIPROCITY);
}

#[test]
fn swapping_light_and_view_changes_the_rendering() {
    let model = Model::<f64>::from(&PRINTED);
    assert!(asymmetry(|texel, l, v| brdf::render(&model, texel, l, v)) > RECIPROCITY);
}

#[test]
fn the_length_of_a_direction_does_not_matter_or_is_refused() {
    let mut random = Random::of_seed(3);
    let (material, prediction) = (random.material::<f64>(3, 3), random.material::<f64>(3, 3));
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

/// Every combination of smooth, rough, black, white, grazing, near and far.
fn extremes() -> impl Iterator<Item = (Texel<f32>, glam::Vec3, glam::Vec3)> {
    const ROUGHNESS: [f32; 6] = [0.0, 1e-6, 1e-4, 1.0 / 255.0, 0.5, 1.0];
    const ALBEDO: [[f32; 2]; 4] = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]];
    const NORMALS: [[f64; 3]; 4] = [[0.0, 0.0, 1.0], [1.0, 0.0, 1e-3], [0.6, 0.0, -0.8], [-0.6, 0.64, 0.48]];
    const HEIGHTS: [f32; 6] = [1e-30, 1e-12, 1e-6, 1e-3, 0.5, 1.0];
    const SIDES: [[f32; 2]; 3] = [[1.0, 0.0], [-1.0, 0.0], [-0.6, 0.8]];
    const LENGTHS: [f32; 3] = [1e-3, 1.0, 1e9];

    let directions: Vec<_> = SIDES
        .into_iter()
        .flat_map(|[x, y]| HEIGHTS.into_iter().map(move |z| glam::Vec3::new(x * (1.0 - z), y * (1.0 - z), z)))
        .flat_map(|w| LENGTHS.into_iter().map(move |length| w * length))
        .collect();
    let texels = NORMALS.into_iter().flat_map(|n| {
        ROUGHNESS.into_iter().flat_map(move |roughness| {
            ALBEDO.into_iter().map(move |[d, s]| Texel {
                normal: DVec3::from(n).normalize().as_vec3(),
                diffuse: [d; 3],
                specular: [s; 3],
                roughness,
            })
        })
    });
    texels.flat_map(move |texel| {
        let directions = directions.clone();
        let views = directions.clone();
        directions.into_iter().flat_map(move |l| views.clone().into_iter().map(move |v| (texel, l, v)))
    })
}

#[test]
fn extreme_points_stay_finite_and_never_turn_negative_in_f32() {
    let mut count = 0;
    for convention in &convention::ALL {
        let model = Model::<f32>::from(convention);
        for (texel, l, v) in extremes() {
            let radiance = brdf::render(&model, &texel, l, v);
            let fine = radiance.iter().all(|x| x.is_finite() && *x >= 0.0);
            assert!(fine, "{}: {texel:?}, l {l:?}, v {v:?} give {radiance:?}", convention.name);
            count += 1;
        }
    }
    assert!(count > 1_000_000, "only {count} points");
}

#[test]
fn nothing_is_reflected_of_a_light_below_the_texel_or_the_plane() {
    let model = Model::<f32>::from(&PRINTED);
    let mut texel = Random::of_seed(2).texel();
    texel.normal = glam::Vec3::X;
    for l in [[-0.6, 0.0, 0.8], [0.6, 0.0, -0.8], [0.6, 0.8, 0.0], [0.0, 0.6, 0.8]] {
        let v = glam::Vec3::new(0.5, 0.1, 0.7);
        assert_eq!(brdf::render(&model, &texel, l.into(), v), [0.0; 3], "{l:?}");
    }
}

#[test]
fn the_loss_grows_with_the_perturbation() {
    let mut random = Random::of_seed(5);
    let (truth, other) = (random.material::<f64>(24, 24), random.material::<f64>(24, 24));
    let map_names = ["normal", "diffuse", "specular", "roughness"];
    for (map, name) in map_names.into_iter().enumerate() {
        let perturbed = [0.01, 0.02, 0.05, 0.1, 0.2, 0.4].map(|t| blend(&truth, &other, map, t));
        let losses =
            losses(&Plain, &truth, &perturbed.each_ref(), &sample(7, 4, 2, &PRINTED), &PRINTED).unwrap();
        let means: Vec<f64> = losses.iter().map(|loss| loss.estimate.mean).collect();
        assert!(means[0] > 0.0 && means.is_sorted_by(|a, b| a < b), "{name}: {means:?}");
    }
}

/// `a` with one map moved towards that of `b`.
fn blend(a: &Material<f64>, b: &Material<f64>, map: usize, t: f64) -> Material<f64> {
    let mix = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + (b - a) * t).collect::<Vec<f64>>();
    let mix3 = |a: &[Vec<f64>; 3], b: &[Vec<f64>; 3]| [0, 1, 2].map(|c| mix(&a[c], &b[c]));
    let (mut planes, b) = (a.planes().clone(), b.planes());
    match map {
        0 => planes.normal = mix3(&planes.normal, &b.normal),
        1 => planes.diffuse = mix3(&planes.diffuse, &b.diffuse),
        2 => planes.specular = mix3(&planes.specular, &b.specular),
        _ => planes.roughness = mix(&planes.roughness, &b.roughness),
    }
    Material::new("blended", a.width(), a.height(), planes).unwrap()
}

#[test]
fn odd_sizes_have_the_loss_of_their_texels() {
    for (width, height) in [(1, 1), (7, 3), (129, 1), (1, 64)] {
        let mut random = Random::of_seed(9);
        let (x, y) = (random.material::<f64>(width, height), random.material::<f64>(width, height));
        let scene = Scene { kind: Kind::Near, view: [0.1, 0.2, 2.0], light: [-0.5, 0.4, 1.5] };
        let log = |m: &Material<f64>| {
            let image = render(m, &scene, &PRINTED, &Progress::default()).unwrap();
            assert_eq!((image.width, image.height), (width, height));
            image.pixels.into_iter().flatten().map(|r| (r + PRINTED.epsilon).ln()).collect::<Vec<_>>()
        };
        let sum: f64 = log(&x).into_iter().zip(log(&y)).map(|(a, b)| (a - b).abs()).sum();
        let got = &losses(&Plain, &x, &[&y], &[scene], &PRINTED).unwrap()[0];
        let expected = sum / (3 * width * height) as f64;
        assert!((got.estimate.mean - expected).abs() <= LOSS_SUM_F64 * expected, "{width} x {height}");
    }
}
