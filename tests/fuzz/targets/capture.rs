//! Descriptions of captures.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let _ = svbrdf_files::capture::Capture::read(&svbrdf_fuzz::written("fuzzed.json", bytes));
});
