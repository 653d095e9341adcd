//! `svbrdf study`.

use super::{assert_has, folder, loss_of, rows, succeed, text_of};

#[test]
fn a_study_writes_its_points_and_prints_what_to_type() {
    let folder = folder();
    let said = succeed(folder.path(), "study gt.png a.png -o study.csv");
    assert_has(&said, &["a against gt, 8 x 8 texels, convention printed", "svbrdf loss"]);
    let rows = rows(&text_of(folder.path(), "study.csv"));
    let count = |name, value| rows.iter().filter(|row| row[name] == value).count();
    assert_eq!((count("sampler", "random"), count("scenes", "9000")), (4, 1));
    assert!(count("pareto", "true") > 1);

    // What is said to be off by at most 1% is off by no more than three times as much in one draw.
    let number = |text: &str| text.parse::<f64>().unwrap();
    let loss = said.lines().find_map(|line| line.strip_prefix("loss ")).unwrap();
    let reference = number(loss.split(' ').next().unwrap());
    let line = said.lines().find(|line| line.trim_start().starts_with("1% ")).unwrap();
    let options = &line[line.find("--").unwrap()..];
    let loss = loss_of(folder.path(), &format!("gt.png a.png {options}"));
    assert!((loss / reference - 1.0).abs() < 0.03, "{loss}, not {reference}");
}
