//! Captures that the tests render: exact scenes, a known exposure, planted outliers.

use std::fs;
use std::path::Path;

use glam::DVec3;
use image::{Rgb, RgbImage};
use serde_json::{Value, json};
use tempfile::{TempDir, tempdir};

use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::{Model, reflectance};
use svbrdf_core::model::convention::{Convention, PRINTED};
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::Error;
use svbrdf_evaluate::photograph::{CaptureExposure, PhotoOutlier, PhotoReport, PhotoSetting};
use svbrdf_evaluate::report::{Json as _, Report as _};
use svbrdf_files::photograph::Capture;

use super::small;
use crate::support::pictures::{gamma, npy};

pub(super) const SIDE: usize = 64;
/// Of each photograph: a light, and a view near it.
pub(super) const LIGHTS: [[f64; 3]; 9] = [
    [-0.8, 0.7, 2.5],
    [0.1, 0.9, 3.0],
    [0.9, 0.8, 2.2],
    [-0.9, 0.0, 2.0],
    [0.0, 0.1, 2.8],
    [0.8, -0.1, 3.5],
    [-0.7, -0.9, 2.4],
    [0.0, -0.8, 2.6],
    [0.7, -0.7, 3.2],
];

/// Radiance `f NoL / d^2` under a point light of power 1, in f64.
pub(super) fn physical(material: &Material<f32>, light: [f64; 3], view: [f64; 3]) -> Vec<[f64; 3]> {
    let (grid, model, exact) = (material.grid(), Model::from(&PRINTED), material.cast::<f64>());
    let texel = |i: usize| {
        let place: DVec3 = grid.position(i % material.width(), i / material.width());
        let texel = exact.texel(i);
        let (to_light, to_view) = (DVec3::from(light) - place, (DVec3::from(view) - place).normalize());
        let l = to_light.normalize();
        let n_dot_l = texel.normal.dot(l).max(0.0);
        reflectance(&model, &texel, l, to_view).map(|f| f * n_dot_l / to_light.length_squared())
    };
    (0..material.width() * material.height()).map(texel).collect()
}

pub(super) fn view(light: [f64; 3]) -> [f64; 3] {
    [light[0] + 0.1, light[1] - 0.1, light[2]]
}

/// The folder of a capture of `material`: floats, of which photograph `k` has the power `power(k)` and is lit from `light(k)`.
fn folder(
    material: &Material<f32>,
    power: impl Fn(usize) -> f64,
    light: impl Fn(usize) -> [f64; 3],
) -> TempDir {
    let folder = tempdir().unwrap();
    fs::create_dir(folder.path().join("raw")).unwrap();
    let mut listed = Vec::new();
    for (k, declared) in LIGHTS.into_iter().enumerate() {
        let radiance = physical(material, light(k), view(light(k)));
        let values: Vec<f32> =
            radiance.into_iter().flatten().map(|value| (power(k) * value) as f32).collect();
        let file = format!("raw/{k}.npy");
        fs::write(folder.path().join(&file), npy([SIDE as u64, SIDE as u64, 3], &values)).unwrap();
        let scene = json!({"kind": "near", "view": view(declared), "light": declared});
        listed.push(json!({"file": file, "scene": scene}));
    }
    write(folder.path(), &json!({"falloff": true, "photographs": listed}));
    folder
}

pub(super) fn write(folder: &Path, capture: &Value) {
    fs::write(folder.join("capture.json"), capture.to_string()).unwrap();
}

pub(super) fn setting(
    folder: &Path,
    exposure: CaptureExposure,
    hold_out: &[&str],
) -> Result<PhotoSetting, Error> {
    let hold_out: Vec<String> = hold_out.iter().map(|name| (*name).to_owned()).collect();
    let capture = Capture::read(folder)?;
    PhotoSetting::new(capture, exposure, &hold_out, Convention::default())
}

pub(super) fn compared(setting: PhotoSetting, materials: &[&Material<f32>]) -> PhotoReport {
    let named = materials.iter().map(|material| (material.name(), *material));
    PhotoReport::new(setting, named, &Progress::default()).unwrap()
}

pub(super) fn of_folder(folder: &Path, materials: &[&Material<f32>]) -> PhotoReport {
    compared(setting(folder, CaptureExposure::Capture, &[]).unwrap(), materials)
}

fn outliers(report: &PhotoReport, result: usize) -> Vec<(usize, PhotoOutlier)> {
    let all = report.results[result].photographs.iter().map(|one| one.outlier).enumerate();
    all.filter(|(_, outlier)| outlier.is_any()).collect()
}

/// A capture of MaterialGAN: its renderer, in centimetres, and its file.
pub(super) fn materialgan(truth: &Material<f32>, power: [f64; 3]) -> TempDir {
    let folder = tempdir().unwrap();
    fs::create_dir(folder.path().join("target")).unwrap();
    let half_width = 3.424;
    let centimetres = |place: [f64; 3]| place.map(|c| half_width * c);
    for (k, light) in LIGHTS.into_iter().enumerate() {
        let radiance = physical(truth, light, view(light));
        let code = |i: usize, c: usize| {
            let value = power[c] * radiance[i][c] / (half_width * half_width);
            (255.0 * gamma(value.min(1.0))).round() as u8
        };
        let picture = RgbImage::from_fn(SIDE as u32, SIDE as u32, |x, y| {
            let i = y as usize * SIDE + x as usize;
            Rgb([code(i, 0), code(i, 1), code(i, 2)])
        });
        // The number of a photograph is not its place in the list.
        picture.save(folder.path().join(format!("target/{:02}.png", 8 - k))).unwrap();
    }
    let reversed = || LIGHTS.into_iter().rev();
    let calibration = json!({
        "_comment": "in cm uint", "target_dir": "target", "optimize_dir": "optim_latent/256", "im_size": 2.0 * half_width,
        "idx": [8, 7, 6, 5, 4, 3, 2, 1, 0], "light_pow": power,
        "camera_pos": reversed().map(|light| centimetres(view(light))).collect::<Vec<_>>(),
        "light_pos": reversed().map(centimetres).collect::<Vec<_>>(),
    });
    fs::write(folder.path().join("render.json"), calibration.to_string()).unwrap();
    folder
}

#[test]
fn a_capture_of_known_lights_has_one_exposure_and_ranks_the_right_material_first() {
    let [truth, blurred, rough] = small();
    // The height of the first light over itself: the factor is h^2 / power.
    let expected = 2.5 * 2.5 / 12.0;
    let folder = folder(&truth, |_| 12.0, |k| LIGHTS[k]);
    let report = of_folder(folder.path(), &[&rough, &truth, &blurred]);
    assert_eq!(report.results[0].material, truth.name());
    let [right, wrong] = [&report.results[0], &report.results[1]];
    let factor = right.factor.unwrap();
    assert!((factor / expected - 1.0).abs() < 1e-5, "{factor}, {expected}");
    let means = &right.means;
    assert_eq!((means.len(), means[0].name, means[0].count), (1, "all", 9));
    let [log, rmse, ssim] = [means[0].log, means[0].rmse, means[0].ssim].map(Option::unwrap);
    assert!(log.mean < 1e-5 && rmse.mean < 1e-5 && (ssim.mean - 1.0).abs() < 1e-6, "{means:?}");
    assert!(outliers(&report, 0).is_empty());
    let worse = wrong.means[0].log.unwrap();
    assert!(worse.mean > 0.01 && worse.interval95.unwrap()[0] > 0.0, "{worse:?}");
    // A planted fault: without the falloff that the photographs have, neither exposure nor difference are right.
    let text = fs::read_to_string(folder.path().join("capture.json")).unwrap();
    fs::write(folder.path().join("capture.json"), text.replace("true", "false")).unwrap();
    let plain = of_folder(folder.path(), &[&truth]);
    assert!(plain.results[0].means[0].log.unwrap().mean > 0.05);
    let declared = plain.setting.declared_factor();
    assert_eq!(declared, None);
}

#[test]
fn a_darker_photograph_and_one_of_another_light_are_found() {
    let [truth, _, rough] = small();
    let moved = |k: usize| if k == 6 { [0.9, 0.9, 1.2] } else { LIGHTS[k] };
    let folder = folder(&truth, |k| if k == 4 { 6.0 } else { 12.0 }, moved);
    let report = of_folder(folder.path(), &[&truth, &rough]);
    let found = outliers(&report, 0);
    assert_eq!(found.iter().map(|(k, _)| *k).collect::<Vec<_>>(), [4, 6], "{found:?}");
    assert!(found[0].1.exposure, "{found:?}");
    let result = &report.results[0];
    let ev = |k: usize| result.photographs[k].own_exposure_ev.unwrap();
    assert!((ev(4) - ev(0) - 1.0).abs() < 1e-4, "{} and {}", ev(4), ev(0));
    // The capture has the exposure of the others.
    assert!((result.factor.unwrap() / (2.5 * 2.5 / 12.0) - 1.0).abs() < 1e-3, "{:?}", result.factor);
    let text = report.text();
    let line = "raw/4.npy is an outlier for 2 of 2 materials (numbers of ";
    assert!(text.contains(line) && text.contains("+1.00 EV from the median"), "{text}");
    // The noise of the photographs and a wrong material make no outlier.
    let even = self::folder(&truth, |_| 12.0, |k| LIGHTS[k]);
    let report = of_folder(even.path(), &[&truth, &rough]);
    assert!(outliers(&report, 0).is_empty() && outliers(&report, 1).is_empty());
}

#[test]
fn photographs_that_are_held_out_do_not_move_the_exposure() {
    let [truth, ..] = small();
    // Most are of the other power, so that they would carry the median.
    let folder = folder(&truth, |k| if k < 5 { 24.0 } else { 12.0 }, |k| LIGHTS[k]);
    let held = ["raw/0.npy", "raw/1", "raw/2.npy", "raw/3.npy", "raw/4"];
    let setting = setting(folder.path(), CaptureExposure::Capture, &held).unwrap();
    assert_eq!(setting.held_out(), "raw/0.npy, raw/1.npy, raw/2.npy, raw/3.npy, raw/4.npy");
    let report = compared(setting, &[&truth]);
    let result = &report.results[0];
    assert!((result.factor.unwrap() / (2.5 * 2.5 / 12.0) - 1.0).abs() < 1e-5);
    let [fitted, out] = result.means.clone().try_into().unwrap();
    assert_eq!([(fitted.name, fitted.count), (out.name, out.count)], [("fitted", 4), ("held out", 5)]);
    assert!(fitted.log.unwrap().mean < 1e-5 && out.log.unwrap().mean > 0.3, "{out:?}");
    assert_eq!(result.log(), out.log.unwrap().mean);
    // With everything fitted, they carry it: a planted fault of this test.
    let all = of_folder(folder.path(), &[&truth]);
    assert!((all.results[0].factor.unwrap() / (2.5 * 2.5 / 24.0) - 1.0).abs() < 1e-5);
    // Each photograph at its own exposure is right.
    let each = self::setting(folder.path(), CaptureExposure::Photograph, &[]).unwrap();
    let each = compared(each, &[&truth]);
    assert_eq!(each.results[0].factor, None);
    assert!(each.results[0].means[0].log.unwrap().mean < 1e-5);
}

#[test]
fn a_clipped_photograph_is_left_out_of_the_means() {
    let [truth, ..] = small();
    let folder = folder(&truth, |_| 12.0, |k| LIGHTS[k]);
    let path = folder.path().join("raw/3.npy");
    fs::write(&path, npy([SIDE as u64, SIDE as u64, 3], &vec![f32::NAN; SIDE * SIDE * 3])).unwrap();
    let report = of_folder(folder.path(), &[&truth]);
    let one = &report.results[0].photographs[3];
    assert_eq!((one.clipped, one.mean_log(), one.own_exposure_ev, one.ssim), (SIDE * SIDE, None, None, None));
    let log = report.results[0].means[0].log.unwrap();
    assert!(log.mean < 1e-5 && log.interval95.is_some());
    let csv = report.csv().unwrap();
    assert_eq!(csv.lines().count(), 1 + 1 + 9, "{csv}");
    let json: Value = serde_json::from_str(&report.json().unwrap()).unwrap();
    assert_eq!(json["results"][0]["photographs"][3]["log"], Value::Null);
    assert_eq!(json["scenes"].as_array().unwrap().len(), 9);
    for k in 0..9 {
        let values = vec![f32::NAN; SIDE * SIDE * 3];
        fs::write(folder.path().join(format!("raw/{k}.npy")), npy([SIDE as u64, SIDE as u64, 3], &values))
            .unwrap();
    }
    for exposure in CaptureExposure::ALL {
        let setting = setting(folder.path(), exposure, &[]).unwrap();
        let report = PhotoReport::new(setting, [("truth", &truth)], &Progress::default());
        assert!(matches!(report, Err(Error::NoExposure { .. })), "{exposure:?}");
    }
}

#[test]
fn captures_that_cannot_be_used_are_refused_with_their_reason() {
    let scene = json!({"kind": "near", "view": [0, 0, 2], "light": [0, 0, 2]});
    let distant = json!({"kind": "distant", "view": [0, 0, 2], "light": [0, 0, 2]});
    let one = json!({"file": "a.png", "scene": scene});
    let refusal = |capture: &Value| {
        let folder = tempdir().unwrap();
        write(folder.path(), capture);
        Capture::read(folder.path()).unwrap_err().to_string()
    };
    let absolute = if cfg!(windows) { "C:/a.png" } else { "/a.png" };
    for (capture, words) in [
        (json!({"photographs": []}), "expected 1 to 10000 photographs, found 0"),
        (json!({"photographs": [one, one]}), "it lists a.png twice"),
        (json!({"photographs": [one], "fallof": true}), "unknown key `fallof`"),
        (json!({"photographs": [{"file": "a.png"}]}), "no key `scene`"),
        (json!({"photographs": [one], "clip": -1}), "photograph 0: expected a clip above 0, found -1"),
        (
            json!({"photographs": [{"file": "a.png", "scene": distant}], "falloff": true}),
            "scene 0: expected a near one",
        ),
        (
            json!({"photographs": [{"file": "a.png", "scene": {"kind": "near", "view": [0, 0, -1], "light": [0, 0, 2]}}]}),
            "scene 0",
        ),
        (json!({"photographs": [{"file": absolute, "scene": scene}]}), "by an absolute path"),
        (json!({"photographs": [one], "transfer": "gamma"}), "unknown value `gamma`"),
        (json!({"camera_pos": []}), "no key"),
        (json!({"camera_pos": [[0, 0, 2]], "light_pos": [[0, 0, 2]], "im_size": 2}), "its target_dir"),
        (
            json!({"camera_pos": [[0, 0, 2]], "light_pos": [[0, 0, 2]], "im_size": 2, "target_dir": "t", "light_pow": [1, -1, 1]}),
            "above 0, found 1, -1, 1",
        ),
    ] {
        let refusal = refusal(&capture);
        assert!(refusal.contains(words) && refusal.contains("capture.json"), "{words}: {refusal}");
    }
    let empty = tempdir().unwrap();
    let error = Capture::read(empty.path()).unwrap_err().to_string();
    assert!(error.contains("it holds no list of photographs"), "{error}");
    let [truth, ..] = small();
    let folder = materialgan(&truth, [150.0; 3]);
    let text = fs::read_to_string(folder.path().join("render.json")).unwrap();
    fs::write(folder.path().join("other.json"), text.replace("150", "151")).unwrap();
    let error = Capture::read(folder.path()).unwrap_err().to_string();
    assert!(error.contains("several that differ: other.json, render.json; name one"), "{error}");
    assert!(Capture::read(&folder.path().join("render.json")).is_ok());
    let all = ["00", "01", "02", "03", "04", "05", "06", "07", "08"];
    for (hold_out, words) in [
        (&["9.png"][..], "unknown photograph `9.png`; use one of: 08.png, 07.png"),
        (&all, "every photograph is held out"),
    ] {
        let wrong = setting(&folder.path().join("render.json"), CaptureExposure::Capture, hold_out);
        assert!(wrong.unwrap_err().to_string().contains(words), "{words}");
    }
}
