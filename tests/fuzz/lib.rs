//! Inputs of the fuzz targets: bytes as a file beside small maps, and the memory limit of all targets.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use svbrdf_core::progress::Progress;
use svbrdf_files::disk::memory;
use svbrdf_files::read::{NonFinite, Order, ReadOptions, read, read_bytes};

/// Most memory of one input: more is an error, which is no finding.
const MEMORY: u64 = 256 << 20;

/// What damaged files are read with.
const OPTIONS: ReadOptions = ReadOptions { non_finite: Some(NonFinite::Replace), ..ReadOptions::AUTO };

/// A strip of four maps, whatever it looks like.
const STRIP: ReadOptions = ReadOptions { order: Some(Order::NDRS), ..OPTIONS };

/// Reads `bytes` as one picture.
pub fn picture(bytes: &[u8]) {
    memory::set_limit(MEMORY);
    let _ = read_bytes::<f32>("fuzzed", bytes, &STRIP);
}

/// Reads `bytes` as the material file `name`, which may name the maps of `fuzz/seeds/maps`.
pub fn material(name: &str, bytes: &[u8]) {
    let path = written(name, bytes);
    let _ = read::<f32>(&path, &OPTIONS, &Progress::default());
}

/// Writes `bytes` as the file `name` beside the maps; the file is overwritten by the next input.
pub fn written(name: &str, bytes: &[u8]) -> PathBuf {
    memory::set_limit(MEMORY);
    let path = folder().join(name);
    std::fs::write(&path, bytes).expect("the folder of temporary files is writable");
    path
}

/// A temporary folder with the maps.
pub fn folder() -> &'static Path {
    static FOLDER: OnceLock<tempfile::TempDir> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let folder = tempfile::tempdir().expect("the folder of temporary files is writable");
        let maps = Path::new(env!("CARGO_MANIFEST_DIR")).join("seeds/maps");
        let entries = maps.read_dir().into_iter().flatten().flatten();
        for entry in entries {
            let _ = std::fs::copy(entry.path(), folder.path().join(entry.file_name()));
        }
        folder
    })
    .path()
}
