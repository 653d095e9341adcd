//! `svbrdf study`.

use std::path::Path;
use std::process::Output;

use super::{fail, folder, succeed, svbrdf, text, write_material};

/// The rows of a table with a heading, as cells by name.
fn rows(csv: &str) -> Vec<Vec<(&str, &str)>> {
    let mut lines = csv.lines();
    let heading: Vec<_> = lines.next().unwrap().split(',').collect();
    lines.map(|line| heading.iter().copied().zip(line.split(',')).collect()).collect()
}

fn cell<'a>(row: &[(&str, &'a str)], name: &str) -> &'a str {
    row.iter().find(|(column, _)| *column == name).unwrap().1
}

/// A study without an adapter.
fn run(folder: &Path, args: &str) -> Output {
    let mut command = svbrdf();
    command.arg("study").args(args.split_whitespace()).current_dir(folder);
    command.env("WGPU_BACKEND", "vulkan").env("VK_ICD_FILENAMES", "none").env("VK_DRIVER_FILES", "none");
    command.output().unwrap()
}

/// Its stdout.
fn study(folder: &Path, args: &str) -> String {
    let output = run(folder, args);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("note: without the GPU: no usable graphics adapter"));
    text(&output.stdout).to_owned()
}

#[test]
fn a_study_writes_its_points_and_prints_what_to_type() {
    let folder = folder();
    let said = study(folder.path(), "gt.png a.png -o study.csv --plot study.svg");
    for expected in ["a against gt, 8 x 8 texels, convention printed", "svbrdf loss", "f64: ", "8-bit maps: "]
    {
        assert!(said.contains(expected), "{expected} is missing in\n{said}");
    }
    let csv = std::fs::read_to_string(folder.path().join("study.csv")).unwrap();
    let rows = rows(&csv);
    let count = |name, value| rows.iter().filter(|row| cell(row, name) == value).count();
    assert_eq!((count("sampler", "random"), count("scenes", "9000"), count("backend", "gpu")), (4, 1, 0));
    // A slow machine leaves out the most scenes of these.
    assert!(count("precision", "f64") >= 4 && count("maps", "8") >= 4 && count("maps", "half") >= 4);
    assert!(count("pareto", "true") > 1);
    let svg = std::fs::read_to_string(folder.path().join("study.svg")).unwrap();
    for expected in ["What accuracy costs: a against gt", "random scenes", "Sobol, f64", "1%"] {
        assert!(svg.contains(expected), "{expected} is missing in the plot");
    }

    // What is said to be off by at most 1% is off by no more than three times as much in one draw.
    let number = |text: &str| text.parse::<f64>().unwrap();
    let loss = said.lines().find_map(|line| line.strip_prefix("loss ")).unwrap();
    let reference = number(loss.split(' ').next().unwrap());
    let line = said.lines().find(|line| line.trim_start().starts_with("1% ")).unwrap();
    let options = &line[line.find("--").unwrap()..];
    let csv = succeed(folder.path(), &format!("loss gt.png a.png --format csv {options}"));
    let loss = number(cell(&self::rows(&csv)[0], "loss"));
    assert!((loss / reference - 1.0).abs() < 0.03, "{loss}, not {reference}");
}

#[test]
fn a_png_shows_points() {
    let folder = folder();
    // More texels than the 128 of the blue points.
    write_material(&folder.path().join("big2.png"), 16, 220);
    study(folder.path(), "big.png big2.png --plot study.png");
    let picture = image::open(folder.path().join("study.png")).unwrap().to_rgb8();
    let is = |colour: [u8; 3]| picture.pixels().filter(|pixel| pixel.0 == colour).count();
    // The paper; a blue point and an orange triangle at least, which others may cover, beside those of the legend.
    assert!(is([255; 3]) > 500_000 && is([0, 114, 178]) > 2 * 60 && is([213, 94, 0]) > 2 * 30);
}

#[test]
fn materials_that_look_the_same_are_bad_input() {
    let folder = folder();
    let output = run(folder.path(), "gt.png gt.png -o study.csv");
    assert_eq!((output.status.code(), text(&output.stdout)), (Some(1), ""));
    assert!(text(&output.stderr).contains("look the same") && !folder.path().join("study.csv").exists());
}

#[test]
fn a_study_that_cannot_be_done_is_refused_before_it_begins() {
    let folder = folder();
    let cases = [
        ("study gt.png", 64, "one prediction"),
        ("study gt.png a.png b.png", 64, "not 2"),
        ("study gt.png big.png", 1, "8 x 8, prediction big is 16 x 16"),
        ("study gt.png a.png --plot study.jpg", 64, ".svg, .png"),
        ("study gt.png a.png --plot no/study.svg", 1, "create the folder"),
        ("study gt.png a.png -o no/study.csv", 1, "create the folder"),
    ];
    for (args, code, said) in cases {
        let stderr = fail(folder.path(), args, code);
        assert!(stderr.contains(said), "{args}: `{said}` is missing in {stderr}");
    }
}
