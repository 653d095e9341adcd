//! The materials of the command line: how they are read, named and brought to one size.

use image::{Rgb, RgbImage};
use serde_json::{Value, json};

use super::{fail, folder, losses_as_json, succeed};

#[test]
fn options_of_reading_change_what_is_read() {
    let folder = folder();
    let loss = |args: &str| {
        losses_as_json(folder.path(), &format!("gt.png a.png {args}"))["results"][0]["loss"].clone()
    };
    let linear = loss("--read albedo=linear");
    let both = loss("--read albedo=gamma2.2");
    assert_eq!(both, loss("--read gt:albedo=gamma2.2 --read pred:albedo=gamma2.2"));
    assert_eq!(loss("--read albedo=srgb --read gt:albedo=linear --read pred:albedo=linear"), linear);
    assert_ne!(linear, both);
    assert_ne!(loss("--read gt:albedo=gamma2.2 --read pred:albedo=linear"), both);
    assert_ne!(loss("--read albedo=linear --read normal-y=down"), linear);
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
    let given =
        succeed(folder.path(), "info gt.png --read albedo=srgb --read order=ndrs --read normal-y=down");
    assert!(
        given.contains("albedo: srgb: as specified") && given.contains("normal y: down: as specified"),
        "{given}"
    );

    RgbImage::from_pixel(32, 8, Rgb([90, 90, 90])).save(folder.path().join("flat.png")).unwrap();
    assert!(
        succeed(folder.path(), "info flat.png")
            .contains("layout: ndrs in 4 x 1 tiles of 8 x 8 (normal, diffuse, roughness, specular) (unsure)")
    );
    assert!(fail(folder.path(), "info flat.png --strict", 1).contains("flat.png is ambiguous: layout"));
}

#[test]
fn convert_writes_what_loss_finds_to_be_the_same() {
    let folder = folder();
    for out in ["gt.exr", "gt16.png", "gt_folder", "gt.glb", "gt.mtlx"] {
        let depth = if out == "gt.exr" { "float" } else { "16" };
        assert_eq!(succeed(folder.path(), &format!("convert gt.png {out} --depth {depth}")), "");
        let json = losses_as_json(folder.path(), &format!("gt.png {out}"));
        let loss = json["results"][0]["loss"].as_f64().unwrap();
        assert!(loss < 1e-3, "{out}: {loss}");
    }
    assert!(
        fail(folder.path(), "convert gt.png x.png --depth half", 64).contains("every other form 8 and 16")
    );
    assert!(fail(folder.path(), "convert gt.png gt_folder", 1).contains("not there yet"));
    assert!(fail(folder.path(), "convert gt.png gt.mtlx", 1).contains("gt_textures"));
}

#[test]
fn a_folder_exists_ends_with_a_slash_or_has_no_extension() {
    let folder = folder();
    for out in ["out.obj", "out.usd", "out.zip", "out.jpg", "out.gltf", "brick_v1.2"] {
        let error = fail(folder.path(), &format!("convert gt.png {out}"), 64);
        assert!(
            error.contains(".exr, .png, .glb or .mtlx") && error.contains("ends with /"),
            "{out}: {error}"
        );
    }
    std::fs::create_dir(folder.path().join("there.zip")).unwrap();
    for out in ["brick_v1.2/", "there.zip", "out", "strip.png/"] {
        succeed(folder.path(), &format!("convert gt.png {out}"));
        assert_eq!(super::files(&folder.path().join(out)).len(), 4, "{out}");
    }
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

#[test]
fn a_size_that_does_not_fit_is_refused() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    // One texel wide and seven high each.
    RgbImage::from_fn(4, 7, |x, _| Rgb([[128, 128, 255], [200, 100, 50], [90; 3], [12; 3]][x as usize]))
        .save(of("slim.png"))
        .unwrap();
    for (materials, width, found) in
        [("slim.png slim.png", 16_384, "16384 x 114688"), ("gt.png a.png", 16_384, "10 GiB")]
    {
        let args = format!("loss {materials} --read order=ndrs --read grid=4x1 --resize-to {width}");
        let stderr = fail(folder.path(), &args, 1);
        assert!(stderr.contains(found) && stderr.contains("smaller width"), "{stderr}");
    }
    let json =
        losses_as_json(folder.path(), "slim.png slim.png --read order=ndrs --read grid=4x1 --resize-to 20");
    assert_eq!(json["size"], json!([20, 140]));
}

#[test]
fn materials_of_one_name_are_told_apart_by_their_paths() {
    let folder = folder();
    for run in ["runA", "runB"] {
        let out = folder.path().join(run).join("out");
        std::fs::create_dir_all(out.parent().unwrap()).unwrap();
        succeed(folder.path(), &format!("convert {}.png {run}/out", if run == "runA" { "a" } else { "b" }));
    }
    let table = succeed(folder.path(), "loss gt.png runA/out runB/out");
    for line in ["\nrunA/out  ", "\nrunB/out  ", "\nrunB/out - runA/out, "] {
        assert!(table.contains(line), "{line} is missing in {table}");
    }
    let json = losses_as_json(folder.path(), "runA/out runB/out a.png");
    assert_eq!((&json["ground_truth"], &json["ground_truth_path"]), (&json!("runA/out"), &json!("runA/out")));
    assert_eq!(json["results"][0]["prediction"], "runB/out");
    assert_eq!(
        (&json["results"][1]["prediction"], &json["results"][1]["path"]),
        (&json!("a"), &json!("a.png"))
    );
    let csv = succeed(folder.path(), "loss gt.png runA/out runB/out --near 6 --format csv");
    assert!(csv.lines().nth(2).unwrap().starts_with("runB/out,"), "{csv}");
    assert!(csv.lines().nth(2).unwrap().contains(",runB/out,gt,gt.png,pilot,"), "{csv}");
}
