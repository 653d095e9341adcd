//! `svbrdf rank --robust` and its section of the page: an order that is known to depend on epsilon.

use std::path::Path;

use serde_json::json;
use tempfile::TempDir;

use super::{assert_has, json_of, rows_of, succeed, text_of, write_tiles};

/// Materials of a dark and a bright half. Method `dark` is off by a small number that is a large share of the dark half, `bright` by a
/// larger number that is a smaller share of the bright half.
fn halves() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, dark, bright) in [("gt", 1.0, 1.0), ("dark", 3.0, 1.0), ("bright", 1.0, 1.35)] {
        std::fs::create_dir(folder.path().join(name)).unwrap();
        for i in 0..6_u8 {
            let path = folder.path().join(format!("{name}/m{i}.png"));
            write_halves(&path, [dark * f64::from(4 + i / 3), bright * f64::from(120 + 5 * i)], 200 + i);
        }
    }
    folder
}

fn write_halves(path: &Path, diffuse: [f64; 2], roughness: u8) {
    write_tiles(path, 8, |x, y| match x / 8 {
        0 => [128, 128 + (x % 2) as u8, 250 + (y % 3) as u8],
        1 => [diffuse[usize::from(x % 8 > 3)].round() as u8; 3],
        2 => [roughness; 3],
        _ => [10; 3],
    });
}

#[test]
fn an_order_that_depends_on_epsilon_is_said_to_in_every_format_and_on_the_page() {
    let folder = halves();
    let robust = "--robust --target-error 10%";
    let command = format!("rank --dataset gt dark bright {robust}");
    let answer = json_of(folder.path(), &command);
    let sentence = answer["sentence"].as_str().unwrap();
    assert!(sentence.starts_with("The order of dark and bright depends on the question"), "{sentence}");
    let at_epsilon = |list: &str| {
        let mut rows = answer[list].as_array().unwrap().iter();
        rows.find(|one| one["question"] == "epsilon 0.1").unwrap()
    };
    let change = at_epsilon("changes");
    let end = |key: &str, end: usize| change[key][end].as_f64().unwrap();
    assert!(end("default_interval95", 0) > 0.0 && end("interval95", 1) < 0.0, "{change}");
    let asked = &answer["questions"][0];
    assert_eq!((&asked["order"], &asked["tau"]), (&json!(["bright", "dark"]), &json!(1.0)));
    let asked = at_epsilon("questions");
    assert_eq!((&asked["order"], &asked["tau"]), (&json!(["dark", "bright"]), &json!(-1.0)));
    let rows = rows_of(folder.path(), &command);
    let row = rows.iter().find(|row| row["question"] == "epsilon 0.1").unwrap();
    assert_eq!((row["tau"].parse(), row["order"].as_str()), (Ok(-1.0), "dark < bright"));
    succeed(folder.path(), &format!("{command} --format html -o page.html"));
    succeed(folder.path(), "verify page.html");
    let page = text_of(folder.path(), "page.html");
    let section = page.split("id=\"does\"").nth(1).unwrap().split("</section>").next().unwrap();
    assert_has(section, &[sentence, " by default, -0", "under epsilon 0.1", "<td>-1.00</td>"]);
}
