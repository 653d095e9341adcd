//! The program as its users run it: exit codes, stdout, stderr and files.

#[cfg(target_os = "linux")]
mod claims;
mod diagnose;
mod links;
mod loss;
mod materials;
mod memory;
mod metrics;
mod names;
mod options;
mod packages;
mod photo;
mod pictures;
mod rank;
mod rank_html;
mod report;
mod results;
mod robust;
mod stopped;
mod study;
mod why;

use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Output};

use image::{Rgb, RgbImage};
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::support::surroundings::command;

fn svbrdf() -> Command {
    command(env!("CARGO_BIN_EXE_svbrdf"))
}

/// Runs in `folder` with arguments that are separated by spaces.
fn run_in(folder: &Path, args: &str) -> Output {
    svbrdf().args(args.split_whitespace()).current_dir(folder).output().unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// The stdout of a run that must succeed, with nothing to complain about.
fn succeed(folder: &Path, args: &str) -> String {
    let output = run_in(folder, args);
    assert!(output.status.success(), "{args}: {}", text(&output.stderr));
    let complaints =
        text(&output.stderr).lines().find(|line| !line.starts_with("svbrdf: note: ") && !is_progress(line));
    assert_eq!(complaints, None, "{args}");
    text(&output.stdout).to_owned()
}

/// `svbrdf: comparing materials: 2 of 3`, as a run of several seconds prints it.
fn is_progress(line: &str) -> bool {
    let count = line.rsplit_once(": ").and_then(|(_, count)| count.split_once(" of "));
    count.is_some_and(|(done, all)| [done, all].iter().all(|number| number.parse::<u64>().is_ok()))
}

/// The JSON of a run that must succeed.
fn json_of(folder: &Path, args: &str) -> Value {
    json(&succeed(folder, &format!("{args} --format json")))
}

/// The rows of the CSV of a run that must succeed, each cell by its title.
fn rows_of(folder: &Path, args: &str) -> Vec<BTreeMap<String, String>> {
    rows(&succeed(folder, &format!("{args} --format csv")))
}

fn rows(csv: &str) -> Vec<BTreeMap<String, String>> {
    let rows = csv::Reader::from_reader(csv.as_bytes()).into_deserialize();
    rows.map(Result::unwrap).collect()
}

#[track_caller]
fn assert_has(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "`{part}` is missing in\n{text}");
    }
}

/// Checks that a file of the folder holds these texts, in whatever surrounds them.
#[track_caller]
fn assert_holds(folder: &Path, name: &str, parts: &[&str]) {
    let bytes = std::fs::read(folder.join(name)).unwrap();
    for part in parts {
        assert!(
            bytes.windows(part.len()).any(|window| window == part.as_bytes()),
            "`{part}` is not in {name}"
        );
    }
}

/// Runs each command, which must fail with its code and a message that has its words.
fn assert_refused(folder: &Path, commands: &[(&str, i32, &str)]) {
    for (args, code, words) in commands {
        let stderr = fail(folder, args, *code);
        assert!(stderr.contains(words), "{args}: `{words}` is missing in {stderr}");
    }
}

/// The output of a command under a limit of the shell, such as `-v 200000`: of one thread, so that it takes little by itself.
#[cfg(target_os = "linux")]
fn limited(folder: &Path, limit: &str, args: &str) -> Output {
    let line = format!("ulimit {limit}; exec {} {args}", env!("CARGO_BIN_EXE_svbrdf"));
    let mut command = command("sh");
    command.args(["-c", &line]).current_dir(folder);
    command.envs([("RAYON_NUM_THREADS", "1"), ("MALLOC_ARENA_MAX", "1")]).output().unwrap()
}

/// The stderr of a run that must fail with `code`: an error on its one line, no result, no new file.
fn fail(folder: &Path, args: &str, code: i32) -> String {
    let before = files(folder);
    let output = run_in(folder, args);
    let stderr = text(&output.stderr).to_owned();
    assert_eq!(output.status.code(), Some(code), "{args}: {stderr}");
    assert_eq!(text(&output.stdout), "", "{args}");
    assert_eq!(stderr.matches("error: ").count(), 1, "{args}: {stderr}");
    assert!(!stderr.contains("panicked"), "{args}: {stderr}");
    assert_eq!(files(folder), before, "{args}");
    stderr
}

fn files(folder: &Path) -> Vec<String> {
    let names = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<_> = names.map(|name| name.to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// A packed strip: normal | diffuse | roughness | specular, `side` texels each.
fn write_material(path: &Path, side: u32, roughness: u8) {
    write_tiles(path, side, |x, y| match x / side {
        0 => [128, 140, 250],
        1 => [200, (8 * (x % side)) as u8, (8 * y) as u8],
        2 => [roughness; 3],
        _ => [12; 3],
    });
}

/// Ground truths and methods in folders, with materials `m0.png` and so on. The roughness of a method is larger by a number.
fn data_set(methods: &[(&str, u8)], materials: u8) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    write_data_set(folder.path(), methods, materials);
    folder
}

fn write_data_set(at: &Path, methods: &[(&str, u8)], materials: u8) {
    for (name, more) in [("gt", 0)].iter().chain(methods) {
        std::fs::create_dir(at.join(name)).unwrap();
        for i in 0..materials {
            write_material(&at.join(name).join(format!("m{i}.png")), 8, 60 + 17 * i + more);
        }
    }
}

/// The folder of the transcripts: that of the other tests, a data set, planted errors, and radiances of two renderers.
pub fn folder_of_transcripts() -> TempDir {
    let folder = folder();
    write_data_set(folder.path(), &[("ours", 8), ("theirs", 40)], 3);
    std::fs::create_dir(folder.path().join("planted")).unwrap();
    diagnose::write_planted(&folder.path().join("planted"));
    for (name, convention) in [("answer", "svbrdf-estimation-2022"), ("viewer", "gltf-viewer")] {
        crate::conform::write_answer(&folder.path().join(name).with_extension("npz"), convention);
    }
    folder
}

/// Writes a packed material of four tiles.
fn write_tiles(path: &Path, side: u32, at: impl Fn(u32, u32) -> [u8; 3]) {
    RgbImage::from_fn(4 * side, side, |x, y| Rgb(at(x, y))).save(path).unwrap();
}

/// A folder with materials of one size and of others, and scene files.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let of = |name: &str| folder.path().join(name);
    for (name, side, roughness) in [("gt", 8, 100), ("a", 8, 120), ("b", 8, 220), ("big", 16, 100)] {
        write_material(&of(&format!("{name}.png")), side, roughness);
    }
    let scene = |light: &str| format!(r#"{{"kind": "near", "view": [0, 0, 2], "light": {light}}}"#);
    let file = |scenes: &str| format!(r#"{{"scenes": [{scenes}]}}"#);
    let scene_files = [
        ("one.json", file(&scene("[0.5, 0.5, 1]"))),
        ("nan.json", file(&scene("[0.5, NaN, 1]"))),
        ("below.json", file(&scene("[0.5, 0.5, -1]"))),
        ("none.json", file("")),
        ("not.json", "scenes".to_owned()),
    ];
    for (name, content) in scene_files {
        std::fs::write(of(name), content).unwrap();
    }
    std::fs::write(of("text.png"), "not an image").unwrap();
    folder
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

fn losses_as_json(folder: &Path, args: &str) -> Value {
    json_of(folder, &format!("loss {args}"))
}

/// The loss of the first prediction.
fn loss_of(folder: &Path, args: &str) -> f64 {
    losses_as_json(folder, args)["results"][0]["loss"].as_f64().unwrap()
}

/// A text file of the folder.
fn text_of(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}
