//! `svbrdf loss`: two ways to one number.

use serde_json::{Value, json};

use super::{folder, losses_as_json, write_material};

#[test]
fn without_options_the_loss_is_that_to_1_percent_beside_that_of_few_scenes() {
    let folder = folder();
    let [all, many, few] = ["", "--target-error 1%", "--near 6 --distant 3"]
        .map(|options| losses_as_json(folder.path(), &format!("gt.png b.png --seed 3 {options}")));
    let (known, few_scenes) = (&all["results"][0], &few["results"][0]);
    for key in ["loss", "standard_error", "interval95", "losses"] {
        assert_eq!(known[key], many["results"][0][key], "{key}");
        assert_eq!(known[format!("few_scenes_{key}")], few_scenes[key], "{key}");
    }
    let settings = all["few_scenes"].as_object().unwrap();
    assert!(settings.len() > 3 && settings.iter().all(|(key, value)| few[key] == *value), "{settings:?}");
    assert_eq!((&many["few_scenes"], &few["few_scenes"]), (&Value::Null, &Value::Null));
}

/// What a report says about its losses, and the options that ask for as many scenes by number.
fn numbers_and_options(json: &Value) -> (Vec<Value>, String) {
    let all = ["results", "differences"].into_iter().flat_map(|list| json[list].as_array().unwrap());
    let numbers = all.flat_map(|one| ["loss", "difference", "standard_error"].map(|key| one[key].clone()));
    let options = ["near", "distant", "seed", "sampler", "texels"]
        .map(|option| format!("--{option} {}", json[option].to_string().trim_matches('"')));
    (numbers.collect(), options.join(" "))
}

#[test]
fn a_run_by_accuracy_or_time_is_the_run_that_its_report_names() {
    let folder = folder();
    write_material(&folder.path().join("big2.png"), 16, 140);
    for (materials, goal) in [
        ("", "--target-error 5% --seed 7"),
        ("gt.png a.png b.png", "--time-budget 30ms --seed 2"),
        ("big.png big2.png", "--target-error 10% --precision f64"),
    ] {
        let by_goal = losses_as_json(folder.path(), &format!("{materials} {goal}"));
        assert_eq!((&by_goal["scenes"], &by_goal["results"][0]["losses"]), (&Value::Null, &Value::Null));
        // How many fit into a time depends on the machine; it is always a doubling of the smallest run.
        let [near, distant] = ["near", "distant"].map(|kind| by_goal[kind].as_u64().unwrap());
        let is_doubling = near >= 16 && near == 2 * distant && distant.is_power_of_two();
        assert!(is_doubling || !goal.contains("time"), "{by_goal}");
        let (numbers, options) = numbers_and_options(&by_goal);
        let precision = if goal.contains("f64") { "--precision f64" } else { "" };
        let again = |options: &str| {
            let again = losses_as_json(folder.path(), &format!("{materials} {options} {precision}"));
            numbers_and_options(&again).0
        };
        assert_eq!(again(&options), numbers, "{goal}: {options}");
        // A planted fault: another seed.
        let seed = by_goal["seed"].as_u64().unwrap();
        assert_ne!(
            again(&options.replace(&format!("--seed {seed}"), &format!("--seed {}", seed + 1))),
            numbers
        );
    }
}

#[test]
fn scenes_that_were_printed_can_be_read_again() {
    let folder = folder();
    let drawn = losses_as_json(folder.path(), "gt.png a.png --near 6 --distant 3 --seed 9 --precision f64");
    std::fs::write(folder.path().join("drawn.json"), drawn.to_string()).unwrap();
    let read = losses_as_json(folder.path(), "gt.png a.png --scenes drawn.json --precision f64");
    // Listed scenes name no distribution: their interval comes from themselves.
    assert_eq!((&read["interval95_from"], &drawn["interval95_from"]), (&json!("scenes"), &json!("pilot")));
    for key in ["loss", "losses", "standard_error"] {
        assert_eq!(read["results"][0][key], drawn["results"][0][key], "{key}");
    }
    assert_eq!(read["scenes"], drawn["scenes"]);
    assert_eq!((&read["seed"], &read["near"]), (&Value::Null, &json!(6)));
}
