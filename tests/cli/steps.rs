//! Folders of training steps in the place of predictions.

use std::collections::BTreeMap;
use std::fs;

use serde_json::Value;
use tempfile::TempDir;

use super::{assert_refused, folder, losses_as_json, rows_of, write_material};

/// A ground truth and a run whose roughness comes closer to it, and at last goes too far.
fn run() -> TempDir {
    let folder = folder();
    fs::create_dir(folder.path().join("run")).unwrap();
    for (step, roughness) in [(1000, 90), (9, 220), (100, 160)] {
        write_material(&folder.path().join(format!("run/pred_step{step:06}.png")), 8, roughness);
    }
    fs::write(folder.path().join("run/pred_step000100.json"), "{}").unwrap();
    fs::write(folder.path().join("run/log.txt"), "step 9").unwrap();
    folder
}

fn column(rows: &[BTreeMap<String, String>], title: &str) -> Vec<String> {
    rows.iter().map(|row| row[title].clone()).collect()
}

#[test]
fn loss_prints_every_step_of_a_run_in_order() {
    let folder = run();
    let csv = rows_of(folder.path(), "loss gt.png run --near 4 --distant 2");
    assert_eq!(column(&csv, "step"), ["9", "100", "1000"]);
    assert_eq!(column(&csv, "prediction"), ["pred_step000009", "pred_step000100", "pred_step001000"]);
    let losses: Vec<f64> = column(&csv, "loss").iter().map(|cell| cell.parse().unwrap()).collect();
    assert!(losses[0] > losses[1] && losses[1] > losses[2], "{losses:?}");
    // Each is the loss of the file alone.
    for (path, loss) in column(&csv, "path").iter().zip(&losses) {
        let alone = losses_as_json(folder.path(), &format!("gt.png {path} --near 4 --distant 2"));
        assert_eq!(alone["results"][0]["loss"].as_f64(), Some(*loss), "{path}");
        assert_eq!(alone["results"][0]["step"], Value::Null);
    }
    let named = rows_of(folder.path(), "loss gt.png ours=run --near 1");
    assert_eq!(column(&named, "prediction"), ["ours, step 9", "ours, step 100", "ours, step 1000"]);
    let json = losses_as_json(folder.path(), "gt.png run a.png");
    let steps: Vec<&Value> = json["results"].as_array().unwrap().iter().map(|entry| &entry["step"]).collect();
    assert_eq!(steps, [&9.into(), &100.into(), &1000.into(), &Value::Null]);
}

#[test]
fn rank_finds_the_best_step_of_several_runs() {
    let folder = run();
    fs::create_dir_all(folder.path().join("runs/other")).unwrap();
    fs::rename(folder.path().join("run"), folder.path().join("runs/run")).unwrap();
    write_material(&folder.path().join("runs/other/epoch_3.png"), 8, 99);
    let csv = rows_of(folder.path(), "rank gt.png runs");
    let expected = ["epoch_3", "pred_step001000", "pred_step000100", "pred_step000009"];
    assert_eq!(column(&csv, "prediction"), expected);
    // A folder without steps is a material, as before.
    fs::create_dir(folder.path().join("empty")).unwrap();
    assert_refused(folder.path(), &[("rank gt.png empty", 1, "empty is not a material")]);
}
