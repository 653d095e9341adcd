//! Rankings of predictions, and of methods over data sets.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use super::{
    assert_has, assert_refused, folder, json, json_of, rows_of, run_in, succeed, text, write_material,
};

#[test]
fn predictions_of_a_pattern_are_ranked() {
    let folder = folder();
    let at = folder.path();
    fs::create_dir(at.join("out")).unwrap();
    for (name, roughness) in [("bad", 230), ("good", 104), ("mean", 150)] {
        write_material(&at.join(format!("out/{name}.png")), 8, roughness);
    }
    fs::write(at.join("out/note.txt"), "no material").unwrap();
    let ranking = json_of(at, "rank gt.png out/*.png");
    let names = [0, 1, 2].map(|place| &ranking["ranking"][place]["prediction"]);
    assert_eq!(
        (names.map(|name| name.as_str().unwrap()), &ranking["ranking"][2]["group"]),
        (["good", "mean", "bad"], &3.into())
    );
    assert_has(ranking["repetition"]["command"].as_str().unwrap(), &["svbrdf rank gt.png"]);
    assert_eq!(
        (ranking["readings"].as_array().unwrap().len(), &ranking["readings"][0]["material"]),
        (4, &"gt".into())
    );
    assert_has(ranking["readings"][0]["remarks"][0].as_str().unwrap(), &["layout: "]);
    assert_has(&succeed(at, "rank gt.png out/*.png"), &["- best", "group"]);
    assert_eq!(rows_of(at, "rank gt.png out/*.png").len(), 3);
    let latex = succeed(at, "rank gt.png out/*.png --format latex");
    assert!(latex.contains("good & \\textbf{") && latex.matches("textbf").count() == 1, "{latex}");

    let above = run_in(at, "rank gt.png out/*.png --fail-above 0.0001");
    assert_eq!(above.status.code(), Some(1));
    assert!(text(&above.stdout).contains("good") && text(&above.stderr).contains("above the limit"));
    succeed(at, "rank gt.png out/*.png --fail-above 10");
    assert_refused(at, &[("rank gt.png nothing*.png", 64, "matches no file")]);
}

/// Ground truths and two methods; of the second, a file is missing and one is broken.
fn data_set() -> TempDir {
    let folder = super::data_set(&[("ours", 8), ("theirs", 40)], 7);
    fs::remove_file(folder.path().join("theirs/m3.png")).unwrap();
    fs::write(folder.path().join("theirs/m5.png"), "not an image").unwrap();
    folder
}

const RANK: &str = "rank --dataset gt ours theirs --target-error 5%";

#[test]
fn a_data_set_names_the_losses_that_miss_the_target_error() {
    let folder = super::data_set(&[("ours", 0)], 0);
    for (name, roughness) in [("gt", 1), ("ours", 2)] {
        write_material(&folder.path().join(name).join("mirror.png"), 4, roughness);
        write_material(&folder.path().join(name).join("rough.png"), 4, 100 + 10 * roughness);
    }
    let command = "rank --dataset gt ours --preset deschaintre --read order=ndrs --format csv";
    let output = run_in(folder.path(), command);
    let warnings = text(&output.stderr);
    assert!(output.status.success() && warnings.matches("warning: ").count() == 1, "{warnings}");
    assert!(warnings.contains("warning: mirror, ours is known to +-"), "{warnings}");
    assert!(warnings.contains("393216 scenes, the limit"), "{warnings}");
    let strict = run_in(folder.path(), &format!("{command} --strict"));
    assert_eq!((strict.status.code(), strict.stdout), (Some(1), output.stdout));
    assert!(text(&strict.stderr).contains("error: mirror, ours is known to +-"));
}

#[test]
fn a_bad_file_of_a_data_set_is_reported_and_not_fatal() {
    let folder = data_set();
    let output = run_in(folder.path(), &format!("{RANK} --format json"));
    assert!(output.status.success(), "{}", text(&output.stderr));
    let stderr = text(&output.stderr);
    assert!(stderr.contains("m3, theirs: ") && stderr.contains("m5, theirs: "), "{stderr}");
    let ranking = json(text(&output.stdout));
    let [ours, theirs] = [0, 1].map(|i| &ranking["methods"][i]);
    assert_eq!(
        (&ours["method"], &ours["materials"], &ours["failures"]),
        (&"ours".into(), &7.into(), &0.into())
    );
    assert_eq!((&theirs["materials"], &theirs["failures"]), (&5.into(), &2.into()));
    assert_eq!((&ours["ties_with_best"], &theirs["ties_with_best"]), (&true.into(), &false.into()));
    assert!(theirs["to_best_interval95_materials"][0].as_f64().unwrap() > 0.0);
    let [known, failed] = [0, 1].map(|method| &ranking["results"][5]["predictions"][method]);
    assert!(known["loss"].as_f64().unwrap() > 0.0 && known.get("error").is_none(), "{known}");
    assert!(failed["error"].as_str().unwrap().contains("m5.png") && failed.get("loss").is_none(), "{failed}");
    assert_has(&succeed(folder.path(), RANK), &["7 of 7 materials", "95% over materials"]);
    assert_eq!(rows_of(folder.path(), RANK).len(), 14);
    assert_refused(folder.path(), &[(&format!("{RANK} --resize-to gt"), 64, "not resized")]);
    let latex = succeed(folder.path(), &format!("{RANK} --format latex"));
    assert!(latex.contains("ours & \\textbf{") && !latex.contains("theirs & \\textbf{"), "{latex}");
}

#[test]
fn a_table_of_pairs_names_methods_and_samples() {
    let folder = data_set();
    let table = "ground_truth, prediction, method\n gt/m0.png, ours/m0.png, a\n gt/m0.png, ours/m1.png, a\n\
        gt/m1.png, ours/m1.png, a\n";
    fs::write(folder.path().join("pairs.csv"), table).unwrap();
    let loss = |pick: &str| {
        let args = format!("rank --pairs pairs.csv --target-error 5% --pick {pick}");
        json_of(folder.path(), &args)["methods"][0]["mean"].as_f64().unwrap()
    };
    assert!(loss("best") <= loss("mean") && loss("best") <= loss("fixed"));
    assert_ne!(loss("mean"), loss("fixed"));
    fs::write(folder.path().join("no.csv"), "a,b\n1,2\n").unwrap();
    assert_refused(folder.path(), &[("rank --pairs no.csv", 1, "the columns ground_truth and prediction")]);
}

#[test]
fn folders_are_matched_by_name_in_subfolders_too() {
    let folder = tempfile::tempdir().unwrap();
    let write = |path: &Path, roughness| {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        write_material(path, 8, roughness);
    };
    for name in ["wood/oak", "metal/iron"] {
        write(&folder.path().join(format!("gt/{name}/maps.png")), 100);
        for sample in 0..2 {
            write(&folder.path().join(format!("ours/{name}_{sample}/maps.png")), 120);
        }
    }
    let ranking = json_of(folder.path(), "rank --dataset gt ours --target-error 5%");
    assert_eq!(ranking["settings"]["materials"], serde_json::json!(["metal/iron", "wood/oak"]));
    assert_eq!(ranking["results"][0]["predictions"].as_array().unwrap().len(), 2);
    assert_eq!(ranking["methods"][0]["failures"], 0);
}
