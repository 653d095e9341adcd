//! Links, second names and pipes: nothing that was read, and nothing that nobody named, is written through them.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

use super::{assert_has, command, fail, files, folder, run_in, succeed, text, text_of};

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

/// Materials, lists, results, scenes, sessions and sidecar files under their name, through a link and by a second name.
#[test]
fn nothing_that_was_read_is_replaced() {
    let folder = folder();
    let at = folder.path();
    let of = |name: &str| at.join(name);
    for out in ["gt.exr", "m.glb", "set"] {
        succeed(at, &format!("convert gt.png {out}"));
    }
    image::GrayImage::from_pixel(8, 8, image::Luma([99])).save(of("rough.png")).unwrap();
    fs::write(of("m.mtl"), "newmtl m\nmap_Kd set/diffuse.png\nmap_Pr set/roughness.png\n").unwrap();
    // In a folder of their own: a kept result depends on the other files beside a material.
    fs::create_dir(of("pair")).unwrap();
    for name in ["gt.png", "a.png"] {
        fs::copy(of(name), of("pair").join(name)).unwrap();
    }
    fs::write(of("pairs.csv"), "ground_truth,prediction\npair/gt.png,pair/a.png\n").unwrap();
    let session = r#"{"svbrdf-session": 1, "convention": "printed", "materials": [{"path": "gt.png"}, {"path": "a.png"}],
        "scene": {"kind": "near", "view": [0, 0, 2], "light": [0.5, 0.5, 1]}}"#;
    fs::write(of("s.svbrdf-session.json"), session).unwrap();
    fs::write(of("gt.svbrdf.json"), r#"{"albedo": "srgb"}"#).unwrap();
    succeed(at, &format!("{PAIRS} --results kept"));
    let result = format!("kept/{}", files(&of("kept"))[0]);
    let page = format!("{PAIRS} --format html -o {{}}");
    let kept = format!("{page} --results kept");
    // `{}` is the output, with the extension of the link; where it is that of the input, the output is also the input itself.
    for (args, input, extension) in [
        ("render gt.png -o {}", "gt.png", "png"),
        ("render gt.exr -o {}", "gt.exr", "exr"),
        ("render gt.png -o {}", "gt.svbrdf.json", "png"),
        ("render m.mtl -o {}", "set/diffuse.png", "png"),
        ("render set -o {}", "set/roughness.png", "png"),
        ("strip gt.png a.png -o {}", "a.png", "png"),
        ("strip gt.png a.png --scenes one.json -o {}", "one.json", "png"),
        ("map gt.png a.png -o {}", "a.png", "png"),
        ("map gt.png a.png --scenes one.json -o {}", "one.json", "csv"),
        ("convert gt.png {}", "gt.svbrdf.json", "exr"),
        ("convert m.glb {}", "m.glb", "glb"),
        ("convert gt.png {} --map roughness=rough.png", "rough.png", "png"),
        ("report s.svbrdf-session.json -o {}", "s.svbrdf-session.json", "html"),
        (&page, "pairs.csv", "html"),
        (&kept, &result, "html"),
    ] {
        let before = fs::read(of(input)).unwrap();
        let link = format!("link.{extension}");
        let own = input.ends_with(extension).then(|| input.to_owned());
        for (output, is_hard) in
            [(link.clone(), true), (link, false)].into_iter().chain(own.map(|own| (own, true)))
        {
            let _ = fs::remove_file(of("link.").with_extension(extension));
            if output != input {
                if is_hard { fs::hard_link(of(input), of(&output)) } else { symlink(input, of(&output)) }
                    .unwrap();
            }
            assert_has(&fail(at, &args.replace("{}", &output), 1), &["made from", "name another file"]);
            assert!(fs::read(of(input)).unwrap() == before, "{args}");
        }
    }
    succeed(at, "render gt.png -o b.png");
}

/// Files whose names the program chooses: figures, results, saved options.
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
            symlink(at.join(name), &written).unwrap();
            let output = run_in(at, args);
            assert_eq!(output.status.code(), Some(1), "{args}");
            assert_has(text(&output.stderr), &["remove the link"]);
            // A loss that cannot be kept is printed.
            assert_eq!(output.stdout.is_empty(), args != results, "{args}");
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
    // A material of a pipe is read once, and its loss is not kept.
    make_pipe(&of("pipe.png"));
    fs::write(of("pairs.csv"), "ground_truth,prediction\ngt/m0.png,pipe.png\n").unwrap();
    let (from, to) = (of("ours/m0.png"), of("pipe.png"));
    // Not joined: it waits for a reader.
    std::thread::spawn(move || fs::write(to, fs::read(from).unwrap()));
    let (code, stderr) = soon(folder.path(), &format!("{PAIRS} --results of_pipe"));
    assert_eq!((code, files(&of("of_pipe")).len()), (Some(0), 0), "{stderr}");
}

/// Other materials of a folder tell how one is read; a command that is repeated finds its own output there.
#[test]
fn a_command_can_be_repeated() {
    let folder = folder();
    succeed(folder.path(), "convert gt.png set");
    for args in [
        "convert gt.png out.exr",
        "convert gt.png out.glb",
        "render set -o set/preview.png",
        "map gt.png a.png -o out.csv",
        "report gt.png a.png -o out.html --figure",
    ] {
        for _ in 0..2 {
            let output = run_in(folder.path(), args);
            assert!(output.status.success(), "{args}: {}", text(&output.stderr));
        }
    }
}
