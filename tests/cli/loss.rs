//! `svbrdf loss`: its numbers and its formats.

use serde_json::{Value, json};

use super::{assert_has, assert_refused, folder, losses_as_json, rows_of, succeed, write_material};

#[test]
fn the_loss_of_the_built_in_pair_is_the_same_in_every_format_with_its_settings() {
    let folder = folder();
    let args = "--near 3 --distant 2 --seed 5 --convention multi-image-2019";
    let table = succeed(folder.path(), &format!("loss {args}"));
    let rows = rows_of(folder.path(), &format!("loss {args}"));
    let json = losses_as_json(folder.path(), args);
    let parts = ["convention multi-image-2019", "epsilon 0.1", "3 near-field and 2 distant", "seed 5", "f32"];
    assert_has(&table, &parts);
    let settings = ["convention", "epsilon", "near", "distant", "seed", "precision", "texels", "size"];
    let expected = json!(["multi-image-2019", 0.1, 3, 2, 5, "f32", "all", [256, 256]]);
    assert_eq!(Value::from_iter(settings.map(|key| json[key].clone())), expected);
    let results = json["results"].as_array().unwrap();
    assert_eq!((results.len(), rows.len(), json["scenes"].as_array().unwrap().len()), (2, 2, 5));
    for (result, row) in results.iter().zip(rows) {
        let (name, loss) = (result["prediction"].as_str().unwrap(), result["loss"].as_f64().unwrap());
        assert_eq!((row["prediction"].as_str(), row["loss"].parse()), (name, Ok(loss)));
        let line = table.lines().find(|line| line.starts_with(name)).unwrap();
        assert_has(line, &[&format!("  {loss:.6}  ")]);
        let losses = result["losses"].as_array().unwrap().iter().map(|loss| loss.as_f64().unwrap());
        assert!((losses.sum::<f64>() / 5.0 - loss).abs() < 1e-12);
    }
    assert_eq!(losses_as_json(folder.path(), "gt.png a.png --near 6 --texels 12")["texels"], 12);
}

#[test]
fn without_options_the_loss_is_over_all_scenes_in_every_format_and_few_scenes_have_a_name_of_their_own() {
    let folder = folder();
    let pair = "gt.png b.png --seed 3";
    let [all, many, few] = ["", "--target-error 1%", "--near 6 --distant 3"]
        .map(|options| losses_as_json(folder.path(), &format!("{pair} {options}")));
    let (known, few_scenes) = (&all["results"][0], &few["results"][0]);
    for key in ["loss", "standard_error", "interval95", "losses"] {
        assert_eq!(known[key], many["results"][0][key], "{key}");
        assert_eq!(known[format!("few_scenes_{key}")], few_scenes[key], "{key}");
    }
    let settings = all["few_scenes"].as_object().unwrap();
    assert!(settings.len() > 3 && settings.iter().all(|(key, value)| few[key] == *value), "{settings:?}");
    assert_eq!((&many["few_scenes"], &few["few_scenes"]), (&Value::Null, &Value::Null));
    let (loss, few_loss) = (known["loss"].as_f64().unwrap(), few_scenes["loss"].as_f64().unwrap());
    let row = &rows_of(folder.path(), &format!("loss {pair}"))[0];
    assert_eq!([&row["loss"], &row["few_scenes_loss"]], [&loss.to_string(), &few_loss.to_string()]);
    let text = succeed(folder.path(), &format!("loss {pair}"));
    let line = text.find("6 + 3 scenes: ").unwrap();
    assert!(text.find(&format!("{loss:.6}")).unwrap() < line, "{text}");
    assert_has(&text[line..], &[&format!("{few_loss:.3} (95% ")]);
}

#[test]
fn a_time_budget_gives_a_loss_and_nonsense_is_refused() {
    let folder = folder();
    let json = losses_as_json(folder.path(), "gt.png a.png --time-budget 20ms");
    // How many fit depends on the machine; it is always a doubling of the smallest run.
    let [near, distant] = ["near", "distant"].map(|kind| json[kind].as_u64().unwrap());
    assert!(near >= 16 && near == 2 * distant && distant.is_power_of_two(), "{json}");
    let refused = [
        ("--target-error -1%", "more than 0%"),
        ("--time-budget 0", "above 0"),
        ("--time-budget 2m", "in us, ms or s"),
        ("--texels 0", "a number such as 256"),
        ("--read dielectric-f0=-1", "a number from 0 to 1"),
        ("--resize-to -1", "a width from 1"),
        ("--sampler halton", "sobol"),
        ("--target-error 1% --texels 3", "the target error decides the scenes; leave out --texels"),
        ("--scenes one.json --seed 5", "the scenes are a fixed list; leave out --seed"),
    ];
    for (options, words) in refused {
        assert_refused(folder.path(), &[(&format!("loss gt.png a.png {options}"), 64, words)]);
    }
}

#[test]
fn what_is_unknown_is_never_printed_as_0() {
    let folder = folder();
    let json = losses_as_json(folder.path(), "gt.png a.png --near 1");
    assert_eq!(json["results"][0]["standard_error"], Value::Null);
    assert_eq!(json["interval95_from"], "pilot");
    assert!(json["results"][0]["interval95"][0].as_f64().unwrap() > 0.0, "a pilot needs no second scene");
    let table = succeed(folder.path(), "loss gt.png a.png --near 1");
    assert_eq!(table.matches("unknown").count(), 1, "{table}");
    // Listed scenes have no distribution to make a pilot from.
    let json = losses_as_json(folder.path(), "gt.png a.png --scenes one.json");
    assert_eq!(
        (&json["interval95_from"], &json["results"][0]["interval95"]),
        (&json!("scenes"), &Value::Null)
    );
    let table = succeed(folder.path(), "loss gt.png a.png --scenes one.json");
    assert_eq!(table.matches("unknown").count(), 2, "{table}");
    let csv = succeed(folder.path(), "loss gt.png a.png --scenes one.json --format csv");
    assert!(csv.contains(",,,,printed,"), "{csv}");
}

/// What a report says about its losses, and the options that ask for as many scenes by number.
fn numbers_and_options(json: &Value) -> (Vec<Value>, String) {
    let results = json["results"].as_array().unwrap();
    let numbers = results.iter().flat_map(|r| ["loss", "standard_error"].map(|k| r[k].clone()));
    let options = ["near", "distant", "seed", "sampler", "texels"]
        .map(|option| format!("--{option} {}", json[option].to_string().trim_matches('"')));
    let differences = json["differences"].as_array().unwrap().iter();
    let differences = differences.flat_map(|d| ["difference", "standard_error"].map(|k| d[k].clone()));
    (numbers.chain(differences).collect(), options.join(" "))
}

#[test]
fn a_run_by_accuracy_or_time_is_the_run_that_its_report_names() {
    let folder = folder();
    for (materials, goal) in [
        ("", "--target-error 5% --seed 7"),
        ("gt.png a.png b.png", "--time-budget 30ms --seed 2"),
        ("big.png big2.png", "--target-error 10% --precision f64"),
    ] {
        write_material(&folder.path().join("big2.png"), 16, 140);
        let by_goal = losses_as_json(folder.path(), &format!("{materials} {goal}"));
        assert_eq!((&by_goal["scenes"], &by_goal["results"][0]["losses"]), (&Value::Null, &Value::Null));
        let (numbers, options) = numbers_and_options(&by_goal);
        let precision = if goal.contains("f64") { "--precision f64" } else { "" };
        let again = |options: &str| {
            numbers_and_options(&losses_as_json(folder.path(), &format!("{materials} {options} {precision}")))
                .0
        };
        assert_eq!(again(&options), numbers, "{goal}: {options}");
        // A planted fault: another seed.
        let seed = by_goal["seed"].as_u64().unwrap();
        let other = options.replace(&format!("--seed {seed}"), &format!("--seed {}", seed + 1));
        assert_ne!(again(&other), numbers);
    }
}
