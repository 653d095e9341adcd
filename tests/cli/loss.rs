//! `svbrdf loss`: its numbers and its formats.

use serde_json::{Value, json};

use super::{fail, folder, losses_as_json, run_in, succeed, text, write_material};

#[test]
fn the_loss_of_the_built_in_pair_is_the_same_in_every_format() {
    let folder = folder();
    let table = succeed(folder.path(), "loss --near 3 --distant 2");
    let csv = succeed(folder.path(), "loss --near 3 --distant 2 --format csv");
    let json = losses_as_json(folder.path(), "--near 3 --distant 2");
    for said in
        ["convention printed", "epsilon 0.01", "3 near-field and 2 distant", "seed 0", "f32 on the cpu"]
    {
        assert!(table.contains(said), "{said} is missing in\n{table}");
    }
    let results = json["results"].as_array().unwrap();
    assert_eq!((results.len(), csv.lines().count()), (2, 3));
    for (result, row) in results.iter().zip(csv.lines().skip(1)) {
        let (name, loss) = (result["prediction"].as_str().unwrap(), result["loss"].as_f64().unwrap());
        assert!(row.starts_with(&format!("{name},{loss},")), "{row}");
        let line = table.lines().find(|line| line.starts_with(name)).unwrap();
        assert!(line.contains(&format!("  {loss:.6}  ")), "{line}");
    }
}

#[test]
fn json_has_the_losses_with_the_settings_that_they_depend_on() {
    let folder = folder();
    let json = losses_as_json(
        folder.path(),
        "gt.png a.png b.png --seed 5 --near 6 --distant 3 --convention multi-image-2019",
    );
    assert_eq!((&json["ground_truth"], &json["ground_truth_path"]), (&json!("gt"), &json!("gt.png")));
    assert_eq!((&json["precision"], &json["texels"]), (&json!("f32"), &json!("all")));
    assert_eq!(losses_as_json(folder.path(), "gt.png a.png --near 6 --texels 12")["texels"], json!(12));
    assert_eq!((&json["convention"], &json["epsilon"]), (&json!("multi-image-2019"), &json!(0.1)));
    assert_eq!((&json["size"], &json["seed"]), (&json!([8, 8]), &json!(5)));
    assert_eq!((&json["near"], &json["distant"]), (&json!(6), &json!(3)));
    let result = &json["results"][1];
    assert_eq!((&result["prediction"], &result["path"]), (&json!("b"), &json!("b.png")));
    let losses: Vec<f64> =
        result["losses"].as_array().unwrap().iter().map(|loss| loss.as_f64().unwrap()).collect();
    assert!((losses.iter().sum::<f64>() / 9.0 - result["loss"].as_f64().unwrap()).abs() < 1e-12);
    assert_eq!(json["scenes"].as_array().unwrap().len(), 9);
    let [low, high] = [0, 1].map(|i| result["interval95"][i].as_f64().unwrap());
    assert!((low..high).contains(&result["loss"].as_f64().unwrap()));
}

#[test]
fn without_options_the_loss_is_over_all_scenes_in_every_format_and_few_scenes_have_a_name_of_their_own() {
    let folder = folder();
    let json = losses_as_json(folder.path(), "gt.png a.png b.png --seed 3");
    let many = losses_as_json(folder.path(), "gt.png a.png b.png --seed 3 --target-error 1%");
    let few = losses_as_json(folder.path(), "gt.png a.png b.png --seed 3 --near 6 --distant 3");
    // The report is that of the accuracy; what is of few scenes says so.
    let mut rest = json.clone();
    rest["few_scenes"] = Value::Null;
    for (entry, few) in
        rest["results"].as_array_mut().unwrap().iter_mut().zip(few["results"].as_array().unwrap())
    {
        let entry = entry.as_object_mut().unwrap();
        for key in ["loss", "standard_error", "interval95", "losses"] {
            assert_eq!(entry.remove(&format!("few_scenes_{key}")), Some(few[key].clone()), "{key}");
        }
    }
    assert_eq!(rest, many);
    let settings = json["few_scenes"].as_object().unwrap();
    assert!(settings.iter().all(|(key, value)| few[key] == *value), "{settings:?}");
    assert_eq!(settings["scenes"].as_array().unwrap().len(), 9);
    let known = &json["results"][1];
    let [loss, low, high] = [&known["loss"], &known["interval95"][0], &known["interval95"][1]];
    let [loss, low, high] = [loss, low, high].map(|number| number.as_f64().unwrap());
    assert!(low < loss && loss < high && (high - low) / 2.0 <= 0.01 * loss, "{known}");
    let few_loss = known["few_scenes_loss"].as_f64().unwrap();
    let csv = succeed(folder.path(), "loss gt.png a.png b.png --seed 3 --format csv");
    let row = csv.lines().nth(2).unwrap();
    assert!(row.starts_with(&format!("b,{loss},")) && row.contains(&format!(",{few_loss},")), "{csv}");
    let text = succeed(folder.path(), "loss gt.png a.png b.png --seed 3");
    let line = text.find("6 + 3 scenes: ").unwrap();
    assert!(text.find(&format!("{loss:.6}")).unwrap() < line, "{text}");
    assert!(text[line..].contains(&format!("{few_loss:.3} (95% ")), "{text}");
    // A number of scenes or a time asks for these alone.
    for options in ["--near 60", "--near 6 --sampler sobol", "--distant 3 --texels 9", "--time-budget 1ms"] {
        let json = losses_as_json(folder.path(), &format!("gt.png a.png {options}"));
        assert_eq!(
            (&json["few_scenes"], &json["results"][0]["few_scenes_loss"]),
            (&Value::Null, &Value::Null)
        );
    }
}

#[test]
fn a_target_error_is_reached_and_a_difference_has_its_own_interval() {
    let folder = folder();
    let json = losses_as_json(folder.path(), "gt.png a.png b.png --target-error 1%");
    for result in json["results"].as_array().unwrap() {
        let [low, high] = [0, 1].map(|i| result["interval95"][i].as_f64().unwrap());
        assert!((high - low) / 2.0 <= 0.01 * result["loss"].as_f64().unwrap(), "{result}");
    }
    let (a, b) = (&json["results"][0]["loss"], &json["results"][1]["loss"]);
    let difference = json["differences"][0]["interval95"].clone();
    let [low, high] = [0, 1].map(|i| difference[i].as_f64().unwrap());
    assert!((low..high).contains(&(b.as_f64().unwrap() - a.as_f64().unwrap())), "{difference}");
    assert_eq!(json["sampler"], "sobol");
}

#[test]
fn a_time_budget_gives_a_loss_and_nonsense_is_refused() {
    let folder = folder();
    let json = losses_as_json(folder.path(), "gt.png a.png --time-budget 20ms");
    // How many fit depends on the machine; it is always a doubling of the smallest run.
    let [near, distant] = ["near", "distant"].map(|kind| json[kind].as_u64().unwrap());
    assert!(near >= 16 && near == 2 * distant && distant.is_power_of_two(), "{json}");
    for (bad, said) in [
        ("--target-error 0%", "more than 0%"),
        ("--target-error -1%", "more than 0%"),
        ("--target-error much", "more than 0%"),
        ("--time-budget 0", "above 0"),
        ("--time-budget -1s", "above 0"),
        ("--time-budget 2m", "in us, ms or s"),
        ("--texels -3", "a number such as 256"),
        ("--texels 0", "a number such as 256"),
        ("--read dielectric-f0=-1", "a number from 0 to 1"),
        ("--resize-to -1", "a width from 1"),
        ("--sampler halton", "sobol"),
    ] {
        let stderr = fail(folder.path(), &format!("loss gt.png a.png {bad}"), 64);
        assert!(stderr.contains(said), "{bad}: {stderr}");
    }
    fail(folder.path(), "loss gt.png a.png --target-error 1% --near 6", 64);
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
    let listed = r#"{"scenes": [{"kind": "near", "view": [0, 0, 1], "light": [0, 0.5, 1]}]}"#;
    std::fs::write(folder.path().join("one.json"), listed).unwrap();
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
        ("", "--target-error 3%"),
        ("", "--target-error 5% --seed 7"),
        ("gt.png a.png b.png", "--time-budget 30ms --seed 2"),
        ("big.png big2.png", "--target-error 10% --precision f64"),
        ("big.png big2.png", "--time-budget 10ms"),
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

#[test]
fn an_accuracy_that_is_not_reached_is_said() {
    let folder = folder();
    let missed = "gt.png a.png --target-error 0.001%";
    let output = run_in(folder.path(), &format!("loss {missed} --format json"));
    let stderr = text(&output.stderr);
    assert!(output.status.success() && stderr.contains("warning: a is known to +-0.0"), "{stderr}");
    assert!(stderr.contains("not to the target of +-0.001%") && stderr.contains("786432 scenes"), "{stderr}");
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&json["target_error"], &json["target_reached"]), (&json!(1e-5), &json!(false)));
    let strict = run_in(
        folder.path(),
        &format!("loss {missed} --strict --preset deschaintre --read order=ndrs --format csv"),
    );
    assert_eq!(strict.status.code(), Some(1));
    assert!(
        text(&strict.stdout).contains(",0.00001,false,a.png,gt,gt.png,scenes,,,,\n"),
        "{}",
        text(&strict.stdout)
    );
    assert!(text(&strict.stderr).contains("error: a is known to"));
    let reached = losses_as_json(
        folder.path(),
        "gt.png a.png --target-error 10% --strict --preset deschaintre --read order=ndrs",
    );
    assert_eq!(reached["target_reached"], json!(true));
}

#[test]
fn the_header_says_which_texels_are_compared() {
    let folder = folder();
    let line = |args: &str| {
        let table = succeed(folder.path(), &format!("loss gt.png a.png {args}"));
        table.lines().nth(2).unwrap().to_owned()
    };
    let drawn = "6 near-field and 3 distant scenes, seed 0";
    assert_eq!(line("--near 6 --texels 99999999999"), drawn);
    assert_eq!(line("--near 6 --texels 64"), drawn);
    assert_eq!(line("--near 6 --texels 63"), format!("{drawn}, 63 random texels per scene"));
    assert_eq!(line("--near 6 --texels 1 --backend cpu"), format!("{drawn}, 1 random texel per scene"));
    line("--near 6 --texels 9 --backend auto");
    line("--target-error 10% --backend cpu");
    for chosen in ["--near 6 --texels 9", "--target-error 1%", "--time-budget 1ms"] {
        let stderr = fail(folder.path(), &format!("loss gt.png a.png {chosen} --backend gpu"), 64);
        assert!(stderr.contains("leave out --backend gpu"), "{stderr}");
    }
}

#[test]
fn a_session_file_stands_for_its_materials() {
    let folder = folder();
    let name = "a.svbrdf-session.json";
    let session = json!({
        "svbrdf-session": 1,
        "materials": [{"path": "gt.png"}, {"path": "a.png"}, {"path": "b.png", "read": {"roughness": "gloss"}}],
        "scene": {"kind": "near", "view": [0, 0, 2.5], "light": [0.4, 0.5, 1.2]},
        "convention": "printed",
    });
    std::fs::write(folder.path().join(name), session.to_string()).unwrap();
    let losses = |args: &str| -> Vec<f64> {
        let json = losses_as_json(folder.path(), &format!("{args} --near 6"));
        json["results"].as_array().unwrap().iter().map(|result| result["loss"].as_f64().unwrap()).collect()
    };
    let [as_found, of_session] = ["gt.png a.png b.png", name].map(losses);
    assert_eq!(of_session.len(), 2);
    assert_eq!(of_session[0], as_found[0]);
    assert_ne!(of_session[1], as_found[1], "its options are not used");
    let stderr = fail(folder.path(), &format!("loss {name} a.png"), 64);
    assert!(stderr.contains("names its predictions itself"), "{stderr}");
    assert!(succeed(folder.path(), &format!("blame {name} --format csv")).lines().count() > 2);
}

#[test]
fn an_option_that_leaves_the_number_of_scenes_open_leaves_the_accuracy() {
    let folder = folder();
    let json = |args: &str| losses_as_json(folder.path(), &format!("gt.png a.png {args}"));
    let usual = json("");
    for same in ["--sampler sobol", "--texels 32", "--sampler sobol --texels 32", "--seed 0"] {
        assert_eq!(json(same), usual, "{same}");
    }
    let counts = |args: &str| {
        let json = json(args);
        [json["near"].as_u64().unwrap(), json["distant"].as_u64().unwrap()]
    };
    assert_eq!(counts("--near 60"), [60, 30]);
    assert_eq!(counts("--near 5"), [5, 3]);
    assert_eq!(counts("--distant 4"), [8, 4]);
    assert_eq!(counts("--near 7 --distant 0"), [7, 0]);
    let scenes = |args: &str| {
        succeed(folder.path(), &format!("scenes gt.png a.png --format csv {args}")).lines().count()
    };
    assert_eq!(scenes("--near 6"), 1 + 9);
    let help = succeed(folder.path(), "loss --help");
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    for said in
        ["[default: sobol; with --near or --distant random]", "[default: 128; with --near or --distant all]"]
    {
        assert!(help.contains(said), "{said} is missing in {help}");
    }
}
