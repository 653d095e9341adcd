//! What holds for the results that a run over a data set keeps, whatever keeps them: a journal, or the folder that replaces it.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, SystemTime};

use serde_json::Value;
use tempfile::TempDir;

use super::{command, fail, files, run_in, succeed, text, write_material};

const RANK: &str = "rank --dataset gt ours --target-error 20%";

/// A ground truth and a method with three materials each, whose results are kept in `run.jsonl`.
fn with_results() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, more) in [("gt", 0), ("ours", 20)] {
        fs::create_dir(folder.path().join(name)).unwrap();
        for i in 0..3_u8 {
            write_material(&folder.path().join(name).join(format!("m{i}.png")), 8, 60 + 17 * i + more);
        }
    }
    succeed(folder.path(), &format!("{RANK} --journal run.jsonl"));
    folder
}

/// Changes the kept result of the last material.
fn change(folder: &Path, change: impl Fn(&mut Value)) {
    let path = folder.join("run.jsonl");
    let mut lines: Vec<Value> =
        fs::read_to_string(&path).unwrap().lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    change(lines.last_mut().unwrap());
    let text: String = lines.iter().map(|line| format!("{line}\n")).collect();
    fs::write(path, text).unwrap();
}

/// A result that belongs to no material of the run is refused, by a run and by a merge.
fn is_refused(changed: impl Fn(&mut Value)) {
    let folder = with_results();
    change(folder.path(), changed);
    fail(folder.path(), &format!("{RANK} --journal run.jsonl"), 1);
    fail(folder.path(), "rank --merge run.jsonl", 1);
}

#[test]
#[ignore = "the journal is replaced by a results folder"]
fn a_result_of_a_foreign_index_is_refused() {
    let folder = with_results();
    let path = folder.path().join("run.jsonl");
    let kept = fs::read_to_string(&path).unwrap();
    let mut foreign: Value = serde_json::from_str(kept.lines().last().unwrap()).unwrap();
    foreign["index"] = 7.into();
    fs::write(&path, format!("{kept}{foreign}\n")).unwrap();
    fail(folder.path(), &format!("{RANK} --journal run.jsonl"), 1);
    fail(folder.path(), "rank --merge run.jsonl", 1);
}

#[test]
#[ignore = "the journal is replaced by a results folder"]
fn a_result_under_another_name_is_refused() {
    is_refused(|line| line["material"] = "another".into());
    is_refused(|line| line["predictions"][0]["method"] = "another".into());
}

#[test]
#[ignore = "the journal is replaced by a results folder"]
fn a_loss_that_is_no_loss_is_refused() {
    is_refused(|line| line["predictions"][0]["result"]["Ok"]["loss"] = (-0.5).into());
    is_refused(|line| line["predictions"][0]["result"]["Ok"]["standard_error"] = (-0.5).into());
}

#[cfg(unix)]
#[test]
#[ignore = "the journal is replaced by a results folder"]
fn results_have_one_writer_under_whatever_name() {
    let folder = with_results();
    let of = |name: &str| folder.path().join(name);
    std::os::unix::fs::symlink("run.jsonl", of("same.jsonl")).unwrap();
    fs::write(of("run.jsonl.lock"), "process 4711\n").unwrap();
    let held = fs::OpenOptions::new().write(true).open(of("run.jsonl.lock")).unwrap();
    held.try_lock().unwrap();
    let error = fail(folder.path(), &format!("{RANK} --journal same.jsonl"), 1);
    assert!(error.contains("being written by"), "{error}");
}

#[cfg(target_os = "linux")]
#[test]
#[ignore = "the journal is replaced by a results folder"]
fn a_signal_leaves_no_lock_and_no_temporary_file() {
    let folder = tempfile::tempdir().unwrap();
    for (name, more) in [("gt", 0), ("ours", 8)] {
        fs::create_dir(folder.path().join(name)).unwrap();
        for i in 0..12 {
            write_material(&folder.path().join(name).join(format!("m{i:02}.png")), 32, 60 + i + more);
        }
    }
    for signal in ["TERM", "INT", "HUP"] {
        let mut command = command("env");
        command.args(["--default-signal=INT,TERM,HUP", env!("CARGO_BIN_EXE_svbrdf")]);
        command.args("rank --dataset gt ours --target-error 1% --journal run.jsonl".split(' '));
        command.current_dir(folder.path()).env("RAYON_NUM_THREADS", "1");
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let lines =
            || fs::read_to_string(folder.path().join("run.jsonl")).map_or(0, |text| text.lines().count());
        while lines() < 3 && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(1));
        }
        assert!(
            Command::new("kill")
                .args([&format!("-{signal}"), &child.id().to_string()])
                .status()
                .unwrap()
                .success()
        );
        child.wait().unwrap();
        assert_eq!(files(folder.path()), ["gt", "ours", "run.jsonl"], "{signal}");
        fs::remove_file(folder.path().join("run.jsonl")).unwrap();
    }
}

#[test]
#[ignore = "the journal is replaced by a results folder"]
fn files_of_the_future_are_not_called_changed() {
    let folder = with_results();
    let later = SystemTime::now() + Duration::from_hours(24);
    for name in ["gt/m0.png", "ours/m0.png"] {
        fs::File::options().write(true).open(folder.path().join(name)).unwrap().set_modified(later).unwrap();
    }
    fs::remove_file(folder.path().join("run.jsonl")).unwrap();
    succeed(folder.path(), &format!("{RANK} --journal run.jsonl"));
    let again = run_in(folder.path(), &format!("{RANK} --journal run.jsonl"));
    assert!(again.status.success() && text(&again.stderr).is_empty(), "{}", text(&again.stderr));
}
