//! Names from files: they forge no lines, hide nothing and turn no text round, wherever they are printed.

use std::fs;
use std::path::Path;

use serde_json::json;

use super::{folder, run_in, text, text_of};

/// Breaks lines, in three ways, turns text round, hides a letter, and steers a terminal; with its end where XML can hold it.
const FORGED: &str = "gold\nsvbrdf: error: forged\u{2028}x\u{2029}y\u{202e}z\u{e0041}";
const ESCAPED: &str = r"gold\u{a}svbrdf: error: forged\u{2028}x\u{2029}y\u{202e}z\u{e0041}";

/// A glTF and a MaterialX whose materials have this name.
fn write_documents(folder: &Path, name: &str) {
    let material = |roughness: f64| {
        let factors =
            json!({"baseColorFactor": [0.5, 0.4, 0.3, 1], "roughnessFactor": roughness, "metallicFactor": 0});
        json!({"name": format!("{name}{roughness}"), "pbrMetallicRoughness": factors})
    };
    for (name, roughness) in [("gt.gltf", 0.5), ("a.gltf", 0.3)] {
        let document =
            json!({"asset": {"version": "2.0"}, "materials": [material(roughness), material(0.9)]});
        fs::write(folder.join(name), document.to_string()).unwrap();
    }
    let name = FORGED.replace('\n', "&#10;");
    let document = format!(
        r#"<?xml version="1.0"?><materialx version="1.39">
        <standard_surface name="{name}" type="surfaceshader"><input name="base_color" type="color3" value="0.5, 0.4, 0.3"/>
        <input name="specular_roughness" type="float" value="0.4"/></standard_surface>
        <surfacematerial name="{name}_m" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="{name}"/></surfacematerial></materialx>"#
    );
    fs::write(folder.join("m.mtlx"), document).unwrap();
}

/// Runs a command, which prints the name on its lines, clean and with an end.
fn assert_clean(folder: &Path, args: &str) {
    let output = run_in(folder, args);
    let page = if args.contains("-o x.html") { text_of(folder, "x.html") } else { String::new() };
    let all = [text(&output.stdout), text(&output.stderr), &page].concat();
    assert!(output.status.success() && all.contains("gold"), "{args}: {all}");
    let printed = &all[..all.len() - page.len()];
    assert!(!printed.lines().any(|line| line.starts_with("svbrdf: error")), "{args}: {printed}");
    let hostile = ['\u{2028}', '\u{2029}', '\u{202e}', '\u{e0041}', '\u{1b}', '\u{7}'];
    assert!(!all.contains(hostile), "{args}: {all}");
    assert!(printed.len() < 100_000, "{args}: {} bytes", printed.len());
}

#[test]
fn a_name_from_a_file_is_one_line_of_what_is_printed() {
    let folder = folder();
    let at = folder.path();
    write_documents(at, FORGED);
    for args in [
        "info gt.gltf",
        "info m.mtlx",
        "loss gt.gltf a.gltf",
        "loss gt.gltf a.gltf --format json",
        "loss gt.gltf m.mtlx --format csv -v",
        "rank gt.gltf a.gltf m.mtlx --target-error 30%",
        "rank gt.gltf a.gltf m.mtlx --target-error 30% --format latex",
        "blame gt.gltf a.gltf",
        "scenes gt.gltf a.gltf",
        "worst gt.gltf a.gltf",
        "metrics gt.gltf a.gltf",
        "map gt.gltf a.gltf -o x.csv",
        "report gt.gltf a.gltf -o x.html --target-error 30%",
        "report gt.gltf a.gltf -o x.html --figure",
    ] {
        assert_clean(at, args);
    }
    assert!(text(&run_in(at, "info gt.gltf").stdout).starts_with(ESCAPED));
    // An error about one.
    let output = run_in(at, "loss gt.gltf gt.png");
    assert_eq!(text(&output.stderr).lines().filter(|line| line.starts_with("svbrdf: error")).count(), 1);
    for name in ["gold\u{1b}[31mred\u{7}", &format!("gold{}", "n".repeat(1 << 20))] {
        write_documents(at, name);
        for args in ["info gt.gltf", "render gt.gltf -o out.png --verbose", "loss gt.gltf a.gltf"] {
            assert_clean(at, args);
        }
    }
}

#[test]
fn a_name_in_a_list_is_one_line() {
    let folder = folder();
    let list = format!("ground_truth,prediction,method,material\ngt.png,a.png,\"{FORGED}\",\"{FORGED}\"\n");
    fs::write(folder.path().join("pairs.csv"), list).unwrap();
    for format in ["text", "csv", "json", "latex"] {
        assert_clean(folder.path(), &format!("rank --pairs pairs.csv --target-error 30% --format {format}"));
    }
}
