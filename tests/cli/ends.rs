//! How the program ends: exit codes, and what it says then.

use std::process::Stdio;

use super::{assert_has, assert_refused, fail, folder, succeed, svbrdf, text};

#[test]
fn help_shows_examples_and_exit_codes() {
    let folder = folder();
    let help = succeed(folder.path(), "--help");
    assert_has(&help, &["view", "loss", "render", "Examples:", "Exit codes:", "64", "help reading"]);
    for (subcommand, option) in [("view", "--read"), ("loss", "--scenes"), ("render", "--exposure")] {
        assert_has(&succeed(folder.path(), &format!("{subcommand} --help")), &[option]);
    }
}

/// Command lines, their status, and what they are told.
const REFUSALS: [(&str, i32, &str); 66] = [
    ("loss gt.png a.png --convention other", 64, "guided-2020"),
    ("loss gt.png a.png --precision f16", 64, "f32, f64"),
    ("loss gt.png a.png --backend tpu", 64, "auto"),
    ("loss gt.png a.png --backend gpu --precision f64", 64, "leave out --backend gpu"),
    ("loss gt.png a.png --near 0 --distant 0", 64, "at least one scene"),
    ("loss gt.png", 64, "no prediction"),
    ("map gt.png a.png -o x.csv --side 8", 64, "the size of its material; leave out --side"),
    ("report gt.png -o x.html --seed 5", 64, "there is no prediction, and no loss; leave out --seed"),
    ("rank gt.png a.png --shard 1/2 --results kept", 64, "only a data set"),
    ("loss gt.png a.png --colour", 64, "--colour"),
    ("loss gt.png a.png --scenes nan.json", 1, "nan.json"),
    ("loss gt.png a.png --scenes below.json", 1, "scene 0: its light [0.5, 0.5, -1.0] is not above"),
    ("loss gt.png a.png --scenes none.json", 1, "no scene"),
    ("loss gt.png a.png --scenes not.json", 1, "not.json"),
    ("loss gt.png missing.png", 1, "missing.png"),
    ("loss gt.png text.png", 1, "text.png"),
    ("loss gt.png big.png", 1, "8 x 8, prediction big is 16 x 16"),
    ("render gt.png", 64, "--output"),
    ("render gt.png -o no/folder.png", 1, "create the folder"),
    ("render gt.png -o picture.jpg", 64, ".exr (linear floats), .png"),
    ("convert gt.png x.exr --like gltf", 64, "leave out --like"),
    ("render gt.png -o x.png --view 1,2", 64, "three numbers"),
    ("render gt.png -o x.png --light 0,0,-1", 64, "above the plane"),
    ("render gt.png -o x.png --distant --light 1e-200,0,1e-200", 64, "too short for a direction"),
    ("render gt.png -o x.png --exposure 1e20", 64, "from -20 to 20"),
    ("render gt.png a.png -o x.exr --difference --range 1", 64, "leave out --range"),
    ("render gt.png a.png -o x.png --difference --exposure 1", 64, "leave out --exposure"),
    ("loss gt.png a.png --target-error 0.5", 64, "0.5% or 50%"),
    ("loss gt.png a.png --sampler random", 64, "number of near-field or distant scenes"),
    ("loss gt.png a.png --texels 64", 64, "not with texels 64"),
    ("render gt.png -o x.png --exposure nan", 64, "number of stops"),
    ("render gt.png big.png -o x.png", 1, "one by one"),
    ("metrics --protocol matfusion gt.png big.png", 1, "sizes differ"),
    ("metrics --protocol matfusion gt.png a.png --near 3", 64, "exposure; leave out --near"),
    ("metrics --protocol matfusion gt.png a.png --exposure 1", 64, "leave out --exposure"),
    ("metrics gt.png a.png --renderings out", 64, "--protocol"),
    ("metrics gt.png a.png --near 3 --renderings out", 64, "only a --protocol writes renderings"),
    ("metrics --protocol other gt.png a.png", 64, "matfusion"),
    ("metrics gt.png a.png --exposure nan", 64, "stops"),
    ("rank gt.png a.png --metrics", 64, "svbrdf metrics"),
    ("blame gt.png", 64, "no prediction"),
    ("worst gt.png big.png", 1, "sizes differ"),
    ("worst gt.png a.png --distance-tail 60%", 1, "less than 50%"),
    ("scenes gt.png a.png --near 0 --distant 0", 64, "at least one scene"),
    ("map gt.png a.png -o map.txt", 64, "extension"),
    ("map gt.png a.png -o nowhere/map.csv", 1, "its folder does not exist"),
    ("map gt.png a.png --over lights --fixed 0,0,-1 -o map.csv", 1, "not above the plane"),
    ("loss gt.png a.png --read albdo=srgb", 64, "use one of: albedo, dielectric-f0"),
    ("loss gt.png a.png --read albedo=sRGB", 64, "linear, srgb, gamma2.2, log0.01"),
    ("loss gt.png a.png b.png --read c:albedo=srgb", 64, "the names are gt, a, b"),
    ("loss gt.png a.png --read albedo=srgb --read albedo=linear", 64, "albedo is specified twice"),
    ("loss gt.png a.png --preset gao --read preset=gltf", 64, "preset is specified twice"),
    ("render gt.png -o x.png --read pred:albedo=srgb", 64, "no prediction; leave out --read"),
    ("loss a.png gt.png --read gt:albedo=srgb", 64, "give it another name"),
    ("loss --read albedo=srgb", 64, "the built-in materials are not read from files; leave out --read"),
    ("study gt.png gt.png -o study.csv", 1, "look the same"),
    ("study gt.png", 64, "one prediction"),
    ("study gt.png a.png b.png", 64, "found 2; leave out the others"),
    ("study gt.png big.png", 1, "8 x 8, prediction big is 16 x 16"),
    ("study gt.png a.png --plot study.jpg", 64, ".svg, .png"),
    ("study gt.png a.png --plot no/study.svg", 1, "create the folder"),
    ("study gt.png a.png -o no/study.csv", 1, "create the folder"),
    ("render gt.png --difference -o out.png", 64, "prediction"),
    ("render gt.png big.png --difference -o out.png", 1, "16 x 16"),
    ("render --show normal --difference=log -o out.png", 64, "log"),
    ("render --show height -o out.png", 64, "height"),
];

#[test]
fn bad_input_gets_one_clear_error_and_leaves_nothing() {
    let folder = folder();
    assert_refused(folder.path(), &REFUSALS);
}

#[test]
fn without_a_display_the_window_names_the_headless_commands() {
    let folder = folder();
    for args in ["", "view", "gt.png a.png", "view gt.png"] {
        let stderr = fail(folder.path(), args, 2);
        assert_has(&stderr, &["`svbrdf loss`", "`svbrdf render`"]);
    }
}

#[test]
fn an_unknown_graphics_interface_is_named() {
    let folder = folder();
    for (value, args) in [
        ("", "render gt.png --gpu -o x.png"),
        ("vulcan", "render gt.png --gpu -o x.png"),
        ("vulkan,dx13", "loss gt.png a.png --near 2 --backend gpu"),
        ("vulcan", "view gt.png a.png"),
    ] {
        let mut command = svbrdf();
        command.args(args.split(' ')).current_dir(folder.path()).env("WGPU_BACKEND", value);
        let output = command.output().unwrap();
        let stderr = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{args}: {stderr}");
        let found = format!("WGPU_BACKEND, found \"{value}\"");
        assert!(stderr.contains(&found) && stderr.contains("unset it"), "{args}: {stderr}");
    }
}

#[cfg(unix)]
#[test]
fn displays_that_do_not_answer_are_named() {
    let folder = folder();
    let mut command = svbrdf();
    command.arg("view").current_dir(folder.path()).env("XDG_RUNTIME_DIR", folder.path());
    let output = command.env("WAYLAND_DISPLAY", "wayland-7").env("DISPLAY", ":9973").output().unwrap();
    let stderr = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert!(stderr.contains("WAYLAND_DISPLAY=wayland-7") && stderr.contains("DISPLAY=:9973"), "{stderr}");
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

    for args in [&["--help"][..], &["loss", "--help"], &["--version"]] {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = svbrdf().args(args).stdout(full).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{args:?}");
    }
}
