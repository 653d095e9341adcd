//! The results folder of a data set: what is there and right is used, everything else is computed.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::thread::sleep;
use std::time::{Duration, SystemTime};

use image::{Rgb, RgbImage};
use tempfile::TempDir;

use super::{assert_has, fail, files, run_in, succeed, svbrdf, text, write_material};

const RANK: &str = "rank --dataset gt ours theirs --target-error 20% --format json";

const NONE: [&str; 0] = [];

/// Ground truths and two methods with three materials each.
fn data_set() -> TempDir {
    super::data_set(&[("ours", 8), ("theirs", 40)], 3)
}

/// The files of the results folder, each with the time when it was written.
fn kept(folder: &Path) -> BTreeMap<String, SystemTime> {
    let time = |name: &String| fs::metadata(folder.join("kept").join(name)).unwrap().modified().unwrap();
    files(&folder.join("kept")).into_iter().map(|name| (name.clone(), time(&name))).collect()
}

/// Runs `args` with the results folder. The output is that of a run with an empty one. Returns the pairs whose files were written, such
/// as `m0_ours`, and the notes.
fn run(folder: &Path, args: &str) -> (Vec<String>, String) {
    let before = if folder.join("kept").exists() { kept(folder) } else { BTreeMap::new() };
    let output = run_in(folder, &format!("{args} --results kept"));
    assert!(output.status.success(), "{args}: {}", text(&output.stderr));
    let without = run_in(folder, &format!("{args} --results new"));
    fs::remove_dir_all(folder.join("new")).unwrap();
    assert!(output.stdout == without.stdout, "{args}: {}", text(&output.stdout));
    let new = kept(folder).into_iter().filter(|(name, time)| before.get(name) != Some(time));
    (new.map(|(name, _)| pair(&name).to_owned()).collect(), text(&output.stderr).to_owned())
}

/// The pair of a file: its name without the hash.
fn pair(name: &str) -> &str {
    name.rsplit_once('_').unwrap().0
}

#[test]
fn each_pair_has_a_file_that_is_used_again() {
    let folder = data_set();
    let pairs = ["m0_ours", "m0_theirs", "m1_ours", "m1_theirs", "m2_ours", "m2_theirs"];
    assert_eq!(run(folder.path(), RANK).0, pairs);
    for format in ["json", "text", "csv", "latex"] {
        let args = RANK.replace("json", format);
        assert_eq!(run(folder.path(), &args).0, NONE, "{format}");
        assert_eq!(succeed(folder.path(), &args), succeed(folder.path(), &format!("{args} --results kept")));
    }
    // With other methods beside it, and materials gone.
    assert_eq!(run(folder.path(), &RANK.replace(" theirs", "")).0, NONE);
    fs::remove_file(folder.path().join("gt/m2.png")).unwrap();
    assert_eq!(run(folder.path(), RANK).0, NONE);
}

#[test]
fn parts_are_the_whole() {
    let folder = data_set();
    for part in [2, 1] {
        let (written, notes) = run(folder.path(), &format!("{RANK} --shard {part}/2"));
        assert_eq!(written.len(), [4, 2][part - 1]);
        assert!(notes.contains(&format!("part {part} of 2: {} of 3 materials", [2, 1][part - 1])), "{notes}");
    }
    assert_eq!(run(folder.path(), RANK).0, NONE);
    for wrong in ["0/3", "4/3", "1", "a/b"] {
        fail(folder.path(), &format!("{RANK} --shard {wrong} --results kept"), 64);
    }
    assert!(fail(folder.path(), &format!("{RANK} --shard 1/2"), 64).contains("--results"));
}

#[test]
fn two_processes_at_once_write_the_same_bytes() {
    let folder = data_set();
    let whole = succeed(folder.path(), RANK);
    let one = || assert_eq!(succeed(folder.path(), &format!("{RANK} --results kept")), whole);
    std::thread::scope(|scope| (0..3).for_each(|_| drop(scope.spawn(one))));
    assert_eq!(kept(folder.path()).len(), 6);
    assert_eq!(run(folder.path(), RANK).0, NONE);
}

#[test]
fn other_options_have_other_results() {
    let folder = data_set();
    run(folder.path(), RANK);
    for (options, new) in [
        ("--read albedo=gamma2.2", 6),
        ("--read gt:albedo=linear", 6),
        ("--read ours:albedo=linear", 3),
        ("--read pred:roughness=gloss", 6),
        ("--read flip-v=true", 6),
        ("--preset deschaintre --read order=ndrs --strict", 6),
        ("--convention guided-2020", 6),
        ("--seed 3", 6),
        ("--metrics", 6),
        ("--diagnose", 6),
        ("--pick best", 0),
        ("--fail-above 10", 0),
    ] {
        let args = format!("{RANK} {options}");
        assert_eq!(run(folder.path(), &args).0.len(), new, "{options}");
        assert_eq!(run(folder.path(), &args).0, NONE, "{options}");
    }
    assert_eq!(run(folder.path(), &RANK.replace("20%", "10%")).0.len(), 6);
}

#[test]
fn files_that_changed_have_other_results_and_touched_ones_the_same() {
    let folder = data_set();
    let of = |name: &str| folder.path().join(name);
    // What the files are like tells nothing of how colours are stored, and their neighbours are asked otherwise.
    let rank = format!("{RANK} --read albedo=srgb");
    run(folder.path(), &rank);
    // Of the same size, at the same time.
    let [size, time] = [0, 1].map(|_| fs::metadata(of("theirs/m1.png")).unwrap());
    let other = (0..).find(|roughness| {
        write_material(&of("theirs/m1.png"), 8, *roughness);
        fs::metadata(of("theirs/m1.png")).unwrap().len() == size.len()
    });
    assert!(other.is_some());
    let set_time = |name: &str, time| {
        fs::File::options().write(true).open(of(name)).unwrap().set_modified(time).unwrap();
    };
    set_time("theirs/m1.png", time.modified().unwrap());
    assert_eq!(run(folder.path(), &rank).0, ["m1_theirs"]);
    fs::write(of("gt/m2.svbrdf.json"), r#"{"roughness": "gloss"}"#).unwrap();
    assert_eq!(run(folder.path(), &rank).0, ["m2_ours", "m2_theirs"]);
    for time in [SystemTime::UNIX_EPOCH, SystemTime::now() + Duration::from_hours(24)] {
        ["gt/m0.png", "ours/m0.png", "gt/m2.svbrdf.json"].iter().for_each(|name| set_time(name, time));
        assert_eq!(run(folder.path(), &rank).0, NONE);
    }
    // A result of files of the future is kept, too.
    assert_eq!(run(folder.path(), &format!("{rank} --seed 1")).0.len(), 6);
    assert_eq!(run(folder.path(), &format!("{rank} --seed 1")).0, NONE);
}

#[test]
fn neighbours_that_a_reading_looked_at_are_a_part_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let of = |name: &str| folder.path().join(name);
    let gray = |name: &str, value: u8| RgbImage::from_pixel(8, 8, Rgb([value; 3])).save(of(name)).unwrap();
    for (at, roughness) in [("gt/one", 120), ("gt/other", 120), ("ours/one", 160)] {
        fs::create_dir_all(of(at)).unwrap();
        for (map, value) in [("diffuse", 102), ("specular", 31), ("roughness", roughness)] {
            gray(&format!("{at}/{map}.png"), value);
        }
    }
    let args = "rank --dataset gt ours --target-error 20% --format json";
    assert_eq!(run(folder.path(), args).0.len(), 1);
    assert_eq!(run(folder.path(), args).0, NONE);
    let before = succeed(folder.path(), args);
    // What is there of the other material tells how the colours of this one are stored.
    gray("gt/other/specular.png", 10);
    assert_ne!(succeed(folder.path(), args), before);
    assert_eq!(run(folder.path(), args).0, ["one_ours"]);
    assert_eq!(run(folder.path(), args).0, NONE);
}

#[test]
fn every_file_of_a_material_counts_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let of = |name: &str| folder.path().join(name);
    for (name, roughness) in [("gt", 60), ("other", 140)] {
        write_material(&of(&format!("{name}.png")), 8, roughness);
        fs::create_dir(of(name)).unwrap();
        for out in ["a.exr", "b.glb", "c.mtlx", "d"] {
            succeed(folder.path(), &format!("convert {name}.png {name}/{out} --read albedo=srgb"));
        }
        let maps = files(&of(name).join("d"));
        let roughness = maps.iter().find(|map| map.contains("roughness")).unwrap();
        for map in &maps {
            fs::copy(of(name).join("d").join(map), of(name).join(format!("p_{map}"))).unwrap();
        }
        let picture = format!(r#""images": [{{"uri": "p_{roughness}"}}], "textures": [{{"source": 0}}]"#);
        let surface = r#"{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}"#;
        let gltf = format!(r#"{{"asset": {{"version": "2.0"}}, {picture}, "materials": [{surface}]}}"#);
        fs::write(of(name).join("e.gltf"), gltf).unwrap();
        fs::write(of(name).join("f.mtl"), format!("newmtl f\nmap_Kd p_{roughness}\nPr 0.5\n")).unwrap();
    }
    let rows =
        ["a.exr", "b.glb", "c.mtlx", "d", "e.gltf", "f.mtl", "p_"].map(|form| format!("gt/{form},gt.png\n"));
    fs::write(of("pairs.csv"), format!("ground_truth,prediction\n{}", rows.concat())).unwrap();
    let args = "rank --pairs pairs.csv --target-error 30% --format json --read albedo=srgb";
    assert_eq!(run(folder.path(), args).0.len(), rows.len());
    assert_eq!(run(folder.path(), args).0, NONE);
    let mut noticed = Vec::new();
    for below in ["", "c_textures", "d"] {
        for name in files(&of("gt").join(below)) {
            let [to, from] = ["gt", "other"].map(|side| of(side).join(below).join(&name));
            if to.is_file() && fs::read(&to).unwrap() != fs::read(&from).unwrap() {
                fs::copy(from, to).unwrap();
                let written = run(folder.path(), args).0;
                noticed.push(written.iter().map(|name| name.split('_').next().unwrap()).collect::<String>());
            }
        }
    }
    assert_eq!(noticed, ["a", "b", "c", "efp", "c", "d"]);
}

#[test]
fn what_fails_is_tried_again() {
    let folder = data_set();
    let of = |name: &str| folder.path().join(name);
    let whole = succeed(folder.path(), RANK);
    let [broken, missing, truth] = ["ours/m0.png", "theirs/m1.png", "gt/m2.png"].map(of);
    let bytes = [&broken, &missing, &truth].map(|path| fs::read(path).unwrap());
    fs::write(&broken, "no image").unwrap();
    fs::remove_file(&missing).unwrap();
    fs::write(&truth, "no image").unwrap();
    for _ in 0..2 {
        run(folder.path(), RANK);
        let kept = files(&of("kept"));
        assert_eq!(kept.iter().map(|name| pair(name)).collect::<Vec<_>>(), ["m0_theirs", "m1_ours"]);
    }
    for (path, bytes) in [broken, missing, truth].iter().zip(bytes) {
        fs::write(path, bytes).unwrap();
    }
    assert_eq!(run(folder.path(), RANK).0.len(), 4);
    assert_eq!(succeed(folder.path(), &format!("{RANK} --results kept")), whole);
}

#[test]
fn a_file_that_changes_while_it_is_read_has_no_result_of_another() {
    let folder = tempfile::tempdir().unwrap();
    let of = |name: &str| folder.path().join(name);
    for (name, roughness) in [("gt", 60), ("ours", 80), ("new", 140)] {
        fs::create_dir(of(name)).unwrap();
        write_material(&of(name).join("m.png"), 256, roughness);
    }
    let args = "rank --dataset gt ours --target-error 30% --format json --read albedo=srgb";
    let contents = [fs::read(of("ours/m.png")).unwrap(), fs::read(of("new/m.png")).unwrap()];
    let place = |bytes: &Vec<u8>| {
        fs::write(of("next"), bytes).unwrap();
        fs::rename(of("next"), of("ours/m.png")).unwrap();
    };
    for delay in [5, 10, 20, 40, 80, 160] {
        place(&contents[0]);
        let with = format!("{args} --results kept");
        let mut command = svbrdf();
        command.args(with.split(' ')).current_dir(folder.path()).stdout(Stdio::null()).stderr(Stdio::null());
        let mut child = command.spawn().unwrap();
        sleep(Duration::from_millis(delay));
        place(&contents[1]);
        assert!(child.wait().unwrap().success());
        for bytes in &contents {
            place(bytes);
            run(folder.path(), args);
        }
        fs::remove_dir_all(of("kept")).unwrap();
    }
}

#[test]
fn a_file_that_was_damaged_or_belongs_to_another_pair_is_not_used() {
    let folder = data_set();
    run(folder.path(), RANK);
    let of = |name: &String| folder.path().join("kept").join(name);
    let [ours, other] = [0, 2].map(|place| files(&folder.path().join("kept"))[place].clone());
    let [right, other] = [&ours, &other].map(|name| fs::read_to_string(of(name)).unwrap());
    let start = right.find("\"loss\":").unwrap() + "\"loss\":".len();
    let loss = &right[start..start + right[start..].find(',').unwrap()];
    let with = |value: &str| format!("{}{value}{}", &right[..start], &right[start + loss.len()..]);
    // Half of the paths that results are of are those of the other pair: all of the text is checked.
    let renamed = right.replace("gt/m0.png", "gt/m1.png");
    let [short, empty] = [&right[..200], "{}"].map(str::to_owned);
    for content in [with("-0.5"), with("0.125"), with("null"), renamed, other, short, empty, String::new()] {
        assert_ne!(content, right);
        fs::write(of(&ours), &content).unwrap();
        let (written, notes) = run(folder.path(), RANK);
        assert_eq!(written, ["m0_ours"], "{content}");
        assert!(notes.contains(&ours) && notes.matches("computed again").count() == 1, "{content}: {notes}");
        assert_eq!(fs::read_to_string(of(&ours)).unwrap(), right);
    }
}

#[test]
fn a_results_folder_is_a_folder() {
    let folder = data_set();
    fs::write(folder.path().join("file"), "precious").unwrap();
    for name in ["file", "none/kept", "file/kept"] {
        let error = fail(folder.path(), &format!("{RANK} --results {name}"), 1);
        assert_has(&error, &[&format!("cannot write {name}"), "name a folder"]);
    }
    assert_eq!(fs::read_to_string(folder.path().join("file")).unwrap(), "precious");
}

#[test]
fn what_killed_processes_have_left_goes_after_a_day() {
    let folder = data_set();
    run(folder.path(), RANK);
    let place = |name: &str, age: Duration| {
        let path = folder.path().join("kept").join(name);
        fs::write(&path, "{").unwrap();
        fs::File::options().write(true).open(path).unwrap().set_modified(SystemTime::now() - age).unwrap();
    };
    // That of a process at work, and a file of another program.
    place(".svbrdf-young", Duration::from_hours(1));
    place(".svbrdf-old", Duration::from_hours(48));
    place("other.json", Duration::from_hours(48));
    run(folder.path(), RANK);
    let left = files(&folder.path().join("kept"));
    assert_eq!((left.len(), left.iter().filter(|name| name.starts_with('.')).count()), (8, 1), "{left:?}");
    assert!(left.contains(&".svbrdf-young".to_owned()), "{left:?}");
}

#[test]
fn a_data_set_without_any_loss_is_an_error() {
    let folder = data_set();
    for path in ["ours", "theirs"].iter().flat_map(|method| [0, 1, 2].map(|i| format!("{method}/m{i}.png"))) {
        fs::write(folder.path().join(path), "no image").unwrap();
    }
    for format in ["text", "json", "csv", "latex"] {
        let output = run_in(folder.path(), &RANK.replace("json", format));
        assert_eq!(output.status.code(), Some(1), "{format}");
        assert!(!text(&output.stdout).contains("NaN"), "{}", text(&output.stdout));
        assert_has(text(&output.stderr), &["no prediction has a loss: 6 of 6"]);
    }
}
