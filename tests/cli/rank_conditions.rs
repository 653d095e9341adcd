//! What stands around the numbers of a ranking: how files were read, over which materials a mean is, and how to repeat it.

use std::fs;

use super::{
    assert_has, assert_refused, data_set, json, json_of, rows_of, run_in, succeed, text, text_of,
    write_material,
};
use serde_json::Value;

const RANK: &str = "rank --dataset gt ours theirs --target-error 5%";

#[test]
fn a_ranking_says_how_files_were_read() {
    let folder = data_set(&[("ours", 8), ("theirs", 16)], 5);
    for i in 0..3 {
        // A set without its normal map.
        let set = folder.path().join(format!("theirs/m{i}"));
        fs::remove_file(set.with_extension("png")).unwrap();
        fs::create_dir(&set).unwrap();
        for (map, value) in [("diffuse", 200), ("specular", 12), ("roughness", 120)] {
            let gray = image::GrayImage::from_pixel(8, 8, image::Luma([value]));
            gray.save(set.join(map).with_extension("png")).unwrap();
        }
    }
    let expected = "3 of 5 without normal map";
    let doubts = |output: &str| output.lines().find(|line| line.contains(expected)).map(str::to_owned);
    let table = succeed(folder.path(), RANK);
    assert!(doubts(&table).is_some_and(|line| line.starts_with("theirs: ")), "{table}");
    assert!(!table.lines().any(|line| line.starts_with("ours: ") && line.contains("normal map")), "{table}");

    let output = run_in(folder.path(), &format!("{RANK} --format json"));
    assert!(doubts(text(&output.stderr)).is_some(), "{}", text(&output.stderr));
    let ranking = json(text(&output.stdout));
    let find = |all: &Value, key: &str, value: &str| {
        all.as_array().unwrap().iter().find(|one| one[key] == value).unwrap().clone()
    };
    let theirs = find(&ranking["methods"], "method", "theirs");
    let without = find(&theirs["reading"]["doubts"], "doubt", "without normal map");
    assert_eq!((&without["materials"], &theirs["reading"]["materials"]), (&3.into(), &5.into()));
    let remarks = ranking["results"][0]["predictions"][1]["reading"].as_array().unwrap();
    let is_missing = |one: &Value| one["text"].as_str().unwrap().starts_with("missing: normal");
    assert!(remarks.iter().any(is_missing), "{remarks:?}");

    let rows = rows_of(folder.path(), RANK);
    let counts: Vec<usize> = rows.iter().map(|row| row["doubts"].parse().unwrap()).collect();
    assert!(counts[1] > counts[7], "without a normal map, and with one: {counts:?}");
    let latex = succeed(folder.path(), &format!("{RANK} --format latex"));
    assert!(doubts(&latex).is_some_and(|line| line.starts_with("% theirs: ")), "{latex}");
    succeed(folder.path(), &format!("{RANK} --format html -o page.html"));
    assert_has(&text_of(folder.path(), "page.html"), &[expected]);
    let verbose = run_in(folder.path(), &format!("{RANK} -v"));
    assert_has(
        text(&verbose.stderr),
        &["note: m0, theirs: missing: normal", "note: m4, ground truth: layout: "],
    );
}

#[test]
fn no_format_puts_a_method_first_that_failed_on_most_materials() {
    // Of the easy material alone, where it is worse than the others.
    let folder = data_set(&[("ours", 8), ("theirs", 16), ("few", 20)], 5);
    for i in 1..5 {
        fs::write(folder.path().join(format!("few/m{i}.png")), "not an image").unwrap();
    }
    let rank = "rank --dataset gt few theirs ours --target-error 5% --metrics";
    let ranking = json_of(folder.path(), rank);
    let last = &ranking["methods"][2];
    assert_eq!([&last["method"], &last["compared"]], [&Value::from("few"), &false.into()]);
    assert_has(&succeed(folder.path(), rank), &["few has 1 of 5 materials: not compared"]);
    let latex = succeed(folder.path(), &format!("{rank} --format latex"));
    let of_few = latex.lines().find(|line| line.starts_with("few & ")).unwrap();
    assert!(!of_few.contains("textbf") && of_few.contains("1 of 5"), "{latex}");
    let metrics = latex.split("Metric, mean").nth(1).unwrap();
    let bold_last = metrics
        .lines()
        .filter(|line| line.contains("arrow"))
        .any(|line| line.rsplit(" & ").next().unwrap().contains("textbf"));
    assert!(!bold_last, "{metrics}");
    succeed(folder.path(), &format!("{rank} --format html -o page.html"));
    let page = text_of(folder.path(), "page.html");
    assert_eq!(page.matches("<td>best</td>").count(), 1);
    assert!(page.find("<td>best</td>").unwrap() < page.find("<td>lacks materials</td>").unwrap());
    for row in rows_of(folder.path(), rank) {
        assert_eq!(row["compared"] == "true", row["method"] != "few", "{row:?}");
    }
}

#[test]
fn a_loss_does_not_depend_on_its_rivals_nor_on_other_materials() {
    let folder = data_set(&[("ours", 8), ("theirs", 80)], 4);
    let losses = |args: &str| -> Vec<(Value, [Value; 3])> {
        let ranking = json_of(folder.path(), args);
        let of = |result: &Value| {
            let predictions = result["predictions"].as_array().unwrap().clone();
            let ours = predictions.into_iter().find(|one| one["method"] == "ours").unwrap();
            (result["material"].clone(), ["loss", "interval95", "scenes"].map(|key| ours[key].clone()))
        };
        ranking["results"].as_array().unwrap().iter().map(of).collect()
    };
    let both = losses("rank --dataset gt ours theirs --target-error 2%");
    assert_eq!(losses("rank --dataset gt ours --target-error 2%"), both);
    fs::remove_file(folder.path().join("gt/m1.png")).unwrap();
    let fewer: Vec<_> = both.iter().filter(|(name, _)| name != "m1").cloned().collect();
    assert_eq!(losses("rank --dataset gt ours --target-error 2%"), fewer);
    assert_ne!(losses("rank --dataset gt ours --target-error 2% --seed 1"), fewer);
}

#[cfg(unix)]
#[test]
fn a_ranking_says_how_to_repeat_it() {
    let folder = data_set(&[("ours", 8), ("their maps", 16)], 5);
    let run = |line: &str| {
        let line = line.replacen("svbrdf", env!("CARGO_BIN_EXE_svbrdf"), 1);
        let output = super::command("sh").args(["-c", &line]).current_dir(folder.path()).output().unwrap();
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout).to_owned()
    };
    let line = "svbrdf rank --dataset gt ours 'their maps' --target-error 3% --seed 7 --pick mean --convention guided-2020 \
        --metrics --preset deschaintre";
    let table = run(line);
    let version = env!("CARGO_PKG_VERSION");
    let repeat = table.lines().find_map(|line| line.strip_prefix(&format!("repeat with svbrdf {version}: ")));
    let repeat = repeat.unwrap_or_else(|| panic!("{table}"));
    assert_eq!(run(repeat), table);
    let ranking = json(&run(&format!("{line} --format json")));
    assert_eq!(ranking["repetition"]["command"], repeat);
    assert_eq!(ranking["reading"]["predictions"]["preset"], "deschaintre");
    assert_has(ranking["repetition"]["software"].as_str().unwrap(), &[version]);
    run(&format!("{line} --format html -o page.html"));
    assert_has(&text_of(folder.path(), "page.html"), &["rank --dataset gt ours", version]);
}

#[test]
fn predictions_of_other_names_are_found_by_a_pattern() {
    let folder = data_set(&[], 3);
    fs::create_dir(folder.path().join("out")).unwrap();
    for i in 0..3 {
        write_material(&folder.path().join(format!("out/m{i}_pred.png")), 8, 60 + 20 * i);
    }
    let output = run_in(folder.path(), "rank --dataset gt out --target-error 5%");
    let notes = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1));
    assert_has(notes, &["no prediction named m0 in out; found m0_pred.png", "out/{}_pred.png"]);
    let rank = "rank --dataset gt out/{}_pred.png --target-error 5%";
    let method = json_of(folder.path(), rank)["methods"][0].take();
    assert_eq!((&method["method"], &method["materials"]), (&"pred".into(), &3.into()));
    fs::remove_file(folder.path().join("out/m1_pred.png")).unwrap();
    assert_has(text(&run_in(folder.path(), rank).stderr), &["no prediction at out/m1_pred.png"]);
}

#[test]
fn a_loss_of_folders_of_materials_says_how_to_rank_them() {
    let folder = data_set(&[("ours", 8)], 3);
    assert_refused(folder.path(), &[("loss gt ours", 1, "svbrdf rank --dataset gt ours")]);
}

#[test]
fn methods_of_unlike_conventions_are_ranked_together() {
    let folder = data_set(&[("ours", 0)], 5);
    fs::create_dir(folder.path().join("glossy")).unwrap();
    for i in 0..5 {
        // Of the ground truth, stored as gloss.
        write_material(&folder.path().join(format!("glossy/m{i}.png")), 8, 255 - (60 + 17 * i));
    }
    let means = |options: &str| {
        let rank = "rank --dataset gt same=ours glossy --target-error 5%";
        let ranking = json_of(folder.path(), &format!("{rank} {options}"));
        let methods = ranking["methods"].as_array().unwrap().clone();
        let mean =
            |name: &str| methods.iter().find(|one| one["method"] == name).unwrap()["mean"].as_f64().unwrap();
        ([mean("same"), mean("glossy")], ranking)
    };
    let (as_stored, _) = means("");
    assert!(as_stored[0] < 1e-9 && as_stored[1] > 0.05, "{as_stored:?}");
    let (read, ranking) = means("--read glossy:roughness=gloss");
    assert!(read[0] < 1e-9 && read[1] < 1e-6, "{read:?}");
    assert_eq!(ranking["reading"]["methods"]["glossy"]["roughness"], "gloss");
    let command = ranking["repetition"]["command"].as_str().unwrap();
    assert_has(command, &["same=ours glossy", "--read glossy:roughness=gloss"]);
    let unknown = "rank --dataset gt ours --read other:roughness=gloss";
    assert_refused(folder.path(), &[(unknown, 64, "no material is named other")]);
}
