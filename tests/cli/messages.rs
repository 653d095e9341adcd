//! Messages: what happened, where, what was expected and found, what to do.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use super::{fail, folder};

/// Mistakes, with the exit code and the words that tell what was expected, what was found, or what to do.
const MISTAKES: [(&str, i32, &str); 42] = [
    // A file of another kind, or of none.
    ("loss empty.png a.png", 1, "expected an image, found an empty file; copy or write it again"),
    ("loss one.json a.png", 64, "one.json is not a material: a list of scenes is given as --scenes FILE"),
    (
        "loss gt.png pairs.csv",
        64,
        "pairs.csv is not a material: a table of pairs is given as `svbrdf rank --pairs FILE`",
    ),
    ("loss gt.png a.png --scenes gt.png", 1, "cannot read gt.png: expected a text, found other bytes"),
    (
        "loss gt.png a.png --scenes cut.json",
        1,
        "cut.json is not a usable scene file: the text ends within an object",
    ),
    ("loss gt.png a.png --scenes kind.json", 1, "unknown value `middle`, expected `near` or `distant`"),
    ("loss gt.png a.png --convention bad.toml", 64, "bad.toml: not a convention: line 1: "),
    ("loss gt.png a.png --convention key.toml", 64, "not a convention: line 2: unknown key `foo`"),
    ("loss old.svbrdf-session.json", 1, "no key `svbrdf-session`"),
    ("loss new.svbrdf-session.json", 1, "version 99 of a newer program: update this one"),
    ("loss gone.svbrdf-session.json", 1, "note: the session gone.svbrdf-session.json names the materials"),
    ("conform gt.png", 1, "expected an npz file, as numpy.savez writes it, found no archive"),
    ("conform nothing", 1, "render each material of `svbrdf conform --points FOLDER` into its folder"),
    ("photo . a.png", 1, ". is not a usable capture: it has neither of these files"),
    ("convert gt.png none/x/", 1, "cannot write none/x/: its folder does not exist; create the folder first"),
    ("convert gt.png none/x.png", 1, "its folder does not exist; create the folder first, or name another"),
    // Data sets.
    (
        "rank --dataset gt.png set",
        1,
        "gt.png is not a data set: expected a folder of materials, found a file",
    ),
    (
        "rank --dataset set gt.png",
        1,
        "gt.png is not a data set: expected a folder of materials, found a file",
    ),
    ("rank --dataset nothing set", 1, "nothing is not a data set: expected materials, found none"),
    (
        "rank --dataset set set --robust",
        1,
        "set is not a data set: expected at least 5 materials that all methods have, found 1",
    ),
    ("rank --pairs columns.csv", 1, "expected the columns ground_truth and prediction, found a, b"),
    ("rank --pairs pairs.csv", 1, "pairs.csv is not a data set: expected rows below the titles, found none"),
    ("rank --pairs short.csv", 1, "expected 2 cells in line 2, as in the first, found 1"),
    ("rank --dataset set set --results gt.png", 1, "cannot write gt.png: it is a file; name a folder"),
    ("rank gt.png a.png --metrics", 64, "only a data set (--dataset, --pairs)"),
    // Values.
    ("info gt.png --map foo=a.png", 64, "unknown map `foo`; use one of: normal, "),
    ("info gt.png --map roughness=5", 64, "unknown constant of a map `5`; use one of: a number from 0 to 1"),
    ("study gt.png", 64, "a study takes one prediction of gt.png, found 0; give one after it"),
    ("study gt.png a.png b.png", 64, "found 2; leave out the others"),
    ("los gt.png", 64, "no file or command `los`; did you mean `loss`?"),
    ("metrics gt.png a.png --metrics lpips", 64, "unknown metric `lpips`"),
    ("render gt.png 'x*.png' -o x.png", 64, "matches no file or folder; correct it, or name the files"),
    // Output.
    ("map gt.png a.png -o x.txt", 64, ".png (8 bits for a screen), .csv (a table)"),
    ("map gt.png a.png -o x.csv --range 1", 64, "only the colours of a .png have a range; leave out --range"),
    ("report gt.png a.png -o x.txt", 64, "unknown name of a report `x.txt`; use NAME.html"),
    ("man gt.png", 1, "cannot write gt.png: it is a file; choose a folder"),
    (
        "convert gt.png x.exr --depth 8",
        64,
        "EXR has half and float, MaterialX all, every other form 8 and 16; leave out --depth",
    ),
    ("convert gt.png x.png --preview", 64, "only EXR has one; leave out --preview"),
    (
        "rank gt.png a.png -o gt.png",
        1,
        "cannot write gt.png: it is the file gt.png, which the result is made from",
    ),
    (
        "rank gt.png a.png -o none/t.tex",
        1,
        "cannot write none/t.tex: its folder does not exist; create the folder first",
    ),
    ("rank gt.png a.png --lights flash --seed 1", 64, "the scenes are a fixed list; leave out --seed"),
    (
        "rank gt.png a.png --near 3 --target-error 2%",
        64,
        "the target error decides the scenes; leave out --near",
    ),
];

fn write(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).unwrap();
}

/// Materials, and files that are none or are wrong.
fn mistaken() -> TempDir {
    let folder = folder();
    let at = folder.path();
    write(at, "empty.png", "");
    write(at, "cut.json", "{");
    write(at, "kind.json", r#"{"scenes": [{"kind": "middle", "view": [0, 0, 1], "light": [0, 0, 1]}]}"#);
    write(at, "bad.toml", "name =\n");
    write(at, "key.toml", "name = \"x\"\nfoo = 3\n");
    write(at, "old.svbrdf-session.json", "{\"a\": 1}");
    write(at, "new.svbrdf-session.json", "{\"svbrdf-session\": 99}");
    let scene = r#"{"kind": "near", "view": [0, 0, 2], "light": [0.5, 0.5, 1]}"#;
    let session = format!(
        r#"{{"svbrdf-session": 1, "convention": "printed", "scene": {scene}, "materials": [{{"path": "gone.png"}}, {{"path": "a.png"}}]}}"#
    );
    write(at, "gone.svbrdf-session.json", &session);
    write(at, "columns.csv", "a,b\n1,2\n");
    write(at, "pairs.csv", "ground_truth,prediction\n");
    write(at, "short.csv", "ground_truth,prediction\ngt.png\n");
    fs::create_dir(at.join("nothing")).unwrap();
    fs::create_dir(at.join("set")).unwrap();
    fs::copy(at.join("gt.png"), at.join("set/m.png")).unwrap();
    folder
}

#[test]
fn a_message_tells_what_was_expected_and_found_and_what_to_do() {
    let folder = mistaken();
    let mut wrong = Vec::new();
    for (args, code, words) in MISTAKES {
        let output = super::run_in(folder.path(), &args.replace('\'', ""));
        let stderr = super::text(&output.stderr);
        let is_one_error = stderr.matches("error: ").count() == 1 && !stderr.contains("panicked");
        if output.status.code() != Some(code) || !stderr.contains(words) || !is_one_error {
            wrong.push(format!("{args}: {:?}: {stderr}", output.status.code()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn strict_reading_names_each_guess_and_its_option_in_a_line() {
    let folder = folder();
    let stderr = fail(folder.path(), "info gt.png --strict", 1);
    let lines: Vec<_> = stderr.lines().collect();
    assert_eq!(lines[0], "svbrdf: error: gt.png is ambiguous; specify what follows, or leave out --strict");
    assert!(lines.len() > 3, "{stderr}");
    for (what, option) in [
        ("layout: ", "--read order=ndrs|dnrs"),
        ("albedo: ", "--read albedo=linear|srgb|gamma2.2|log0.01"),
        ("normal y: ", "--read normal-y=up|down"),
    ] {
        let line = lines.iter().find(|line| line.starts_with(&format!("svbrdf:   {what}")));
        assert!(line.is_some_and(|line| line.contains(option)), "{what}: {stderr}");
    }
    // What is specified by these options is no guess.
    let options = lines[1..].iter().filter_map(|line| {
        let (key, values) = line.rsplit_once("--read ")?.1.split_once('=')?;
        Some(format!("{key}={}", values.split('|').next()?))
    });
    let read = options.collect::<Vec<_>>().join(",");
    super::succeed(folder.path(), &format!("info gt.png --strict --read {read}"));
}
