//! Evaluations in the forms that research codes release them in: their losses are those of plain files of one size whose reading is stated.

use std::fs;
use std::path::Path;

use image::{Rgb, RgbImage, Rgba, RgbaImage};
use tempfile::TempDir;

use svbrdf_core::loss::Request;
use svbrdf_core::math::srgb;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::dataset::{
    DatasetReading, DatasetReport, DatasetSettings, Pick, Source, best_by_metric, decided, run,
};
use svbrdf_evaluate::protocols::{MaskSource, Protocol};
use svbrdf_files::arrays::{Array, Arrays};
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::read::{Albedo, ReadOptions};

use crate::support::surroundings::command;

/// The maps of a texel: normal, diffuse, roughness and specular, as stored.
type Texel = [[u8; 3]; 4];

/// Where diffuse and specular are stored.
type Curve = fn(f64) -> f64;

const REQUEST: Request = Request::Accuracy { target: 0.05, seed: 0 };
const MATERIALS: usize = 6;
const SIDE: u32 = 40;
const SRGB: Curve = |value| f64::from(srgb::encode(value as f32));
const LINEAR: Curve = |value| value;

/// A texel of a smooth material, and of what a method makes of it: rougher, and with a diffuse times `level`.
fn texel(material: usize, [x, y]: [u32; 2], encode: Curve, level: Option<f64>) -> Texel {
    let [u, v, seed] = [f64::from(x), f64::from(y), material as f64];
    let wave = |a: f64, b: f64, phase: f64| (a * u + b * v + phase + 1.7 * seed).sin();
    let normal = [0.35 * wave(0.31, 0.12, 0.0), 0.35 * wave(-0.09, 0.27, 1.0), 1.0];
    let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
    let bright = [0.45, 0.12, 0.25][material % 3];
    let diffuse = [1.0, 0.8, 0.6].map(|tint| tint * bright * (1.0 + 0.4 * wave(0.11, 0.17, 2.0)));
    let specular = 0.07 + 0.04 * wave(0.13, -0.21, 3.0);
    let rough = 0.5 + 0.2 * wave(0.19, 0.08, 4.0) + if level.is_some() { 0.08 } else { 0.0 };
    let code = |value: f64| (255.0 * value.clamp(0.0, 1.0)).round() as u8;
    [
        normal.map(|x| code(0.5 + 0.5 * x / length)),
        diffuse.map(|value| code(encode(value * level.unwrap_or(1.0)))),
        [code(rough); 3],
        [code(encode(specular)); 3],
    ]
}

/// Normal, diffuse, roughness and specular side by side, of the texels from `at` on.
fn strip(path: &Path, [at, side]: [u32; 2], of: impl Fn([u32; 2]) -> Texel) {
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    let pixel = |x: u32, y: u32| Rgb(of([at + x % side, at + y])[(x / side) as usize]);
    RgbImage::from_fn(4 * side, side, pixel).save(path).unwrap();
}

/// The losses of `ours`, read as `reading` states and, where it leaves something open, as the materials beside each other decide.
fn losses(folder: &Path, truths: &str, reading: DatasetReading) -> Vec<Result<f64, String>> {
    let report = report(folder, truths, reading, None);
    let one = |result: &svbrdf_evaluate::dataset::MaterialResult| {
        let prediction = &result.predictions[0];
        prediction.known.map(|known| known.loss).ok_or_else(|| prediction.error.clone().unwrap())
    };
    report.results.iter().map(one).collect()
}

/// The report of `ours`, by a protocol where one is given.
fn report(folder: &Path, truths: &str, reading: DatasetReading, protocol: Option<Protocol>) -> DatasetReport {
    let source = Source::folders(folder.join(truths), vec![(None, folder.join("ours"))]);
    let cases = source.cases().unwrap();
    let settings = DatasetSettings::new(source, ChosenConvention::default(), REQUEST, &cases);
    let metrics = protocol.as_ref().map(Protocol::selection);
    let reading = protocol.iter().fold(reading, DatasetReading::over);
    let settings = DatasetSettings { metrics, protocol, ..settings };
    let reading = decided(&cases, reading, &Progress::default()).unwrap();
    let found = run(&cases, &settings, &reading, None, &Progress::default()).unwrap();
    DatasetReport::new(settings, reading, found.answer, Pick::Fixed)
}

fn stated(truths: Albedo, ours: Albedo) -> DatasetReading {
    let options = |albedo| ReadOptions { albedo: Some(albedo), specular: Some(albedo), ..ReadOptions::AUTO };
    DatasetReading { ground_truths: options(truths), predictions: options(ours), ..DatasetReading::default() }
}

fn name(material: usize) -> String {
    format!("m{material}.png")
}

#[test]
fn a_method_is_read_as_it_is_stored_and_a_dark_one_is_not_flattered() {
    for (truths, ours, level) in
        [(SRGB, LINEAR, 1.0), (LINEAR, SRGB, 1.0), (SRGB, SRGB, 0.22), (LINEAR, LINEAR, 0.9)]
    {
        let folder = TempDir::new().unwrap();
        for material in 0..MATERIALS {
            let whole = [0, SIDE];
            let at = |folder_name: &str| folder.path().join(folder_name).join(name(material));
            strip(&at("gt"), whole, |at| texel(material, at, truths, None));
            strip(&at("ours"), whole, |at| texel(material, at, ours, Some(level)));
        }
        let [truths, ours] =
            [truths, ours].map(|curve| if curve(0.5) > 0.6 { Albedo::Srgb } else { Albedo::Linear });
        let expected = losses(folder.path(), "gt", stated(truths, ours));
        assert_eq!(
            losses(folder.path(), "gt", DatasetReading::default()),
            expected,
            "{truths} {ours} {level}"
        );
        let flattered = losses(folder.path(), "gt", stated(truths, Albedo::Log));
        assert_ne!(flattered, expected, "a planted reading is seen");
    }
}

#[test]
fn a_doubt_is_named_by_what_specifies_it() {
    let folder = TempDir::new().unwrap();
    for material in 0..MATERIALS {
        for (of, level) in [("gt", None), ("ours", Some(1.0))] {
            let path = folder.path().join(of).join(name(material));
            strip(&path, [0, SIDE], |at| texel(material, at, SRGB, level));
        }
    }
    let doubts = |reading| report(folder.path(), "gt", reading, None).doubts();
    let both = "6 of 6 with unsure albedo=srgb; 6 of 6 with unsure specular-albedo=srgb";
    assert_eq!(
        doubts(DatasetReading::default()),
        ["ground truths", "ours"].map(|of| format!("{of}: {both}"))
    );
    assert_eq!(doubts(stated(Albedo::Srgb, Albedo::Srgb)), [""; 0]);
}

#[test]
fn crops_and_names_of_a_method_are_found() {
    let folder = TempDir::new().unwrap();
    let (at, side) = (4, SIDE - 8);
    let path = |of: &str, file: &str| folder.path().join(of).join(file);
    for material in 0..MATERIALS {
        let truth = |at| texel(material, at, SRGB, None);
        strip(&path("gt", &format!("0{material};Oak_{material}.png")), [0, SIDE], truth);
        strip(&path("cropped", &format!("0{material};Oak_{material}.png")), [at, side], truth);
        for (index, map) in ["N", "D", "R", "S"].iter().enumerate() {
            let of = |x, y| Rgb(texel(material, [at + x, at + y], SRGB, Some(1.0))[index]);
            let file = path("ours", &format!("0{material}_{map}out.png"));
            fs::create_dir_all(file.parent().unwrap()).unwrap();
            RgbImage::from_fn(side, side, of).save(file).unwrap();
        }
    }
    let expected = losses(folder.path(), "cropped", stated(Albedo::Srgb, Albedo::Srgb));
    assert!(expected.iter().all(Result::is_ok), "{expected:?}");
    assert_eq!(losses(folder.path(), "gt", DatasetReading::default()), expected);
    // Of other materials, nothing is located.
    for material in 0..MATERIALS {
        let file = path("gt", &format!("0{material};Oak_{material}.png"));
        strip(&file, [0, SIDE], |[x, y]| texel(material + 50, [3 * y + 7, 2 * x], SRGB, None));
    }
    let unrelated = losses(folder.path(), "gt", DatasetReading::default());
    assert!(
        unrelated.iter().all(|loss| loss.as_ref().is_err_and(|why| why.contains("sizes differ"))),
        "{unrelated:?}"
    );
}

#[test]
fn the_order_under_other_questions_is_of_the_same_parts() {
    let folder = TempDir::new().unwrap();
    let (whole, part) = ([0, SIDE], [4, SIDE - 8]);
    for (root, others) in [("whole", whole), ("cut", part)] {
        for material in 0..MATERIALS {
            for (of, at, level) in
                [("gt", others, None), ("ours", part, Some(0.9)), ("theirs", others, Some(0.6))]
            {
                let path = folder.path().join(root).join(of).join(name(material));
                strip(&path, at, |at| texel(material, at, SRGB, level));
            }
        }
    }
    let order = |root: &str| {
        let mut rank = command(env!("CARGO_BIN_EXE_svbrdf"));
        rank.current_dir(folder.path().join(root));
        rank.args("rank --robust --dataset gt ours theirs --target-error 10% --format json".split(' '));
        rank.args(["gt", "pred"].map(|of| format!("--read={of}:albedo=srgb,specular-albedo=srgb")));
        let output = rank.output().unwrap();
        let notes = String::from_utf8(output.stderr).unwrap();
        assert!(!notes.contains("left out"), "{notes}");
        String::from_utf8(output.stdout).unwrap()
    };
    let found = order("whole");
    assert!(found.contains("\"order\""), "{found}");
    assert_eq!(found, order("cut"));
}

/// The made folders have the forms of a released evaluation: strips of linear ground truths, and their centres in files of maps of gamma 2.2
/// beside inputs and copies of the ground truths.
#[test]
fn a_protocol_gives_the_numbers_of_the_code_that_it_follows() {
    let folder = TempDir::new().unwrap();
    let (at, side) = (4, SIDE - 8);
    let gamma: Curve = |value| value.powf(0.4545);
    let path = |of: &str, file: String| folder.path().join(of).join(file);
    let mut expected = [0.0; 4];
    for material in 0..MATERIALS {
        let [truth, ours] = [(LINEAR, None), (gamma, Some(0.8))]
            .map(|(curve, level)| move |at| texel(material, at, curve, level));
        // The number of one is that of a size in texels.
        let number = format!("000006{material}");
        strip(&path("gt", format!("{number};Oak_{material}.png")), [0, SIDE], truth);
        let map = |index: usize| move |x, y| Rgb(ours([at + x, at + y])[index]);
        let save = |name: String, index| {
            fs::create_dir_all(path("ours", String::new())).unwrap();
            RgbImage::from_fn(side, side, map(index)).save(path("ours", name)).unwrap();
        };
        ["N", "D", "R", "S"]
            .iter()
            .enumerate()
            .for_each(|(index, map)| save(format!("{number}_{map}out.png"), index));
        save(format!("{number}_input.png"), 1);
        save(format!("gt_N_{material}.png"), 0);
        let value = |code: u8| f64::from(code) / 255.0;
        let read = |index: usize, [truth, ours]: [u8; 2]| match index {
            2 => [0.9 * value(truth) + 0.1, value(ours)],
            1 | 3 => [value(truth), value(ours).powf(2.2)],
            _ => [value(truth), value(ours)],
        };
        for (index, sum) in expected.iter_mut().enumerate() {
            let texels = (0..side).flat_map(|y| (0..side).map(move |x| [at + x, at + y]));
            let both = |place| [truth(place)[index], ours(place)[index]];
            let square = |place| -> f64 {
                let [a, b] = both(place);
                (0..3).map(|c| read(index, [a[c], b[c]])).map(|[a, b]| (a - b).powi(2)).sum::<f64>() / 3.0
            };
            *sum += (texels.map(square).sum::<f64>() / f64::from(side * side)).sqrt() / MATERIALS as f64;
        }
    }
    let weiyi = Protocol::read("weiyi").unwrap();
    let report = report(folder.path(), "gt", DatasetReading::default(), Some(weiyi));
    let rows = best_by_metric(&report);
    assert_eq!(rows.iter().map(|(row, _)| row.label.as_deref().unwrap()).collect::<String>(), "NDRS");
    for ((row, _), expected) in rows.iter().zip(expected) {
        let (found, _) = row.value(&report.methods[0]).unwrap();
        // Normals are normalized on reading.
        assert!(
            (found - expected).abs() < 0.005 * expected + 1e-9,
            "{}: {found}, not {expected}",
            row.title()
        );
    }
    let command = report.repetition.to_string();
    assert!(command.contains("--protocol weiyi") && !command.contains("--read"), "{command}");
}

#[test]
fn a_batch_of_arrays_is_as_many_materials() {
    const SIDE: usize = 12;
    let folder = TempDir::new().unwrap();
    let channel = |map: usize, c: usize, material: usize, at: usize, level: f64| {
        let wave = (0.37 * at as f64 + 1.3 * material as f64 + map as f64).sin();
        match (map, c) {
            (0, 2) => 1.0,
            (0, _) => 0.2 * wave,
            _ => level * (0.4 + 0.2 * wave + 0.05 * c as f64),
        }
    };
    let arrays = |materials: std::ops::Range<usize>, level: f64, is_batch: bool| {
        let of = |map: usize, name: &str, channels: usize| {
            let texels =
                materials.clone().flat_map(|material| (0..SIDE * SIDE).map(move |at| (material, at)));
            let values = texels
                .flat_map(|(material, at)| (0..channels).map(move |c| channel(map, c, material, at, level)));
            let shape = [materials.len(), SIDE, SIDE, channels];
            let shape = &shape[usize::from(!is_batch)..shape.len() - usize::from(channels == 1)];
            (name.to_owned(), Array::new(shape, values.collect()))
        };
        let all = [("normal", 3), ("diffuse", 3), ("specular", 3), ("roughness", 1)];
        let all = all.into_iter().enumerate().map(|(map, (name, channels))| of(map, name, channels));
        all.collect::<Arrays>()
    };
    let write = |path: &str, arrays: &Arrays| {
        let path = folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        svbrdf_files::arrays::write(&path, arrays, &Progress::default()).unwrap();
    };
    for (name, level) in [("gt", 1.0), ("ours", 0.8)] {
        write(&format!("batch/{name}.npz"), &arrays(0..3, level, true));
        for material in 0..3 {
            let file = format!("single/{name}/000{}.npz", material + 1);
            write(&file, &arrays(material..material + 1, level, false));
        }
    }
    let of = |truths: &str, ours: &str| {
        let [truths, ours] = [truths, ours].map(|path| folder.path().join(path));
        let source = Source::folders(truths, vec![(None, ours)]);
        let cases = source.cases().unwrap();
        let settings = DatasetSettings::new(source, ChosenConvention::default(), REQUEST, &cases);
        let found = run(&cases, &settings, &DatasetReading::default(), None, &Progress::default()).unwrap();
        let one = |result: &svbrdf_evaluate::dataset::MaterialResult| {
            (result.material.clone(), result.predictions[0].known.map(|known| known.loss))
        };
        (settings.methods, found.answer.iter().map(one).collect::<Vec<_>>())
    };
    let expected = of("single/gt", "single/ours");
    assert!(expected.1.iter().all(|(_, loss)| loss.is_some()), "{expected:?}");
    assert_eq!(of("batch/gt.npz", "batch/ours.npz"), expected);
}

#[test]
fn texels_outside_of_a_mask_do_not_count() {
    let folder = TempDir::new().unwrap();
    let maps = ["normal", "diffuse", "roughness", "specular"];
    let is_inside = |[x, y]: [u32; 2]| (x.abs_diff(SIDE / 2)).pow(2) + (y.abs_diff(SIDE / 2)).pow(2) < 160;
    let write = |outside: u8| {
        for material in 0..MATERIALS {
            for (index, map) in maps.iter().enumerate() {
                let truth = |x, y| {
                    let [r, g, b] = texel(material, [x, y], SRGB, None)[index];
                    Rgba([r, g, b, if is_inside([x, y]) { 255 } else { 0 }])
                };
                let ours = |x, y| match (index, is_inside([x, y])) {
                    (1 | 2, false) => Rgb([outside; 3]),
                    _ => Rgb(texel(material, [x, y], SRGB, Some(1.0))[index]),
                };
                let path =
                    |of: &str| folder.path().join(of).join(format!("m{material}")).join(format!("{map}.png"));
                ["gt", "ours"].iter().for_each(|of| fs::create_dir_all(path(of).parent().unwrap()).unwrap());
                RgbaImage::from_fn(SIDE, SIDE, truth).save(path("gt")).unwrap();
                RgbImage::from_fn(SIDE, SIDE, ours).save(path("ours")).unwrap();
            }
        }
    };
    let by = |mask: Option<MaskSource>| {
        losses(folder.path(), "gt", DatasetReading { mask, ..stated(Albedo::Srgb, Albedo::Srgb) })
    };
    let of = |mask: bool| by(mask.then_some(MaskSource::Alpha));
    let pictures = folder.path().join("masks");
    fs::create_dir(&pictures).unwrap();
    for material in 0..MATERIALS {
        let white = |x, y| Rgb([if is_inside([x, y]) { 255 } else { 0 }; 3]);
        RgbImage::from_fn(SIDE, SIDE, white).save(pictures.join(name(material))).unwrap();
    }
    let picture = || Some(MaskSource::File(pictures.join("{}.png")));
    write(0);
    let [masked, whole] = [of(true), of(false)];
    write(255);
    assert_eq!(of(true), masked);
    assert_eq!(by(picture()), masked);
    assert_ne!(of(false), whole);
    // A mask is cut with its ground truth: a crop that has all of it changes what lies around the texels alone.
    for material in 0..MATERIALS {
        for map in maps {
            let file = folder.path().join("ours").join(format!("m{material}")).join(format!("{map}.png"));
            let cut = image::open(&file).unwrap().crop_imm(4, 4, SIDE - 8, SIDE - 8);
            cut.save(&file).unwrap();
        }
    }
    let cropped = by(picture());
    let pairs = cropped.iter().zip(&masked).map(|(a, b)| a.as_ref().unwrap() / b.as_ref().unwrap());
    assert!(pairs.clone().all(|ratio| (0.9..1.1).contains(&ratio)), "{cropped:?} {masked:?}");
    let is_less = |(masked, whole): (&Result<f64, String>, &Result<f64, String>)| {
        masked.as_ref().unwrap() < whole.as_ref().unwrap()
    };
    assert!(masked.iter().zip(&whole).all(is_less), "{masked:?} {whole:?}");
}
