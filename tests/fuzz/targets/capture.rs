//! Descriptions of captures.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let _ = svbrdf_files::photograph::Capture::read(&svbrdf_fuzz::written("fuzzed.json", bytes));
});
