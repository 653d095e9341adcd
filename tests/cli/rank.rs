//! Rankings of predictions, and of methods over data sets.

use std::fs;

use super::*;

const RANK: &str = "rank --dataset gt ours theirs --target-error 5%";

/// The losses by the names of the predictions.
fn losses(report: &Value, list: &str, loss: &str) -> BTreeMap<String, Value> {
    let of =
        |one: &Value| (one["prediction"].as_str().unwrap().to_owned(), one.pointer(loss).unwrap().clone());
    report[list].as_array().unwrap().iter().map(of).collect()
}

#[test]
fn a_ranking_in_scenes_has_the_losses_of_these_scenes() {
    let folder = folder();
    let at = folder.path();
    for scenes in [
        "--near 6 --distant 3 --seed 2",
        "--near 4 --sampler sobol",
        "--lights flash-9",
        "--lights flash --fov 30",
        "--scenes one.json",
    ] {
        let ranked = json_of(at, &format!("rank gt.png a.png b.png {scenes}"));
        let lost = json_of(at, &format!("loss gt.png a.png b.png {scenes}"));
        assert_eq!(losses(&ranked, "ranking", "/loss/mean"), losses(&lost, "results", "/loss"), "{scenes}");
        assert_eq!((&ranked["target_error"], &ranked["target_reached"]), (&Value::Null, &Value::Null));
    }

    let folder = data_set(&[("ours", 8), ("theirs", 40)], 6);
    let at = folder.path();
    let results = || fs::read_dir(at.join("kept")).map_or(0, Iterator::count);
    for (scenes, count) in [("--near 6 --distant 3", 12), ("--lights hemisphere", 24)] {
        let ranked = json_of(at, &format!("rank --dataset gt ours theirs {scenes} --results kept"));
        let result = &ranked["results"][4];
        let seed = if scenes.contains("near") { format!("--seed {}", result["seed"]) } else { String::new() };
        let lost = json_of(at, &format!("loss gt/m4.png ours/m4.png theirs/m4.png {scenes} {seed}"));
        for method in [0, 1] {
            assert_eq!(result["predictions"][method]["loss"], lost["results"][method]["loss"], "{scenes}");
        }
        assert_eq!(ranked["settings"]["target_error"], Value::Null);
        assert_has(ranked["repetition"]["command"].as_str().unwrap(), &[scenes]);
        // Losses in other scenes are other ones, and are found again.
        let again = json_of(at, &format!("rank --dataset gt ours theirs {scenes} --results kept"));
        assert_eq!((results(), &again["methods"]), (count, &ranked["methods"]));
    }
    assert_refused(at, &[("rank --dataset gt ours --near 1 --distant 3", 64, "--near")]);
}

#[test]
fn a_data_set_names_the_losses_that_miss_the_target_error() {
    let folder = data_set(&[("ours", 0)], 0);
    for (name, roughness) in [("gt", 1), ("ours", 2)] {
        write_material(&folder.path().join(name).join("mirror.png"), 4, roughness);
        write_material(&folder.path().join(name).join("rough.png"), 4, 100 + 10 * roughness);
    }
    let command = "rank --dataset gt ours --preset deschaintre --read order=ndrs --format csv";
    let output = run_in(folder.path(), command);
    let warnings = text(&output.stderr);
    assert!(output.status.success() && warnings.matches("warning: ").count() == 1, "{warnings}");
    assert_has(warnings, &["warning: mirror, ours is known to +-", "393216 scenes, the limit"]);
    let strict = run_in(folder.path(), &format!("{command} --strict"));
    // The command that repeats it is a column.
    let stdout = text(&strict.stdout).replace(" --strict", "");
    assert_eq!((strict.status.code(), stdout.as_str()), (Some(1), text(&output.stdout)));
    assert_has(text(&strict.stderr), &["error: mirror, ours is known to +-"]);
}

/// Of the second method, a file is missing, and one is broken.
#[test]
fn a_bad_file_of_a_data_set_is_reported_and_not_fatal() {
    let folder = data_set(&[("ours", 8), ("theirs", 40)], 9);
    fs::remove_file(folder.path().join("theirs/m3.png")).unwrap();
    fs::write(folder.path().join("theirs/m5.png"), "not an image").unwrap();
    let output = run_in(folder.path(), &format!("{RANK} --format json"));
    assert!(output.status.success());
    assert_has(text(&output.stderr), &["m3, theirs: ", "m5, theirs: "]);
    let ranking = json(text(&output.stdout));
    let facts = |method: usize| {
        let method = &ranking["methods"][method];
        json!([method["method"], method["materials"], method["failures"], method["ties_with_best"]])
    };
    assert_eq!([facts(0), facts(1)], [json!(["ours", 9, 0, true]), json!(["theirs", 7, 2, false])]);
    assert_eq!(ranking["methods"][1]["worse_on"], json!([7, 7]));
    let [known, failed] = [0, 1].map(|method| &ranking["results"][5]["predictions"][method]);
    assert!(known["loss"].as_f64().unwrap() > 0.0 && known.get("error").is_none(), "{known}");
    assert!(failed["error"].as_str().unwrap().contains("m5.png") && failed.get("loss").is_none(), "{failed}");
    assert_eq!(rows_of(folder.path(), RANK).len(), 18);
    let latex = succeed(folder.path(), &format!("{RANK} --format latex"));
    assert!(latex.contains("ours & \\textbf{") && !latex.contains("theirs & \\textbf{"), "{latex}");
}

#[test]
fn materials_are_matched_in_subfolders_with_their_samples() {
    let folder = data_set(&[("ours", 8)], 2);
    let at = folder.path();
    for (name, samples) in [("wood/oak", 2), ("metal/iron", 2)] {
        fs::create_dir_all(at.join(format!("in/gt/{name}"))).unwrap();
        fs::copy(at.join("gt/m0.png"), at.join(format!("in/gt/{name}/maps.png"))).unwrap();
        for sample in 0..samples {
            fs::create_dir_all(at.join(format!("in/ours/{name}_{sample}"))).unwrap();
            fs::copy(at.join("ours/m0.png"), at.join(format!("in/ours/{name}_{sample}/maps.png"))).unwrap();
        }
    }
    let ranking = json_of(at, "rank --dataset in/gt in/ours --target-error 5%");
    assert_eq!(ranking["settings"]["materials"], json!(["metal/iron", "wood/oak"]));
    assert_eq!(ranking["results"][0]["predictions"].as_array().unwrap().len(), 2);
    assert_eq!(ranking["methods"][0]["failures"], 0);
}

#[test]
fn a_loss_does_not_depend_on_its_rivals_nor_on_other_materials() {
    let folder = data_set(&[("ours", 8), ("theirs", 80)], 4);
    let losses = |args: &str| -> Vec<(Value, [Value; 3])> {
        let ranking = json_of(folder.path(), &format!("rank --dataset gt ours --target-error 2% {args}"));
        let of = |result: &Value| {
            let predictions = result["predictions"].as_array().unwrap();
            let ours = predictions.iter().find(|one| one["method"] == "ours").unwrap();
            (result["material"].clone(), ["loss", "interval95", "scenes"].map(|key| ours[key].clone()))
        };
        ranking["results"].as_array().unwrap().iter().map(of).collect()
    };
    let both = losses("theirs");
    assert_eq!(losses(""), both);
    fs::remove_file(folder.path().join("gt/m1.png")).unwrap();
    let fewer: Vec<_> = both.iter().filter(|(name, _)| name != "m1").cloned().collect();
    assert_eq!(losses(""), fewer);
    assert_ne!(losses("--seed 1"), fewer);
}

/// Three materials of a method are sets without a normal map.
#[test]
fn a_ranking_says_how_files_were_read_in_every_format() {
    let folder = data_set(&[("ours", 8), ("theirs", 16)], 5);
    let at = folder.path();
    for i in 0..3 {
        let set = at.join(format!("theirs/m{i}"));
        fs::remove_file(set.with_extension("png")).unwrap();
        fs::create_dir(&set).unwrap();
        for (map, value) in [("diffuse", 200), ("specular", 12), ("roughness", 120)] {
            image::GrayImage::from_pixel(8, 8, image::Luma([value]))
                .save(set.join(format!("{map}.png")))
                .unwrap();
        }
    }
    let output = run_in(at, &format!("{RANK} --format json"));
    let (ranking, notes) = (json(text(&output.stdout)), text(&output.stderr));
    let [table, latex] = ["text", "latex"].map(|format| succeed(at, &format!("{RANK} --format {format}")));
    succeed(at, &format!("{RANK} --format html -o page.html"));
    let page = text_of(at, "page.html");
    let prefixes =
        [(notes, "svbrdf: note: theirs: "), (&table, "theirs: "), (&latex, "% theirs: "), (&page, "")];
    for (text, prefix) in prefixes {
        let line = text.lines().find(|line| line.contains("3 of 5 without normal map")).unwrap();
        assert!(line.starts_with(prefix), "{line}");
    }
    assert!(!table.lines().any(|line| line.starts_with("ours: ") && line.contains("normal map")), "{table}");
    let doubts = ranking["methods"][1]["reading"]["doubts"].as_array().unwrap();
    assert!(
        doubts.iter().any(|one| one["doubt"] == "without normal map" && one["materials"] == 3),
        "{doubts:?}"
    );
    let counts: Vec<usize> = rows_of(at, RANK).iter().map(|row| row["doubts"].parse().unwrap()).collect();
    assert!(counts[1] > counts[7], "without a normal map, and with one: {counts:?}");
    let verbose = run_in(at, &format!("{RANK} -v"));
    let remarks = ["note: m0, theirs: missing: normal", "note: m4, ground truth: layout: "];
    assert_has(text(&verbose.stderr), &remarks);
}
