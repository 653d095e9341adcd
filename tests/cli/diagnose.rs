//! `svbrdf diagnose`: planted errors of files, and the options that correct them.

use std::path::Path;

use serde_json::Value;

use super::{folder, succeed, write_tiles};

const SIDE: u32 = 32;
const READ: &str = "--preset deschaintre --order ndrs";

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

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

#[test]
fn a_planted_reading_is_found_and_its_option_corrects_it() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    write(&of("truth.png"), |_, texel| texel);
    write(&of("directx.png"), |tile, [r, g, b]| if tile == 0 { [r, 255 - g, b] } else { [r, g, b] });
    write(&of("gloss.png"), |tile, texel| if tile == 2 { texel.map(|v| 255 - v) } else { texel });
    for (name, hypothesis, value, option) in [
        ("directx", "normal_y", "flipped", "--pred-normal-y down"),
        ("gloss", "roughness", "gloss", "--pred-roughness gloss"),
    ] {
        let printed =
            json(&succeed(folder.path(), &format!("diagnose truth.png {name}.png {READ} --format json")));
        let prediction = &printed["predictions"][0];
        let findings = prediction["findings"].as_array().unwrap();
        let marked: Vec<&Value> = findings.iter().filter(|finding| finding["marked"] == true).collect();
        assert!(marked.len() == 1, "{printed}");
        let found = ["hypothesis", "value", "remedy"].map(|key| marked[0][key].as_str().unwrap());
        assert_eq!(found, [hypothesis, value, option]);
        // 128 + 64 scrambled Sobol scenes of the same seed on all texels.
        let scenes = "--near 128 --distant 64 --sampler sobol --format json";
        let loss = |options: &str| {
            let printed =
                succeed(folder.path(), &format!("loss truth.png {name}.png {READ} {options} {scenes}"));
            json(&printed)["results"][0]["loss"].as_f64().unwrap()
        };
        let expected = [loss(""), loss(option)];
        let found = [&prediction["loss"]["mean"], &marked[0]["loss"]].map(|value| value.as_f64().unwrap());
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-3 * loss(""), "{found} {expected}");
        }
        assert!(prediction["sentence"].as_str().unwrap().contains("would lower the loss by"), "{prediction}");
    }
}

#[test]
fn every_format_has_every_line_and_rounding_is_below_the_floor() {
    let folder = folder();
    write(&folder.path().join("truth.png"), |_, texel| texel);
    // An eighth of the values is one step away.
    write(&folder.path().join("near.png"), |_, [r, g, b]| [r, g + u8::from(r % 8 == 0), b]);
    let text = succeed(folder.path(), &format!("diagnose truth.png near.png {READ}"));
    for part in ["floor of the ground truth", "exposure_rgb", "resampling", "32 x 32", "seams of"] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(text.contains("The loss is not resolvable with this ground truth"), "{text}");
    let csv = succeed(folder.path(), &format!("diagnose truth.png near.png {READ} --format csv"));
    assert_eq!(csv.lines().count(), 14);
    assert!(csv.starts_with("prediction,hypothesis,value,unit,loss,"), "{csv}");
    let printed = json(&succeed(folder.path(), &format!("diagnose truth.png near.png {READ} --format json")));
    let resolvable = |prediction: &Value| prediction["resolvable"].as_bool().unwrap();
    assert!(!resolvable(&printed["predictions"][0]), "{printed}");
    let floor = printed["floor"]["mean"].as_f64().unwrap();
    let ranking = json(&succeed(folder.path(), &format!("rank truth.png near.png {READ} --format json")));
    assert_eq!(ranking["floor"], floor);
    assert!(succeed(folder.path(), &format!("rank truth.png near.png {READ}")).contains("not resolvable"));
    let wrong = json(&succeed(folder.path(), "diagnose gt.png b.png --format json"));
    assert!(resolvable(&wrong["predictions"][0]), "{wrong}");
}
