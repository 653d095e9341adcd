//! The program as its users run it: exit codes, stdout, stderr and files.

#[cfg(target_os = "linux")]
mod claims;
mod links;
mod memory;
mod names;
mod pictures;
mod results;
mod stopped;
mod version;

use std::path::Path;
use std::process::{Command, Output};

use image::{Rgb, RgbImage};
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
    write_planted(&folder.path().join("planted"));
    for (name, convention) in [("answer", "svbrdf-estimation-2022"), ("viewer", "gltf-viewer")] {
        crate::conform::write_answer(&folder.path().join(name).with_extension("npz"), convention);
    }
    folder
}

/// Writes a ground truth with bumps, and copies with a planted error each, on the stored texels of the tiles: 0 normals, 1 diffuse,
/// 2 roughness, 3 specular.
fn write_planted(folder: &Path) {
    const SIDE: u32 = 32;
    type Change = fn(u32, [u8; 3]) -> [u8; 3];
    let copies: [(&str, Change); 9] = [
        ("truth", |_, texel| texel),
        ("directx", |tile, [r, g, b]| if tile == 0 { [r, 255 - g, b] } else { [r, g, b] }),
        ("gloss", |tile, texel| if tile == 2 { texel.map(|v| 255 - v) } else { texel }),
        ("encoded", |tile, texel| if tile % 2 == 1 { texel.map(encoded) } else { texel }),
        ("swapped", |tile, [r, g, b]| if tile == 1 { [b, g, r] } else { [r, g, b] }),
        // Rounding: an eighth of the values is one step away.
        ("rounded", |_, [r, g, b]| [r, g + u8::from(r % 8 == 0), b]),
        // Both far from the truth, and near each other; and one that is far from all.
        ("rough", |tile, texel| if tile == 2 { texel.map(|v| v + 60) } else { texel }),
        ("same", |tile, texel| if tile == 2 { texel.map(|v| v + 61) } else { texel }),
        ("black", |tile, texel| if tile == 1 { [0; 3] } else { texel }),
    ];
    let wave = |x: u32, y: u32, by: f32| {
        (0.5 + 0.5 * (0.9 * x as f32 + by).sin() * (0.7 * y as f32 + 2.0 * by).cos()) * 255.0
    };
    for (name, change) in copies {
        write_tiles(&folder.join(name).with_extension("png"), SIDE, |x, y| {
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
}

/// The gamma 2.2 of a stored value.
fn encoded(value: u8) -> u8 {
    (255.0 * (f32::from(value) / 255.0).powf(1.0 / 2.2)).round() as u8
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

/// A text file of the folder.
fn text_of(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}
