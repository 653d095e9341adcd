//! `svbrdf diagnose`: planted errors of files, and the options that correct them.

use super::*;

const SIDE: u32 = 32;
const READ: &str = "--preset deschaintre --read order=ndrs";

/// Writes a packed material with bumps; `change` sees each stored texel of a map (0 normals, 1 diffuse, 2 roughness, 3 specular).
fn write(path: &Path, change: impl Fn(u32, [u8; 3]) -> [u8; 3]) {
    let wave = |x: u32, y: u32, by: f32| {
        (0.5 + 0.5 * (0.9 * x as f32 + by).sin() * (0.7 * y as f32 + 2.0 * by).cos()) * 255.0
    };
    write_tiles(path, SIDE, |x, y| {
        let (tile, x) = (x / SIDE, x % SIDE);
        let texel = match tile {
            0 => [90.0 + 0.3 * wave(x, y, 0.0), 80.0 + 0.35 * wave(x, y, 1.0), 235.0].map(|v| v as u8),
            1 => [60.0 + 0.5 * wave(x, y, 0.3), 50.0 + 0.3 * wave(x, y, 0.3), 30.0].map(|v| v as u8),
            2 => [(60.0 + 0.2 * wave(x, y, 2.0)) as u8; 3],
            _ => [12; 3],
        };
        change(tile, texel)
    });
}

/// Writes a ground truth, copies with a planted error each, and another capture.
pub fn write_planted(folder: &Path) {
    let encoded = |v: u8| (255.0 * (f32::from(v) / 255.0).powf(1.0 / 2.2)).round() as u8;
    let at = |name: &str| folder.join(name);
    write(&at("truth.png"), |_, texel| texel);
    write(&at("directx.png"), |tile, [r, g, b]| if tile == 0 { [r, 255 - g, b] } else { [r, g, b] });
    write(&at("gloss.png"), |tile, texel| if tile == 2 { texel.map(|v| 255 - v) } else { texel });
    write(&at("encoded.png"), |tile, texel| if tile % 2 == 1 { texel.map(encoded) } else { texel });
    write(&at("swapped.png"), |tile, [r, g, b]| if tile == 1 { [b, g, r] } else { [r, g, b] });
    // Rounding: an eighth of the values is one step away.
    write(&at("rounded.png"), |_, [r, g, b]| [r, g + u8::from(r % 8 == 0), b]);
}

/// The advice replaces the options of this material: with `albedo` alone specular would be read as its specified option says, or not.
#[test]
fn planted_readings_are_found_and_their_options_give_the_losses_that_were_computed() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    write_planted(at);
    let command = format!(
        "diagnose truth.png directx.png gloss.png encoded.png {READ} --read encoded:specular-albedo=linear"
    );
    let printed = json_of(at, &command);
    let findings = |prediction: usize| printed["predictions"][prediction]["findings"].as_array().unwrap();
    // 2,048 + 1,024 scrambled Sobol scenes of the same seed, of maps as small as these on all texels.
    let loss = |name: &str, options: &str| {
        let scenes = "--near 2048 --distant 1024 --sampler sobol";
        loss_of(at, &format!("truth.png {name}.png {READ} {options} {scenes}"))
    };
    for (prediction, name, hypothesis, marked, option) in [
        (0, "directx", "normal_y", "flipped", "directx:normal-y=down"),
        (1, "gloss", "roughness", "gloss", "gloss:roughness=gloss"),
        (2, "encoded", "albedo_encoding", "", ""),
        (2, "encoded", "diffuse_encoding", "", ""),
        (2, "encoded", "specular_encoding", "", ""),
    ] {
        let found = findings(prediction).iter().find(|finding| finding["hypothesis"] == hypothesis).unwrap();
        let remedy = found["remedy"].as_str().unwrap();
        let (got, expected) = (found["loss"].as_f64().unwrap(), loss(name, &format!("--read {remedy}")));
        assert!((got - expected).abs() < 1e-4 * expected + 1e-6, "{name} {remedy}: {got} {expected}");
        if !marked.is_empty() {
            let of_all = &printed["predictions"][prediction];
            let (got, expected) = (of_all["loss"]["mean"].as_f64().unwrap(), loss(name, ""));
            assert!((got - expected).abs() < 1e-4 * expected, "{name}: {got} {expected}");
            assert_eq!(
                (&found["value"], remedy, &of_all["resolvable"]),
                (&marked.into(), option, &true.into())
            );
            let marked = findings(prediction).iter().filter(|finding| finding["marked"] == true);
            assert_eq!(marked.count(), 1, "{prediction}");
        }
    }
    // A spreadsheet takes no text of the program as a formula: only names may begin with a guard.
    let in_csv = rows_of(at, &command).into_iter().map(|row| row["remedy"].clone());
    let in_json = (0..3).flat_map(findings).map(|finding| finding["remedy"].as_str().unwrap_or_default());
    assert!(in_csv.eq(in_json));
}

#[test]
fn a_ranking_names_the_losses_and_differences_below_the_floor() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    write_planted(at);
    // Both far from the truth, and near each other; and one that is far from all.
    for (name, step) in [("rough.png", 0), ("same.png", 1)] {
        write(&at.join(name), |tile, texel| if tile == 2 { texel.map(|v| v + 60 + step) } else { texel });
    }
    write(&at.join("black.png"), |tile, texel| if tile == 1 { [0; 3] } else { texel });
    for (predictions, expected) in [
        ("rounded.png rough.png", [["false", ""], ["true", "true"]]),
        ("rough.png same.png", [["true", ""], ["true", "false"]]),
        ("rough.png black.png", [["true", ""], ["true", "true"]]),
    ] {
        let rank = format!("rank truth.png {predictions} {READ} --near 128 --distant 64");
        let csv = rows_of(at, &rank);
        let json = json_of(at, &rank)["ranking"].take();
        for (place, expected) in expected.iter().enumerate() {
            for (key, expected) in ["resolvable", "to_best_resolvable"].into_iter().zip(expected) {
                assert_eq!(csv[place][key], *expected, "{predictions}");
                assert_eq!(json[place][key].as_bool(), expected.parse().ok(), "{predictions}");
            }
        }
    }
    let [diagnosed, ranked] =
        ["diagnose", "rank"].map(|command| json_of(at, &format!("{command} truth.png gloss.png {READ}")));
    assert_eq!(diagnosed["floor"]["mean"], ranked["floor"]);
}
