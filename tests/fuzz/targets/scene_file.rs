//! Scene files.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let _ = svbrdf_files::scene_file::read(&svbrdf_fuzz::written("fuzzed.json", bytes));
});
