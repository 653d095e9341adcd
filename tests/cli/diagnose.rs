//! `svbrdf diagnose`: planted errors of files, and the options that correct them.

use std::path::Path;

use serde_json::Value;

use super::{folder, json, succeed, write_tiles};

const SIDE: u32 = 32;
const READ: &str = "--preset deschaintre --read order=ndrs";

/// Writes a packed material with bumps; `change` sees each stored texel of a map (0 normals, 1 diffuse, 2 roughness, 3 specular).
fn write(path: &Path, change: impl Fn(u32, [u8; 3]) -> [u8; 3]) {
    let wave = |x: u32, y: u32, by: f32| {
        (0.5 + 0.5 * (0.9 * x as f32 + by).sin() * (0.7 * y as f32 + 2.0 * by).cos()) * 255.0
    };
    write_tiles(path, SIDE, |x, y| {
        let (tile, x) = (x / SIDE, x % SIDE);
        let texel = match tile {
            0 => [90.0 + 0.3 * wave(x, y, 0.0), 80.0 + 0.35 * wave(x, y, 1.0), 235.0].map(|v| v as u8),
            1 => [60.0 + 0.5 * wave(x, y, 0.3), 50.0 + 0.3 * wave(x, y, 0.3), 30.0].map(|v| v as u8),
            2 => [(60.0 + 0.2 * wave(x, y, 2.0)) as u8; 3],
            _ => [12; 3],
        };
        change(tile, texel)
    });
}

#[test]
fn a_planted_reading_is_found_and_its_option_corrects_it() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    write(&of("truth.png"), |_, texel| texel);
    write(&of("directx.png"), |tile, [r, g, b]| if tile == 0 { [r, 255 - g, b] } else { [r, g, b] });
    write(&of("gloss.png"), |tile, texel| if tile == 2 { texel.map(|v| 255 - v) } else { texel });
    for (name, hypothesis, value, option) in [
        ("directx", "normal_y", "flipped", "directx:normal-y=down"),
        ("gloss", "roughness", "gloss", "gloss:roughness=gloss"),
    ] {
        let printed =
            json(&succeed(folder.path(), &format!("diagnose truth.png {name}.png {READ} --format json")));
        let prediction = &printed["predictions"][0];
        let findings = prediction["findings"].as_array().unwrap();
        let marked: Vec<&Value> = findings.iter().filter(|finding| finding["marked"] == true).collect();
        assert!(marked.len() == 1, "{printed}");
        let found = ["hypothesis", "value", "remedy"].map(|key| marked[0][key].as_str().unwrap());
        assert_eq!(found, [hypothesis, value, option]);
        // 2,048 + 1,024 scrambled Sobol scenes of the same seed, of maps as small as these on all texels.
        let scenes = "--near 2048 --distant 1024 --sampler sobol --format json";
        let loss = |options: &str| {
            let printed =
                succeed(folder.path(), &format!("loss truth.png {name}.png {READ} {options} {scenes}"));
            json(&printed)["results"][0]["loss"].as_f64().unwrap()
        };
        let expected = [loss(""), loss(&format!("--read {option}"))];
        let found = [&prediction["loss"]["mean"], &marked[0]["loss"]].map(|value| value.as_f64().unwrap());
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-3 * loss(""), "{found} {expected}");
        }
        assert!(prediction["sentence"].as_str().unwrap().contains("would lower the loss by"), "{prediction}");
        // A spreadsheet takes no text of the program as a formula: only names may begin with a guard.
        let csv = succeed(folder.path(), &format!("diagnose truth.png {name}.png {READ} --format csv"));
        let mut reader = csv::Reader::from_reader(csv.as_bytes());
        assert_eq!(reader.headers().unwrap().iter().next_back(), Some("remedy"));
        let remedies: Vec<String> =
            reader.records().map(|row| row.unwrap().iter().next_back().unwrap().to_owned()).collect();
        let in_json = findings.iter().map(|finding| finding["remedy"].as_str().unwrap_or_default());
        assert!(remedies.iter().eq(in_json), "{csv}");
    }
}

/// The advice replaces the options of this material: with `albedo` alone specular would be read as its specified option says, or not.
#[test]
fn the_option_of_an_advice_gives_the_loss_that_was_computed() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    write(&of("truth.png"), |_, texel| texel);
    write(&of("encoded.png"), |tile, texel| match tile {
        1 | 3 => texel.map(|v| (255.0 * (f32::from(v) / 255.0).powf(1.0 / 2.2)).round() as u8),
        _ => texel,
    });
    write(&of("swapped.png"), |tile, [r, g, b]| if tile == 1 { [b, g, r] } else { [r, g, b] });
    let read = format!("{READ} --read encoded:specular-albedo=linear");
    let printed =
        json(&succeed(folder.path(), &format!("diagnose truth.png encoded.png {read} --format json")));
    let findings = printed["predictions"][0]["findings"].as_array().unwrap();
    let scenes = "--near 2048 --distant 1024 --sampler sobol --format json";
    for name in ["albedo_encoding", "diffuse_encoding", "specular_encoding"] {
        let finding = findings.iter().find(|finding| finding["hypothesis"] == name).unwrap();
        let option = finding["remedy"].as_str().unwrap();
        let loss =
            succeed(folder.path(), &format!("loss truth.png encoded.png {READ} --read {option} {scenes}"));
        let found = json(&loss)["results"][0]["loss"].as_f64().unwrap();
        let expected = finding["loss"].as_f64().unwrap();
        assert!((found - expected).abs() < 1e-4 * expected + 1e-6, "{name} {option}: {found} {expected}");
    }
    // Of red and blue there is no option.
    let text = succeed(folder.path(), &format!("diagnose truth.png swapped.png {READ}"));
    assert!(text.lines().any(|line| line.starts_with('*') && line.ends_with("none")), "{text}");
    assert!(text.contains("No option corrects this reading"), "{text}");
}

#[test]
fn every_format_has_every_line_and_rounding_is_below_the_floor() {
    let folder = folder();
    write(&folder.path().join("truth.png"), |_, texel| texel);
    // An eighth of the values is one step away.
    write(&folder.path().join("near.png"), |_, [r, g, b]| [r, g + u8::from(r % 8 == 0), b]);
    let text = succeed(folder.path(), &format!("diagnose truth.png near.png {READ}"));
    for part in ["floor of the ground truth", "exposure_rgb", "resampling", "32 x 32", "seams of"] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(text.contains("The loss is not resolvable with this ground truth"), "{text}");
    assert!(!text.lines().any(|line| line.starts_with('*')), "a mark below the floor: {text}");
    let csv = succeed(folder.path(), &format!("diagnose truth.png near.png {READ} --format csv"));
    assert_eq!(csv.lines().count(), 16);
    assert!(csv.starts_with("prediction,hypothesis,value,unit,loss,"), "{csv}");
    let printed = json(&succeed(folder.path(), &format!("diagnose truth.png near.png {READ} --format json")));
    let resolvable = |prediction: &Value| prediction["resolvable"].as_bool().unwrap();
    assert!(!resolvable(&printed["predictions"][0]), "{printed}");
    let floor = printed["floor"]["mean"].as_f64().unwrap();
    let ranking = json(&succeed(folder.path(), &format!("rank truth.png near.png {READ} --format json")));
    assert_eq!(ranking["floor"], floor);
    assert!(succeed(folder.path(), &format!("rank truth.png near.png {READ}")).contains("not resolvable"));
    let prediction = &ranking["ranking"][0];
    assert_eq!((&prediction["resolvable"], &prediction["to_best_resolvable"]), (&false.into(), &Value::Null));
    let wrong = json(&succeed(folder.path(), "diagnose gt.png b.png --format json"));
    assert!(resolvable(&wrong["predictions"][0]), "{wrong}");
}

#[test]
fn a_ranking_names_the_losses_and_differences_below_the_floor() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    write(&of("truth.png"), |_, texel| texel);
    write(&of("near.png"), |_, [r, g, b]| [r, g + u8::from(r % 8 == 0), b]);
    // Both far from the truth, and near each other.
    let rough = |step: u8| {
        move |tile: u32, texel: [u8; 3]| if tile == 2 { texel.map(|v| v + 60 + step) } else { texel }
    };
    write(&of("rough.png"), rough(0));
    write(&of("same.png"), rough(1));
    let rank = |predictions: &str, format: &str| {
        succeed(folder.path(), &format!("rank truth.png {predictions} {READ} --format {format}"))
    };
    let of_ranking = |predictions: &str| {
        let ranking = json(&rank(predictions, "json"));
        let entry = |place: usize| {
            let place = &ranking["ranking"][place];
            ["resolvable", "to_best_resolvable"].map(|key| place[key].as_bool())
        };
        [entry(0), entry(1)]
    };
    assert_eq!(of_ranking("near.png rough.png"), [[Some(false), None], [Some(true), Some(true)]]);
    assert_eq!(of_ranking("rough.png same.png"), [[Some(true), None], [Some(true), Some(false)]]);
    let last = |predictions: &str, line: usize| {
        let text = rank(predictions, "text");
        let table = text.split("\n\n").nth(1).unwrap().to_owned();
        table.lines().nth(line).unwrap().split("  ").last().unwrap().to_owned()
    };
    assert_eq!(last("rough.png same.png", 0), "not resolvable");
    assert_eq!(last("rough.png same.png", 2), "difference");
    assert_eq!(last("near.png rough.png", 1), "loss");
    // Where all is resolvable, there is no such column.
    write(&of("black.png"), |tile, texel| if tile == 1 { [0; 3] } else { texel });
    assert_eq!(last("rough.png black.png", 0), "group");
    let csv = rank("rough.png same.png", "csv");
    assert!(csv.lines().next().unwrap().ends_with(",resolvable,to_best_resolvable"), "{csv}");
    assert!(csv.lines().nth(2).unwrap().ends_with(",true,false"), "{csv}");
}

#[test]
fn other_captures_of_the_ground_truth_give_its_floor() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    write(&of("truth.png"), |_, texel| texel);
    write(&of("again.png"), |tile, texel| if tile == 1 { texel.map(|v| v - v / 8) } else { texel });
    write(&of("more.png"), |tile, texel| if tile == 2 { texel.map(|v| v + 9) } else { texel });
    write(&of("flat.png"), |tile, texel| if tile == 0 { [128, 128, 255] } else { texel });
    let run = |command: &str, options: &str| {
        json(&succeed(folder.path(), &format!("{command} truth.png flat.png {READ} {options} --format json")))
    };
    let scenes = "--near 128 --distant 64 --sampler sobol --format json";
    let loss = |first: &str, second: &str| {
        let printed = succeed(folder.path(), &format!("loss {first}.png {second}.png {READ} {scenes}"));
        json(&printed)["results"][0]["loss"].as_f64().unwrap()
    };
    let pairs = [loss("truth", "again"), loss("truth", "more"), loss("again", "more")];
    let expected = [pairs[0], pairs.iter().sum::<f64>() / 3.0];
    for (captures, options) in [(2, "--repeat again.png"), (3, "--repeat again.png --repeat more.png")] {
        let diagnosed = run("diagnose", options);
        let ranked = run("rank", options);
        assert_eq!([&diagnosed["captures"], &ranked["captures"]], [captures, captures]);
        let expected = expected[captures - 2];
        for floor in [&diagnosed["floor"]["mean"], &ranked["floor"]] {
            let floor = floor.as_f64().unwrap();
            assert!((floor / expected - 1.0).abs() < 1e-3, "{floor} {expected}");
        }
    }
    assert_eq!(run("diagnose", "")["captures"], Value::Null);
    let text = succeed(folder.path(), &format!("diagnose truth.png flat.png {READ} --repeat again.png"));
    assert!(text.contains(", the mean loss between 2 captures: smaller losses"), "{text}");
    write_tiles(&of("small.png"), 8, |_, _| [100; 3]);
    let error = super::fail(folder.path(), &format!("rank truth.png flat.png {READ} --repeat small.png"), 1);
    assert!(error.contains("8 x 8") && error.contains("32 x 32"), "{error}");
}

/// Three materials: `ours` has Y of two in the other direction and a third one that rounding explains, `theirs` is rougher than the truth.
#[test]
fn a_data_set_counts_the_materials_of_each_method_by_their_marks() {
    let folder = folder();
    for method in ["gt", "ours", "theirs"] {
        std::fs::create_dir(folder.path().join(method)).unwrap();
        for material in 0..3_u32 {
            let path = folder.path().join(method).join(format!("m{material}.png"));
            write(&path, |tile, [r, g, b]| match (method, tile) {
                ("gt", _) => [r, g, b],
                ("ours", 0) if material < 2 => [r, 255 - g, b],
                ("ours", _) if material == 2 => [r, g + u8::from(r % 8 == 0), b],
                ("theirs", 2) => [r + 60 + 9 * material as u8, g, b],
                _ => [r, g, b],
            });
        }
    }
    let rank = |options: &str| {
        succeed(folder.path(), &format!("rank --dataset gt ours theirs {READ} --target-error 10% {options}"))
    };
    let kept = |format: &str| rank(&format!("--diagnose --results kept {format}"));
    let found = json(&kept("--format json"));
    let of = |method: &str| {
        let all = found["methods"].as_array().unwrap();
        all.iter().find(|entry| entry["method"] == method).unwrap()["marks"].clone()
    };
    let (ours, theirs) = (of("ours"), of("theirs"));
    assert_eq!(
        (&ours["materials"], &ours["marked"], &ours["by"]["normal_y"]),
        (&3.into(), &2.into(), &2.into())
    );
    assert_eq!(
        (&ours["not_resolvable"], &theirs["not_resolvable"]),
        (&1.into(), &0.into()),
        "{ours} {theirs}"
    );
    let marks = &found["results"][0]["predictions"][0]["marks"];
    assert_eq!(marks[0]["remedy"], "normal-y=down");
    assert!(found["results"][0]["floor"].as_f64().unwrap() > 0.0);
    let text = rank("--diagnose");
    let row = |name: &str| -> Vec<String> {
        let line =
            text.lines().find(|line| line.starts_with(name)).unwrap_or_else(|| panic!("{name}: {text}"));
        line.split_whitespace().skip(name.split(' ').count()).map(str::to_owned).collect()
    };
    let order: Vec<&str> =
        found["methods"].as_array().unwrap().iter().map(|m| m["method"].as_str().unwrap()).collect();
    assert_eq!(row("number of materials"), order);
    let by = |method: &str| row("by normal_y")[order.iter().position(|one| *one == method).unwrap()].clone();
    assert_eq!([by("ours"), by("theirs")], ["2", "0"]);
    let csv = kept("--format csv");
    assert!(csv.lines().next().unwrap().ends_with(",floor,resolvable,marked"), "{csv}");
    assert_eq!(csv.lines().filter(|line| line.ends_with(",true,normal_y")).count(), 2, "{csv}");
    assert_eq!(kept(""), text, "results that were kept print the same");
    assert!(!rank("").contains("number of materials"));
}

#[test]
fn a_material_of_one_texel_is_diagnosed_beside_others_of_a_data_set() {
    let folder = folder();
    for (method, roughness) in [("gt", 90), ("ours", 140)] {
        let at = folder.path().join(method);
        std::fs::create_dir(&at).unwrap();
        write_tiles(&at.join("one.png"), 1, |x, _| {
            [[128, 128, 255], [90; 3], [roughness; 3], [12; 3]][x as usize]
        });
        write(
            &at.join("many.png"),
            |tile, texel| if tile == 2 { texel.map(|v| v / 2 + roughness / 2) } else { texel },
        );
    }
    let args =
        format!("rank --dataset gt ours {READ} --read grid=4x1 --target-error 20% --diagnose --format json");
    let found = json(&succeed(folder.path(), &args));
    assert_eq!(found["methods"][0]["marks"]["materials"], 2, "{found}");
    let args = format!("diagnose gt/one.png ours/one.png {READ} --read grid=4x1 --format json");
    let loss = json(&succeed(folder.path(), &args))["predictions"][0]["loss"]["mean"].as_f64().unwrap();
    assert!(loss > 0.0, "{loss}");
}
