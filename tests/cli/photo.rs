//! `svbrdf photo`.

use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use super::{fail, folder, succeed};

/// Materials, and photographs of `gt.png` in the scene of `one.json`: floats, and 8 bits of half the exposure.
fn photographed() -> TempDir {
    let folder = folder();
    let scene = "--view 0,0,2 --light 0.5,0.5,1";
    succeed(folder.path(), &format!("render gt.png -o photo.exr {scene}"));
    succeed(folder.path(), &format!("render gt.png -o photo.png --exposure -1 {scene}"));
    folder
}

fn json(folder: &Path, args: &str) -> Value {
    serde_json::from_str(&succeed(folder, &format!("photo {args} --format json"))).unwrap()
}

#[test]
fn the_right_material_comes_first_with_the_factor_of_the_exposure() {
    let folder = photographed();
    let at = folder.path();
    let floats = json(at, "photo.exr b.png a.png gt.png --scene one.json");
    let names: Vec<_> = floats["results"].as_array().unwrap().iter().map(|r| r["material"].clone()).collect();
    assert_eq!(names, ["gt", "a", "b"]);
    let [right, wrong] = [0, 1].map(|k| &floats["results"][k]["photographs"][0]);
    assert_eq!((&floats["photographs"][0]["transfer"], &right["factor"]), (&"linear".into(), &1.0.into()));
    for kind in ["log", "absolute", "relative"] {
        assert_eq!(right[kind]["p95"], 0.0, "{kind}");
        assert!(wrong[kind]["mean"].as_f64().unwrap() > 0.0, "{kind}");
    }
    assert_eq!((&right["rmse"], &floats["capture"]), (&0.0.into(), &Value::Null));
    let bytes = json(at, "photo.png gt.png b.png --scene one.json");
    let clipped = &bytes["results"][0]["photographs"][0]["clipped"];
    assert_eq!((&bytes["photographs"][0]["transfer"], clipped), (&"srgb".into(), &0.into()));
    let ev = bytes["results"][0]["exposure_ev"].as_f64().unwrap();
    assert!((ev - 1.0).abs() < 0.02, "{ev}");
    assert_eq!(bytes["results"][0]["material"], "gt");
    // The JSON is a scene file.
    std::fs::write(at.join("again.json"), bytes.to_string()).unwrap();
    assert_eq!(json(at, "photo.png gt.png b.png --scene again.json"), bytes);
}

#[test]
fn every_format_says_how_the_photograph_was_read_and_exposed() {
    let folder = photographed();
    let at = folder.path();
    let text = succeed(at, "photo photo.png gt.png a.png --scene one.json --corners 0,0 8,0 8,8 0,8");
    for words in [
        "photo.png, 8 x 8 pixels, sRGB since it stores integers, corners 0,0 8,0 8,8 0,8",
        "near scene: view (0.000, 0.000, 2.000), light (0.500, 0.500, 1.000)",
        "convention printed, epsilon 0.01",
        "factor",
        "+1.0",
        "0.00%",
    ] {
        assert!(text.contains(words), "{words} is missing in\n{text}");
    }
    let linear = succeed(at, "photo photo.png gt.png --scene one.json --transfer linear --falloff");
    assert!(linear.contains("linear as specified") && linear.contains("falloff of the light divided out"));
    let mut white = image::open(at.join("photo.png")).unwrap().into_rgb8();
    white.put_pixel(2, 3, image::Rgb([90, 255, 90]));
    white.save(at.join("white.png")).unwrap();
    let csv = succeed(at, "photo white.png gt.png a.png --flash --fov 45 --format csv");
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let heading = reader.headers().unwrap().clone();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let cell = |row: usize, name: &str| &rows[row][heading.iter().position(|head| head == name).unwrap()];
    assert_eq!((rows.len(), cell(0, "texels"), cell(1, "clipped")), (2, "64", "1"));
    assert_eq!((cell(1, "transfer"), cell(0, "photograph")), ("srgb", "white.png"));
}

#[test]
fn differences_are_written_as_numbers_and_colours() {
    let folder = photographed();
    let at = folder.path();
    let printed = json(at, "photo.exr a.png --scene one.json -o log.exr");
    let read = exr::prelude::read_first_rgba_layer_from_file(
        at.join("log.exr"),
        |_, _| Vec::new(),
        |values: &mut Vec<f32>, _, (r, g, b, _): (f32, f32, f32, f32)| values.extend([r, g, b]),
    );
    let values = read.unwrap().layer_data.channel_data.pixels;
    let mean = values.iter().map(|value| f64::from(*value)).sum::<f64>() / values.len() as f64;
    let expected = printed["results"][0]["photographs"][0]["log"]["mean"].as_f64().unwrap();
    assert!((mean / expected - 1.0).abs() < 1e-6 && expected > 0.0, "{mean}, {expected}");
    succeed(at, "photo photo.exr a.png b.png --scene one.json -o relative.png --difference relative");
    let picture = image::open(at.join("relative.png")).unwrap();
    assert_eq!((picture.width(), picture.height()), (8 + 4 + 8, 8));
    let bytes = std::fs::read(at.join("relative.png")).unwrap();
    let says = |text: &[u8]| bytes.windows(text.len()).any(|window| window == text);
    assert!(says(b"relative difference from the photograph g") && says(b"svbrdf:factors"));
}

#[test]
fn what_cannot_be_done_is_refused_with_what_to_do() {
    let folder = photographed();
    let at = folder.path();
    let two = std::fs::read_to_string(at.join("one.json")).unwrap();
    let scene = &two[two.find('[').unwrap() + 1..two.rfind(']').unwrap()];
    std::fs::write(at.join("two.json"), format!(r#"{{"scenes": [{scene}, {scene}]}}"#)).unwrap();
    for (args, code, words) in [
        ("photo.png gt.png", 64, "give --scene FILE, or --flash with --fov DEGREES"),
        ("photo.png gt.png --flash", 64, "--fov"),
        ("photo.png gt.png --flash --fov 180", 64, "0.1 to 179 degrees"),
        (
            "photo.png gt.png --scene two.json",
            1,
            "lists 2 scenes, of which a photograph has one; give its number from 0 to 1",
        ),
        ("photo.png gt.png --scene two.json --scene-number 2", 1, "found number 2"),
        ("photo.png gt.png --scene below.json", 1, "above the plane"),
        (
            "photo.png gt.png --scene one.json --corners 0,0 9,0 8,8 0,8",
            1,
            "within the 8 x 8 pixels of the photograph, found 9,0",
        ),
        ("photo.png gt.png --scene one.json --corners 0,0 0,8 8,8 8,0", 1, "clockwise"),
        ("photo.png gt.png --scene one.json --corners 0,0 8,0 8,8", 64, "--corners"),
        ("photo.png gt.png --scene one.json --transfer gamma", 64, "linear, srgb"),
        ("photo.png gt.png --scene one.json -o x.png --difference angle", 64, "log, absolute, relative"),
        ("photo.png gt.png --scene one.json --clip 0.0001", 1, "every texel is clipped"),
        ("photo.png gt.png --scene one.json -o out.txt", 64, "extension"),
        ("photo.png gt.png big.png --scene one.json -o out.png", 1, "sizes differ"),
        ("text.png gt.png --scene one.json", 1, "photograph: expected PNG"),
    ] {
        let stderr = fail(at, &format!("photo {args}"), code);
        assert!(stderr.contains(words), "{args}: {stderr}");
    }
    // Materials of several sizes are compared where nothing is written side by side.
    let sizes = json(at, "photo.png gt.png big.png --scene two.json --scene-number 1");
    assert_eq!(sizes["results"].as_array().unwrap().len(), 2);
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
    let found = json(at, "--capture cap b.png gt.png a.png");
    let names: Vec<_> = found["results"].as_array().unwrap().iter().map(|r| r["material"].clone()).collect();
    assert_eq!(names, ["gt", "a", "b"]);
    let right = &found["results"][0];
    let ev = right["exposure_ev"].as_f64().unwrap();
    assert!((ev - 1.0).abs() < 0.02, "{ev}");
    let marks = right["photographs"].as_array().unwrap().iter().map(|one| one["outlier"]["exposure"] == true);
    assert_eq!(marks.collect::<Vec<_>>(), [false, false, false, false, true, false]);
    assert_eq!(found["exposure"], "capture");
    // The JSON is a scene file.
    std::fs::write(at.join("scenes.json"), found.to_string()).unwrap();
    succeed(at, "loss gt.png a.png --scenes scenes.json");

    let text = succeed(at, "photo --capture cap/capture.json gt.png a.png --hold-out 4,5.png");
    for words in [
        "differences from the 6 photographs of cap/capture.json, sRGB since it stores integers",
        "one exposure for all photographs, not fitted to the held-out photographs: 4.png, 5.png",
        "4.png is an outlier for 2 of 2 materials (numbers of gt): the exposure that fits it alone is +1.0",
        "2 held out",
        "outlier, held out",
    ] {
        assert!(text.contains(words), "{words} is missing in\n{text}");
    }
    let csv = succeed(at, "photo --capture cap gt.png a.png --exposure photograph --format csv");
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let heading = reader.headers().unwrap().clone();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let cell = |row: usize, name: &str| &rows[row][heading.iter().position(|head| head == name).unwrap()];
    assert_eq!((rows.len(), cell(0, "photographs"), cell(0, "factor")), (2 * 7, "all", ""));
    assert_eq!(
        (cell(5, "photograph"), cell(5, "outlier"), cell(5, "exposure")),
        ("4.png", "true", "photograph")
    );
    let [ev, own] = ["exposure_ev", "own_exposure_ev"].map(|name| cell(5, name).parse::<f64>().unwrap());
    assert!(ev == own && (ev - 2.0).abs() < 0.02, "{ev}, {own}");
}

#[test]
fn one_material_of_a_capture_is_read_with_every_option() {
    let folder = captured();
    let at = folder.path();
    let two = json(at, "--capture cap gt.png a.png --read gt:albedo=srgb");
    let read = json(at, "--capture cap gt.png --read albedo=srgb");
    assert_eq!(
        read["results"][0],
        two["results"].as_array().unwrap().iter().find(|r| r["material"] == "gt").unwrap().clone()
    );
    assert_ne!(read["results"], json(at, "--capture cap gt.png")["results"]);
    let sure = "--read order=ndrs,albedo=linear,specular-albedo=linear,roughness=r,normal-y=up --strict";
    for option in ["--albedo srgb", "--preset gao", "--resize-to 8", sure] {
        succeed(at, &format!("photo --capture cap gt.png {option}"));
    }
    assert!(fail(at, "photo --capture cap gt.png --strict", 1).contains("gt.png is ambiguous"));
}

#[test]
fn a_capture_that_cannot_be_used_is_refused_with_what_to_do() {
    let folder = captured();
    let at = folder.path();
    let text = std::fs::read_to_string(at.join("cap/capture.json")).unwrap();
    let write = |name: &str, from: &str, to: &str| {
        std::fs::create_dir(at.join(name)).unwrap();
        std::fs::write(at.join(name).join("capture.json"), text.replace(from, to)).unwrap();
    };
    write("absent", "", "");
    write("above", "\"file\": \"", "\"file\": \"../cap/");
    for (args, code, words) in [
        ("--capture cap", 64, "required"),
        ("--capture nowhere gt.png", 1, "cannot read nowhere"),
        ("--capture absent gt.png", 1, "0.png"),
        ("--capture one.json gt.png", 1, "unknown field `scenes`"),
        ("--capture cap gt.png --hold-out 9.png", 64, "unknown photograph `9.png`; use one of: 0.png, 1.png"),
        ("--capture cap gt.png --exposure none", 64, "capture, photograph"),
        ("--capture cap gt.png --scene one.json", 64, "cannot be used with"),
        ("--capture cap gt.png -o x.png", 64, "cannot be used with"),
        ("photo.png gt.png --flash --fov 45 --hold-out 1", 64, "--capture"),
    ] {
        let stderr = fail(at, &format!("photo {args}"), code);
        assert!(stderr.contains(words), "{args}: {stderr}");
    }
    // A photograph outside of the folder is named.
    let output = super::run_in(at, "photo --capture above gt.png");
    assert!(output.status.success());
    let stderr = super::text(&output.stderr);
    assert!(stderr.contains("0.png lies outside of the folder of above/capture.json"), "{stderr}");
}
