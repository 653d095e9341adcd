//! Photographs that our own renderer makes: what is known of them has to come out.

use std::fs;
use std::path::Path;

use exr::prelude::{AnyChannel, AnyChannels, FlatSamples, Image as Exr, WritableImage as _};
use glam::DVec3;
use image::{Rgb, RgbImage};
use serde_json::{Value, json};
use tempfile::{TempDir, tempdir};

use svbrdf_core::image::Image;
use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::{Model, reflectance};
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_f32;
use svbrdf_evaluate::Error;
use svbrdf_evaluate::photograph::{PhotoReport, compare, on_texels};
use svbrdf_evaluate::report::{Json as _, Report as _};
use svbrdf_files::disk::open::NamedFile;
use svbrdf_files::photograph::Capture;
use svbrdf_files::read::{Albedo, Photograph, read_photograph};
use svbrdf_files::samples;

use crate::support::npy::npy;
use crate::support::png::{Png, RGB};

const SIDE: usize = 64;
/// A light and a view of a hand-held photograph.
const SCENE: Scene = Scene { kind: Kind::Near, view: [0.2, -0.1, 2.4], light: [0.5, 0.3, 1.6] };
/// Of each photograph of a capture: a light, and a view near it.
const LIGHTS: [[f64; 3]; 5] =
    [[-0.8, 0.7, 2.5], [0.1, 0.9, 3.0], [0.9, 0.8, 2.2], [-0.7, -0.9, 2.4], [0.8, -0.1, 3.5]];
/// The power of the light of a capture.
const POWER: f64 = 12.0;

/// The built-in ground truth and its predictions, 64 x 64.
fn small() -> [Material<f32>; 3] {
    let built_in = samples::load::<f32>().unwrap();
    let all = std::iter::once(built_in.ground_truth).chain(built_in.predictions);
    let all: Vec<_> = all.map(|read| read.material.resized([SIDE, SIDE]).unwrap()).collect();
    all.try_into().unwrap()
}

/// Radiance `f NoL / d^2` under a point light of power 1, in f64.
fn physical(material: &Material<f32>, light: [f64; 3]) -> Vec<[f64; 3]> {
    let (grid, model, exact) = (material.grid(), Model::from(&PRINTED), material.cast::<f64>());
    let texel = |i: usize| {
        let place: DVec3 = grid.position(i % material.width(), i / material.width());
        let texel = exact.texel(i);
        let (to_light, to_view) =
            (DVec3::from(light) - place, (DVec3::from(view(light)) - place).normalize());
        let l = to_light.normalize();
        let n_dot_l = texel.normal.dot(l).max(0.0);
        reflectance(&model, &texel, l, to_view).map(|f| f * n_dot_l / to_light.length_squared())
    };
    (0..material.width() * material.height()).map(texel).collect()
}

fn view(light: [f64; 3]) -> [f64; 3] {
    [light[0] + 0.1, light[1] - 0.1, light[2]]
}

/// The folder of a capture of `material`: floats, of a light of the power `POWER` with falloff.
fn folder(material: &Material<f32>) -> TempDir {
    let folder = tempdir().unwrap();
    let mut listed = Vec::new();
    for (k, light) in LIGHTS.into_iter().enumerate() {
        let values = physical(material, light).into_iter().flatten().map(|value| (POWER * value) as f32);
        write_floats(folder.path(), k, &values.collect::<Vec<_>>());
        let scene = json!({"kind": "near", "view": view(light), "light": light});
        listed.push(json!({"file": format!("{k}.npy"), "scene": scene}));
    }
    write(folder.path(), &json!({"falloff": true, "photographs": listed}));
    folder
}

fn write_floats(folder: &Path, k: usize, values: &[f32]) {
    fs::write(folder.join(format!("{k}.npy")), npy([SIDE as u64, SIDE as u64, 3], values)).unwrap();
}

fn write(folder: &Path, capture: &Value) {
    fs::write(folder.join("capture.json"), capture.to_string()).unwrap();
}

fn report(capture: &Capture, materials: &[&Material<f32>]) -> Result<PhotoReport, Error> {
    let named = materials.iter().map(|material| (material.name(), *material));
    PhotoReport::new(capture, named, &PRINTED, &Progress::default())
}

fn of_folder(folder: &Path, materials: &[&Material<f32>]) -> PhotoReport {
    report(&Capture::read(folder).unwrap(), materials).unwrap()
}

#[test]
fn a_capture_of_known_lights_has_one_exposure_and_ranks_the_right_material_first() {
    let [truth, blurred, rough] = small();
    let folder = folder(&truth);
    let found = of_folder(folder.path(), &[&rough, &truth, &blurred]);
    let [right, wrong] = [&found.results[0], &found.results[1]];
    assert_eq!(right.material, truth.name());
    assert!((right.factor * POWER - 1.0).abs() < 1e-5, "{}", right.factor);
    let (log, worse) = (right.log.unwrap(), wrong.log.unwrap());
    assert!(log < 1e-5 && worse > 0.01 && right.photographs.iter().all(|one| one.log.unwrap() < 1e-5));
    // Planted faults: photographs with their falloff, one of twice the power, and one that is lit from elsewhere.
    let list = fs::read_to_string(folder.path().join("capture.json")).unwrap();
    let log = || of_folder(folder.path(), &[&truth]).results[0].log.unwrap();
    fs::write(folder.path().join("capture.json"), list.replace("true", "false")).unwrap();
    assert!(log() > 0.05);
    fs::write(folder.path().join("capture.json"), &list).unwrap();
    for (power, light) in [(2.0 * POWER, LIGHTS[3]), (POWER, [0.9, 0.9, 1.2])] {
        let values = physical(&truth, light).into_iter().flatten().map(|value| (power * value) as f32);
        write_floats(folder.path(), 3, &values.collect::<Vec<_>>());
        assert!(log() > 0.02, "{}", log());
        let found = of_folder(folder.path(), &[&truth]);
        let by_photograph = |k: usize| found.results[0].photographs[k].log.unwrap();
        assert!(by_photograph(3) > 0.1 && by_photograph(0) < 0.05, "{power}");
    }
    // A clipped one is left out.
    write_floats(folder.path(), 3, &[f32::NAN; SIDE * SIDE * 3]);
    let found = of_folder(folder.path(), &[&truth]);
    let one = &found.results[0].photographs[3];
    assert_eq!((one.clipped, one.log, one.rmse, one.ssim), (SIDE * SIDE, None, None, None));
    assert!(found.results[0].log.unwrap() < 1e-5 && (found.results[0].clipped - 0.2).abs() < 1e-12);
    let json: Value = serde_json::from_str(&found.json().unwrap()).unwrap();
    assert_eq!(json["results"][0]["photographs"][3]["log"], Value::Null);
    assert_eq!(json["scenes"].as_array().unwrap().len(), LIGHTS.len());
    (0..LIGHTS.len()).for_each(|k| write_floats(folder.path(), k, &[f32::NAN; SIDE * SIDE * 3]));
    let refused = report(&Capture::read(folder.path()).unwrap(), &[&truth]);
    assert!(refused.unwrap_err().to_string().contains("every texel is clipped"));
}

/// A capture of MaterialGAN: its renderer, in centimetres, and its file.
#[test]
fn a_capture_of_materialgan_is_one_of_its_lights() {
    let [truth, _, rough] = small();
    let (folder, half_width, power) = (tempdir().unwrap(), 3.424, 150.0);
    fs::create_dir(folder.path().join("target")).unwrap();
    for (k, light) in LIGHTS.into_iter().enumerate() {
        let radiance = physical(&truth, light);
        let code = |value: f64| {
            (255.0 * (power * value / (half_width * half_width)).min(1.0).powf(1.0 / 2.2)).round() as u8
        };
        let picture = RgbImage::from_fn(SIDE as u32, SIDE as u32, |x, y| {
            Rgb(radiance[y as usize * SIDE + x as usize].map(code))
        });
        // The number of a photograph is not its place in the list.
        picture.save(folder.path().join(format!("target/{:02}.png", 4 - k))).unwrap();
    }
    let centimetres = |place: [f64; 3]| place.map(|c| half_width * c);
    let calibration = json!({
        "_comment": "in cm uint", "target_dir": "target", "im_size": 2.0 * half_width, "idx": [4, 3, 2, 1, 0],
        "light_pow": [power, power, power],
        "camera_pos": LIGHTS.into_iter().rev().map(|light| centimetres(view(light))).collect::<Vec<_>>(),
        "light_pos": LIGHTS.into_iter().rev().map(centimetres).collect::<Vec<_>>(),
    });
    let list = |calibration: &Value| {
        fs::write(folder.path().join("render.json"), calibration.to_string()).unwrap();
        Capture::read(folder.path())
    };
    let capture = list(&calibration).unwrap();
    let found = report(&capture, &[&rough, &truth]).unwrap();
    assert_eq!(
        (found.results[0].material.as_str(), capture.photographs[0].name.as_str()),
        (truth.name(), "04.png")
    );
    let factor = found.results[0].factor * power / (half_width * half_width);
    assert!(factor.log2().abs() < 0.01, "{factor}");
    let [log, worse] = [0, 1].map(|k| found.results[k].log.unwrap());
    assert!(log < 0.02 && worse > 2.0 * log, "{log}, {worse}");
    assert!(found.text().contains("gamma 2.2 as specified, falloff of the light divided out"));
    // Planted faults: another curve, photographs in another order.
    let mut wrong = capture.clone();
    wrong.photographs.iter_mut().for_each(|one| one.transfer = Some(Albedo::Linear));
    assert!(report(&wrong, &[&truth]).unwrap().results[0].log.unwrap() > 0.1);
    let mut wrong = calibration.clone();
    wrong["idx"] = json!([0, 1, 2, 3, 4]);
    wrong["light_pos"].as_array_mut().unwrap().reverse();
    assert!(report(&list(&wrong).unwrap(), &[&truth]).unwrap().results[0].log.unwrap() > 2.0 * log);
    for (key, value, words) in [
        ("light_pow", json!([1, 2, 1]), "expected a white light, found the light_pow 1, 2, 1"),
        ("im_size", json!("6.8"), "found string \"6.8\", expected a number"),
        ("im_size", json!(0), "not a width"),
        ("target_dir", Value::Null, "its target_dir"),
    ] {
        let mut wrong = calibration.clone();
        wrong[key] = value;
        let refusal = list(&wrong).unwrap_err().to_string();
        assert!(refusal.contains(words) && refusal.contains("render.json"), "{words}: {refusal}");
    }
}

#[test]
fn captures_that_cannot_be_used_are_refused_with_their_reason() {
    let scene = json!({"kind": "near", "view": [0, 0, 2], "light": [0, 0, 2]});
    let distant = json!({"kind": "distant", "view": [0, 0, 2], "light": [0, 0, 2]});
    let below = json!({"kind": "near", "view": [0, 0, -1], "light": [0, 0, 2]});
    let of = |file: &str, scene: &Value| json!({"file": file, "scene": scene});
    let one = of("a.png", &scene);
    let absolute = if cfg!(windows) { "C:/a.png" } else { "/a.png" };
    for (capture, words) in [
        (json!({"photographs": []}), "expected 1 to 10000 photographs, found 0"),
        (json!({"photographs": [one, one]}), "it lists a.png twice"),
        (json!({"photographs": [one], "fallof": true}), "unknown key `fallof`"),
        (json!({"photographs": [{"file": "a.png"}]}), "no key `scene`"),
        (json!({"photographs": [of("a.png", &distant)], "falloff": true}), "scene 0: expected a near one"),
        (json!({"photographs": [of("a.png", &below)]}), "scene 0"),
        (json!({"photographs": [of(absolute, &scene)]}), "by an absolute path"),
        (json!({"photographs": [one], "transfer": "gamma"}), "unknown value `gamma`"),
    ] {
        let folder = tempdir().unwrap();
        write(folder.path(), &capture);
        let refusal = Capture::read(folder.path()).unwrap_err().to_string();
        assert!(refusal.contains(words) && refusal.contains("capture.json"), "{words}: {refusal}");
    }
    let refusal = Capture::read(tempdir().unwrap().path()).unwrap_err().to_string();
    assert!(refusal.contains("it has neither of these files"), "{refusal}");
}

fn photograph(width: usize, height: usize, at: impl Fn(usize, usize) -> [f32; 3]) -> Photograph {
    let pixels = (0..width * height).map(|i| at(i % width, i / width)).collect();
    let image = Image { width, height, pixels };
    Photograph { image, transfer: Albedo::Linear, transfer_from: "as specified", notes: Vec::new() }
}

#[test]
fn a_photograph_is_averaged_over_each_texel_and_taken_as_it_is_in_the_size_of_the_material() {
    let [truth, ..] = small();
    let rendering = render_f32(&truth, &SCENE, &PRINTED, &Progress::default()).unwrap();
    let at = |x: usize, y: usize| rendering.pixels[y * SIDE + x];
    let whole = on_texels(&photograph(SIDE, SIDE, at), "p", [SIDE; 2], None).unwrap();
    assert_eq!(whole, rendering);
    // Of 3 x 3 pixels a texel, with a pattern that averages out; one pixel is clipped.
    let larger = photograph(3 * SIDE, 3 * SIDE, |x, y| {
        let pattern = 1.0 + if (x % 3, y % 3) == (1, 1) { 0.8 } else { -0.1 };
        if (x, y) == (7, 5) { [f32::NAN; 3] } else { at(x / 3, y / 3).map(|value| 4.0 * pattern * value) }
    });
    let photographs = [(on_texels(&larger, "p", [SIDE; 2], None).unwrap(), SCENE)];
    let compared = &compare(&photographs, &truth, "", &PRINTED, &Progress::default()).unwrap()[0];
    assert!((compared.factor / 0.25 - 1.0).abs() < 1e-5 && compared.clipped() == 1, "{}", compared.factor);
    assert!(compared.photograph.pixels[SIDE + 2][0].is_nan());
    let near = compared.photograph.pixels.iter().flatten().zip(rendering.pixels.iter().flatten());
    assert!(near.filter(|(g, _)| !g.is_nan()).all(|(g, p)| (g - p).abs() < 1e-5 * (1.0 + p)));
    let refusal = on_texels(&photograph(SIDE, SIDE + 2, |_, _| [1.0; 3]), "p", [SIDE; 2], None).unwrap_err();
    assert!(refusal.to_string().contains("p is 64 x 66, the material is 64 x 64"), "{refusal}");
}

/// A picture of 3 x 2 pixels.
fn three_by_two(depth: u8, chunks: &[([u8; 4], Vec<u8>)]) -> Vec<u8> {
    Png { size: [3, 2], depth, colour: RGB, interlaced: false, chunks }
        .bytes(|x, y, c| (10 * (x + 3 * y) + c) as u16)
}

fn read(path: &Path, transfer: Option<Albedo>) -> Result<Photograph, svbrdf_files::Error> {
    read_photograph(&NamedFile::by_user(path), transfer)
}

#[test]
fn the_curve_is_that_of_the_option_of_the_file_or_of_the_kind_of_samples() {
    let folder = tempdir().unwrap();
    let of = |name: &str, bytes: &[u8], transfer: Option<Albedo>| {
        fs::write(folder.path().join(name), bytes).unwrap();
        let found = read(&folder.path().join(name), transfer).unwrap();
        (found.transfer, found.transfer_from, found.notes.len())
    };
    let gamma = [(*b"gAMA", 100_000_u32.to_be_bytes().to_vec())];
    let (srgb, integers, specified) = (Some(Albedo::Srgb), "since it stores integers", "as specified");
    let (plain, declared) = (three_by_two(16, &[]), three_by_two(16, &gamma));
    let floats = npy([2, 3, 3], &[0.25; 18]);
    assert_eq!(of("16.png", &plain, None), (Albedo::Srgb, integers, 0));
    assert_eq!(of("g.png", &declared, None), (Albedo::Linear, "declared by its gAMA chunk", 0));
    let declared_by_cicp = three_by_two(16, &[(*b"cICP", vec![1, 8, 0, 1])]);
    assert_eq!(of("c.png", &declared_by_cicp, None), (Albedo::Linear, "declared by its cICP chunk", 0));
    // What the option overrides is said.
    assert_eq!(of("g.png", &declared, srgb), (Albedo::Srgb, specified, 1));
    assert_eq!(of("f.npy", &floats, None), (Albedo::Linear, "since it stores floats", 0));
    assert_eq!(of("f.npy", &floats, srgb), (Albedo::Srgb, specified, 0));
}

#[test]
fn a_photograph_is_turned_by_its_orientation_and_nan_where_it_is_clipped() {
    let folder = tempdir().unwrap();
    // Orientation 6: row 0 is the right side.
    let exif = b"MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0".to_vec();
    let path = folder.path().join("turned.png");
    fs::write(&path, three_by_two(8, &[(*b"eXIf", exif)])).unwrap();
    let turned = read(&path, Some(Albedo::Linear)).unwrap();
    assert_eq!((turned.image.width, turned.image.height, turned.notes.len()), (2, 3, 0));
    let red: Vec<u32> = turned.image.pixels.iter().map(|rgb| (255.0 * rgb[0]).round() as u32).collect();
    assert_eq!(red, [30, 0, 40, 10, 50, 20]);

    let nan = |rgb: &[f32; 3]| rgb.iter().all(|value| value.is_nan());
    let clipped =
        |path: &Path| -> Vec<bool> { read(path, None).unwrap().image.pixels.iter().map(nan).collect() };
    let path = folder.path().join("white.png");
    RgbImage::from_fn(3, 1, |x, _| Rgb([9, 253 + x as u8, 0])).save(&path).unwrap();
    assert_eq!(clipped(&path), [false, false, true]);
    let path = folder.path().join("gray.npy");
    fs::write(&path, npy([1, 4, 1], &[0.5, f32::NAN, 7.0, f32::INFINITY])).unwrap();
    assert_eq!(clipped(&path), [false, true, false, true]);
    assert_eq!(read(&path, None).unwrap().image.pixels[2], [7.0; 3], "gray stands for all channels");
}

#[test]
fn what_is_no_photograph_is_refused_with_its_reason() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("text.png"), "not an image").unwrap();
    let channel = |name: &str| AnyChannel::new(name, FlatSamples::F32(vec![0.5; 4]));
    for (name, channels) in
        [("layers.exr", ["beauty.Y", "depth.Y"]), ("xy.exr", ["X", "Y"]), ("unnamed.exr", ["Y", "depth.Y"])]
    {
        let channels = AnyChannels::sort(channels.map(channel).into_iter().collect());
        Exr::from_channels((2, 2), channels).write().to_file(at(name)).unwrap();
    }
    assert_eq!(read(&at("unnamed.exr"), None).unwrap().image.width, 2);
    for (name, words) in [
        ("text.png", "photograph: expected PNG"),
        ("absent.png", "cannot read"),
        ("xy.exr", "photograph: expected gray or RGB, found 2 channels; convert it to RGB"),
        ("layers.exr", "photograph: expected one picture, found the layers beauty, depth; save the layer"),
    ] {
        let refusal = read(&at(name), None).unwrap_err().to_string();
        assert!(refusal.contains(words) && refusal.contains(name), "{name}: {refusal}");
    }
}
