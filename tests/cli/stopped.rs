//! Ctrl+C while files are written, and a data-set run that is killed.
#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::support::temporary::is_writing;

use super::{command, files, folder, succeed, write_material};

/// Width and height of the material: writing it takes a while.
const LARGE: u32 = 640;

/// Starts the program in `folder`. Signals that the tests' own parent ignores are not ignored, but those of `ignored` are.
fn start(folder: &Path, args: &str, ignored: &str) -> Child {
    let mut command = command("env");
    command.arg("--default-signal=INT,TERM,HUP,QUIT,USR1,USR2,ALRM,XCPU");
    command.args((!ignored.is_empty()).then(|| format!("--ignore-signal={ignored}")));
    command.arg(env!("CARGO_BIN_EXE_svbrdf")).args(args.split(' ')).current_dir(folder);
    // One material of a data set after the other: many cores would be done with all at once.
    command.env("RAYON_NUM_THREADS", if args.starts_with("rank") { "1" } else { "0" });
    command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
}

fn convert(folder: &Path, out: &str) -> Child {
    start(folder, &format!("convert large.png {out}"), "")
}

fn send(signal: &str, child: &Child) {
    let kill = format!("kill -{signal} {}", child.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
}

/// Waits until the child has a temporary file or folder in `folder`; false where it has ended before.
fn writing(folder: &Path, child: &mut Child) -> bool {
    while child.try_wait().unwrap().is_none() {
        if is_writing(folder, child.id()) {
            return true;
        }
        sleep(Duration::from_millis(1));
    }
    false
}

/// Ends as a shell shows it: by the signal itself, or with its code.
fn is_interrupted(status: ExitStatus) -> bool {
    use std::os::unix::process::ExitStatusExt;
    status.code() == Some(130) || matches!(status.signal(), Some(2 | 15))
}

fn remove(target: &Path) {
    if target.is_dir() { fs::remove_dir_all(target) } else { fs::remove_file(target) }.unwrap();
}

#[test]
fn an_interrupt_at_any_moment_leaves_what_was_there() {
    let folder = folder();
    write_material(&folder.path().join("large.png"), LARGE, 90);
    let before = files(folder.path());
    for (args, target, signal) in [
        ("out.exr --depth float", "out.exr", "INT"),
        ("out.png --depth 16", "out.png", "TERM"),
        ("out", "out", "INT"),
        ("out.glb", "out.glb", "TERM"),
    ] {
        let target = folder.path().join(target);
        let started = Instant::now();
        let mut child = convert(folder.path(), args);
        assert!(writing(folder.path(), &mut child));
        let reading = started.elapsed();
        assert!(child.wait().unwrap().success());
        let writing_time = started.elapsed() - reading;
        remove(&target);

        let mut cancelled = 0;
        for share in [0.0, 0.2, 0.4, 0.6, 0.8] {
            let mut child = convert(folder.path(), args);
            assert!(writing(folder.path(), &mut child));
            sleep(writing_time.mul_f64(share));
            send(signal, &child);
            let status = child.wait().unwrap();
            let finished = status.success() && target.exists();
            assert!(finished || status.code() == Some(130) && !target.exists(), "{args}: {status}");
            cancelled += u32::from(!finished);
            if finished {
                remove(&target);
            }
            assert_eq!(files(folder.path()), before, "{args}: something is left");
        }
        assert!(cancelled > 0, "{args}: nothing was ever cancelled");

        // While it reads there is nothing to take away, and no need to wait.
        let mut child = convert(folder.path(), args);
        sleep(reading / 4);
        send(signal, &child);
        assert!(is_interrupted(child.wait().unwrap()), "{args}");
        assert_eq!(files(folder.path()), before);
    }
}

#[test]
fn every_signal_that_ends_the_program_leaves_nothing_though_another_one_is_ignored() {
    let folder = folder();
    write_material(&folder.path().join("large.png"), LARGE, 90);
    let before = files(folder.path());
    let alone = ["QUIT", "USR1", "USR2", "ALRM", "XCPU", "HUP"].map(|signal| (signal, ""));
    // The one that is ignored does not end it.
    let beside = [("TERM", "INT"), ("HUP", "INT"), ("TERM", "HUP"), ("INT", "HUP"), ("INT", "INT")];
    for (signal, ignored) in alone.into_iter().chain(beside) {
        let mut child = start(folder.path(), "convert large.png out.exr --depth float", ignored);
        assert!(writing(folder.path(), &mut child));
        if !ignored.is_empty() {
            send(ignored, &child);
        }
        send(signal, &child);
        let status = child.wait().unwrap();
        if status.success() {
            remove(&folder.path().join("out.exr"));
        }
        assert!(status.success() || status.code() == Some(130) && signal != ignored, "{signal}: {status}");
        assert_eq!(files(folder.path()), before, "{signal}: something is left");
    }
}

/// What is written is complete before it has a name.
#[test]
fn a_kill_at_any_moment_leaves_the_whole_old_file() {
    let folder = folder();
    write_material(&folder.path().join("large.png"), LARGE, 90);
    let out = folder.path().join("out.exr");
    fs::write(&out, "old").unwrap();
    let before = files(folder.path());
    let mut unfinished = 0;
    for delay in [0, 5, 20, 60] {
        let mut child = convert(folder.path(), "out.exr --depth float");
        assert!(writing(folder.path(), &mut child));
        sleep(Duration::from_millis(delay));
        let ended = child.try_wait().unwrap().is_some();
        child.kill().unwrap();
        child.wait().unwrap();
        let is_old = fs::read(&out).unwrap() == b"old";
        assert!(is_old || fs::metadata(&out).unwrap().len() > 1_000_000, "{delay}: a part of the new file");
        unfinished += u32::from(is_old && !ended);
        fs::write(&out, "old").unwrap();
        assert_eq!(files(folder.path()), before, "{delay}: something is left");
    }
    assert!(unfinished > 0, "nothing was ever killed");
}

#[test]
fn a_signal_while_options_are_saved_leaves_nothing() {
    let folder = folder();
    for delay in (0..600).step_by(20) {
        let mut child = start(folder.path(), "info gt.png --save", "");
        let began = writing(folder.path(), &mut child);
        sleep(Duration::from_micros(delay));
        if began && child.try_wait().unwrap().is_none() {
            send("TERM", &child);
        }
        child.wait().unwrap();
        let left: Vec<_> = files(folder.path()).into_iter().filter(|name| name.starts_with('.')).collect();
        assert_eq!(left, [""; 0], "after {delay} us");
    }
}

/// A data set of so many materials that a run of it can be killed on its way.
fn data_set() -> tempfile::TempDir {
    let folder = super::data_set(&[("ours", 8), ("theirs", 40)], MATERIALS);
    fs::write(folder.path().join("theirs/m3.png"), "not an image").unwrap();
    folder
}

const MATERIALS: u8 = 10;
const RANK: &str = "rank --dataset gt ours theirs --target-error 3% --metrics";

/// Starts a run with a results folder. Returns it when two results are there.
fn rank(folder: &Path) -> Child {
    let mut child = start(folder, &format!("{RANK} --results kept"), "");
    while kept(folder).len() < 2 && child.try_wait().unwrap().is_none() {
        sleep(Duration::from_millis(1));
    }
    child
}

/// The results that are there.
fn kept(folder: &Path) -> Vec<String> {
    let kept = folder.join("kept");
    let names = if kept.exists() { files(&kept) } else { Vec::new() };
    names.into_iter().filter(|name| !name.starts_with('.')).collect()
}

#[test]
fn a_data_set_run_that_is_killed_and_continued_prints_the_bytes_of_a_whole_one() {
    let folder = data_set();
    let mut child = rank(folder.path());
    child.kill().unwrap();
    child.wait().unwrap();
    let left = kept(folder.path());
    assert!(
        (2..2 * usize::from(MATERIALS) - 1).contains(&left.len()),
        "{left:?}: the run was not interrupted"
    );
    let time =
        |name: &String| fs::metadata(folder.path().join("kept").join(name)).unwrap().modified().unwrap();
    let times: Vec<_> = left.iter().map(time).collect();
    for format in ["csv", "json", "latex"] {
        let whole = succeed(folder.path(), &format!("{RANK} --format {format}"));
        assert_eq!(succeed(folder.path(), &format!("{RANK} --format {format} --results kept")), whole);
    }
    assert_eq!(left.iter().map(time).collect::<Vec<_>>(), times, "results were computed again");
}

#[test]
fn a_signal_while_results_are_computed_leaves_no_temporary_file() {
    let folder = data_set();
    for signal in ["TERM", "INT", "HUP"] {
        let mut child = rank(folder.path());
        send(signal, &child);
        let status = child.wait().unwrap();
        assert!(status.success() || status.code() == Some(130), "{signal}: {status}");
        assert_eq!(files(&folder.path().join("kept")), kept(folder.path()), "{signal}");
        fs::remove_dir_all(folder.path().join("kept")).unwrap();
    }
}
