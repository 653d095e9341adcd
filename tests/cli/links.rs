//! Links and second names: nothing that was read, and nothing that nobody named, is written through them; links, devices and pipes that
//! a user names stay what they are.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::{FileTypeExt, symlink};
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

use super::{assert_has, command, fail, files, folder, run_in, succeed, svbrdf, text, text_of};

const RANK: &str = "rank --dataset gt ours --target-error 30%";
const PAIRS: &str = "rank --pairs pairs.csv --target-error 30%";

/// A ground truth and a method with two materials each.
fn data_set() -> TempDir {
    super::data_set(&[("ours", 20)], 2)
}

fn make_pipe(path: &Path) {
    assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
}

/// The code and stderr of a run that must end soon.
fn soon(folder: &Path, args: &str) -> (Option<i32>, String) {
    let mut command = command("timeout");
    command.args(["30", env!("CARGO_BIN_EXE_svbrdf")]).args(args.split(' ')).current_dir(folder);
    let output = command.output().unwrap();
    (output.status.code(), text(&output.stderr).to_owned())
}

/// Materials, lists, results, scenes, sessions and sidecar files, through a link and by a second name.
#[test]
fn nothing_that_was_read_is_replaced_by_another_name() {
    let folder = folder();
    let at = folder.path();
    let of = |name: &str| at.join(name);
    fs::write(of("pairs.csv"), "ground_truth,prediction\ngt.png,a.png\n").unwrap();
    let session = r#"{"svbrdf-session": 1, "convention": "printed", "materials": [{"path": "gt.png"}, {"path": "a.png"}],
        "scene": {"kind": "near", "view": [0, 0, 2], "light": [0.5, 0.5, 1]}}"#;
    fs::write(of("s.svbrdf-session.json"), session).unwrap();
    fs::write(of("gt.svbrdf.json"), r#"{"albedo": "srgb"}"#).unwrap();
    succeed(at, &format!("{PAIRS} --results kept"));
    let result = format!("kept/{}", files(&of("kept"))[0]);
    let page = format!("{PAIRS} --format html -o link.html");
    let kept = format!("{page} --results kept");
    for (args, input, output) in [
        ("render gt.png -o link.png", "gt.png", "link.png"),
        (&page, "pairs.csv", "link.html"),
        (&kept, &result, "link.html"),
        ("report s.svbrdf-session.json -o link.html", "s.svbrdf-session.json", "link.html"),
        ("map gt.png a.png --scenes one.json -o link.csv", "one.json", "link.csv"),
        ("strip gt.png a.png --scenes one.json -o link.png", "one.json", "link.png"),
        ("render gt.png -o link.png", "gt.svbrdf.json", "link.png"),
        ("convert gt.png link.exr", "gt.svbrdf.json", "link.exr"),
    ] {
        let before = fs::read(of(input)).unwrap();
        for is_hard in [false, true] {
            let _ = fs::remove_file(of(output));
            if is_hard { fs::hard_link(of(input), of(output)) } else { symlink(input, of(output)) }.unwrap();
            assert_has(&fail(at, args, 1), &["made from"]);
            assert!(fs::read(of(input)).unwrap() == before, "{args}");
        }
    }
}

/// Files whose names the program chooses: figures, saved options, results.
#[test]
fn what_nobody_named_is_not_written_through_a_link() {
    let (folder, set) = (folder(), data_set());
    let figures = format!("{RANK} --format html -o page.html --figures all");
    let results = format!("{RANK} --results kept");
    succeed(set.path(), &results);
    let result = format!("kept/{}", files(&set.path().join("kept"))[0]);
    for (at, args, written) in [
        (set.path(), figures.as_str(), "page-figures/0001-m0.html"),
        (set.path(), &results, &result),
        (folder.path(), "info a.png --read roughness=gloss --save", "a.svbrdf.json"),
    ] {
        succeed(at, args);
        let written = at.join(written);
        fs::write(at.join("other.txt"), "{}").unwrap();
        for name in ["other.txt", "none"] {
            fs::remove_file(&written).unwrap();
            let target = at.join(name);
            symlink(&target, &written).unwrap();
            let error = fail(at, args, 1);
            assert!(error.contains("link") && error.contains("remove the link"), "{args}: {error}");
            assert!(text_of(at, "other.txt") == "{}" && !at.join("none").exists(), "{args}");
        }
    }
    let at = set.path();
    fs::remove_dir_all(at.join("page-figures")).unwrap();
    symlink("gt", at.join("page-figures")).unwrap();
    assert_has(&fail(at, &figures, 1), &["a link to gt"]);
    assert_eq!(files(&at.join("gt")).len(), 2);
}

#[test]
fn a_result_is_no_pipe_and_no_folder_and_a_link_to_the_folder_of_results_is_meant() {
    let folder = data_set();
    let of = |name: &str| folder.path().join(name);
    let args = format!("{RANK} --results kept");
    succeed(folder.path(), &args);
    let result = of("kept").join(&files(&of("kept"))[0]);
    for is_pipe in [true, false] {
        fs::remove_file(&result).unwrap();
        if is_pipe {
            make_pipe(&result)
        } else {
            fs::create_dir(&result).unwrap()
        }
        let (code, stderr) = soon(folder.path(), &args);
        assert!(code == Some(1) && stderr.contains("no regular file"), "{code:?} {stderr}");
    }
    symlink("other", of("link")).unwrap();
    fs::create_dir(of("other")).unwrap();
    succeed(folder.path(), &format!("{RANK} --results link"));
    assert_eq!(files(&of("other")).len(), 2);
}

#[test]
fn a_material_of_a_pipe_is_read_once_and_not_kept() {
    let folder = data_set();
    let of = |name: &str| folder.path().join(name);
    make_pipe(&of("pipe.png"));
    fs::write(of("pairs.csv"), "ground_truth,prediction\ngt/m0.png,pipe.png\n").unwrap();
    let (from, to) = (of("ours/m0.png"), of("pipe.png"));
    // Not joined: it waits for a reader.
    std::thread::spawn(move || fs::write(to, fs::read(from).unwrap()));
    let (code, stderr) = soon(folder.path(), &format!("{PAIRS} --results kept"));
    assert_eq!((code, files(&of("kept")).len()), (Some(0), 0), "{stderr}");
}

/// Other materials of a folder tell how one is read; a command that is repeated finds its own output there.
#[test]
fn a_command_can_be_repeated() {
    let folder = folder();
    succeed(folder.path(), "convert gt.png set");
    for args in [
        "convert gt.png out.exr",
        "convert gt.png out.glb",
        "render gt.png -o out.png",
        "render set -o set/preview.png",
        "map gt.png a.png -o out.csv --over lights --side 4",
        "report gt.png a.png -o out.html --figure",
    ] {
        for _ in 0..2 {
            let output = run_in(folder.path(), args);
            assert!(output.status.success(), "{args}: {}", text(&output.stderr));
        }
    }
}

/// Whoever names a link means its target, where this is no input.
#[test]
fn a_link_that_is_named_stays_and_its_target_is_written() {
    let (folder, set) = (folder(), data_set());
    let page = format!("{RANK} --format html -o page.html");
    for (at, args, link) in [
        (folder.path(), "convert gt.png link.exr", "link.exr"),
        (folder.path(), "convert gt.png link.png", "link.png"),
        (folder.path(), "render gt.png -o picture.png", "picture.png"),
        (set.path(), &page, "page.html"),
    ] {
        fs::create_dir(at.join("kept")).unwrap();
        let target = at.join("kept").join(link);
        fs::write(&target, "old").unwrap();
        symlink(&target, at.join(link)).unwrap();
        succeed(at, args);
        assert!(at.join(link).is_symlink(), "{args}");
        assert!(target.is_file() && fs::metadata(&target).unwrap().len() > 100, "{args}");
        assert_eq!(files(&at.join("kept")).len(), 1, "{args}: a temporary file is left");
        fs::remove_dir_all(at.join("kept")).unwrap();
    }
}

#[test]
fn pipes_and_devices_that_are_named_are_written_to() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    for extension in ["exr", "png"] {
        let [pipe, plain] = ["pipe", "plain"].map(|stem| format!("{stem}.{extension}"));
        make_pipe(&of(&pipe));
        let mut child =
            svbrdf().args(["convert", "gt.png", &pipe]).current_dir(folder.path()).spawn().unwrap();
        let through = fs::read(of(&pipe)).unwrap();
        assert!(child.wait().unwrap().success());
        assert!(fs::metadata(of(&pipe)).unwrap().file_type().is_fifo());
        succeed(folder.path(), &format!("convert gt.png {plain}"));
        assert!(through == fs::read(of(&plain)).unwrap(), "{pipe}: {} bytes", through.len());
    }
    // A link, so that a program that replaces what it is given replaces this one.
    symlink("/dev/null", of("null.exr")).unwrap();
    succeed(folder.path(), "convert gt.png null.exr");
    succeed(folder.path(), "render gt.png -o null.exr");
    assert!(of("null.exr").is_symlink());
    assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
}
