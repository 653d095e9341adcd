//! Rankings in scenes that are asked for, and their files.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::{assert_has, assert_refused, data_set, folder, json_of, run_in, succeed, text};

/// The losses by the names of the predictions.
fn losses(report: &Value, list: &str, loss: impl Fn(&Value) -> Value) -> Vec<(String, Value)> {
    let of = |one: &Value| (one["prediction"].as_str().unwrap().to_owned(), loss(one));
    let mut all: Vec<_> = report[list].as_array().unwrap().iter().map(of).collect();
    all.sort_by(|a, b| a.0.cmp(&b.0));
    all
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
        assert_eq!(
            losses(&ranked, "ranking", |one| one["loss"]["mean"].clone()),
            losses(&lost, "results", |one| one["loss"].clone()),
            "{scenes}"
        );
        assert_eq!((&ranked["target_error"], &ranked["target_reached"]), (&Value::Null, &Value::Null));
    }
    let usual = json_of(at, "rank gt.png a.png b.png");
    assert_eq!((usual["target_error"].as_f64(), &usual["target_reached"]), (Some(0.01), &true.into()));
    assert_refused(
        at,
        &[
            ("rank gt.png a.png --near 6 --target-error 2%", 64, "leave out --near"),
            ("rank gt.png a.png --lights flash-9 --seed 3", 64, "leave out --seed"),
            ("rank gt.png a.png --lights flash-9 --scenes one.json", 64, "--lights"),
            ("rank gt.png a.png --robust --near 6", 64, "leave out --near"),
            ("rank gt.png a.png --robust --lights flash", 64, "leave out --lights"),
            ("rank gt.png a.png --fov 30", 64, "leave out --fov"),
        ],
    );
}

#[test]
fn a_data_set_in_scenes_has_the_losses_of_these_scenes() {
    let folder = data_set(&[("ours", 8), ("theirs", 40)], 6);
    let at = folder.path();
    for scenes in ["--near 6 --distant 3", "--lights hemisphere"] {
        let ranked = json_of(at, &format!("rank --dataset gt ours theirs {scenes}"));
        let result = &ranked["results"][4];
        let seed = if scenes.contains("near") { format!("--seed {}", result["seed"]) } else { String::new() };
        let lost = json_of(at, &format!("loss gt/m4.png ours/m4.png theirs/m4.png {scenes} {seed}"));
        for method in [0, 1] {
            assert_eq!(result["predictions"][method]["loss"], lost["results"][method]["loss"], "{scenes}");
        }
        assert_eq!(ranked["settings"]["target_error"], Value::Null);
        assert_has(ranked["repetition"]["command"].as_str().unwrap(), &[scenes]);
    }
    // Losses in other scenes are other ones.
    let kept = |scenes: &str| {
        json_of(at, &format!("rank --dataset gt ours theirs --results kept {scenes}"))["methods"].clone()
    };
    let [papers, hemisphere] = ["--near 6 --distant 3", "--lights hemisphere"].map(kept);
    assert_eq!(fs::read_dir(at.join("kept")).unwrap().count(), 24);
    assert_eq!([kept("--near 6 --distant 3"), kept("--lights hemisphere")], [papers, hemisphere]);
    assert_eq!(fs::read_dir(at.join("kept")).unwrap().count(), 24);
    let printed = succeed(at, "rank --dataset gt ours theirs --near 6 --distant 3");
    assert_has(&printed, &["6 near-field and 3 distant scenes each, seed 0, pick fixed"]);
    assert_refused(at, &[("rank --dataset gt ours --near 1 --distant 3", 64, "--near")]);
}

/// What a command writes into `name`, where it prints nothing.
fn written(folder: &Path, command: &str, name: &str) -> String {
    assert_eq!(succeed(folder, &format!("{command} -o {name}")), "", "{command}");
    let path = folder.join(name);
    let text = fs::read_to_string(&path).unwrap();
    fs::remove_file(path).unwrap();
    text
}

#[test]
fn every_format_of_a_ranking_is_written_into_a_file() {
    let folder = data_set(&[("ours", 8), ("theirs", 40)], 6);
    let at = folder.path();
    // Without the command, which has the name of the file.
    let others = |text: &str| -> Vec<String> {
        text.lines().filter(|line| !line.contains("svbrdf rank")).map(str::to_owned).collect()
    };
    for command in [
        "rank --dataset gt ours theirs --near 4 --distant 2",
        "rank gt/m0.png ours/m0.png theirs/m0.png --near 4 --distant 2",
        "rank gt/m0.png ours/m0.png theirs/m0.png --robust --target-error 10%",
    ] {
        for (format, name) in [("text", "r.txt"), ("json", "r.json"), ("csv", "r.csv"), ("latex", "r.tex")] {
            let printed = succeed(at, &format!("{command} --format {format}"));
            assert_eq!(
                others(&written(at, &format!("{command} --format {format}"), "file")),
                others(&printed)
            );
            assert_eq!(others(&written(at, command, name)), others(&printed), "the format of {name}");
        }
    }
    succeed(at, "rank --dataset gt ours --near 4 --distant 2 -o page.html");
    assert!(fs::read_to_string(at.join("page.html")).unwrap().starts_with("<!doctype html>"));
    assert_refused(
        at,
        &[
            ("rank gt/m0.png ours/m0.png -o page2.html", 64, "svbrdf report"),
            ("rank gt/m0.png ours/m0.png -o none/t.tex", 1, "none"),
            ("rank gt/m0.png ours/m0.png -o ours/m0.png", 1, "ours/m0.png"),
            ("rank --dataset gt ours -o ours/m3.png", 1, "ours/m3.png"),
            ("rank --dataset gt ours --figures all -o t.tex", 64, "leave out --figures"),
        ],
    );
}

#[test]
fn patterns_are_expanded_in_every_command_that_takes_materials() {
    let folder = data_set(&[("ours", 8)], 3);
    let at = folder.path();
    for [command, options] in [
        ["loss", "--near 3"],
        ["blame", "--target-error 10%"],
        ["metrics", "--metrics roughness"],
        ["scenes", "--near 3"],
        ["diagnose", ""],
    ] {
        let printed = succeed(at, &format!("{command} gt/m0.png ours/m*.png {options}"));
        assert_has(&printed, &["m1", "m2"]);
    }
    assert_has(&succeed(at, "loss */m1.png --near 3"), &["against gt", "ours"]);
    succeed(at, "strip gt/m0.png ours/m?.png -o figure.png");
    let refused = run_in(at, "strip gt/m0.png ours/x*.png -o figure.png");
    assert_eq!(refused.status.code(), Some(64));
    assert_has(text(&refused.stderr), &["the pattern ours/x*.png matches no file"]);
}
