//! The program as its users run it: exit codes, stdout, stderr and files.

mod backend;
mod kept;
mod pictures;
mod study;

use std::path::Path;
use std::process::{Command, Output, Stdio};

use image::{Rgb, RgbImage};
use serde_json::{Value, json};
use tempfile::TempDir;

fn svbrdf() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_svbrdf"));
    command.stdin(Stdio::null());
    for display in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(display);
    }
    command
}

/// Runs in `folder` with arguments that are separated by spaces.
fn run_in(folder: &Path, args: &str) -> Output {
    svbrdf().args(args.split_whitespace()).current_dir(folder).output().unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// The stdout of a run that must succeed, with nothing to complain about.
fn succeed(folder: &Path, args: &str) -> String {
    let output = run_in(folder, args);
    assert!(output.status.success(), "{args}: {}", text(&output.stderr));
    let complaints = text(&output.stderr).lines().find(|line| !line.starts_with("svbrdf: note: "));
    assert_eq!(complaints, None, "{args}");
    text(&output.stdout).to_owned()
}

/// The stderr of a run that must fail with `code`: an error on its one line, no result, no new file.
fn fail(folder: &Path, args: &str, code: i32) -> String {
    let before = files(folder);
    let output = run_in(folder, args);
    let stderr = text(&output.stderr).to_owned();
    assert_eq!(output.status.code(), Some(code), "{args}: {stderr}");
    assert_eq!(text(&output.stdout), "", "{args}");
    assert_eq!(stderr.matches("error: ").count(), 1, "{args}: {stderr}");
    assert!(!stderr.contains("panicked"), "{args}: {stderr}");
    assert_eq!(files(folder), before, "{args}");
    stderr
}

fn files(folder: &Path) -> Vec<String> {
    let names = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<_> = names.map(|name| name.to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// A packed strip: normal | diffuse | roughness | specular, `side` texels each.
fn write_material(path: &Path, side: u32, roughness: u8) {
    let tile = |x: u32, y: u32| match x / side {
        0 => [128, 140, 250],
        1 => [200, (8 * (x % side)) as u8, (8 * y) as u8],
        2 => [roughness; 3],
        _ => [12; 3],
    };
    RgbImage::from_fn(4 * side, side, |x, y| Rgb(tile(x, y))).save(path).unwrap();
}

/// A folder with materials of one size and of others, and scene files.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let of = |name: &str| folder.path().join(name);
    for (name, side, roughness) in [("gt", 8, 100), ("a", 8, 120), ("b", 8, 220), ("big", 16, 100)] {
        write_material(&of(&format!("{name}.png")), side, roughness);
    }
    let scene = |light: &str| format!(r#"{{"kind": "near", "view": [0, 0, 2], "light": {light}}}"#);
    let file = |scenes: &str| format!(r#"{{"scenes": [{scenes}]}}"#);
    let scene_files = [
        ("one.json", file(&scene("[0.5, 0.5, 1]"))),
        ("nan.json", file(&scene("[0.5, NaN, 1]"))),
        ("below.json", file(&scene("[0.5, 0.5, -1]"))),
        ("none.json", file("")),
        ("not.json", "scenes".to_owned()),
    ];
    for (name, content) in scene_files {
        std::fs::write(of(name), content).unwrap();
    }
    std::fs::write(of("text.png"), "not an image").unwrap();
    folder
}

fn losses_as_json(folder: &Path, args: &str) -> Value {
    serde_json::from_str(&succeed(folder, &format!("loss {args} --format json"))).unwrap()
}

fn keys(object: &Value) -> Vec<&str> {
    object.as_object().unwrap().keys().map(String::as_str).collect()
}

#[test]
fn help_shows_examples_and_exit_codes() {
    let folder = folder();
    let help = succeed(folder.path(), "--help");
    for expected in ["view", "loss", "render", "Examples:", "Exit codes:", "64", "--albedo", "--normal-y"] {
        assert!(help.contains(expected), "{expected} is missing in\n{help}");
    }
    for (subcommand, option) in [("view", "--gt-albedo"), ("loss", "--scenes"), ("render", "--exposure")] {
        assert!(succeed(folder.path(), &format!("{subcommand} --help")).contains(option));
    }
    assert!(succeed(folder.path(), "--version").contains(env!("CARGO_PKG_VERSION")));
}

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
fn json_is_one_object_with_exactly_these_keys() {
    let folder = folder();
    let json = losses_as_json(folder.path(), "gt.png a.png b.png --seed 5 --convention multi-image-2019");
    let top = [
        "convention",
        "epsilon",
        "backend",
        "size",
        "near",
        "distant",
        "seed",
        "sampler",
        "differences",
        "results",
    ];
    let mut sorted = top;
    sorted.sort_unstable();
    assert_eq!(keys(&json), sorted);
    assert_eq!((&json["convention"], &json["epsilon"]), (&json!("multi-image-2019"), &json!(0.1)));
    assert_eq!((&json["size"], &json["seed"]), (&json!([8, 8]), &json!(5)));
    assert_eq!((&json["near"], &json["distant"]), (&json!(6), &json!(3)));
    let result = &json["results"][1];
    assert_eq!(keys(result), ["interval95", "loss", "prediction", "scenes", "standard_error"]);
    assert_eq!(result["prediction"], "b");
    assert_eq!(result["scenes"].as_array().unwrap().len(), 9);
    assert_eq!(keys(&result["scenes"][0]), ["kind", "light", "loss", "view"]);
    let [low, high] = [0, 1].map(|i| result["interval95"][i].as_f64().unwrap());
    assert!((low..high).contains(&result["loss"].as_f64().unwrap()));
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
    assert!(json["near"].as_u64().unwrap() >= 32, "{json}");
    for bad in ["--target-error 0%", "--target-error much", "--time-budget -1s", "--sampler halton"] {
        fail(folder.path(), &format!("loss gt.png a.png {bad}"), 64);
    }
    fail(folder.path(), "loss gt.png a.png --target-error 1% --near 6", 64);
}

#[test]
fn what_is_unknown_is_never_printed_as_0() {
    let folder = folder();
    let json = losses_as_json(folder.path(), "gt.png a.png --near 1");
    assert_eq!(json["results"][0]["standard_error"], Value::Null);
    assert_eq!(json["results"][0]["interval95"], Value::Null);
    let table = succeed(folder.path(), "loss gt.png a.png --near 1");
    assert_eq!(table.matches("unknown").count(), 2, "{table}");
    let csv = succeed(folder.path(), "loss gt.png a.png --near 1 --format csv");
    assert!(csv.contains(",,,,printed,"), "{csv}");
}

#[test]
fn scenes_that_were_printed_can_be_read_again() {
    let folder = folder();
    let drawn = losses_as_json(folder.path(), "gt.png a.png --seed 9 --precision f64");
    let mut scenes = drawn["results"][0]["scenes"].clone();
    for scene in scenes.as_array_mut().unwrap() {
        scene.as_object_mut().unwrap().remove("loss");
    }
    std::fs::write(folder.path().join("drawn.json"), json!({ "scenes": scenes }).to_string()).unwrap();
    let read = losses_as_json(folder.path(), "gt.png a.png --scenes drawn.json --precision f64");
    assert_eq!(read["results"], drawn["results"]);
    assert_eq!((&read["seed"], &read["near"]), (&Value::Null, &json!(6)));
    let table = succeed(folder.path(), "loss gt.png a.png --scenes drawn.json");
    assert!(table.contains("from a file"), "{table}");
}

#[test]
fn options_of_reading_change_what_is_read() {
    let folder = folder();
    let loss = |args: &str| {
        losses_as_json(folder.path(), &format!("gt.png a.png {args}"))["results"][0]["loss"].clone()
    };
    let linear = loss("--albedo linear");
    let both = loss("--albedo gamma2.2");
    assert_eq!(both, loss("--gt-albedo gamma2.2 --pred-albedo gamma2.2"));
    assert_eq!(loss("--albedo srgb --gt-albedo linear --pred-albedo linear"), linear);
    assert_ne!(linear, both);
    assert_ne!(loss("--gt-albedo gamma2.2 --pred-albedo linear"), both);
    assert_ne!(loss("--albedo linear --normal-y down"), linear);
}

#[test]
fn bad_input_gets_one_clear_error_and_leaves_nothing() {
    let folder = folder();
    let cases = [
        ("loss gt.png a.png --convention other", 64, "guided-2020"),
        ("loss gt.png a.png --precision f16", 64, "f32, f64"),
        ("loss gt.png a.png --backend tpu", 64, "auto"),
        ("loss gt.png a.png --backend gpu --precision f64", 64, "leave out --backend gpu"),
        ("loss gt.png a.png --near -1", 64, "--near"),
        ("loss gt.png a.png --near 0 --distant 0", 64, "at least one scene"),
        ("loss gt.png a.png --scenes one.json --seed 1", 64, "cannot be used with"),
        ("loss gt.png", 64, "no prediction"),
        ("loss gt.png a.png --colour", 64, "--colour"),
        ("loss --albedo srgb", 64, "<GT>"),
        ("loss gt.png a.png --scenes nan.json", 1, "nan.json"),
        ("loss gt.png a.png --scenes below.json", 1, "scene 0: its light [0.5, 0.5, -1.0] is not above"),
        ("loss gt.png a.png --scenes none.json", 1, "no scene"),
        ("loss gt.png a.png --scenes not.json", 1, "not.json"),
        ("loss gt.png a.png --scenes missing.json", 1, "missing.json"),
        ("loss gt.png missing.png", 1, "missing.png"),
        ("loss gt.png text.png", 1, "text.png"),
        ("loss gt.png big.png", 1, "8 x 8, prediction big is 16 x 16"),
        ("render gt.png", 64, "--output"),
        ("render gt.png -o no/folder.png", 1, "create the folder"),
        ("render gt.png -o picture.jpg", 1, ".exr (linear floats), .png"),
        ("render gt.png -o picture", 1, ".exr"),
        ("render gt.png -o x.png --view 1,2", 64, "three numbers"),
        ("render gt.png -o x.png --view a,b,c", 64, "three numbers"),
        ("render gt.png -o x.png --light 0,0,-1", 1, "above the plane"),
        ("render gt.png -o x.png --light 0,nan,1", 1, "not finite"),
        ("render gt.png -o x.png --exposure nan", 64, "number of stops"),
        ("render gt.png big.png -o x.png", 1, "one by one"),
        ("render missing.png -o x.exr", 1, "missing.png"),
    ];
    for (args, code, said) in cases {
        let stderr = fail(folder.path(), args, code);
        assert!(stderr.contains(said), "{args}: `{said}` is missing in {stderr}");
    }
}

#[test]
fn without_a_display_the_window_names_the_headless_commands() {
    let folder = folder();
    for args in ["", "view", "gt.png a.png", "view gt.png"] {
        let stderr = fail(folder.path(), args, 2);
        assert!(stderr.contains("`svbrdf loss`") && stderr.contains("`svbrdf render`"), "{args}: {stderr}");
    }
}

#[test]
fn without_an_adapter_the_gpu_is_a_clear_error() {
    let folder = folder();
    let mut command = svbrdf();
    command.args(["render", "gt.png", "--gpu", "-o", "x.png"]).current_dir(folder.path());
    command.env("WGPU_BACKEND", "vulkan").env("VK_ICD_FILENAMES", "none").env("VK_DRIVER_FILES", "none");
    let output = command.output().unwrap();
    let stderr = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert!(stderr.contains("no usable graphics adapter"), "{stderr}");
    assert!(!folder.path().join("x.png").exists());
}

#[test]
fn a_closed_pipe_is_no_error() {
    let mut child =
        svbrdf().args(["loss", "--near", "2"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert_eq!(text(&output.stderr).lines().find(|line| !line.contains("note: ")), None);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = svbrdf().args(["loss", "--near", "2"]).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("cannot write standard output"));
}

#[test]
fn info_says_what_was_assumed_and_strict_refuses_guesses() {
    let folder = folder();
    let text = succeed(folder.path(), "info gt.png");
    for said in ["gt, 8 x 8 texels", "As stored:", "tile 1", "Assumed:", "layout: ndrs", "albedo: linear"] {
        assert!(text.contains(said), "{said} is missing in\n{text}");
    }
    let json: Value = serde_json::from_str(&succeed(folder.path(), "info gt.png --format json")).unwrap();
    assert_eq!(json["maps"].as_array().unwrap().len(), 4);
    assert_eq!(json["assumptions"][0]["what"], "layout");
    let given = succeed(folder.path(), "info gt.png --albedo srgb --order ndrs --normal-y down");
    assert!(
        given.contains("albedo: srgb: as you said") && given.contains("normal y: down: as you said"),
        "{given}"
    );

    RgbImage::from_pixel(32, 8, Rgb([90, 90, 90])).save(folder.path().join("flat.png")).unwrap();
    assert!(
        succeed(folder.path(), "info flat.png").contains("layout: ndrs in 4 x 1 tiles of 8 x 8 (unsure)")
    );
    assert!(fail(folder.path(), "info flat.png --strict", 1).contains("flat.png is ambiguous: layout"));
}

#[test]
fn convert_writes_what_loss_finds_to_be_the_same() {
    let folder = folder();
    for out in ["gt.exr", "gt16.png", "gt_folder"] {
        let depth = if out == "gt.exr" { "float" } else { "16" };
        assert_eq!(succeed(folder.path(), &format!("convert gt.png {out} --depth {depth}")), "");
        let json = losses_as_json(folder.path(), &format!("gt.png {out}"));
        let loss = json["results"][0]["loss"].as_f64().unwrap();
        assert!(loss < 1e-3, "{out}: {loss}");
    }
    assert!(
        fail(folder.path(), "convert gt.png x.png --depth half", 64)
            .contains("PNG and folders have 8 and 16")
    );
    assert!(fail(folder.path(), "convert gt.png gt_folder", 1).contains("not there yet"));
}

#[test]
fn predictions_of_another_size_are_compared_once_it_is_said_how() {
    let folder = folder();
    assert!(fail(folder.path(), "loss gt.png big.png", 1).contains("--resize-to gt, pred or a width"));
    for (to, side) in [("gt", 8), ("pred", 16), ("12", 12)] {
        let json = losses_as_json(folder.path(), &format!("gt.png big.png --resize-to {to}"));
        assert_eq!(json["size"], json!([side, side]), "{to}");
    }
    fail(folder.path(), "loss gt.png big.png --resize-to half", 64);
}
