//! Seeds of the fuzz targets in `tests/fuzz/`, and the inputs that these have found, which stay tests.

use svbrdf_core::model::scene::SceneFile;
use svbrdf_files::disk::open::NamedFile;
use svbrdf_files::photograph::Capture;
use svbrdf_files::read::read_photograph;
use svbrdf_files::scene_file;
use svbrdf_files::session::{Session, SessionMaterial};

use super::listings::{SIDECAR, listings};
use super::*;
use crate::scene_files::mtl;

const SCENES: &str = r#"{"scenes": [{"light": [0.1, 0.2, 1.5], "view": [0, 0, 2], "kind": "near"},
    {"light": [0.1, 0.2, 1.5e0], "view": [-0.3, 0, 2], "kind": "distant"}]}"#;

const CAPTURE: &str = r#"{"falloff": true, "transfer": "srgb", "photographs": [{"file": "packed.png",
    "scene": {"kind": "near", "view": [0, 0, 2], "light": [0.1, 0.2, 1.5]}}]}"#;

const CALIBRATION: &str = r#"{"target_dir": "target", "im_size": 6.8, "idx": [1, 0], "camera_pos": [[-3, 3, 16], [0, 3, 16]],
    "light_pos": [[-3, 3, 16], [0, 3, 16]], "light_pow": [1500, 1500, 1500]}"#;

fn pictures() -> Vec<Vec<u8>> {
    super::pictures::pictures().into_iter().map(|(_, bytes)| bytes).collect()
}

fn session() -> String {
    let path = Some("packed.png".into());
    let material = SessionMaterial { name: None, path, built_in: None, read: OPTIONS, fit: true };
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
    let listing = |target| {
        let of_target = listings().into_iter().filter(move |(kind, _)| *kind == target);
        (target, of_target.map(|(_, bytes)| bytes).collect())
    };
    let mut all: Vec<_> = ["mtlx", "mtl", "gltf", "glb"].into_iter().map(listing).collect();
    all.extend([
        ("picture", pictures()),
        ("photograph", pictures()),
        ("scene_file", vec![text(SCENES)]),
        ("capture", [CAPTURE, CALIBRATION].map(text).into()),
        ("sidecar", vec![text(SIDECAR)]),
        ("session", vec![text(&session())]),
    ]);
    all
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
        "photograph" => read_photograph(&NamedFile::by_user(put("fuzzed.png")), None).map(drop),
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
