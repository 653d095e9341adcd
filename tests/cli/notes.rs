//! Notes on materials on stderr.

use image::{Rgb, RgbImage};

use super::{folder, run_in, succeed, text};

/// The notes of a run that must succeed.
fn notes(folder: &std::path::Path, args: &str) -> Vec<String> {
    let output = run_in(folder, args);
    assert!(output.status.success(), "{args}: {}", text(&output.stderr));
    text(&output.stderr).lines().map(|line| line.strip_prefix("svbrdf: note: ").unwrap().to_owned()).collect()
}

#[test]
fn what_is_sure_is_only_said_when_asked_for() {
    let folder = folder();
    for command in ["loss gt.png a.png", "convert gt.png gt.exr", "render a.png -o a.exr"] {
        assert_eq!(notes(folder.path(), command), [""; 0], "{command}");
    }
    let all = notes(folder.path(), "loss gt.png a.png --verbose");
    for name in ["gt", "a"] {
        let note = format!("{name}: albedo: linear: Deschaintre et al. store this order in this way");
        assert!(all.contains(&note), "{all:?}");
    }
    assert_eq!(notes(folder.path(), "loss gt.png a.png -v"), all);
}

#[test]
fn what_a_form_for_other_programs_loses_is_said() {
    let folder = folder();
    let at = folder.path();
    let glb = notes(at, "convert gt.png x.glb");
    let start = "x.glb: written as base colour (diffuse) and KHR_materials_specular, which change diffuse by";
    let end = "; programs without this extension show specular 0.04";
    assert!(glb.len() == 1 && glb[0].starts_with(start) && glb[0].ends_with(end), "{glb:?}");
    assert!(glb[0].contains("; base colour and metallic would change diffuse by at most "), "{glb:?}");
    let mtlx = notes(at, "convert gt.png x.mtlx");
    assert!(mtlx.len() == 1 && mtlx[0].contains("weight, colour and index of refraction"), "{mtlx:?}");
    // A material of base colour and metallic.
    std::fs::create_dir(at.join("metal")).unwrap();
    for (map, rgb) in [("basecolor", [180, 90, 60]), ("normal", [128, 128, 255]), ("roughness", [99; 3])] {
        RgbImage::from_pixel(8, 8, Rgb(rgb)).save(at.join("metal").join(format!("{map}.png"))).unwrap();
    }
    RgbImage::from_fn(8, 8, |x, _| Rgb([if x < 4 { 255 } else { 0 }; 3]))
        .save(at.join("metal/metallic.png"))
        .unwrap();
    for out in ["y.glb", "y.mtlx", "y --like gltf"] {
        let said = notes(at, &format!("convert metal {out} --read normal-y=up"));
        let kept = "written as base colour and metallic, which change diffuse by at most 0.0000 (mean 0.0000), specular by \
                    at most 0.0000 (mean 0.0000)";
        assert!(said.len() == 1 && said[0].ends_with(kept), "{said:?}");
    }
}

#[test]
fn what_is_unsure_or_changed_is_said_with_the_name_of_its_material() {
    let folder = folder();
    RgbImage::from_pixel(32, 8, Rgb([90, 90, 90])).save(folder.path().join("flat.png")).unwrap();
    let guessed = notes(folder.path(), "loss gt.png flat.png");
    assert!(guessed.iter().any(|note| note.starts_with("flat: layout: ndrs") && note.contains("(unsure)")));
    assert!(guessed.iter().all(|note| note.starts_with("flat: ")), "{guessed:?}");

    succeed(folder.path(), "convert gt.png set");
    std::fs::remove_file(folder.path().join("set/specular.png")).unwrap();
    succeed(folder.path(), "convert big.png other");
    std::fs::copy(folder.path().join("other/roughness.png"), folder.path().join("set/roughness.png"))
        .unwrap();
    let changed = notes(folder.path(), "loss big.png set");
    for said in ["set: missing: ", "set: size: "] {
        assert!(changed.iter().any(|note| note.starts_with(said)), "{said} is missing in {changed:?}");
    }
    assert!(!changed.iter().any(|note| note.contains("map is")), "{changed:?}");
    let resized = notes(folder.path(), "loss gt.png big.png --resize-to gt");
    assert_eq!(resized, ["big is resized from 16 x 16 to 8 x 8"]);
}
