//! The subcommands that tell what a loss comes from.

use serde_json::Value;

use super::{
    assert_has, assert_refused, folder, json, json_of, loss_of, losses_as_json, rows, rows_of, run_in,
    succeed, text, text_of, write_material, write_tiles,
};

#[test]
fn blame_is_that_of_the_wrong_map_in_every_format() {
    let folder = folder();
    let at = folder.path();
    let text = succeed(at, "blame gt.png a.png b.png");
    assert_eq!(text.matches("blame of ").count(), 2, "{text}");
    assert_has(&text, &["roughness  100.0%", "normal       0.0%"]);
    let printed = json_of(at, "blame gt.png a.png b.png");
    assert_eq!(printed["attributions"][1]["maps"].as_array().unwrap().len(), 4);
    let csv = succeed(at, "blame gt.png a.png b.png --format csv");
    assert!(csv.lines().count() == 9 && csv.starts_with("prediction,map,shapley,standard_error,"), "{csv}");
    let listed = succeed(at, "blame gt.png a.png --scenes one.json");
    assert_has(&listed, &["1 near-field and 0 distant scenes, listed"]);
    // A metal and a rougher, darker prediction: what the roughness adds to the light off the highlight, the specular takes away.
    for (name, roughness, specular) in [("metal", 40, 200), ("dull", 120, 20)] {
        let tiles = [[128, 128, 255], [2; 3], [roughness; 3], [specular; 3]];
        write_tiles(&at.join(format!("{name}.png")), 4, |x, _| tiles[x as usize / 4]);
    }
    let table = succeed(at, "blame metal.png dull.png --preset deschaintre --read order=ndrs");
    let note = "A negative share: the wrong specular partly cancels the errors of other maps.";
    assert_has(&table, &["specular   -90.1%", &format!("\n\n{note}\n")]);
    assert!(!text.contains("below"));
}

/// Nearly equal mirrors: few scenes see a highlight, and those see a large difference.
#[test]
fn a_question_ends_at_its_limit_of_scenes_and_says_so() {
    let folder = folder();
    for (name, roughness) in [("mirror", 1), ("near", 2)] {
        write_material(&folder.path().join(format!("{name}.png")), 4, roughness);
    }
    let pair = "mirror.png near.png --preset deschaintre --read order=ndrs";
    for (command, results, scenes, who) in [
        ("loss", "results", 786_432, "near is known to +-"),
        ("blame", "attributions", 49_152, "near is known to +-"),
        ("worst", "results", 49_152, "the mean of near is known to +-"),
        ("rank", "ranking", 393_216, "near is known to +-"),
    ] {
        let output = run_in(folder.path(), &format!("{command} {pair} --format json"));
        let (printed, warning) = (json(text(&output.stdout)), text(&output.stderr));
        assert!(output.status.success(), "{warning}");
        let end = format!("not to the target of +-1%: {scenes} scenes, the limit, are not enough");
        assert_has(warning, &[&format!("warning: {who}"), &end]);
        let reached = |value: &Value| value["target_reached"].as_bool();
        assert_eq!(reached(&printed[results][0]).or(reached(&printed)), Some(false), "{printed}");
        let strict = run_in(folder.path(), &format!("{command} {pair} --format csv --strict"));
        assert_eq!(strict.status.code(), Some(1));
        assert_eq!(rows(text(&strict.stdout))[0]["target_reached"], "false");
        assert_has(text(&strict.stderr), &[&format!("error: {who}")]);
        assert_eq!(rows_of(folder.path(), &format!("{command} gt.png b.png"))[0]["target_reached"], "true");
    }
}

#[test]
fn the_worst_scenes_are_a_scene_file() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    let scenes = json_of(folder.path(), "scenes gt.png a.png --near 6 --distant 3 --top 4");
    std::fs::write(of("worst.json"), scenes.to_string()).unwrap();
    let again = losses_as_json(folder.path(), "gt.png a.png --scenes worst.json");
    assert_eq!(again["results"][0]["losses"], scenes["results"][0]["losses"]);
    assert_eq!((scenes["scenes"].as_array().unwrap().len(), &scenes["of"]), (4, &9.into()));

    let found = json_of(folder.path(), "worst gt.png b.png");
    std::fs::write(of("found.json"), found.to_string()).unwrap();
    let loss = losses_as_json(folder.path(), "gt.png b.png --scenes found.json");
    assert_eq!(loss["results"][0]["loss"], found["results"][0]["worst"]);
    assert_has(&succeed(folder.path(), "scenes gt.png a.png"), &["the worst tenth of the scenes adds "]);
    assert_has(&succeed(folder.path(), "worst gt.png b.png"), &["times the mean"]);
    for (command, count) in [("scenes gt.png a.png", 10), ("worst gt.png a.png b.png", 2)] {
        assert_eq!(rows_of(folder.path(), command).len(), count, "{command}");
    }
    // A capture of MaterialGAN: the same scene in half widths.
    let capture = r#"{"im_size": 4, "idx": [0], "camera_pos": [[0, 0, 4]], "light_pos": [[1, 1, 2]], "light_pow": [1, 1, 1]}"#;
    std::fs::write(of("render.json"), capture).unwrap();
    let [loss, one] = ["render", "one"]
        .map(|name| losses_as_json(folder.path(), &format!("gt.png a.png --scenes {name}.json")));
    assert_eq!((&loss["scenes"], &loss["results"]), (&one["scenes"], &one["results"]));
}

#[test]
fn maps_are_written_in_every_format() {
    let folder = folder();
    for over in ["texels", "lights --side 12", "views --side 12"] {
        for (extension, least) in [("csv", 100), ("exr", 300), ("png", 150)] {
            let name = format!("{}.{extension}", over.split(' ').next().unwrap());
            let printed = succeed(folder.path(), &format!("map gt.png a.png b.png --over {over} -o {name}"));
            assert_has(&printed, &["largest", "convention printed"]);
            let bytes = std::fs::metadata(folder.path().join(&name)).unwrap().len();
            assert!(bytes > least, "{name}: {bytes}");
        }
    }
    let rows = rows(&text_of(folder.path(), "texels.csv"));
    assert_eq!(rows.len(), 2 * 64);
    let cells = rows
        .iter()
        .filter(|row| row["prediction"] == "a")
        .flat_map(|row| ["red", "green", "blue"].map(|title| &row[title]));
    let mean: f64 = cells.map(|cell| cell.parse::<f64>().unwrap()).sum::<f64>() / (3.0 * 64.0);
    let loss = loss_of(folder.path(), "gt.png a.png --near 128 --distant 64 --sampler sobol");
    assert!((mean / loss - 1.0).abs() < 1e-5, "{mean}, {loss}");
}

#[test]
fn the_colours_of_a_map_have_a_range_of_their_own_or_the_one_that_is_given() {
    let folder = folder();
    let at = folder.path();
    let last = |args: &str| {
        let printed = succeed(at, &format!("map gt.png a.png --near 4 -o x.png {args}"));
        let line = printed.lines().find_map(|line| line.strip_prefix("colours from 0 to ")).unwrap();
        line.split(';').next().unwrap().parse::<f64>().unwrap()
    };
    let mut losses: Vec<f64> = rows(&{
        succeed(at, "map gt.png a.png --near 4 -o x.csv");
        super::text_of(at, "x.csv")
    })
    .iter()
    .map(|row| ["red", "green", "blue"].iter().map(|c| row[*c].parse::<f64>().unwrap()).sum::<f64>() / 3.0)
    .collect();
    losses.sort_by(f64::total_cmp);
    let (range, largest) = (last(""), losses[losses.len() - 1]);
    let above = losses.iter().filter(|loss| **loss > range + 1e-6).count();
    assert!(range <= largest && above <= 1 + losses.len() / 100, "{range} of {largest}, {above} above");
    assert_eq!((last("--range auto"), last("--range 0.25")), (range, 0.25));
    super::assert_holds(at, "x.png", &["the last colour is 0.25"]);
    assert_refused(
        at,
        &[
            ("map gt.png a.png -o x.csv --range 1", 64, "leave out --range"),
            ("map gt.png a.png -o x.png --range -1", 64, "expected auto or a number above 0"),
        ],
    );
}
