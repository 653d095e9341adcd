//! `svbrdf rank --format html`: the page and its figures. `tests/page` sorts it in a browser.

use std::fs;

use serde_json::Value;
use tempfile::TempDir;

use super::{fail, folder, run_in, succeed, text, write_material};

/// Ground truths and two methods; of the second, a file is broken.
fn data_set() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, more) in [("gt", 0), ("ours", 4), ("theirs", 30)] {
        fs::create_dir(folder.path().join(name)).unwrap();
        for (i, material) in ["m0", "m1", "\"><svg onload=hit>", "m3"].iter().enumerate() {
            let path = folder.path().join(name).join(format!("{material}.png"));
            write_material(&path, 8, 60 + 10 * i as u8 + more * (1 + i as u8));
        }
    }
    fs::write(folder.path().join("theirs/m3.png"), "not an image").unwrap();
    folder
}

const RANK: &str = "rank --dataset gt ours theirs --target-error 5%";

/// The addresses that a page links.
fn links(page: &str) -> Vec<&str> {
    page.split("<a href=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect()
}

#[test]
fn a_page_has_the_losses_the_verdicts_the_failures_and_figures_of_the_worst() {
    let folder = data_set();
    let output =
        run_in(folder.path(), &format!("{RANK} --format html -o out.html --figures worst:2 --metrics"));
    assert!(output.status.success() && output.stdout.is_empty(), "{}", text(&output.stderr));
    let page = fs::read_to_string(folder.path().join("out.html")).unwrap();
    let ranking: Value =
        serde_json::from_str(&succeed(folder.path(), &format!("{RANK} --format json --metrics"))).unwrap();
    for result in ranking["results"].as_array().unwrap() {
        for prediction in result["predictions"].as_array().unwrap() {
            let expected = match &prediction["loss"] {
                Value::Null => {
                    let problem = prediction["error"].as_str().unwrap();
                    let plain = problem.split(['&', '<', '>', '"', '\'']).next().unwrap();
                    assert!(plain.len() > 10, "{problem}");
                    format!("<td class=\"problem\" data-sort=\"\">{plain}")
                }
                loss => format!("<td data-sort=\"{loss}\">"),
            };
            assert!(page.contains(&expected), "{expected}");
        }
    }
    assert!(
        page.contains("<td>best</td>") && page.contains("normal") && page.contains("Metrics of the maps")
    );
    assert_eq!(page.matches("src=\"data:image/jpeg").count(), 4);
    assert!(page.contains("&quot;&gt;&lt;svg onload=hit&gt;") && !page.contains("<svg onload"));
    // Of the largest mean losses; the materials are in the order of their names.
    let links = links(&page);
    assert_eq!(links, ["out-figures/0001-___svg_onload_hit_.html", "out-figures/0003-m1.html"]);
    let files = fs::read_dir(folder.path().join("out-figures")).unwrap();
    let mut files: Vec<String> = files.map(|file| file.unwrap().file_name().into_string().unwrap()).collect();
    files.sort();
    assert_eq!(files, ["0001-___svg_onload_hit_.html", "0003-m1.html"]);
    let figure = fs::read_to_string(folder.path().join("out-figures/0003-m1.html")).unwrap();
    assert!(figure.contains("ours, theirs against m1") && figure.contains("id=\"canvas\""));
}

#[test]
fn a_page_is_a_file_of_a_data_set_and_replaces_no_material() {
    let folder = data_set();
    let no_file = fail(folder.path(), &format!("{RANK} --format html"), 64);
    assert!(no_file.contains("--output NAME.html"), "{no_file}");
    fail(folder.path(), &format!("{RANK} --format html -o out.txt"), 64);
    fail(folder.path(), &format!("{RANK} -o out.html"), 64);
    fail(folder.path(), &format!("{RANK} --figures all"), 64);
    fail(folder.path(), &format!("{RANK} --format html -o out.html --figures worst:0"), 64);
    fs::rename(folder.path().join("gt/m0.png"), folder.path().join("gt/m0.webp")).unwrap();
    fs::write(folder.path().join("pairs.csv"), "ground_truth,prediction\ngt/page.html,ours/m0.png\n")
        .unwrap();
    fs::copy(folder.path().join("gt/m1.png"), folder.path().join("gt/page.html")).unwrap();
    let replaced = fail(folder.path(), "rank --pairs pairs.csv --format html -o gt/page.html", 1);
    assert!(replaced.contains("which the result is made from"), "{replaced}");
    let one = self::folder();
    assert!(fail(one.path(), "rank gt.png a.png --format html", 64).contains("svbrdf report"));
}
