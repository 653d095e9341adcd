//! Names from files: they forge no lines, hide nothing and turn no text round, wherever they are printed.

use std::fs;
use std::path::Path;

use serde_json::json;

use super::{folder, run_in, text};

/// Breaks lines, in three ways, turns text round, and hides a letter.
const FORGED: &str = "gold\nsvbrdf: error: forged\u{2028}x\u{2029}y\u{202e}z\u{e0041}";
const ESCAPED: &str = r"gold\u{a}svbrdf: error: forged\u{2028}x\u{2029}y\u{202e}z\u{e0041}";

/// A glTF and a MaterialX whose materials have this name, or one that XML can hold.
fn write_documents(folder: &Path) {
    let material = |roughness: f64| {
        let factors =
            json!({"baseColorFactor": [0.5, 0.4, 0.3, 1], "roughnessFactor": roughness, "metallicFactor": 0});
        json!({"name": format!("{FORGED}{roughness}"), "pbrMetallicRoughness": factors})
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

fn is_clean(text: &str) -> bool {
    !text.contains(['\u{2028}', '\u{2029}', '\u{202e}', '\u{e0041}'])
}

#[test]
fn a_name_from_a_file_is_one_line_of_what_is_printed() {
    let folder = folder();
    let at = folder.path();
    write_documents(at);
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
    ] {
        let output = run_in(at, args);
        let (stdout, stderr) = (text(&output.stdout), text(&output.stderr));
        assert!(output.status.success(), "{args}: {stderr}");
        let lines = || stdout.lines().chain(stderr.lines());
        assert!(!lines().any(|line| line.starts_with("svbrdf: error")), "{args}: {stdout}{stderr}");
        assert!(is_clean(stdout) && is_clean(stderr), "{args}: {stdout}{stderr}");
        assert!(lines().any(|line| line.contains("gold")), "{args}: {stdout}{stderr}");
    }
    assert!(text(&run_in(at, "info gt.gltf").stdout).starts_with(ESCAPED));
    // An error about one.
    let output = run_in(at, "loss gt.gltf gt.png");
    assert_eq!(text(&output.stderr).lines().filter(|line| line.starts_with("svbrdf: error")).count(), 1);
}

#[test]
fn a_name_from_a_file_is_plain_in_figures_and_pages() {
    let folder = folder();
    let at = folder.path();
    write_documents(at);
    for args in
        ["report gt.gltf a.gltf -o x.html --target-error 30%", "report gt.gltf a.gltf -o x.html --figure"]
    {
        let output = run_in(at, args);
        assert!(output.status.success(), "{args}: {}", text(&output.stderr));
        let page = fs::read_to_string(at.join("x.html")).unwrap();
        assert!(page.contains("gold") && is_clean(&page), "{args}");
    }
}

#[test]
fn a_name_in_a_list_is_one_line() {
    let folder = folder();
    let list = format!("ground_truth,prediction,method,material\ngt.png,a.png,\"{FORGED}\",\"{FORGED}\"\n");
    fs::write(folder.path().join("pairs.csv"), list).unwrap();
    for format in ["text", "csv", "json", "latex"] {
        let args = format!("rank --pairs pairs.csv --target-error 30% --format {format}");
        let output = run_in(folder.path(), &args);
        let stdout = text(&output.stdout);
        assert!(output.status.success() && is_clean(stdout), "{stdout}{}", text(&output.stderr));
        assert!(!stdout.lines().any(|line| line.starts_with("svbrdf: error")), "{stdout}");
    }
}
