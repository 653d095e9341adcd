//! Metrics against closed forms.

use svbrdf::material::{Material, Planes};
use svbrdf::metrics::{Metric, of_maps, of_renderings};
use svbrdf::model::convention::Convention;
use svbrdf::model::sampler::Sampler;
use svbrdf::progress::Progress;
use svbrdf::samples;

/// Two texels of one normal, with diffuse, specular and roughness of each.
fn two(normal: [f64; 3], diffuse: [f64; 2], specular: [f64; 2], roughness: [f64; 2]) -> Material<f64> {
    let planes = Planes {
        normal: normal.map(|c| vec![c; 2]),
        diffuse: [(); 3].map(|()| diffuse.to_vec()),
        specular: [(); 3].map(|()| specular.to_vec()),
        roughness: roughness.to_vec(),
    };
    Material::new("two", 2, 1, planes).unwrap()
}

#[track_caller]
fn assert_is(metrics: &[Metric], name: &str, expected: f64) {
    let got = metrics.iter().find(|metric| metric.name == name).unwrap_or_else(|| panic!("no {name}")).value;
    assert!((got - expected).abs() < 1e-12, "{name}: {got}, not {expected}");
}

#[test]
fn metrics_of_maps_have_their_closed_forms() {
    let tilt = 30.0_f64.to_radians();
    let truth = two([0.0, 0.0, 1.0], [0.5, 0.1], [0.04, 0.2], [0.5, 0.2]);
    let predicted = two([tilt.sin(), 0.0, tilt.cos()], [0.5, 0.3], [0.02, 0.1], [0.6, 0.2]);
    let got = of_maps(&truth, &predicted).unwrap();
    for name in ["angle_normal_mean_degrees", "angle_normal_median_degrees", "angle_normal_p95_degrees"] {
        assert_is(&got, name, 30.0);
    }
    let chord = 2.0 * (tilt / 2.0).sin();
    assert_is(&got, "rmse_normal_unit", chord / 3.0_f64.sqrt());
    assert_is(&got, "rmse_normal_stored", 0.5 * chord / 3.0_f64.sqrt());
    assert_is(&got, "l1_normal_stored", (tilt.sin() + 1.0 - tilt.cos()) / 6.0);
    assert_is(&got, "rmse_diffuse_linear", 0.2 / 2.0_f64.sqrt());
    assert_is(&got, "l1_diffuse_linear", 0.1);
    let srgb = |x: f64| 1.055 * x.powf(1.0 / 2.4) - 0.055;
    assert_is(&got, "l1_diffuse_srgb", (srgb(0.3) - srgb(0.1)) / 2.0);
    // Twice as large everywhere: nothing is left once it is scaled.
    assert_is(&got, "rmse_specular_linear_scaled", 0.0);
    assert_is(&got, "rmse_specular_linear", ((0.02_f64.powi(2) + 0.1_f64.powi(2)) / 2.0).sqrt());
    assert_is(&got, "rmse_roughness", 0.1 / 2.0_f64.sqrt());
    assert_is(&got, "rmse_roughness_alpha", 0.11 / 2.0_f64.sqrt());
    let faulty = of_maps(&predicted, &two([0.0, 0.0, 1.0], [0.5, 0.1], [0.04, 0.2], [0.5, 0.21])).unwrap();
    assert!(faulty.iter().any(|m| m.name == "l1_roughness" && (m.value - 0.05).abs() > 1e-3));
}

#[test]
fn equal_materials_differ_by_nothing() {
    let truth = samples::load::<f32>().unwrap().ground_truth.material;
    assert!(of_maps(&truth, &truth).unwrap().iter().all(|metric| metric.value == 0.0));
    let scenes = Sampler::Random.scenes(0, 2, 1, &Convention::default());
    let renderings =
        of_renderings(&truth, &truth, &scenes, &Convention::default(), &Progress::default()).unwrap();
    for metric in renderings {
        let expected = if metric.name.starts_with("psnr") { f64::INFINITY } else { 0.0 };
        assert_eq!(metric.value, expected, "{}", metric.name);
    }
}

#[test]
fn renderings_of_diffuse_materials_have_their_closed_form() {
    // Without specular reflectance at normal incidence: d / pi NoL / l.z = d / pi, but for the Fresnel term, which is tiny here.
    let material = |d| two([0.0, 0.0, 1.0], [d; 2], [0.0; 2], [1.0; 2]).cast::<f32>();
    let direction = [0.0, 0.0, 1.0];
    let scene = svbrdf::model::scene::Scene {
        kind: svbrdf::model::scene::Kind::Distant,
        view: direction,
        light: direction,
    };
    let got =
        of_renderings(&material(0.9), &material(0.3), &[scene], &Convention::default(), &Progress::default())
            .unwrap();
    let [linear, psnr] = ["rmse_rendering_clipped_linear", "psnr_rendering_clipped_linear"]
        .map(|name| got.iter().find(|metric| metric.name == name).unwrap().value);
    let expected = 0.6 / std::f64::consts::PI;
    assert!((linear / expected - 1.0).abs() < 1e-3, "{linear}, not {expected}");
    assert!((psnr + 20.0 * linear.log10()).abs() < 1e-12);
}
