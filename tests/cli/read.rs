//! `--read`, `--preset` and `NAME=PATH`: how each material is read, and its name.

use serde_json::json;

use super::*;

#[test]
fn options_of_reading_apply_to_all_to_a_side_or_to_a_name() {
    let folder = folder();
    let loss = |args: &str| loss_of(folder.path(), args);
    let linear = loss("gt.png a.png --read albedo=linear");
    let both = loss("gt.png a.png --read albedo=gamma2.2");
    assert_ne!(linear, both);
    let sides = "gt.png a.png --read gt:albedo=gamma2.2 --read pred:albedo=gamma2.2";
    assert_eq!(loss(sides), both);
    assert_eq!(loss("gt.png a.png --read gt:albedo=gamma2.2 --read a:albedo=gamma2.2"), both);
    // The name counts before the side, and the side before all.
    assert_eq!(
        loss("gt.png a.png --read albedo=srgb --read gt:albedo=linear --read pred:albedo=linear"),
        linear
    );
    assert_eq!(
        loss("gt.png a.png --read albedo=linear --read pred:albedo=srgb --read a:albedo=linear"),
        linear
    );
    let one = losses_as_json(folder.path(), "gt.png a.png b.png --read b:roughness=gloss");
    let other = losses_as_json(folder.path(), "gt.png a.png b.png");
    let few = |json: &Value, index: usize| json["results"][index]["few_scenes_loss"].clone();
    assert_eq!(few(&one, 0), few(&other, 0));
    assert_ne!(few(&one, 1), few(&other, 1));
    // Several options of one material, and a preset of one side.
    let several = loss("gt.png a.png --read pred:albedo=srgb,roughness=gloss");
    assert_eq!(several, loss("gt.png a.png --read pred:albedo=srgb --read pred:roughness=gloss"));
    assert_eq!(loss("gt.png a.png --preset pred:gao"), loss("gt.png a.png --read a:preset=gao"));
    assert_ne!(loss("gt.png a.png --preset pred:gao"), loss("gt.png a.png --preset gao"));
    succeed(folder.path(), "info gt.png --read gt:albedo=srgb");
}

#[test]
fn a_material_has_the_name_before_its_path_in_every_result() {
    let folder = folder();
    let at = folder.path();
    let json = losses_as_json(at, "truth=gt.png ours=a.png b.png");
    assert_eq!((&json["ground_truth"], &json["ground_truth_path"]), (&json!("truth"), &json!("gt.png")));
    let names =
        |index: usize| (json["results"][index]["prediction"].clone(), json["results"][index]["path"].clone());
    assert_eq!([names(0), names(1)], [(json!("ours"), json!("a.png")), (json!("b"), json!("b.png"))]);
    for (args, said) in [
        ("loss gt.png ours=a.png theirs=b.png --scenes one.json", "\ntheirs - ours, "),
        ("rank gt.png ours=a.png theirs=b.png --target-error 30% --format csv", "ours,"),
        ("blame gt.png ours=a.png", "ours"),
        ("diagnose gt.png ours=a.png", "ours"),
        ("metrics gt.png ours=a.png", "ours"),
        ("scenes gt.png ours=a.png --near 2 --distant 1 --format csv", "ours"),
        ("info ours=a.png", "ours, 8 x 8 texels"),
    ] {
        assert_has(&succeed(at, args), &[said]);
    }
    succeed(at, "report truth=gt.png ours=a.png -o r.html --target-error 30%");
    assert_has(&text_of(at, "r.html"), &["truth", ">ours<"]);
    succeed(at, "convert ours=a.png out.exr");
    // The name and its option together.
    let loss = |args: &str| loss_of(at, args);
    assert_eq!(loss("gt.png ours=a.png --read ours:albedo=srgb"), loss("gt.png a.png --read a:albedo=srgb"));
}

#[test]
fn a_path_that_exists_is_opened_whatever_its_name() {
    let folder = folder();
    let at = folder.path();
    std::fs::copy(at.join("a.png"), at.join("lr=0.1.png")).unwrap();
    assert_eq!(losses_as_json(at, "gt.png lr=0.1.png")["results"][0]["prediction"], "lr=0.1");
    assert_eq!(losses_as_json(at, "gt.png x=lr=0.1.png")["results"][0]["prediction"], "x");
    let stderr = fail(at, "loss gt.png x=missing.png", 1);
    assert!(stderr.contains("missing.png") && !stderr.contains("x=missing.png"), "{stderr}");
    let refused = [
        ("loss gt.png x=a.png x=b.png", 64, "2 materials have the name x"),
        ("loss gt.png b=a.png b.png", 64, "2 materials have the name b"),
        ("rank gt.png x=?.png", 64, "the name x is for one"),
        ("loss x=s.svbrdf-session.json", 64, "a session names its materials itself"),
    ];
    assert_refused(at, &refused);
}
