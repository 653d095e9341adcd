//! The materials of the command line: how they are read, named and brought to one size.

use image::{Rgb, RgbImage};
use serde_json::json;

use super::{assert_has, assert_refused, fail, folder, json_of, loss_of, losses_as_json, rows_of, succeed};

#[test]
fn info_says_what_was_assumed_and_strict_refuses_guesses() {
    let folder = folder();
    let text = succeed(folder.path(), "info gt.png");
    let parts = ["gt, 8 x 8 texels", "As stored:", "tile 1", "Assumed:", "layout: ndrs", "albedo: linear"];
    assert_has(&text, &parts);
    let json = json_of(folder.path(), "info gt.png");
    assert_eq!(json["maps"].as_array().unwrap().len(), 4);
    assert_eq!(json["assumptions"][0]["what"], "layout");
    let given =
        succeed(folder.path(), "info gt.png --read albedo=srgb --read order=ndrs --read normal-y=down");
    assert_has(&given, &["albedo: srgb: as specified", "normal y: down: as specified"]);

    RgbImage::from_pixel(32, 8, Rgb([90, 90, 90])).save(folder.path().join("flat.png")).unwrap();
    let unsure = "layout: ndrs in 4 x 1 tiles of 8 x 8 (normal, diffuse, roughness, specular) (unsure)";
    assert_has(&succeed(folder.path(), "info flat.png"), &[unsure]);
    assert_refused(
        folder.path(),
        &[(
            "info flat.png --strict",
            1,
            "flat.png is ambiguous; specify what follows, or leave out --strict\nsvbrdf:   layout: ",
        )],
    );
}

#[test]
fn convert_writes_what_loss_finds_to_be_the_same() {
    let folder = folder();
    for out in ["gt.exr", "gt16.png", "gt_folder", "gt.glb", "gt.mtlx"] {
        let depth = if out == "gt.exr" { "float" } else { "16" };
        assert_eq!(succeed(folder.path(), &format!("convert gt.png {out} --depth {depth}")), "");
        let loss = loss_of(folder.path(), &format!("gt.png {out}"));
        assert!(loss < 1e-3, "{out}: {loss}");
    }
    let refused = [
        ("convert gt.png x.png --depth half", 64, "every other form 8 and 16"),
        ("convert gt.png gt_folder", 1, "not there yet"),
        ("convert gt.png gt.mtlx", 1, "gt_textures"),
    ];
    assert_refused(folder.path(), &refused);
}

#[test]
fn a_folder_exists_ends_with_a_slash_or_has_no_extension() {
    let folder = folder();
    for out in ["out.obj", "out.usd", "out.zip", "out.jpg", "out.gltf", "brick_v1.2"] {
        let error = fail(folder.path(), &format!("convert gt.png {out}"), 64);
        assert_has(&error, &[".exr, .png, .glb or .mtlx", "ends with /"]);
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
    assert_refused(folder.path(), &[("loss gt.png big.png", 1, "--resize-to gt, pred or a width")]);
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
    assert_has(&table, &["\nrunA  ", "\nrunB  ", "\nrunB - runA, "]);
    let json = losses_as_json(folder.path(), "runA/out runB/out a.png");
    assert_eq!((&json["ground_truth"], &json["ground_truth_path"]), (&json!("runA"), &json!("runA/out")));
    let names = [0, 1].map(|k| &json["results"][k]).map(|one| [&one["prediction"], &one["path"]]);
    assert_eq!(json!(names), json!([["runB", "runB/out"], ["a", "a.png"]]));
    let rows = rows_of(folder.path(), "loss gt.png runA/out runB/out --near 6");
    assert_eq!([&rows[1]["prediction"], &rows[1]["path"]], ["runB", "runB/out"]);
}
