//! `svbrdf diagnose`: planted errors of files, and the options that correct them.

use std::path::Path;

use serde_json::Value;

use super::{assert_has, data_set, fail, folder, json_of, loss_of, rows, rows_of, succeed, write_tiles};

const SIDE: u32 = 16;
const READ: &str = "--preset deschaintre --read order=ndrs";

/// Writes a packed material with bumps; `change` sees each stored texel of a map (0 normals, 1 diffuse, 2 roughness, 3 specular).
fn write(path: &Path, change: impl Fn(u32, [u8; 3]) -> [u8; 3]) {
    write_of(SIDE, path, change);
}

fn write_of(side: u32, path: &Path, change: impl Fn(u32, [u8; 3]) -> [u8; 3]) {
    let wave = |x: u32, y: u32, by: f32| {
        (0.5 + 0.5 * (0.9 * x as f32 + by).sin() * (0.7 * y as f32 + 2.0 * by).cos()) * 255.0
    };
    write_tiles(path, side, |x, y| {
        let (tile, x) = (x / side, x % side);
        let texel = match tile {
            0 => [90.0 + 0.3 * wave(x, y, 0.0), 80.0 + 0.35 * wave(x, y, 1.0), 235.0].map(|v| v as u8),
            1 => [60.0 + 0.5 * wave(x, y, 0.3), 50.0 + 0.3 * wave(x, y, 0.3), 30.0].map(|v| v as u8),
            2 => [(60.0 + 0.2 * wave(x, y, 2.0)) as u8; 3],
            _ => [12; 3],
        };
        change(tile, texel)
    });
}

/// Rounding: an eighth of the values is one step away.
fn rounded(_: u32, [r, g, b]: [u8; 3]) -> [u8; 3] {
    [r, g + u8::from(r % 8 == 0), b]
}

/// The advice replaces the options of this material: with `albedo` alone specular would be read as its specified option says, or not.
#[test]
fn planted_readings_are_found_and_their_options_give_the_losses_that_were_computed() {
    let folder = folder();
    let at = folder.path();
    let encoded = |v: u8| (255.0 * (f32::from(v) / 255.0).powf(1.0 / 2.2)).round() as u8;
    write(&at.join("truth.png"), |_, texel| texel);
    write(&at.join("directx.png"), |tile, [r, g, b]| if tile == 0 { [r, 255 - g, b] } else { [r, g, b] });
    write(&at.join("gloss.png"), |tile, texel| if tile == 2 { texel.map(|v| 255 - v) } else { texel });
    write(&at.join("encoded.png"), |tile, texel| if tile % 2 == 1 { texel.map(encoded) } else { texel });
    write(&at.join("swapped.png"), |tile, [r, g, b]| if tile == 1 { [b, g, r] } else { [r, g, b] });
    let command = format!(
        "diagnose truth.png directx.png gloss.png encoded.png swapped.png {READ} --read encoded:specular-albedo=linear"
    );
    let printed = json_of(at, &command);
    let finding = |prediction: usize, hypothesis: &str| -> &Value {
        let findings = printed["predictions"][prediction]["findings"].as_array().unwrap();
        findings.iter().find(|finding| finding["hypothesis"] == hypothesis).unwrap()
    };
    // 2,048 + 1,024 scrambled Sobol scenes of the same seed, of maps as small as these on all texels.
    let loss = |name: &str, options: &str| {
        let scenes = "--near 2048 --distant 1024 --sampler sobol";
        loss_of(at, &format!("truth.png {name}.png {READ} {options} {scenes}"))
    };
    for (prediction, name, hypothesis, marked, option) in [
        (0, "directx", "normal_y", "flipped", "directx:normal-y=down"),
        (1, "gloss", "roughness", "gloss", "gloss:roughness=gloss"),
        (2, "encoded", "albedo_encoding", "", ""),
        (2, "encoded", "diffuse_encoding", "", ""),
        (2, "encoded", "specular_encoding", "", ""),
    ] {
        let found = finding(prediction, hypothesis);
        let remedy = found["remedy"].as_str().unwrap();
        let (got, expected) = (found["loss"].as_f64().unwrap(), loss(name, &format!("--read {remedy}")));
        assert!((got - expected).abs() < 1e-4 * expected + 1e-6, "{name} {remedy}: {got} {expected}");
        if !marked.is_empty() {
            let prediction = &printed["predictions"][prediction];
            assert_eq!(prediction["resolvable"], true);
            let (got, expected) = (prediction["loss"]["mean"].as_f64().unwrap(), loss(name, ""));
            assert!((got - expected).abs() < 1e-4 * expected, "{name}: {got} {expected}");
            assert_eq!((&found["value"], remedy), (&marked.into(), option));
            let all = prediction["findings"].as_array().unwrap();
            assert_eq!(all.iter().filter(|finding| finding["marked"] == true).count(), 1, "{prediction}");
            assert_has(prediction["sentence"].as_str().unwrap(), &["would lower the loss by"]);
        }
    }
    // A spreadsheet takes no text of the program as a formula: only names may begin with a guard.
    let in_csv = rows_of(at, &command).into_iter().map(|row| row["remedy"].clone());
    let in_json = printed["predictions"].as_array().unwrap().iter().flat_map(|prediction| {
        let findings = prediction["findings"].as_array().unwrap().iter();
        findings.map(|finding| finding["remedy"].as_str().unwrap_or_default())
    });
    assert!(in_csv.eq(in_json));
    // Of red and blue there is no option.
    let text = succeed(at, &format!("diagnose truth.png swapped.png {READ}"));
    assert!(text.lines().any(|line| line.starts_with('*') && line.ends_with("none")), "{text}");
    assert_has(&text, &["No option corrects this reading"]);
}

#[test]
fn every_format_has_every_line_and_rounding_is_below_the_floor() {
    let folder = folder();
    let at = folder.path();
    write_of(32, &at.join("truth.png"), |_, texel| texel);
    write_of(32, &at.join("near.png"), rounded);
    let near = format!("diagnose truth.png near.png {READ}");
    let text = succeed(at, &near);
    assert_has(&text, &["exposure_rgb", "ground_truth"]);
    assert_has(&text, &["The loss is not resolvable with this ground truth"]);
    assert!(!text.lines().any(|line| line.starts_with('*')), "a mark below the floor: {text}");
    let csv = succeed(at, &format!("{near} --format csv"));
    assert_eq!(csv.lines().count(), 14);
    assert!(csv.starts_with("prediction,hypothesis,value,unit,loss,"), "{csv}");
    let ranking = json_of(at, &format!("rank truth.png near.png {READ}"));
    assert_has(&text, &[&format!("floor of the ground truth {:.6}:", ranking["floor"].as_f64().unwrap())]);
}

#[test]
fn a_ranking_names_the_losses_and_differences_below_the_floor() {
    let folder = folder();
    let at = folder.path();
    write(&at.join("truth.png"), |_, texel| texel);
    write(&at.join("near.png"), rounded);
    // Both far from the truth, and near each other; and one that is far from all.
    for (name, step) in [("rough.png", 0), ("same.png", 1)] {
        write(&at.join(name), |tile, texel| if tile == 2 { texel.map(|v| v + 60 + step) } else { texel });
    }
    write(&at.join("black.png"), |tile, texel| if tile == 1 { [0; 3] } else { texel });
    for (predictions, expected, cells) in [
        ("near.png rough.png", [["false", ""], ["true", "true"]], ["not resolvable", "loss"]),
        ("rough.png same.png", [["true", ""], ["true", "false"]], ["not resolvable", "difference"]),
        // Where all is resolvable, there is no such column.
        ("rough.png black.png", [["true", ""], ["true", "true"]], ["group", ""]),
    ] {
        let rank = format!("rank truth.png {predictions} {READ}");
        let csv = rows_of(at, &rank);
        let found =
            [0, 1].map(|row| ["resolvable", "to_best_resolvable"].map(|title| csv[row][title].as_str()));
        assert_eq!(found, expected, "{predictions}");
        let json = json_of(at, &rank)["ranking"].take();
        let found =
            [0, 1].map(|place| ["resolvable", "to_best_resolvable"].map(|key| json[place][key].as_bool()));
        assert_eq!(found, expected.map(|place| place.map(|cell| cell.parse().ok())), "{predictions}");
        let text = succeed(at, &rank);
        let table: Vec<&str> = text.split("\n\n").nth(1).unwrap().lines().collect();
        let last = |line: &str| line.split("  ").last().unwrap_or_default().trim().to_owned();
        assert_eq!(last(table[0]), cells[0], "{text}");
        assert!(cells[1].is_empty() || table[1..].iter().any(|line| last(line) == cells[1]), "{text}");
    }
}

#[test]
fn other_captures_of_the_ground_truth_give_its_floor() {
    let folder = folder();
    let at = folder.path();
    write(&at.join("truth.png"), |_, texel| texel);
    write(&at.join("again.png"), |tile, texel| if tile == 1 { texel.map(|v| v - v / 8) } else { texel });
    write(&at.join("flat.png"), |tile, texel| if tile == 0 { [128, 128, 255] } else { texel });
    let scenes = "--near 128 --distant 64 --sampler sobol";
    let expected = loss_of(at, &format!("truth.png again.png {READ} {scenes}"));
    for (command, floor) in [("diagnose", "/floor/mean"), ("rank", "/floor")] {
        let repeated = json_of(at, &format!("{command} truth.png flat.png {READ} --repeat again.png"));
        let floor = repeated.pointer(floor).unwrap().as_f64().unwrap();
        assert!((floor / expected - 1.0).abs() < 1e-3 && repeated["captures"] == 2, "{floor} {expected}");
    }
    assert_eq!(json_of(at, &format!("diagnose truth.png flat.png {READ}"))["captures"], Value::Null);
    let text = succeed(at, &format!("diagnose truth.png flat.png {READ} --repeat again.png"));
    assert_has(&text, &[", the mean loss between 2 captures: smaller losses"]);
    let error = fail(at, &format!("rank truth.png flat.png {READ} --repeat gt.png"), 1);
    assert_has(&error, &["8 x 8", "16 x 16"]);
}

/// Three materials: `ours` has Y of two in the other direction and a third one that rounding explains, `theirs` is rougher than the truth.
#[test]
fn a_data_set_counts_the_materials_of_each_method_by_their_marks() {
    let folder = data_set(&[("ours", 0), ("theirs", 0)], 0);
    let at = folder.path();
    for (method, material) in ["gt", "ours", "theirs"].into_iter().flat_map(|m| [0, 1, 2].map(|i| (m, i))) {
        write(&at.join(method).join(format!("m{material}.png")), |tile, [r, g, b]| match (method, tile) {
            ("ours", 0) if material < 2 => [r, 255 - g, b],
            ("ours", _) if material == 2 => rounded(tile, [r, g, b]),
            ("theirs", 2) => [r + 60 + 9 * material, g, b],
            _ => [r, g, b],
        });
    }
    let rank = format!("rank --dataset gt ours theirs {READ} --target-error 10%");
    let diagnosed = format!("{rank} --diagnose --results kept");
    let found = json_of(at, &diagnosed);
    let methods = found["methods"].as_array().unwrap();
    let text = succeed(at, &diagnosed);
    for (place, method) in methods.iter().enumerate() {
        let [marked, unresolved] = if method["method"] == "ours" { [2, 1] } else { [0, 0] };
        let marks = &method["marks"];
        assert_eq!(
            (&marks["materials"], &marks["not_resolvable"]),
            (&3.into(), &unresolved.into()),
            "{marks}"
        );
        assert_eq!(marks["by"]["normal_y"].as_u64().unwrap_or(0), marked, "{marks}");
        let cell = |row: &str| {
            let line =
                text.lines().find(|line| line.starts_with(row)).unwrap_or_else(|| panic!("{row}: {text}"));
            line.split_whitespace().nth(row.split(' ').count() + place).unwrap().to_owned()
        };
        assert_eq!(cell("number of materials"), method["method"].as_str().unwrap());
        assert_eq!(cell("by normal_y"), marked.to_string());
    }
    assert_eq!(found["results"][0]["predictions"][0]["marks"][0]["remedy"], "normal-y=down");
    assert!(found["results"][0]["floor"].as_f64().unwrap() > 0.0);
    let csv = succeed(at, &format!("{diagnosed} --format csv"));
    assert!(csv.lines().next().unwrap().ends_with(",floor,resolvable,marked"), "{csv}");
    assert_eq!(rows(&csv).iter().filter(|row| row["marked"] == "normal_y").count(), 2, "{csv}");
    assert!(!succeed(at, &rank).contains("number of materials"));
}
