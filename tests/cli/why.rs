//! The subcommands that tell what a loss comes from.

use serde_json::Value;

use super::{fail, folder, json, run_in, succeed, text, write_material, write_tiles};

#[test]
fn blame_adds_up_in_every_format() {
    let folder = folder();
    let text = succeed(folder.path(), "blame gt.png a.png b.png");
    assert_eq!(text.matches("blame of ").count(), 2, "{text}");
    assert!(text.contains("roughness  100.0%") && text.contains("normal       0.0%"), "{text}");
    let printed = json(&succeed(folder.path(), "blame gt.png a.png b.png --format json"));
    for attribution in printed["attributions"].as_array().unwrap() {
        let maps = attribution["maps"].as_array().unwrap();
        let sum: f64 = maps.iter().map(|map| map["shapley"]["mean"].as_f64().unwrap()).sum();
        let loss = attribution["loss"]["mean"].as_f64().unwrap();
        assert!((sum / loss - 1.0).abs() < 1e-9 && loss > 0.0);
    }
    let csv = succeed(folder.path(), "blame gt.png a.png b.png --format csv");
    assert_eq!(csv.lines().count(), 9);
    assert!(csv.starts_with("prediction,map,shapley,standard_error,"), "{csv}");
    let listed = succeed(folder.path(), "blame gt.png a.png --scenes one.json");
    assert!(listed.contains("1 near-field and 0 distant scenes, listed"), "{listed}");
}

/// A metal and a rougher, darker prediction: what the roughness adds to the light that is seen off the highlight, the specular takes away.
#[test]
fn a_share_below_0_is_explained() {
    let folder = folder();
    for (name, roughness, specular) in [("metal", 40, 200), ("dull", 120, 20)] {
        let tiles = [[128, 128, 255], [2; 3], [roughness; 3], [specular; 3]];
        write_tiles(&folder.path().join(format!("{name}.png")), 4, |x, _| tiles[x as usize / 4]);
    }
    let table = succeed(folder.path(), "blame metal.png dull.png --preset deschaintre --read order=ndrs");
    let note =
        "Below 0%, the wrong specular hides errors of other maps, whose shares add up to more than 100%.";
    assert!(table.contains("specular   -90.1%") && table.ends_with(&format!("\n\n{note}\n")), "{table}");
    assert!(!succeed(folder.path(), "blame gt.png b.png").contains("below"));
}

/// Nearly equal mirrors: few scenes see a highlight, and those see a large difference.
/// The column `target_reached` of the last row of a CSV.
fn reached_in(csv: &str) -> &str {
    let (headings, row) = (csv.lines().next().unwrap(), csv.lines().last().unwrap());
    let column = headings.split(',').position(|heading| heading == "target_reached");
    column.and_then(|column| row.split(',').nth(column)).unwrap_or_else(|| panic!("{csv}"))
}

#[test]
fn a_question_ends_at_its_limit_of_scenes_and_says_so() {
    let folder = folder();
    for (name, roughness) in [("mirror", 1), ("near", 2)] {
        write_material(&folder.path().join(format!("{name}.png")), 4, roughness);
    }
    let pair = "mirror.png near.png --preset deschaintre --read order=ndrs";
    for (command, results, scenes, who) in [
        ("blame", "attributions", 49_152, "near is known to +-"),
        ("worst", "results", 49_152, "the mean of near is known to +-"),
        ("rank", "ranking", 393_216, "near is known to +-"),
    ] {
        let output = run_in(folder.path(), &format!("{command} {pair} --format json"));
        let (printed, warning) = (json(text(&output.stdout)), text(&output.stderr));
        assert!(output.status.success(), "{warning}");
        let end = format!("not to the target of +-1%: {scenes} scenes, the limit, are not enough");
        assert!(warning.contains(&format!("warning: {who}")) && warning.contains(&end), "{warning}");
        let reached = |value: &Value| value["target_reached"].as_bool();
        assert_eq!(reached(&printed[results][0]).or(reached(&printed)), Some(false), "{printed}");
        let strict = run_in(folder.path(), &format!("{command} {pair} --format csv --strict"));
        assert_eq!(strict.status.code(), Some(1));
        assert_eq!(reached_in(text(&strict.stdout)), "false");
        assert!(text(&strict.stderr).contains(&format!("error: {who}")), "{}", text(&strict.stderr));
        let usual = succeed(folder.path(), &format!("{command} gt.png b.png --format csv"));
        assert_eq!(reached_in(&usual), "true");
    }
    let few = run_in(folder.path(), &format!("loss {pair} --format json"));
    let warning = text(&few.stderr);
    assert!(few.status.success() && warning.contains("786432 scenes, the limit"), "{warning}");
    let listed = json(&succeed(folder.path(), "blame gt.png a.png --scenes one.json --format json"));
    assert_eq!(listed["attributions"][0]["target_reached"], Value::Null);
}

#[test]
fn the_worst_scenes_are_a_scene_file() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    let scenes = succeed(folder.path(), "scenes gt.png a.png --near 6 --distant 3 --top 4 --format json");
    std::fs::write(of("worst.json"), &scenes).unwrap();
    let scenes = json(&scenes);
    let again = json(&succeed(folder.path(), "loss gt.png a.png --scenes worst.json --format json"));
    assert_eq!(again["results"][0]["losses"], scenes["results"][0]["losses"]);
    assert_eq!((scenes["scenes"].as_array().unwrap().len(), &scenes["of"]), (4, &9.into()));

    let found = succeed(folder.path(), "worst gt.png b.png --format json");
    std::fs::write(of("found.json"), &found).unwrap();
    let loss = json(&succeed(folder.path(), "loss gt.png b.png --scenes found.json --format json"));
    assert_eq!(loss["results"][0]["loss"], json(&found)["results"][0]["worst"]);

    let text = succeed(folder.path(), "scenes gt.png a.png");
    assert!(text.contains("the worst tenth of the scenes adds "), "{text}");
    assert_eq!(succeed(folder.path(), "scenes gt.png a.png --format csv").lines().count(), 11);
    assert!(succeed(folder.path(), "worst gt.png b.png").contains("times the mean"));
    assert_eq!(succeed(folder.path(), "worst gt.png a.png b.png --format csv").lines().count(), 3);
}

#[test]
fn a_capture_of_materialgan_is_read_as_scenes() {
    let folder = folder();
    let capture = r#"{"im_size": 4, "idx": [0], "camera_pos": [[0, 0, 4]], "light_pos": [[1, 1, 2]], "light_pow": [1, 1, 1]}"#;
    std::fs::write(folder.path().join("render.json"), capture).unwrap();
    let loss = json(&succeed(folder.path(), "loss gt.png a.png --scenes render.json --format json"));
    // The same scene in half widths.
    let one = json(&succeed(folder.path(), "loss gt.png a.png --scenes one.json --format json"));
    assert_eq!(loss["scenes"], one["scenes"]);
    assert_eq!(loss["results"][0]["losses"], one["results"][0]["losses"]);
}

#[test]
fn maps_are_written_in_every_format() {
    let folder = folder();
    for over in ["texels", "lights --side 12", "views --side 12"] {
        for (extension, least) in [("csv", 100), ("exr", 300), ("png", 150)] {
            let name = format!("{}.{extension}", over.split(' ').next().unwrap());
            let printed = succeed(folder.path(), &format!("map gt.png a.png b.png --over {over} -o {name}"));
            assert!(printed.contains("largest") && printed.contains("convention printed"), "{printed}");
            let bytes = std::fs::metadata(folder.path().join(&name)).unwrap().len();
            assert!(bytes > least, "{name}: {bytes}");
        }
    }
    let table = std::fs::read_to_string(folder.path().join("texels.csv")).unwrap();
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 2 * 64);
    let of = |row: &csv::StringRecord| (3..6).map(|c| row[c].parse::<f64>().unwrap()).sum::<f64>();
    let mean: f64 = rows.iter().filter(|row| &row[0] == "a").map(of).sum::<f64>() / (3.0 * 64.0);
    let loss = json(&succeed(
        folder.path(),
        "loss gt.png a.png --near 128 --distant 64 --sampler sobol --format json",
    ));
    let loss = loss["results"][0]["loss"].as_f64().unwrap();
    assert!((mean / loss - 1.0).abs() < 1e-5, "{mean}, {loss}");
}

#[test]
fn what_cannot_be_done_is_refused() {
    let folder = folder();
    for (args, code, problem) in [
        ("blame gt.png", 64, "no prediction"),
        ("worst gt.png big.png", 1, "sizes differ"),
        ("scenes gt.png a.png --near 0 --distant 0", 64, "at least one scene"),
        ("map gt.png a.png -o map.txt", 64, "extension"),
        ("map gt.png a.png -o nowhere/map.csv", 1, "its folder does not exist"),
        ("map gt.png a.png --over lights --fixed 0,0,-1 -o map.csv", 1, "not above the plane"),
    ] {
        let stderr = fail(folder.path(), args, code);
        assert!(stderr.contains(problem), "{args}: {stderr}");
    }
}
