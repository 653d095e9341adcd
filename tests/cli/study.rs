//! `svbrdf study`.

use std::path::Path;

use super::{assert_has, folder, loss_of, rows, run_in, text, text_of, write_material};

/// The stdout of a study.
fn study(folder: &Path, args: &str) -> String {
    let output = run_in(folder, &format!("study {args}"));
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert_has(text(&output.stderr), &["note: about ", " to go"]);
    text(&output.stdout).to_owned()
}

#[test]
fn a_study_writes_its_points_and_prints_what_to_type() {
    let folder = folder();
    let said = study(folder.path(), "gt.png a.png -o study.csv --plot study.svg");
    assert_has(
        &said,
        &["a against gt, 8 x 8 texels, convention printed", "svbrdf loss", "f64: ", "8-bit maps: "],
    );
    let rows = rows(&text_of(folder.path(), "study.csv"));
    let count = |name, value| rows.iter().filter(|row| row[name] == value).count();
    assert_eq!((count("sampler", "random"), count("scenes", "9000")), (4, 1));
    // A slow machine leaves out the most scenes of these.
    assert!(count("precision", "f64") >= 4 && count("maps", "8") >= 4 && count("maps", "half") >= 4);
    assert!(count("pareto", "true") > 1);
    let svg = text_of(folder.path(), "study.svg");
    assert_has(&svg, &["What accuracy costs: a against gt", "random scenes", "Sobol, f64", "1%"]);

    // What is said to be off by at most 1% is off by no more than three times as much in one draw.
    let number = |text: &str| text.parse::<f64>().unwrap();
    let loss = said.lines().find_map(|line| line.strip_prefix("loss ")).unwrap();
    let reference = number(loss.split(' ').next().unwrap());
    let line = said.lines().find(|line| line.trim_start().starts_with("1% ")).unwrap();
    let options = &line[line.find("--").unwrap()..];
    let loss = loss_of(folder.path(), &format!("gt.png a.png {options}"));
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
