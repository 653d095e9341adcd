//! Binary glTF as it is written, by its specification and by the validator of Khronos.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use tempfile::tempdir;

use svbrdf_core::material::{Material, Planes};
use svbrdf_files::write::{self, FileKind};
use svbrdf_needs::needs;

use super::{material, open};
use crate::materials::formula::{Place, values};

/// Coloured specular on coloured diffuse, up to `most`: no base colour and metallic make it.
fn coloured(size: [usize; 2], most: &str) -> Material<f32> {
    material(size, ["N", "0.3, 0.6 * v, 0.02 + 0.9 * u", &format!("{most} * (u, v, u * v)"), "r"])
}

/// Materials, and whether base colour and metallic express them.
fn cases() -> [(Material<f32>, bool); 7] {
    let base = "(0.1 + 0.05 * x, 0.4, 0.03 * y)";
    let metal = "less(3, x) * less(x, 9)";
    let diffuse = format!("{base} * (1 - {metal})");
    let specular = format!("0.04 * (1 - {metal}) + {base} * {metal}");
    let noise = |a, b, c| {
        format!("0.5 + 0.5 * (sin({a} * x + {b} * y), sin({b} * x - {c} * y), cos({c} * x + {a} * y))")
    };
    let slopes = "unit(sin(71 * x + 13 * y), cos(19 * x - 83 * y), 2)";
    [
        (material([16, 16], ["N", &diffuse, &specular, "r"]), true),
        (coloured([16, 16], "0.1"), false),
        (coloured([16, 16], "1"), false),
        (coloured([23, 9], "0.3"), false),
        (material([5, 7], ["N", "0, 0.0005 * y, 0.001", "0.001 * x, 0, 0.0002", "r"]), false),
        (material([2, 1], ["0, 0, 1", "0", "0", "0"]), true),
        (material([24, 24], [slopes, &noise(91, 37, 53), &noise(17, 61, 29), "u"]), false),
    ]
}

/// The largest difference of two materials in steps of 8 bits, as a PNG stores them.
fn steps(a: &Material<f32>, b: &Material<f32>) -> f64 {
    let coded = |material: &Material<f32>| {
        let Planes { normal, diffuse, specular, roughness } = material.planes();
        let colours = diffuse.iter().chain(specular).flatten();
        let srgb = |v: f64| if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 };
        let normals = normal.iter().flatten().map(|n| 0.5 * f64::from(*n) + 0.5);
        let all =
            normals.chain(colours.map(|c| srgb((*c).into()))).chain(roughness.iter().map(|r| f64::from(*r)));
        all.collect::<Vec<_>>()
    };
    coded(a).into_iter().zip(coded(b)).map(|(a, b)| 255.0 * (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn a_glb_opens_again_within_one_step_of_8_bits() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.glb");
    for (number, (original, is_metallic)) in cases().into_iter().enumerate() {
        for sixteen in [false, true] {
            let note = write::write(&original, &path, FileKind::Glb { sixteen }).unwrap();
            assert_eq!(note.is_none(), is_metallic, "{number}: {note:?}");
            let again = open(&path);
            let off = steps(&original, &again.material);
            assert!(off <= 1.0, "{number}: off by {off} steps");
            assert!(again.unsure().count() == 0 && again.notes.is_empty(), "{number}: {:?}", again.notes);
        }
    }
}

/// The document and the binary part of a glb, by the specification and without the reader.
struct Parts(Value, Vec<u8>);

fn index(value: &Value) -> usize {
    value.as_u64().unwrap() as usize
}

impl Parts {
    fn of(path: &Path) -> Self {
        let bytes = fs::read(path).unwrap();
        let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((&bytes[..4], number(4), number(8)), (&b"glTF"[..], 2, bytes.len()));
        let json = &bytes[20..20 + number(12)];
        Self(serde_json::from_slice(json).unwrap(), bytes[20 + number(12) + 8..].to_vec())
    }

    /// The bytes of a view of the buffer.
    fn view(&self, number: &Value) -> &[u8] {
        let view = &self.0["bufferViews"][index(number)];
        &self.1[index(&view["byteOffset"])..][..index(&view["byteLength"])]
    }

    fn accessor(&self, number: &Value) -> &[u8] {
        self.view(&self.0["accessors"][index(number)]["bufferView"])
    }

    /// The pixels of the texture that the material has at this place.
    fn texture(&self, place: &str) -> image::RgbImage {
        let texture = index(&self.0["materials"][0].pointer(place).unwrap()["index"]);
        let image = &self.0["images"][index(&self.0["textures"][texture]["source"])];
        image::load_from_memory(self.view(&image["bufferView"])).unwrap().into_rgb8()
    }
}

/// sRGB colours, y up, roughness in green, metallic in blue, row 0 on top.
#[test]
fn a_glb_has_what_the_specification_says() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.glb");
    let original = coloured([23, 9], "0.3");
    write::write(&original, &path, FileKind::Glb { sixteen: false }).unwrap();
    let parts = Parts::of(&path);
    let of_material = &parts.0["materials"][0];
    assert_eq!(parts.0["extensionsUsed"], serde_json::json!(["KHR_materials_specular", "KHR_materials_ior"]));
    assert_eq!(of_material["pbrMetallicRoughness"]["metallicFactor"], 0.0);
    let ior = of_material["extensions"]["KHR_materials_ior"]["ior"].as_f64().unwrap();
    let reflectance = ((ior - 1.0) / (ior + 1.0)).powi(2);
    assert!((0.3..0.301).contains(&reflectance), "{reflectance}");
    let [base, rough, normal, colour] = [
        "/pbrMetallicRoughness/baseColorTexture",
        "/pbrMetallicRoughness/metallicRoughnessTexture",
        "/normalTexture",
        "/extensions/KHR_materials_specular/specularColorTexture",
    ]
    .map(|place| parts.texture(place));
    for (x, y) in [(0, 0), (22, 0), (3, 8), (11, 4)] {
        let near = |image: &image::RgbImage, c: usize, formula: &str| {
            let place = Place { x: x as usize, y: y as usize, size: [23, 9] };
            let all = values(formula, place);
            let [got, expected] = [f64::from(image.get_pixel(x, y).0[c]), 255.0 * all[c.min(all.len() - 1)]];
            assert!((got - expected).abs() <= 1.0, "{formula} at {x}, {y}: {got}, not {expected}");
        };
        for c in 0..3 {
            near(&base, c, "srgb(0.3, 0.6 * v, 0.02 + 0.9 * u)");
            near(&normal, c, "n");
            near(&colour, c, &format!("srgb((u, v, u * v) * 0.3 / {reflectance})"));
        }
        near(&rough, 1, "r");
    }
    write::write(&cases()[0].0, &path, FileKind::Glb { sixteen: false }).unwrap();
    let parts = Parts::of(&path);
    assert!(parts.0.get("extensionsUsed").is_none());
    let packed = parts.texture("/pbrMetallicRoughness/metallicRoughnessTexture");
    assert_eq!([3, 4, 8, 9].map(|x| packed.get_pixel(x, 5).0[2]), [0, 255, 255, 0]);
}

#[test]
fn a_glb_has_a_plane_of_the_size_of_the_material_that_faces_the_viewer() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.glb");
    let original = coloured([23, 9], "0.3");
    write::write(&original, &path, FileKind::Glb { sixteen: false }).unwrap();
    let parts = Parts::of(&path);
    let primitive = &parts.0["meshes"][0]["primitives"][0];
    let floats = |name: &str, width: usize| -> Vec<Vec<f32>> {
        let chunks = parts.accessor(&primitive["attributes"][name]).chunks(4);
        let numbers: Vec<f32> = chunks.map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
        numbers.chunks(width).map(<[f32]>::to_vec).collect()
    };
    let half = original.grid().half_extent();
    let positions = floats("POSITION", 3);
    for (position, at) in positions.iter().zip(floats("TEXCOORD_0", 2)) {
        // (0, 0) is the upper left corner of the pictures, x to the right and y up.
        assert_eq!(*position, [half[0] * (2.0 * at[0] - 1.0), half[1] * (1.0 - 2.0 * at[1]), 0.0]);
    }
    assert!(floats("NORMAL", 3).iter().all(|normal| *normal == [0.0, 0.0, 1.0]));
    assert!(floats("TANGENT", 4).iter().all(|tangent| *tangent == [1.0, 0.0, 0.0, 1.0]));
    // Counterclockwise, seen from +z: each triangle has a positive area.
    let indices = parts.accessor(&primitive["indices"]).chunks(2).map(|b| usize::from(b[0]));
    for triangle in indices.take(6).collect::<Vec<_>>().chunks(3) {
        let [a, b, c] = [0, 1, 2].map(|corner| &positions[triangle[corner]]);
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        assert!((area - 4.0 * half[0] * half[1]).abs() < 1e-5, "{area}");
    }
}

/// The issues that the validator of Khronos finds in these files.
fn issues(files: &[PathBuf]) -> Vec<Value> {
    const SCRIPT: &str = "const validator = require('gltf-validator'), fs = require('fs');
        const report = path => validator.validateBytes(new Uint8Array(fs.readFileSync(path)));
        Promise.all(process.argv.slice(1).map(report)).then(found => console.log(JSON.stringify(found.map(one => one.issues))));";
    let output = Command::new("node").args(["-e", SCRIPT]).args(files).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[needs(gltf_validator)]
fn the_validator_of_khronos_finds_nothing_in_a_glb_and_sees_planted_faults() {
    let folder = tempdir().unwrap();
    let files = cases().map(|(material, _)| {
        let path = folder.path().join(format!("{:p}.glb", &raw const material));
        write::write(&material, &path, FileKind::Glb { sixteen: material.width() == 16 }).unwrap();
        path
    });
    let found = issues(&files);
    assert_eq!(found.len(), files.len());
    for issues in found {
        // It remarks on sizes that are no powers of two.
        let of_size = |issue: &&Value| issue["code"] == "IMAGE_NPOT_DIMENSIONS";
        let all = issues["messages"].as_array().unwrap();
        assert_eq!(all.iter().filter(of_size).count(), all.len(), "{issues:#}");
    }
    for (from, to) in
        [("\"SCALAR\"", "\"VEC999\""), ("image/png", "image/jpg"), ("\"POSITION\"", "\"POSITIOM\"")]
    {
        let bytes = fs::read(&files[0]).unwrap();
        let at = bytes.windows(from.len()).position(|window| window == from.as_bytes()).unwrap();
        let path = folder.path().join("changed.glb");
        fs::write(&path, [&bytes[..at], to.as_bytes(), &bytes[at + from.len()..]].concat()).unwrap();
        let issues = &issues(&[path])[0];
        let count = |kind: &str| issues[kind].as_u64().unwrap();
        assert!(count("numErrors") + count("numWarnings") > 0, "{from} as {to}: {issues:#}");
    }
}

#[test]
fn the_comparison_sees_every_convention_that_can_be_taken_wrongly() {
    let original = coloured([16, 16], "0.3");
    let changed = |change: &dyn Fn(&mut Planes<f32>)| {
        let mut planes = original.planes().clone();
        change(&mut planes);
        steps(&original, &Material::new("changed", 16, 16, planes).unwrap())
    };
    assert_eq!(changed(&|_| {}), 0.0);
    for (what, off) in [
        ("y down", changed(&|planes| planes.normal[1].iter_mut().for_each(|y| *y = -*y))),
        ("alpha for r", changed(&|planes| planes.roughness.iter_mut().for_each(|r| *r *= *r))),
        ("linear for sRGB", changed(&|planes| planes.diffuse[2].iter_mut().for_each(|d| *d = d.powf(0.45)))),
        ("red for blue", changed(&|planes| planes.specular.swap(0, 2))),
        ("rows upside down", changed(&|planes| planes.roughness.reverse())),
        ("1.1 steps", changed(&|planes| planes.roughness.iter_mut().for_each(|r| *r -= 1.1 / 255.0))),
    ] {
        assert!(off > 1.0, "{what}: {off}");
    }
}
