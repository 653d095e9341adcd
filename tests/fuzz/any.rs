//! Every reader of files: the first byte chooses it, the others are the file.
//!
//! A document and a sidecar file stand beside the maps of `seeds/maps`, and are overwritten by the next input.

#![no_main]

use std::path::Path;
use std::sync::OnceLock;

use svbrdf_core::progress::Progress;
use svbrdf_files::disk::memory;
use svbrdf_files::read::{NonFinite, Order, ReadOptions, read, read_bytes};
use svbrdf_files::scene_file;
use svbrdf_files::session::Session;

/// Most memory of one input: more is an error, which is no finding.
const MEMORY: u64 = 256 << 20;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    static FOLDER: OnceLock<tempfile::TempDir> = OnceLock::new();
    memory::set_limit(MEMORY);
    let folder = FOLDER.get_or_init(|| {
        let folder = tempfile::tempdir().expect("the folder of temporary files is writable");
        let maps = Path::new(env!("CARGO_MANIFEST_DIR")).join("seeds/maps");
        for entry in maps.read_dir().into_iter().flatten().flatten() {
            let _ = std::fs::copy(entry.path(), folder.path().join(entry.file_name()));
        }
        folder
    });
    let Some((kind, bytes)) = bytes.split_first() else { return };
    let options = ReadOptions { non_finite: Some(NonFinite::Replace), ..ReadOptions::AUTO };
    let written = |name: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("the folder of temporary files is writable");
        path
    };
    let material = |path: &Path| drop(read::<f32>(path, &options, &Progress::default()));
    match kind % 8 {
        0 => drop(read_bytes::<f32>("fuzzed", bytes, &ReadOptions { order: Some(Order::NDRS), ..options })),
        1 => material(&written("fuzzed.gltf")),
        2 => material(&written("fuzzed.glb")),
        3 => material(&written("fuzzed.mtl")),
        4 => material(&written("fuzzed.mtlx")),
        5 => material(&written("packed.svbrdf.json").with_file_name("packed.png")),
        6 => drop(scene_file::read(&written("fuzzed.json"))),
        _ => drop(Session::read(&written("fuzzed.svbrdf-session.json"))),
    }
});
