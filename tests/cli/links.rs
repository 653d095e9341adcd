//! Links and second names: nothing that was read, and nothing that nobody named, is written through them.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

use super::{command, fail, files, folder, run_in, succeed, text};

const RANK: &str = "rank --dataset gt ours --target-error 30%";

/// A ground truth and a method with two materials each.
fn data_set() -> TempDir {
    super::data_set(&[("ours", 20)], 2)
}

/// The code and stderr of a run that must end soon.
fn soon(folder: &Path, args: &str) -> (Option<i32>, String) {
    let mut command = command("timeout");
    command.args(["30", env!("CARGO_BIN_EXE_svbrdf")]).args(args.split(' ')).current_dir(folder);
    let output = command.output().unwrap();
    (output.status.code(), text(&output.stderr).to_owned())
}

#[test]
fn a_result_is_no_link_no_pipe_and_no_folder() {
    let folder = data_set();
    let of = |name: &str| folder.path().join(name);
    let args = format!("{RANK} --results kept");
    succeed(folder.path(), &args);
    let result = of("kept").join(&files(&of("kept"))[0]);
    let precious = fs::read(of("gt/m0.png")).unwrap();
    let cases: [(&str, &dyn Fn()); 4] = [
        ("link to ../gt/m0.png", &|| symlink("../gt/m0.png", &result).unwrap()),
        ("remove the link", &|| symlink("none", &result).unwrap()),
        ("no regular file", &|| assert!(Command::new("mkfifo").arg(&result).status().unwrap().success())),
        ("no regular file", &|| fs::create_dir(&result).unwrap()),
    ];
    for (problem, place) in cases {
        fs::remove_file(&result).unwrap();
        place();
        let (code, stderr) = soon(folder.path(), &args);
        assert!(code == Some(1) && stderr.contains(problem), "{problem}: {code:?} {stderr}");
        assert!(fs::read(of("gt/m0.png")).unwrap() == precious, "{problem}");
        assert!(!of("kept/none").exists() && result.symlink_metadata().is_ok(), "{problem}");
    }
    // Whoever names a link to a folder means the folder.
    symlink("other", of("link")).unwrap();
    fs::create_dir(of("other")).unwrap();
    succeed(folder.path(), &format!("{RANK} --results link"));
    assert_eq!(files(&of("other")).len(), 2);
}

#[test]
fn a_material_of_a_pipe_is_read_once_and_not_kept() {
    let folder = data_set();
    let of = |name: &str| folder.path().join(name);
    assert!(Command::new("mkfifo").arg(of("pipe.png")).status().unwrap().success());
    fs::write(of("pairs.csv"), "ground_truth,prediction\ngt/m0.png,pipe.png\n").unwrap();
    let (from, to) = (of("ours/m0.png"), of("pipe.png"));
    // Not joined: it waits for a reader.
    std::thread::spawn(move || fs::write(to, fs::read(from).unwrap()));
    let (code, stderr) = soon(folder.path(), "rank --pairs pairs.csv --target-error 30% --results kept");
    assert_eq!((code, files(&of("kept")).len()), (Some(0), 0), "{stderr}");
}

#[test]
fn figures_are_not_written_through_links() {
    let folder = data_set();
    let of = |name: &str| folder.path().join(name);
    let page = format!("{RANK} --format html -o page.html --figures all");
    succeed(folder.path(), &page);
    let figure = of("page-figures/0001-m0.html");
    fs::write(of("other.txt"), "kept").unwrap();
    for target in ["../gt/m0.png", "../other.txt", "../none"] {
        fs::remove_file(&figure).unwrap();
        symlink(target, &figure).unwrap();
        let before = fs::read(of("gt/m0.png")).unwrap();
        let error = fail(folder.path(), &page, 1);
        assert!(error.contains(&format!("a link to {target}")), "{error}");
        assert!(fs::read(of("gt/m0.png")).unwrap() == before && !of("none").exists());
        assert_eq!(fs::read_to_string(of("other.txt")).unwrap(), "kept");
    }
    fs::remove_dir_all(of("page-figures")).unwrap();
    symlink("gt", of("page-figures")).unwrap();
    assert!(fail(folder.path(), &page, 1).contains("a link to gt"));
    assert_eq!(fs::read_dir(of("gt")).unwrap().count(), 2);
}

#[test]
fn renderings_of_a_protocol_are_not_written_through_links() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    let args = "metrics gt.png a.png --protocol matfusion --renderings out";
    succeed(folder.path(), args);
    let rendering = fs::read_dir(of("out")).unwrap().next().unwrap().unwrap().path();
    fs::remove_file(&rendering).unwrap();
    fs::write(of("other.txt"), "kept").unwrap();
    symlink("../other.txt", &rendering).unwrap();
    assert!(fail(folder.path(), args, 1).contains("a link to ../other.txt"));
    assert_eq!(fs::read_to_string(of("other.txt")).unwrap(), "kept");
}

/// Lists, results, scenes, sessions and sidecar files, through a link and by a second name.
#[test]
fn nothing_that_was_read_is_replaced() {
    let folder = folder();
    let at = folder.path();
    let of = |name: &str| at.join(name);
    fs::write(of("pairs.csv"), "ground_truth,prediction\ngt.png,a.png\n").unwrap();
    let session = r#"{"svbrdf-session": 1, "convention": "printed", "materials": [{"path": "gt.png"}, {"path": "a.png"}],
        "scene": {"kind": "near", "view": [0, 0, 2], "light": [0.5, 0.5, 1]}}"#;
    fs::write(of("s.svbrdf-session.json"), session).unwrap();
    fs::write(of("gt.svbrdf.json"), r#"{"albedo": "srgb"}"#).unwrap();
    let pairs = "rank --pairs pairs.csv --target-error 30%";
    succeed(at, &format!("{pairs} --results kept"));
    let result = format!("kept/{}", files(&of("kept"))[0]);
    for (args, input, output) in [
        (format!("{pairs} --format html -o link.html"), "pairs.csv", "link.html"),
        (format!("{pairs} --results kept --format html -o link.html"), &result, "link.html"),
        (
            "report s.svbrdf-session.json --target-error 30% -o link.html".to_owned(),
            "s.svbrdf-session.json",
            "link.html",
        ),
        ("map gt.png a.png --scenes one.json -o link.csv".to_owned(), "one.json", "link.csv"),
        ("strip gt.png a.png --scenes one.json -o link.png".to_owned(), "one.json", "link.png"),
        ("render gt.png -o link.png".to_owned(), "gt.svbrdf.json", "link.png"),
        ("convert gt.png link.exr".to_owned(), "gt.svbrdf.json", "link.exr"),
    ] {
        let before = fs::read(of(input)).unwrap();
        for is_hard in [false, true] {
            let _ = fs::remove_file(of(output));
            if is_hard { fs::hard_link(of(input), of(output)) } else { symlink(input, of(output)) }.unwrap();
            assert!(fail(at, &args, 1).contains("made from"), "{args}");
            assert!(fs::read(of(input)).unwrap() == before, "{args}");
        }
    }
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
fn a_page_that_is_named_by_a_link_replaces_the_target() {
    let folder = data_set();
    let of = |name: &str| folder.path().join(name);
    fs::write(of("target.html"), "old").unwrap();
    symlink("target.html", of("page.html")).unwrap();
    succeed(folder.path(), &format!("{RANK} --format html -o page.html"));
    assert!(of("page.html").is_symlink() && fs::metadata(of("target.html")).unwrap().len() > 1000);
}
