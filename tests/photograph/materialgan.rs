//! Captures in MaterialGAN's formats: its JSON, and the text files of its first release.

use std::fs;
use std::path::Path;

use svbrdf_evaluate::photograph::{CaptureExposure, PhotoReport};
use svbrdf_evaluate::report::Report as _;
use svbrdf_files::photograph::Capture;
use svbrdf_files::read::{PhotographOptions, Transfer};

use super::captures::{LIGHTS, compared, materialgan, of_folder, setting, view};
use super::small;

#[test]
fn a_capture_of_materialgan_has_the_exposure_of_its_light() {
    let [truth, _, rough] = small();
    let folder = materialgan(&truth, [150.0, 120.0, 180.0]);
    // Another program of the same capture, with other results.
    let text = fs::read_to_string(folder.path().join("render.json")).unwrap();
    let other = text.replace("optim_latent/256", "optim_latent/1024");
    fs::write(folder.path().join("optim_latent_1024.json"), &other).unwrap();
    fs::write(folder.path().join("notes.json"), "[1, 2]").unwrap();
    let report = of_folder(folder.path(), &[&rough, &truth]);
    let result = &report.results[0];
    assert_eq!(result.material, truth.name());
    assert_eq!(report.photographs[0].name, "08.png");
    assert_eq!(report.photographs[0].transfer_from, "as MaterialGAN encodes");
    let ev = (result.factor.unwrap() / report.setting.declared_factor().unwrap()).log2();
    assert!(ev.abs() < 0.01, "{ev} stops from light_pow");
    let log = result.means[0].log.unwrap().mean;
    assert!(log < 0.02 && report.results[1].log() > 2.0 * log, "{log}");
    assert!(report.text().contains("gamma 2.2 as MaterialGAN encodes, falloff of the light divided out"));
    // Planted faults: the colour of the light ignored, another power, another curve.
    let of = |from: &str, to: &str| {
        fs::remove_file(folder.path().join("optim_latent_1024.json")).ok();
        fs::write(folder.path().join("render.json"), text.replace(from, to)).unwrap();
        let setting = setting(folder.path(), CaptureExposure::Capture, &[]).unwrap();
        let report = compared(setting, &[&truth]);
        let factor = report.results[0].factor.unwrap() / report.setting.declared_factor().unwrap();
        (factor.log2(), report.results[0].log())
    };
    let white = of("[150.0,120.0,180.0]", "[150.0,150.0,150.0]");
    assert!(white.1 > 2.0 * log, "{white:?}");
    let double = of("[150.0,120.0,180.0]", "[300.0,240.0,360.0]");
    assert!((double.0 - 1.0 - ev).abs() < 1e-6, "{double:?}");
    fs::write(folder.path().join("render.json"), &text).unwrap();
    let mut setting = setting(folder.path(), CaptureExposure::Capture, &[]).unwrap();
    let linear = PhotographOptions { transfer: Some(Transfer::Linear), clip: None, light_colour: None };
    setting.capture = setting.capture.with_options(&linear);
    assert!(compared(setting, &[&truth]).results[0].log() > 0.1);
}

/// The same capture in the text files of the first release, which have the photographs in the order of their numbers.
fn with_texts(folder: &Path, power: [f64; 3]) {
    let line = |place: [f64; 3]| place.map(|c| format!("{c:.4}")).join(",") + "\n";
    let half_width = 3.424;
    let of = |place: &dyn Fn([f64; 3]) -> [f64; 3]| -> String {
        LIGHTS.into_iter().rev().map(|light| line(place(light).map(|c| half_width * c))).collect()
    };
    for (name, text) in [
        ("camera_pos.txt", of(&view)),
        ("light_pos.txt", of(&|light| light)),
        ("image_size.txt", format!("{:.4}\n", 2.0 * half_width)),
        ("light_power.txt", line(power)),
    ] {
        fs::write(folder.join(name), text).unwrap();
    }
    for photograph in fs::read_dir(folder.join("target")).unwrap() {
        let photograph = photograph.unwrap();
        fs::rename(photograph.path(), folder.join(photograph.file_name())).unwrap();
    }
}

#[test]
fn the_text_files_of_materialgan_are_the_same_capture_as_its_json() {
    let [truth, _, rough] = small();
    let power = [150.0, 120.0, 180.0];
    let folder = materialgan(&truth, power);
    let json = of_folder(folder.path(), &[&rough, &truth]);
    fs::remove_file(folder.path().join("render.json")).unwrap();
    with_texts(folder.path(), power);
    let names: Vec<&str> = json.photographs.iter().map(|one| one.name.as_str()).collect();
    for path in [folder.path().to_owned(), folder.path().join("camera_pos.txt")] {
        let texts = of_folder(&path, &[&rough, &truth]);
        assert_eq!(texts.photographs.iter().map(|one| one.name.as_str()).rev().collect::<Vec<_>>(), names);
        for (a, b) in texts.results.iter().zip(&json.results) {
            assert_eq!(a.material, b.material);
            // Positions have four digits behind the point.
            assert!((a.log() / b.log() - 1.0).abs() < 1e-3, "{} and {}", a.log(), b.log());
        }
        let ev = |report: &PhotoReport| {
            (report.results[0].factor.unwrap() / report.setting.declared_factor().unwrap()).log2()
        };
        assert!((ev(&texts) - ev(&json)).abs() < 1e-3 && ev(&texts).abs() < 0.01, "{}", ev(&texts));
    }
    // Planted faults: another order, a missing file.
    let lights = fs::read_to_string(folder.path().join("light_pos.txt")).unwrap();
    let reversed: String = lights.lines().rev().flat_map(|line| [line, "\n"]).collect();
    fs::write(folder.path().join("light_pos.txt"), reversed).unwrap();
    assert!(of_folder(folder.path(), &[&truth]).results[0].log() > 2.0 * json.results[0].log());
    fs::remove_file(folder.path().join("image_size.txt")).unwrap();
    let error = Capture::read(folder.path()).unwrap_err().to_string();
    assert!(error.contains("image_size.txt"), "{error}");
}

#[test]
fn a_calibration_with_a_mistake_is_named_and_not_overlooked() {
    let [truth, ..] = small();
    let folder = materialgan(&truth, [150.0, 120.0, 180.0]);
    let path = folder.path().join("render.json");
    let text = fs::read_to_string(&path).unwrap();
    let size = text.split("\"im_size\":").nth(1).unwrap().split([',', '}']).next().unwrap().to_owned();
    let quoted = text.replace(&format!("\"im_size\":{size}"), &format!("\"im_size\":\"{}\"", size.trim()));
    assert_ne!(quoted, text);
    fs::write(&path, quoted).unwrap();
    let error = Capture::read(folder.path()).unwrap_err().to_string();
    assert!(
        error.contains("render.json") && error.contains("found string \"6.848\", expected a number"),
        "{error}"
    );
}
