//! The commands that tell what a loss comes from.

use std::fs;

use super::*;

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
    let at = folder.path();
    let again = |report: &Value, pair: &str| {
        fs::write(at.join("worst.json"), report.to_string()).unwrap();
        losses_as_json(at, &format!("{pair} --scenes worst.json"))["results"][0].take()
    };
    let scenes = json_of(at, "scenes gt.png a.png --near 6 --distant 3 --top 4");
    assert_eq!(again(&scenes, "gt.png a.png")["losses"], scenes["results"][0]["losses"]);
    assert_eq!((scenes["scenes"].as_array().unwrap().len(), &scenes["of"]), (4, &9.into()));
    let found = json_of(at, "worst gt.png b.png");
    assert_eq!(again(&found, "gt.png b.png")["loss"], found["results"][0]["worst"]);
    // A capture of MaterialGAN: the same scene in half widths.
    let capture = r#"{"im_size": 4, "idx": [0], "camera_pos": [[0, 0, 4]], "light_pos": [[1, 1, 2]], "light_pow": [1, 1, 1]}"#;
    fs::write(at.join("render.json"), capture).unwrap();
    let [loss, one] =
        ["render", "one"].map(|name| losses_as_json(at, &format!("gt.png a.png --scenes {name}.json")));
    assert_eq!((&loss["scenes"], &loss["results"]), (&one["scenes"], &one["results"]));
}

/// The mean over channels of each texel of `x.csv`.
fn texels(folder: &Path) -> Vec<f64> {
    let mean = |row: &BTreeMap<String, String>| {
        ["red", "green", "blue"].iter().map(|c| row[*c].parse::<f64>().unwrap()).sum::<f64>() / 3.0
    };
    rows(&text_of(folder, "x.csv")).iter().map(mean).collect()
}

#[test]
fn the_mean_of_a_map_is_the_loss_and_its_last_colour_is_the_99th_percentile_or_as_specified() {
    let folder = folder();
    let at = folder.path();
    for (extension, least) in [("csv", 100), ("exr", 300), ("png", 150)] {
        let printed = succeed(at, &format!("map gt.png a.png b.png -o x.{extension}"));
        assert_has(&printed, &["largest", "convention printed"]);
        let bytes = fs::metadata(at.join(format!("x.{extension}"))).unwrap().len();
        assert!(bytes > least, "{extension}: {bytes} bytes");
    }
    succeed(at, "map gt.png a.png -o x.csv");
    let losses = texels(at);
    let mean = losses.iter().sum::<f64>() / 64.0;
    let loss = loss_of(at, "gt.png a.png --near 128 --distant 64 --sampler sobol");
    assert!(losses.len() == 64 && (mean / loss - 1.0).abs() < 1e-5, "{mean}, {loss}");

    let last = |args: &str| {
        let printed = succeed(at, &format!("map gt.png a.png --near 4 -o x.png {args}"));
        let line = printed.lines().find_map(|line| line.strip_prefix("colours from 0 to ")).unwrap();
        line.split(';').next().unwrap().parse::<f64>().unwrap()
    };
    succeed(at, "map gt.png a.png --near 4 -o x.csv");
    let losses = texels(at);
    let (range, largest) = (last(""), losses.iter().copied().fold(0.0, f64::max));
    let above = losses.iter().filter(|loss| **loss > range + 1e-6).count();
    assert!(range <= largest && above <= 1 + losses.len() / 100, "{range} of {largest}, {above} above");
    assert_eq!((last("--range auto"), last("--range 0.25")), (range, 0.25));
    assert_holds(at, "x.png", &["the last colour is 0.25"]);
}
