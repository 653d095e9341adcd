//! `svbrdf rank --robust`: whether an order survives other questions, on materials whose answer is known.

use std::path::Path;

use serde_json::{Value, json};
use tempfile::TempDir;

use super::{fail, folder, json_of, rows_of, run_in, succeed, text, write_material, write_tiles};

const ROBUST: &str = "--robust --target-error 10%";

#[track_caller]
fn assert_survives(answer: &Value) {
    let questions = answer["questions"].as_array().unwrap();
    let under_all = format!("near beats far under all {} questions.", questions.len());
    assert_eq!(answer["sentence"], under_all, "{answer}");
    assert!(questions.len() > 12, "{answer}");
    let order = json!(["near", "far"]);
    assert!(questions.iter().all(|one| one["tau"] == 1.0 && one["order"] == order), "{answer}");
}

#[test]
fn a_roughness_that_is_farther_off_is_so_under_every_question() {
    let folder = folder();
    assert_survives(&json_of(folder.path(), &format!("rank gt.png near=a.png far=b.png {ROBUST}")));
}

#[test]
fn methods_are_compared_over_the_materials_that_all_have() {
    let folder = tempfile::tempdir().unwrap();
    for (name, more) in [("gt", 0), ("near", 8), ("far", 60)] {
        std::fs::create_dir(folder.path().join(name)).unwrap();
        for i in 0..6 {
            write_material(&folder.path().join(format!("{name}/m{i}.png")), 8, 140 + 10 * i + more);
        }
    }
    std::fs::remove_file(folder.path().join("far/m2.png")).unwrap();
    let command = format!("rank --dataset gt near far {ROBUST}");
    let output = run_in(folder.path(), &format!("{command} --format json"));
    assert!(text(&output.stderr).contains("m2 is left out: far: no prediction"), "{output:?}");
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(answer["materials"], json!(["m0", "m1", "m3", "m4", "m5"]));
    assert_survives(&answer);
    std::fs::remove_file(folder.path().join("near/m3.png")).unwrap();
    let stderr = fail(folder.path(), &command, 1);
    assert!(stderr.contains("expected at least 5 materials that all methods have, found 4"), "{stderr}");
    let stderr = fail(folder.path(), &format!("{command} --metrics"), 64);
    assert!(stderr.contains("--metrics"), "{stderr}");
}

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
fn an_order_that_depends_on_epsilon_is_said_to() {
    let folder = halves();
    let command = format!("rank --dataset gt dark bright {ROBUST}");
    let answer = json_of(folder.path(), &command);
    let sentence = answer["sentence"].as_str().unwrap();
    assert!(sentence.starts_with("The order of dark and bright depends on the question"), "{sentence}");
    let changes = answer["changes"].as_array().unwrap();
    let change = changes.iter().find(|change| change["question"] == "epsilon 0.1").unwrap();
    let end = |key: &str, end: usize| change[key][end].as_f64().unwrap();
    assert!(end("default_interval95", 0) > 0.0 && end("interval95", 1) < 0.0, "{change}");
    let of = |question: &str| {
        let questions = answer["questions"].as_array().unwrap();
        questions.iter().find(|one| one["question"] == question).unwrap().clone()
    };
    assert_eq!((&of("printed")["order"][0], &of("printed")["tau"]), (&json!("bright"), &json!(1.0)));
    assert_eq!((&of("epsilon 0.1")["order"][0], &of("epsilon 0.1")["tau"]), (&json!("dark"), &json!(-1.0)));
    let rows = rows_of(folder.path(), &command);
    let row = rows.iter().find(|row| row["question"] == "epsilon 0.1").unwrap();
    assert_eq!((row["tau"].parse(), row["order"].as_str()), (Ok(-1.0), "dark < bright"));
    let text = succeed(folder.path(), &command);
    assert!(text.starts_with("order by the rendering loss over 6 materials of gt\n"), "{text}");
    assert!(text.contains("by default") && text.contains("under epsilon 0.1"), "{text}");
}

#[test]
fn pages_have_the_answer_of_the_command() {
    let folder = halves();
    let of = "--dataset gt dark bright --robust --target-error 10%";
    let sentence = json_of(folder.path(), &format!("rank {of}"))["sentence"].as_str().unwrap().to_owned();
    succeed(folder.path(), &format!("rank {of} --format html -o page.html"));
    succeed(folder.path(), "rank --dataset gt dark bright --target-error 10% --format html -o without.html");
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(read("page.html").contains(&sentence), "{sentence}");
    assert!(!read("without.html").contains("Does the order survive?"));
    let of = "gt/m0.png dark=dark/m0.png bright=bright/m0.png --robust --target-error 10%";
    let answer = json_of(folder.path(), &format!("rank {of}"));
    succeed(folder.path(), &format!("report {of} -o report.html"));
    let page = read("report.html");
    assert!(page.contains(answer["sentence"].as_str().unwrap()), "{answer}");
    let rows = answer["questions"].as_array().unwrap().iter();
    let names = rows.map(|row| row["question"].as_str().unwrap());
    assert!(names.clone().count() > 12 && names.clone().all(|name| page.contains(&format!(">{name}</th>"))));
    let stderr = fail(folder.path(), "report gt/m0.png --robust -o report.html", 64);
    assert!(stderr.contains("--robust"), "{stderr}");
}

/// The questions of a convention in a file, of a data set, too.
#[test]
fn a_data_set_is_ranked_and_asked_about_by_the_convention_of_a_file() {
    let folder = halves();
    let write = |factor: &str| {
        let text = format!(
            "name = \"mine\"\n[light]\nfactor = {factor}\n[loss]\nnorm = \"log-l1\"\nepsilon = 0.01\n"
        );
        std::fs::write(folder.path().join("mine.toml"), text).unwrap();
    };
    let rank = "rank --dataset gt dark bright --convention mine.toml --target-error 10% --results results";
    let of = |factor: &str| {
        write(factor);
        json_of(folder.path(), rank)
    };
    let (one, two, again) = (of("1.0"), of("5.0"), of("1.0"));
    assert_eq!(one["settings"]["convention"], "mine");
    assert_eq!(one["methods"], again["methods"]);
    assert_ne!(one["methods"], two["methods"], "files of one name are told apart in the results folder");
    let command = one["repetition"]["command"].as_str().unwrap();
    assert!(command.contains("mine.toml"), "{command}");
    write("5.0");
    let answer =
        json_of(folder.path(), &format!("rank --dataset gt dark bright --convention mine.toml {ROBUST}"));
    assert_eq!(answer["questions"][0]["question"], "mine");
    // A changed copy of a named convention has the name of its file.
    let printed = succeed(folder.path(), "conventions printed");
    std::fs::write(folder.path().join("copy.toml"), &printed).unwrap();
    let loss = |file: &str| {
        json_of(folder.path(), &format!("loss gt/m0.png dark/m0.png --convention {file}"))["convention"]
            .clone()
    };
    assert_eq!(loss("copy.toml"), "printed");
    std::fs::write(folder.path().join("copy.toml"), printed.replace("epsilon = 0.01", "epsilon = 0.02"))
        .unwrap();
    assert_eq!(loss("copy.toml"), "copy.toml");
}
