//! `svbrdf rank --format html`: the page and its figures.

use std::fs;

use super::*;

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
    let page = text_of(folder.path(), "out.html");
    for text in [
        "<span class=\"problem\">cannot decode theirs/m3.png",
        "rmse_roughness",
        "<th scope=\"col\">mean loss</th>",
    ] {
        assert!(page.contains(text), "{text}");
    }
    // Of 4 ground truths and of the predictions that can be read.
    assert_eq!(page.matches("src=\"data:image/jpeg").count(), 11);
    assert!(page.contains("ours (") && page.contains("has losses of 4 materials"));
    assert!(page.contains("&quot;&gt;&lt;svg onload=hit&gt;") && !page.contains("<svg onload"));
    // Of the largest mean losses; the materials are in the order of their names.
    let mut links = links(&page);
    links.dedup();
    let links: [&str; 2] = links.try_into().unwrap();
    assert_eq!(links, ["out-figures/0001-___svg_onload_hit_.html", "out-figures/0003-m1.html"]);
    let files = files(&folder.path().join("out-figures"));
    assert_eq!(files, links.map(|link| link.trim_start_matches("out-figures/")));
    let figure = text_of(folder.path(), "out-figures/0003-m1.html");
    assert!(figure.contains("ours, theirs against m1") && figure.contains("id=\"canvas\""));
}

#[test]
fn a_page_replaces_no_material() {
    let folder = data_set();
    fs::rename(folder.path().join("gt/m0.png"), folder.path().join("gt/m0.webp")).unwrap();
    fs::write(folder.path().join("pairs.csv"), "ground_truth,prediction\ngt/page.html,ours/m0.png\n")
        .unwrap();
    fs::copy(folder.path().join("gt/m1.png"), folder.path().join("gt/page.html")).unwrap();
    let replaced = "rank --pairs pairs.csv --format html -o gt/page.html";
    assert_refused(folder.path(), &[(replaced, 1, "which the result is made from")]);
}
