//! `svbrdf photo`.

use std::path::Path;

use serde_json::{Value, json};
use tempfile::TempDir;

use super::pictures::image_of_exr;
use super::{
    assert_has, assert_holds, assert_refused, folder, json_of, rows_of, run_in, succeed, text, text_of,
};

/// Materials, and photographs of `gt.png` in the scene of `one.json`: floats, and 8 bits of half the exposure.
fn photographed() -> TempDir {
    let folder = folder();
    let scene = "--view 0,0,2 --light 0.5,0.5,1";
    succeed(folder.path(), &format!("render gt.png -o photo.exr {scene}"));
    succeed(folder.path(), &format!("render gt.png -o photo.png --exposure -1 {scene}"));
    folder
}

fn photo(folder: &Path, args: &str) -> Value {
    json_of(folder, &format!("photo {args}"))
}

fn names(report: &Value) -> Vec<&str> {
    report["results"].as_array().unwrap().iter().map(|one| one["material"].as_str().unwrap()).collect()
}

#[test]
fn the_right_material_comes_first_with_the_factor_of_the_exposure() {
    let folder = photographed();
    let at = folder.path();
    let floats = photo(at, "photo.exr b.png a.png gt.png --scene one.json");
    assert_eq!(names(&floats), ["gt", "a", "b"]);
    let [right, wrong] = [0, 1].map(|k| &floats["results"][k]["photographs"][0]);
    assert_eq!((&floats["photographs"][0]["transfer"], &right["factor"]), (&"linear".into(), &1.0.into()));
    for kind in ["log", "absolute", "relative"] {
        assert_eq!(right[kind]["p95"], 0.0, "{kind}");
        assert!(wrong[kind]["mean"].as_f64().unwrap() > 0.0, "{kind}");
    }
    let bytes = photo(at, "photo.png gt.png b.png --scene one.json");
    assert_eq!((names(&bytes)[0], &bytes["photographs"][0]["transfer"]), ("gt", &"srgb".into()));
    let ev = bytes["results"][0]["exposure_ev"].as_f64().unwrap();
    assert!((ev - 1.0).abs() < 0.02, "{ev}");
    // The JSON is a scene file.
    std::fs::write(at.join("again.json"), bytes.to_string()).unwrap();
    assert_eq!(photo(at, "photo.png gt.png b.png --scene again.json"), bytes);
}

#[test]
fn every_format_says_how_the_photograph_was_read_and_exposed() {
    let folder = photographed();
    let at = folder.path();
    let text = succeed(at, "photo photo.png gt.png a.png --scene one.json --corners 0,0 8,0 8,8 0,8");
    let parts = [
        "photo.png, 8 x 8 pixels, sRGB since it stores integers, corners 0,0 8,0 8,8 0,8",
        "near scene: view (0.000, 0.000, 2.000), light (0.500, 0.500, 1.000)",
        "convention printed, epsilon 0.01",
        "+1.0",
        "0.00%",
    ];
    assert_has(&text, &parts);
    let linear = succeed(at, "photo photo.png gt.png --scene one.json --transfer linear --falloff");
    assert_has(&linear, &["linear as specified", "falloff of the light divided out"]);
    let mut white = image::open(at.join("photo.png")).unwrap().into_rgb8();
    white.put_pixel(2, 3, image::Rgb([90, 255, 90]));
    white.save(at.join("white.png")).unwrap();
    let rows = rows_of(at, "photo white.png gt.png a.png --flash --fov 45");
    let cells = ["texels", "clipped", "transfer", "photograph"].map(|title| rows[1][title].as_str());
    assert_eq!((rows.len(), cells), (2, ["64", "1", "srgb", "white.png"]));
}

#[test]
fn differences_are_written_as_numbers_and_colours() {
    let folder = photographed();
    let at = folder.path();
    let printed = photo(at, "photo.exr a.png --scene one.json -o log.exr");
    let values = image_of_exr(&at.join("log.exr")).pixels.concat();
    let mean = values.iter().map(|value| f64::from(*value)).sum::<f64>() / values.len() as f64;
    let expected = printed["results"][0]["photographs"][0]["log"]["mean"].as_f64().unwrap();
    assert!((mean / expected - 1.0).abs() < 1e-6 && expected > 0.0, "{mean}, {expected}");
    succeed(at, "photo photo.exr a.png b.png --scene one.json -o relative.png --difference relative");
    let picture = image::open(at.join("relative.png")).unwrap();
    assert_eq!((picture.width(), picture.height()), (8 + 4 + 8, 8));
    assert_holds(at, "relative.png", &["relative difference from the photograph g", "svbrdf:factors"]);
}

#[test]
fn what_cannot_be_done_is_refused_with_what_to_do() {
    let folder = photographed();
    let at = folder.path();
    let one = super::json(&text_of(at, "one.json"))["scenes"][0].take();
    std::fs::write(at.join("two.json"), json!({"scenes": [one, one]}).to_string()).unwrap();
    let refused = [
        ("photo photo.png gt.png", 64, "give --scene FILE, or --flash with --fov DEGREES"),
        ("photo photo.png gt.png --flash --fov 180", 64, "0.1 to 179 degrees"),
        (
            "photo photo.png gt.png --scene two.json",
            1,
            "a photograph has one of its 2 scenes: give its number, 0 to 1",
        ),
        ("photo photo.png gt.png --scene one.json --corners 0,0 9,0 8,8 0,8", 1, "photograph, found 9,0"),
        ("photo photo.png gt.png --scene one.json --corners 0,0 8,0 8,8", 64, "--corners"),
        ("photo photo.png gt.png --flash --fov 9 -o x.png --difference angle", 64, "absolute, relative"),
        ("photo photo.png gt.png --scene one.json -o out.txt", 64, "extension"),
        ("photo photo.png gt.png big.png --scene one.json -o out.png", 1, "sizes differ"),
        ("photo text.png gt.png --scene one.json", 1, "photograph: expected PNG"),
    ];
    assert_refused(at, &refused);
    // Materials of several sizes are compared where nothing is written side by side.
    assert_eq!(names(&photo(at, "photo.png gt.png big.png --scene two.json --scene-number 1")).len(), 2);
}

/// A capture in `cap` of `gt.png`, in six scenes: pictures of 8 bits, of which `4.png` is a stop darker.
fn captured() -> TempDir {
    let folder = folder();
    let at = folder.path();
    std::fs::create_dir(at.join("cap")).unwrap();
    let mut listed = Vec::new();
    for (k, light) in
        ["-0.5,0.5,1", "0,0.5,1.2", "0.5,0.5,1", "-0.5,0,1.5", "0,0,1", "0.5,-0.5,1.1"].iter().enumerate()
    {
        let exposure = if k == 4 { -2 } else { -1 };
        let args = format!("render gt.png -o cap/{k}.png --view 0,0,2 --light {light} --exposure {exposure}");
        succeed(at, &args);
        listed.push(format!(
            r#"{{"file": "{k}.png", "scene": {{"kind": "near", "view": [0, 0, 2], "light": [{light}]}}}}"#
        ));
    }
    let text = format!(r#"{{"photographs": [{}]}}"#, listed.join(", "));
    std::fs::write(at.join("cap/capture.json"), text).unwrap();
    folder
}

#[test]
fn a_capture_has_one_exposure_and_names_the_photograph_that_is_off() {
    let folder = captured();
    let at = folder.path();
    let found = photo(at, "--capture cap b.png gt.png a.png");
    assert_eq!((names(&found), &found["exposure"]), (vec!["gt", "a", "b"], &"capture".into()));
    let right = &found["results"][0];
    assert!((right["exposure_ev"].as_f64().unwrap() - 1.0).abs() < 0.02, "{right}");
    let marks = right["photographs"].as_array().unwrap().iter().map(|one| one["outlier"]["exposure"] == true);
    assert_eq!(marks.collect::<Vec<_>>(), [false, false, false, false, true, false]);
    // The JSON is a scene file.
    std::fs::write(at.join("scenes.json"), found.to_string()).unwrap();
    succeed(at, "loss gt.png a.png --scenes scenes.json");
    let text = succeed(at, "photo --capture cap/capture.json gt.png a.png --hold-out 4,5.png");
    let parts = [
        "differences from the 6 photographs of cap/capture.json, sRGB since it stores integers",
        "one exposure for all photographs, not fitted to the held-out photographs: 4.png, 5.png",
        "4.png is an outlier for 2 of 2 materials (numbers of gt): the exposure that fits it alone is +1.0",
        "2 held out",
        "outlier, held out",
    ];
    assert_has(&text, &parts);
    let rows = rows_of(at, "photo --capture cap gt.png a.png --exposure photograph");
    let cells = |row: usize, titles: [&str; 3]| titles.map(|title| rows[row][title].clone());
    assert_eq!(
        (rows.len(), &rows[0]["photographs"], &rows[0]["factor"]),
        (2 * 7, &"all".into(), &String::new())
    );
    assert_eq!(cells(5, ["photograph", "outlier", "exposure"]), ["4.png", "true", "photograph"]);
    let [ev, own, _] = cells(5, ["exposure_ev", "own_exposure_ev", "photograph"]);
    assert!(ev == own && (ev.parse::<f64>().unwrap() - 2.0).abs() < 0.02, "{ev}, {own}");
}

#[test]
fn one_material_of_a_capture_is_read_with_every_option() {
    let folder = captured();
    let at = folder.path();
    let two = photo(at, "--capture cap gt.png a.png --read gt:albedo=srgb");
    let read = photo(at, "--capture cap gt.png --read albedo=srgb");
    assert_eq!(
        read["results"][0],
        two["results"].as_array().unwrap().iter().find(|r| r["material"] == "gt").unwrap().clone()
    );
    assert_ne!(read["results"], photo(at, "--capture cap gt.png")["results"]);
    let sure = "--read order=ndrs,albedo=linear,specular-albedo=linear,roughness=r,normal-y=up --strict";
    for option in ["--albedo srgb", "--preset gao", "--resize-to 8", sure] {
        succeed(at, &format!("photo --capture cap gt.png {option}"));
    }
    assert_refused(at, &[("photo --capture cap gt.png --strict", 1, "gt.png is ambiguous")]);
}

#[test]
fn a_capture_that_cannot_be_used_is_refused_with_what_to_do() {
    let folder = captured();
    let at = folder.path();
    let capture = text_of(at, "cap/capture.json");
    std::fs::create_dir(at.join("above")).unwrap();
    let above = capture.replace("\"file\": \"", "\"file\": \"../cap/");
    std::fs::write(at.join("above/capture.json"), above).unwrap();
    let refused = [
        ("photo --capture cap", 64, "required"),
        ("photo --capture nowhere gt.png", 1, "cannot read nowhere"),
        ("photo --capture cap gt.png --hold-out 9.png", 64, "unknown photograph `9.png`; use one"),
        ("photo photo.png gt.png --flash --fov 45 --hold-out 1", 64, "--capture"),
    ];
    assert_refused(at, &refused);
    // A photograph outside of the folder is named.
    let output = run_in(at, "photo --capture above gt.png");
    assert!(output.status.success());
    assert_has(text(&output.stderr), &["0.png lies outside of the folder of above/capture.json"]);
}
