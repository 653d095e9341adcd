//! Seeds of the fuzz targets in `tests/fuzz/`, and the inputs that these have found, which stay tests.

use exr::prelude::Compression;
use svbrdf_core::model::scene::SceneFile;
use svbrdf_files::photograph::Capture;
use svbrdf_files::read::read_photograph;
use svbrdf_files::scene_file;
use svbrdf_files::session::{Session, SessionMaterial};

use super::listings::{GLTF_OF_EXTENSIONS, GLTF_OF_GLOSS, OPEN_PBR, USD};
use super::pictures::{palette, palette_bmp};
use super::*;
use crate::formats::decoders::{ETC1S, blocks};
use crate::scene_files::{GLTF_PBR, STANDARD_SURFACE, glb, gltf_text, mtl};
use crate::support::pictures::{compressed, layered, multi_part, npy, npz};
use crate::support::textures::{bc1_block, dds_blocks, dds_dx10, dds_plain};

const SIDECAR: &str = r#"{"albedo": "srgb", "dielectric-f0": 0.05, "grid": "4x1", "order": "ndrs", "flip-v": true,
    "exemplar": 0, "maps": {"roughness": "n.png:g"}, "preset": "gao"}"#;

const SCENES: &str = r#"{"scenes": [{"light": [0.1, 0.2, 1.5], "view": [0, 0, 2], "kind": "near"},
    {"light": [0.1, 0.2, 1.5e0], "view": [-0.3, 0, 2], "kind": "distant"}]}"#;

const CAPTURE: &str = r#"{"falloff": true, "transfer": "srgb", "clip": 0.98, "photographs": [{"file": "packed.png",
    "scene": {"kind": "near", "view": [0, 0, 2], "light": [0.1, 0.2, 1.5]}, "corners": [[0, 0], [4, 0], [4, 4], [0, 4]]}]}"#;

const CALIBRATION: &str = r#"{"target_dir": "target", "im_size": 6.8, "idx": [1, 0], "camera_pos": [[-3, 3, 16], [0, 3, 16]],
    "light_pos": [[-3, 3, 16], [0, 3, 16]], "light_pow": [1500, 1500, 1500]}"#;

fn pictures() -> Vec<Vec<u8>> {
    use Compression::{B44, B44A, DWAA, DWAB, PIZ, PXR24, RLE, Uncompressed, ZIP1, ZIP16};
    let eight = packed("NDRS", 4, |_, v| v);
    let [sixteen, float]: [DynamicImage; 2] = [eight.to_rgb16().into(), eight.to_rgb32f().into()];
    let rgba = eight.to_rgba8();
    let numbers = eight.to_rgb32f();
    let bc1: Vec<u8> = (0..64).flat_map(|block| bc1_block([block / 2, block, 31 - block / 2])).collect();
    let blocks_of_16: Vec<u8> = (0..64_u8).flat_map(|k| [k | 1; 16].map(|b| b.wrapping_mul(37))).collect();
    let mut all: Vec<Vec<u8>> = [
        (&eight, ImageFormat::Png),
        (&sixteen, ImageFormat::Png),
        (&eight, ImageFormat::Jpeg),
        (&float, ImageFormat::Hdr),
        (&eight, ImageFormat::Tiff),
        (&sixteen, ImageFormat::Tiff),
        (&float, ImageFormat::Tiff),
        (&eight, ImageFormat::Bmp),
        (&eight, ImageFormat::WebP),
    ]
    .map(|(image, format)| encoded(image, format))
    .into();
    let exr = [Uncompressed, RLE, ZIP1, ZIP16, PIZ, PXR24, B44, B44A, DWAA(None), DWAB(None)];
    all.extend(exr.map(|compression| written(|path| compressed(path, compression))));
    all.extend([
        palette(),
        palette_bmp(),
        dds_plain(rgba.width(), rgba.height(), rgba.as_raw()),
        dds_blocks(64, 16, b"DXT1", &bc1),
        dds_blocks(64, 16, b"DXT3", &blocks_of_16),
        dds_blocks(64, 16, b"DXT5", &blocks_of_16),
        dds_dx10(64, 16, 98, &blocks_of_16),
        blocks().1,
        ETC1S.to_vec(),
        written(|path| layered(path, true)),
        written(multi_part),
        npy([u64::from(numbers.height()), u64::from(numbers.width()), 3], numbers.as_raw()),
        written(npz),
    ]);
    all
}

fn session() -> String {
    let path = Some("packed.png".into());
    let material =
        SessionMaterial { name: None, path, built_in: None, read: OPTIONS, fit: true, steps: true };
    let folder = tempdir().unwrap();
    let file: SceneFile = serde_json::from_str(SCENES).unwrap();
    let session = Session::new(vec![material], file.scenes[0], "printed".to_owned(), 0.5);
    session.text(&folder.path().join("a.svbrdf-session.json")).unwrap()
}

fn text(text: &str) -> Vec<u8> {
    text.as_bytes().to_vec()
}

/// The seeds of each target.
fn seeds() -> Vec<(&'static str, Vec<Vec<u8>>)> {
    let (folder, _) = mtl::wall("");
    vec![
        ("picture", pictures()),
        ("photograph", pictures()),
        ("scene_file", vec![text(SCENES)]),
        ("capture", [CAPTURE, CALIBRATION].map(text).into()),
        ("mtlx", [GLTF_PBR, STANDARD_SURFACE, OPEN_PBR, USD].map(text).into()),
        ("mtl", vec![text(mtl::PBR)]),
        ("gltf", vec![gltf_text(), text(GLTF_OF_EXTENSIONS), text(GLTF_OF_GLOSS)]),
        ("glb", vec![glb(folder.path())]),
        ("sidecar", vec![text(SIDECAR)]),
        ("session", vec![text(&session())]),
    ]
}

/// Opens what a target opens, beside the maps in `folder`.
fn open(target: &str, folder: &Path, bytes: &[u8]) -> Result<(), Error> {
    let put = |name: &str| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    };
    let material = |path: &Path, options| read::<f32>(path, options, &Progress::default()).map(drop);
    match target {
        "picture" => read_bytes::<f32>("fuzzed", bytes, &STRIP).map(drop),
        "photograph" => read_photograph(&put("fuzzed.png"), &Default::default()).map(drop),
        "capture" => Capture::read(&put("fuzzed.json")).map(drop),
        "scene_file" => scene_file::read(&put("fuzzed.json")).map(drop),
        "session" => Session::read(&put("fuzzed.svbrdf-session.json")).map(drop),
        "sidecar" => {
            put("packed.svbrdf.json");
            material(&folder.join("packed.png"), &ReadOptions::AUTO)
        }
        "mtlx" | "mtl" | "gltf" | "glb" => material(&put(&format!("fuzzed.{target}")), &OPTIONS),
        other => panic!("no target {other}"),
    }
}

/// The maps that text files name, and a packed picture.
fn maps() -> tempfile::TempDir {
    let (folder, _) = mtl::wall("");
    let image = packed("NDRS", 4, |_, v| v);
    image.save_with_format(folder.path().join("packed.png"), ImageFormat::Png).unwrap();
    folder
}

#[test]
fn inputs_that_the_fuzz_targets_have_found_never_panic() {
    let folder = maps();
    let found = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/mutations/found");
    let mut count = 0;
    for target in std::fs::read_dir(found).into_iter().flatten().flatten() {
        let name = target.file_name().into_string().unwrap();
        for input in std::fs::read_dir(target.path()).unwrap() {
            let path = input.unwrap().path();
            println!("{}", path.display());
            let _ = open(&name, folder.path(), &std::fs::read(path).unwrap());
            count += 1;
        }
    }
    println!("{count} inputs");
}

#[test]
fn every_seed_is_opened_by_its_target() {
    let folder = maps();
    for (target, inputs) in seeds() {
        for (index, bytes) in inputs.iter().enumerate() {
            let opened = open(target, folder.path(), bytes);
            // Arrays, textures with several layers and the like are no photographs.
            let is_fine = opened.is_ok() || target == "photograph";
            assert!(is_fine, "{target} {index}: {opened:?}");
        }
    }
}

#[test]
#[ignore = "writes tests/fuzz/seeds"]
fn the_seeds_of_the_fuzz_targets() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/seeds");
    for (target, inputs) in seeds() {
        let folder = root.join(target);
        std::fs::create_dir_all(&folder).unwrap();
        for (index, bytes) in inputs.iter().enumerate() {
            std::fs::write(folder.join(format!("{index:02}")), bytes).unwrap();
        }
    }
    let (from, to) = (maps(), root.join("maps"));
    std::fs::create_dir_all(&to).unwrap();
    for entry in std::fs::read_dir(from.path()).unwrap() {
        let entry = entry.unwrap();
        std::fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
    }
}
