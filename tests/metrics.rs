//! Metrics against closed forms.

use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::convention::{Convention, PRINTED};
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::flip::mean_flip;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_f32;
use svbrdf_evaluate::metrics::{Kept, Metric, RenderedScenes, of_maps, of_masked_maps, of_renderings};
use svbrdf_files::samples;

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
    assert_is(&got, "rmse_diffuse_linear_minus1_to_1", 2.0 * 0.2 / 2.0_f64.sqrt());
    assert_is(&got, "psnr_diffuse_linear", -10.0 * (0.04_f64 / 2.0).log10());
    assert_is(&got, "psnr_normal_stored", -20.0 * (0.5 * chord / 3.0_f64.sqrt()).log10());
    assert_is(&got, "rmse_roughness", 0.1 / 2.0_f64.sqrt());
    assert_is(&got, "rmse_roughness_minus1_to_1", 0.2 / 2.0_f64.sqrt());
    assert_is(&got, "rmse_roughness_alpha", 0.11 / 2.0_f64.sqrt());
    let faulty = of_maps(&predicted, &two([0.0, 0.0, 1.0], [0.5, 0.1], [0.04, 0.2], [0.5, 0.21])).unwrap();
    assert!(faulty.iter().any(|m| m.name == "l1_roughness" && (m.value - 0.05).abs() > 1e-3));
}

/// What two texels of a base colour and a metallic are as diffuse and specular (glTF 2.0, appendix B.2).
fn of_base(base: [f64; 2], metallic: [f64; 2]) -> Material<f64> {
    let both = [0, 1].map(|i| (base[i], metallic[i]));
    let diffuse = both.map(|(b, m)| b * (1.0 - m));
    let specular = both.map(|(b, m)| 0.04 * (1.0 - m) + b * m);
    two([0.0, 0.0, 1.0], diffuse, specular, [0.5; 2])
}

#[test]
fn base_colour_and_metallic_have_the_errors_of_the_maps_that_they_are_stored_as() {
    let (base, metallic) = ([[0.5, 0.9], [0.7, 0.6]], [[0.0, 1.0], [0.2, 0.6]]);
    let got = of_maps(&of_base(base[0], metallic[0]), &of_base(base[1], metallic[1])).unwrap();
    let rmse = |a: [f64; 2], b: [f64; 2]| ((0..2).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>() / 2.0).sqrt();
    // Roots of a quadratic equation: half of the digits.
    let is = |name: &str, expected: f64| {
        let found = got.iter().find(|metric| metric.name == name).unwrap().value;
        assert!((found - expected).abs() < 1e-7, "{name}: {found}, not {expected}");
    };
    is("rmse_base_colour_linear", rmse(base[0], base[1]));
    is("rmse_metallic", rmse(metallic[0], metallic[1]));
    is("l1_metallic", 0.3);
    is("psnr_metallic", -20.0 * rmse(metallic[0], metallic[1]).log10());
    let encoded = base.map(|base| base.map(|x: f64| 1.055 * x.powf(1.0 / 2.4) - 0.055));
    is("rmse_base_colour_srgb", rmse(encoded[0], encoded[1]));
    is("l1_base_colour_srgb", (0..2).map(|i| (encoded[0][i] - encoded[1][i]).abs()).sum::<f64>() / 2.0);
}

/// Renderings at no exposure.
fn rendered(scenes: &[Scene]) -> RenderedScenes<'_> {
    RenderedScenes { scenes, sampler: Sampler::Random, convention: &PRINTED, exposure_ev: 0.0 }
}

fn value(metrics: &[Metric], name: &str) -> Metric {
    *metrics.iter().find(|metric| metric.name == name).unwrap_or_else(|| panic!("no {name}"))
}

#[test]
fn equal_materials_differ_by_nothing() {
    let truth = samples::load::<f32>().unwrap().ground_truth.material;
    let scenes = Sampler::Random.scenes(0, 2, 2, &Convention::default());
    let renderings = of_renderings(&truth, &truth, &rendered(&scenes), &Progress::default()).unwrap();
    for metric in of_maps(&truth, &truth).unwrap().into_iter().chain(renderings) {
        let (name, value) = (metric.name, metric.value);
        match name {
            _ if name.starts_with("psnr") => assert_eq!(value, f64::INFINITY, "{name}"),
            _ if name.starts_with("ssim") => assert!((value - 1.0).abs() < 1e-13, "{name}: {value}"),
            _ => assert!(value.abs() < 1e-14, "{name}: {value}"),
        }
    }
}

#[test]
fn means_over_scenes_have_the_interval_of_these_scenes_and_an_exposure_changes_them() {
    let samples = samples::load::<f32>().unwrap();
    let (truth, predicted) = (samples.ground_truth.material, &samples.predictions[1].material);
    let of = |rendered: &RenderedScenes<'_>| {
        of_renderings(&truth, predicted, rendered, &Progress::default()).unwrap()
    };
    let scenes = Sampler::Random.scenes(0, 3, 2, &PRINTED);
    let all = of(&rendered(&scenes));
    let each: Vec<f64> =
        scenes.iter().map(|scene| value(&of(&rendered(&[*scene])), "flip_rendering_clipped").value).collect();
    let expected = svbrdf_core::loss::Estimate::of_scenes(&scenes, &each);
    let flip = value(&all, "flip_rendering_clipped");
    assert!((flip.value - expected.mean).abs() < 1e-12);
    assert_eq!(flip.interval95, expected.interval95);
    let [low, high] = value(&all, "rmse_rendering_clipped_srgb").interval95.unwrap();
    assert!(low < value(&all, "rmse_rendering_clipped_srgb").value && high < 1.0, "{low}, {high}");
    assert!(value(&of(&rendered(&scenes[..1])), "flip_rendering_clipped").interval95.is_none());
    let bright = of(&RenderedScenes { exposure_ev: 1.0, ..rendered(&scenes) });
    for name in ["flip_rendering_clipped", "rmse_rendering_clipped_linear", "psnr_rendering_clipped_srgb"] {
        assert!((value(&bright, name).value / value(&all, name).value - 1.0).abs() > 0.01, "{name}");
    }
}

#[test]
fn renderings_of_diffuse_materials_have_their_closed_form() {
    // Without specular reflectance at normal incidence: d / pi NoL / l.z = d / pi, but for the Fresnel term, which is tiny here.
    let material = |d| two([0.0, 0.0, 1.0], [d; 2], [0.0; 2], [1.0; 2]).cast::<f32>();
    let direction = [0.0, 0.0, 1.0];
    let scene = Scene { kind: Kind::Distant, view: direction, light: direction };
    let got =
        of_renderings(&material(0.9), &material(0.3), &rendered(&[scene]), &Progress::default()).unwrap();
    let [linear, psnr] = ["rmse_rendering_clipped_linear", "psnr_rendering_clipped_linear"]
        .map(|name| got.iter().find(|metric| metric.name == name).unwrap().value);
    let expected = 0.6 / std::f64::consts::PI;
    assert!((linear / expected - 1.0).abs() < 1e-3, "{linear}, not {expected}");
    assert!((psnr + 20.0 * linear.log10()).abs() < 1e-12);
}

/// The materials of the references below, of `height` rows of 24 texels: diffuse maps that NumPy computes the same, their red channel as
/// roughness, and as specular the diffuse map or a constant.
fn patterns(height: usize, specular: Option<f64>) -> [Material<f64>; 2] {
    let first = |x: usize, y: usize, c: usize| ((7 * x + 13 * y + 29 * c) % 64) as f64 / 63.0;
    let second =
        |x: usize, y: usize, c: usize| 0.8 * first(x, y, c) + 0.2 * ((x * x + 3 * y + c) % 50) as f64 / 49.0;
    let material = |of: &dyn Fn(usize, usize, usize) -> f64| {
        let map = |c: usize| (0..24 * height).map(|i| of(i % 24, i / 24, c)).collect::<Vec<_>>();
        let flat = |value| vec![value; 24 * height];
        let planes = Planes {
            normal: [0.0, 0.0, 1.0].map(flat),
            diffuse: [0, 1, 2].map(map),
            specular: [0, 1, 2].map(|c| specular.map_or_else(|| map(c), flat)),
            roughness: map(0),
        };
        Material::new("pattern", 24, height, planes).unwrap()
    };
    [material(&first), material(&second)]
}

/// scikit-image 0.26:
///
/// ```python
/// y, x, c = np.mgrid[0:17, 0:24, 0:3]
/// a = ((7 * x + 13 * y + 29 * c) % 64) / 63
/// b = 0.8 * a + 0.2 * ((x * x + 3 * y + c) % 50) / 49
/// window = {"gaussian_weights": True, "sigma": 1.5, "use_sample_covariance": False, "data_range": 1.0}
/// structural_similarity(srgb(a), srgb(b), **window, channel_axis=2)  # 0.9093539401489618
/// structural_similarity(a[..., 0], b[..., 0], **window)  # 0.9469866473748026
/// ```
#[test]
fn ssim_is_that_of_scikit_image() {
    let of = |height| {
        let [a, b] = patterns(height, None);
        of_maps(&a, &b).unwrap()
    };
    let got = of(17);
    assert_is(&got, "ssim11_gaussian_diffuse_srgb", 0.909_353_940_148_961_8);
    assert_is(&got, "ssim11_gaussian_specular_srgb", 0.909_353_940_148_961_8);
    assert_is(&got, "ssim11_gaussian_roughness", 0.946_986_647_374_802_6);
    assert_is(&got, "ssim11_gaussian_normal_stored", 1.0);
    assert_is(&got, "ssim7_uniform_diffuse_srgb", 0.913_961_696_783_317_4);
    assert_is(&got, "ssim7_uniform_roughness", 0.949_632_108_006_939_6);
    assert_is(&got, "ssim7_uniform_normal_stored", 1.0);
    // Smaller than a window.
    let names = |height| -> Vec<&str> {
        of(height).iter().map(|metric| metric.name).filter(|name| name.starts_with("ssim")).collect()
    };
    assert!(names(10).iter().all(|name| name.starts_with("ssim7")) && names(10).len() == 6);
    assert!(names(6).is_empty());
}

/// The functions that protocols follow, of the patterns `a` and `b` above with specular 0.04:
///
/// ```python
/// mask = numpy.ones(a.shape[:2], numpy.float32)
/// orb = dict(max_value=1, use_gt_median=False, tonemapping=False, scale_invariant=True, divide_mask=False)
/// calc_PSNR(b, a, mask, **orb)  # Stanford-ORB: 21.85338230394205
/// scaled = numpy.clip((a * b).sum((0, 1)) / (b * b).sum((0, 1)) * b, 0, 1)
/// structural_similarity(a, scaled, **window, channel_axis=2)  # 0.9547757642788864
/// material = lambda v: srgb(numpy.stack([v[..., 0], 0 * v[..., 0], 0 * v[..., 0]], -1))
/// peak_signal_noise_ratio(material(a), material(b), data_range=1)  # Marigold: 25.963282072062878
/// structural_similarity(material(a), material(b), **window, channel_axis=2)  # 0.9675758368498789
/// numpy.abs(A - B).mean()  # DeepBasis, of 10 channels in [-1, 1]: 0.054146547507892044
/// kept = numpy.arange(24)[None, :, None] < 12, with --use_mask
/// peak_signal_noise_ratio(srgb(a)[:, :12], srgb(b)[:, :12], data_range=1)  # 21.056218790379585
/// structural_similarity(kept * srgb(a), kept * srgb(b), **window, channel_axis=2)  # 0.9603892122786788
/// ```
#[test]
fn metrics_of_protocols_are_those_of_the_codes_that_they_follow() {
    let [a, b] = patterns(17, Some(0.04));
    let got = of_maps(&a, &b).unwrap();
    assert_is(&got, "l1_maps_minus1_to_1", 0.054_146_547_507_892_044);
    assert_is(&got, "psnr_base_colour_linear_scaled_channels", 21.853_382_303_942_05);
    assert_is(&got, "ssim11_gaussian_base_colour_linear_scaled_channels", 0.954_775_764_278_886_4);
    assert_is(&got, "psnr_roughness_metallic_0_srgb", 25.963_282_072_062_878);
    assert_is(&got, "ssim11_gaussian_roughness_metallic_0_srgb", 0.967_575_836_849_878_9);
    assert_is(&got, "ssim11_gaussian_base_colour_srgb", 0.909_353_940_148_961_8);
    assert_is(&got, "ssim11_gaussian_metallic", 1.0);
    let texels: Vec<bool> = (0..24 * 17).map(|texel| texel % 24 < 12).collect();
    let masked = |count_all| of_masked_maps(&a, &b, Some(Kept { texels: &texels, count_all })).unwrap();
    assert_is(&masked(false), "psnr_base_colour_srgb", 21.056_218_790_379_585);
    assert_is(&masked(false), "ssim11_gaussian_base_colour_srgb", 0.960_389_212_278_678_8);
    // All texels count, half of which are equal.
    assert_is(&masked(true), "psnr_base_colour_srgb", 21.056_218_790_379_585 + 10.0 * 2.0_f64.log10());
}

/// flip-evaluator 1.7, the means of its error maps of linear pictures in f64:
///
/// ```python
/// # One row for each scene, here `scenes`: at 0 EV and at 2 EV in turn; a column for each prediction.
/// clipped = [np.clip(x * 2.0**ev, 0, 1).astype(np.float32) for x in (truth, predicted)]
/// flip_evaluator.evaluate(*clipped, "LDR", inputsRGB=False, applyMagma=False)[0].astype(np.float64).mean()
/// ```
#[test]
fn flip_is_that_of_flip_evaluator() {
    const EXPECTED: [[f64; 2]; 10] = [
        [0.207_441_64, 0.160_866_36],
        [0.259_476_89, 0.173_071_26],
        [0.242_466_36, 0.161_194_01],
        [0.372_323_86, 0.230_017_46],
        [0.273_109_65, 0.149_710_82],
        [0.406_031_38, 0.247_417_44],
        [0.172_767_57, 0.108_829_47],
        [0.198_548_05, 0.151_579_38],
        [0.119_718_47, 0.097_936_33],
        [0.187_602_72, 0.171_077_82],
    ];
    let samples = samples::load::<f32>().unwrap();
    let scenes = Sampler::Random.scenes(0, 7, 3, &PRINTED);
    let mut worst = 0.0_f64;
    for (index, (scene, expected)) in scenes.iter().zip(EXPECTED).enumerate() {
        let render = |material| render_f32(material, scene, &PRINTED, &Progress::default()).unwrap();
        let truth = render(&samples.ground_truth.material);
        let exposure_ev = [0.0, 2.0][index % 2];
        for (prediction, expected) in samples.predictions.iter().zip(expected) {
            let found = mean_flip(&truth, &render(&prediction.material), exposure_ev);
            let off = (found - expected).abs();
            assert!(off < 1e-6, "{index}, {}: {found}, not {expected}", prediction.material.name());
            worst = worst.max(off);
            // A planted fault: half a stop.
            let darker = mean_flip(&truth, &render(&prediction.material), exposure_ev - 0.5);
            assert!((darker - expected).abs() > 1e-4, "{index}: {darker}");
        }
    }
    println!("largest deviation of a mean: {worst:e}");
}
