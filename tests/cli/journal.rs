//! Journals: what results depend on is recorded, and whatever differs is refused or computed again.

use std::fs::{self, File};
use std::path::Path;
use std::time::{Duration, SystemTime};

use serde_json::Value;
use tempfile::TempDir;

use super::{fail, run_in, succeed, text, write_material};

const RANK: &str = "rank --dataset gt ours theirs --target-error 10%";

/// Ground truths and two methods with three materials each.
fn data_set() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, more) in [("gt", 0), ("ours", 8), ("theirs", 40)] {
        fs::create_dir(folder.path().join(name)).unwrap();
        for i in 0..3_u8 {
            write_material(&folder.path().join(name).join(format!("m{i}.png")), 8, 60 + 17 * i + more);
        }
    }
    folder
}

/// The results of a run that must succeed as JSON, and its notes.
fn results(folder: &Path, args: &str) -> (Value, String) {
    let output = run_in(folder, &format!("{args} --format json"));
    assert!(output.status.success(), "{args}: {}", text(&output.stderr));
    (serde_json::from_slice(&output.stdout).unwrap(), text(&output.stderr).to_owned())
}

#[test]
fn a_journal_of_other_options_of_reading_is_refused() {
    let folder = data_set();
    let run = |options: &str| format!("{RANK} --journal run.jsonl {options}");
    succeed(folder.path(), &run("--read albedo=gamma2.2"));
    let before = fs::read(folder.path().join("run.jsonl")).unwrap();
    for (options, difference) in [
        ("--read albedo=linear", r#"reading.ground-truths.albedo is "gamma2.2", but "linear""#),
        ("", r#"reading.predictions.albedo is "gamma2.2", but unspecified"#),
        ("--read albedo=gamma2.2 --read normal-y=down", r#"normal-y is unspecified, but "down""#),
        (
            "--read albedo=gamma2.2 --read pred:albedo=linear",
            r#"reading.predictions.albedo is "gamma2.2", but "linear""#,
        ),
        ("--read albedo=gamma2.2 --read roughness=gloss", "roughness"),
        ("--read albedo=gamma2.2 --read flip-v=true", "flip-v"),
        ("--read albedo=gamma2.2 --strict", "reading.strict is false, but true"),
        ("--read albedo=gamma2.2 --convention guided-2020", r#"convention is "printed", but "guided-2020""#),
        ("--read albedo=gamma2.2 --seed 3", "seed is 0, but 3 in this run"),
        ("--read albedo=gamma2.2 --metrics", "metrics"),
        ("--read albedo=gamma2.2 --diagnose", "diagnose is unspecified, but true"),
    ] {
        let stderr = fail(folder.path(), &run(options), 1);
        assert!(stderr.contains("of other settings") && stderr.contains(difference), "{options}: {stderr}");
    }
    assert_eq!(fs::read(folder.path().join("run.jsonl")).unwrap(), before);
    succeed(folder.path(), &run("--read albedo=gamma2.2"));
}

#[test]
fn parts_that_were_read_differently_are_not_joined() {
    let folder = data_set();
    for (part, albedo) in [(1, "gamma2.2"), (2, "linear")] {
        succeed(
            folder.path(),
            &format!("{RANK} --shard {part}/2 --journal {part}.jsonl --read albedo={albedo}"),
        );
    }
    let stderr = fail(folder.path(), "rank --merge 1.jsonl 2.jsonl", 1);
    for part in ["2.jsonl cannot be used", r#"albedo is "linear", but "gamma2.2""#, "in 1.jsonl"] {
        assert!(stderr.contains(part), "{part}: {stderr}");
    }
    succeed(folder.path(), &format!("{RANK} --shard 2/2 --journal 3.jsonl --read albedo=gamma2.2"));
    succeed(folder.path(), "rank --merge 1.jsonl 3.jsonl");
}

#[test]
fn results_of_replaced_files_are_computed_again() {
    let folder = data_set();
    let of = |name: &str| folder.path().join(name);
    let with_journal = format!("{RANK} --journal run.jsonl");
    let (old, _) = results(folder.path(), &with_journal);
    // A method is replaced by files of the same size, and a sidecar file changes how a ground truth is read.
    let bytes = |name: &str| fs::metadata(of(name)).unwrap().len();
    let size = bytes("theirs/m1.png");
    let other = (0..).find(|roughness| {
        write_material(&of("theirs/m1.png"), 8, *roughness);
        bytes("theirs/m1.png") == size
    });
    assert!(other.is_some());
    fs::write(of("gt/m2.svbrdf.json"), r#"{"albedo": "gamma2.2"}"#).unwrap();
    let (whole, _) = results(folder.path(), RANK);
    assert_ne!(whole["methods"], old["methods"]);
    let (resumed, notes) = results(folder.path(), &with_journal);
    assert_eq!(resumed, whole);
    for note in [
        "m1 is computed again: theirs/m1.png has changed",
        "m2 is computed again: gt/m2.svbrdf.json has changed",
    ] {
        assert!(notes.contains(note), "{note}: {notes}");
    }
    assert_eq!(notes.matches("computed again").count(), 2, "{notes}");
    let (_, notes) = results(folder.path(), &with_journal);
    assert!(!notes.contains("computed again"), "{notes}");
    fs::remove_file(of("ours/m0.png")).unwrap();
    let (_, notes) = results(folder.path(), &with_journal);
    assert!(notes.contains("m0 is computed again: ours/m0"), "{notes}");
}

#[test]
fn files_that_were_copied_or_touched_have_the_same_results() {
    let folder = data_set();
    let with_journal = format!("{RANK} --journal run.jsonl");
    let (old, _) = results(folder.path(), &with_journal);
    // A planted loss shows that nothing is computed again.
    let journal = folder.path().join("run.jsonl");
    let loss = old["results"][1]["predictions"][0]["result"]["Ok"]["loss"].to_string();
    fs::write(
        &journal,
        fs::read_to_string(&journal).unwrap().replace(&format!("\"loss\":{loss}"), "\"loss\":0.125"),
    )
    .unwrap();
    for name in ["gt", "ours", "theirs"] {
        let file = File::options().write(true).open(folder.path().join(name).join("m1.png")).unwrap();
        file.set_modified(SystemTime::UNIX_EPOCH + Duration::from_secs(1_000_000_000)).unwrap();
    }
    let (touched, notes) = results(folder.path(), &with_journal);
    assert_eq!(touched["results"][1]["predictions"][0]["result"]["Ok"]["loss"], 0.125, "{notes}");
    assert!(!notes.contains("computed again"), "{notes}");
}

#[test]
fn an_empty_file_becomes_a_journal_and_is_not_joined() {
    let folder = data_set();
    fs::write(folder.path().join("empty.jsonl"), "").unwrap();
    let error = fail(folder.path(), "rank --merge empty.jsonl", 1);
    assert!(error.contains("it is empty"), "{error}");
    succeed(folder.path(), &format!("{RANK} --journal empty.jsonl"));
    succeed(folder.path(), &format!("{RANK} --journal new.jsonl"));
    let of = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert!(of("empty.jsonl") == of("new.jsonl"));
}

#[test]
fn a_journal_without_a_head_is_refused_with_what_to_do() {
    let folder = data_set();
    let first = r#"{"convention":"printed","target_error":0.1,"seed":0,"materials":["m0","m1","m2"],"methods":["ours","theirs"]}"#;
    fs::write(folder.path().join("old.jsonl"), format!("{first}\n")).unwrap();
    for args in [format!("{RANK} --journal old.jsonl"), "rank --merge old.jsonl".to_owned()] {
        let stderr = fail(folder.path(), &args, 1);
        for part in ["did not record how the materials were read", "delete it or name another file"] {
            assert!(stderr.contains(part), "{part}: {stderr}");
        }
    }
    let newer = r#"{"svbrdf-journal":4,"program":"svbrdf 9.0.0"}"#;
    fs::write(folder.path().join("new.jsonl"), format!("{newer}\n")).unwrap();
    let stderr = fail(folder.path(), &format!("{RANK} --journal new.jsonl"), 1);
    assert!(stderr.contains("its format is 4, expected 3"), "{stderr}");
}

#[test]
fn a_journal_that_another_process_writes_is_refused() {
    let folder = data_set();
    let lock = folder.path().join("run.jsonl.lock");
    fs::write(&lock, "process 4711\n").unwrap();
    let held = fs::OpenOptions::new().write(true).open(&lock).unwrap();
    held.try_lock().unwrap();
    let error = fail(folder.path(), &format!("{RANK} --journal run.jsonl"), 1);
    for part in ["run.jsonl is being written by process 4711", "every shard has its own"] {
        assert!(error.contains(part), "{error}");
    }
    drop(held);
    succeed(folder.path(), &format!("{RANK} --journal run.jsonl"));
    assert!(!lock.exists());
}

#[test]
fn two_shards_at_once_on_one_journal_do_not_lose_results_in_silence() {
    let folder = data_set();
    let shard = |part: usize| {
        let args = format!("{RANK} --shard {part}/2 --journal run.jsonl");
        super::svbrdf().args(args.split(' ')).current_dir(folder.path()).output().unwrap()
    };
    let ends: Vec<_> = std::thread::scope(|scope| {
        let running: Vec<_> = (1..=2).map(|part| scope.spawn(move || shard(part))).collect();
        running.into_iter().map(|running| running.join().unwrap()).collect()
    });
    let lines = fs::read_to_string(folder.path().join("run.jsonl")).unwrap().lines().count() - 1;
    match ends.iter().filter(|end| end.status.success()).count() {
        // One after the other.
        2 => assert_eq!(lines, 3),
        1 => assert!((1..=2).contains(&lines), "{lines}"),
        none => panic!("{none} shards have ended well: {}", text(&ends[0].stderr)),
    }
}

#[test]
fn a_journal_that_contradicts_itself_is_refused() {
    let folder = data_set();
    succeed(folder.path(), &format!("{RANK} --journal run.jsonl"));
    let path = folder.path().join("run.jsonl");
    let journal = fs::read_to_string(&path).unwrap();
    let line = journal.lines().nth(1).unwrap();
    // The same line twice is no contradiction.
    fs::write(&path, format!("{journal}{line}\n")).unwrap();
    succeed(folder.path(), "rank --merge run.jsonl");
    let mut other: Value = serde_json::from_str(line).unwrap();
    other["seed"] = 12345.into();
    fs::write(&path, format!("{journal}{other}\n")).unwrap();
    for args in ["rank --merge run.jsonl".to_owned(), format!("{RANK} --journal run.jsonl")] {
        let error = fail(folder.path(), &args, 1);
        assert!(error.contains("two results of m0"), "{error}");
    }
}

#[test]
fn a_data_set_without_any_loss_is_an_error() {
    let folder = data_set();
    for method in ["ours", "theirs"] {
        for i in 0..3 {
            fs::write(folder.path().join(format!("{method}/m{i}.png")), "no image").unwrap();
        }
    }
    for format in ["text", "json", "csv", "latex"] {
        let output = run_in(folder.path(), &format!("{RANK} --format {format}"));
        assert_eq!(output.status.code(), Some(1), "{format}");
        assert!(!text(&output.stdout).contains("NaN"), "{}", text(&output.stdout));
        assert!(
            text(&output.stderr).contains("no prediction has a loss: 6 of 6"),
            "{}",
            text(&output.stderr)
        );
    }
}
