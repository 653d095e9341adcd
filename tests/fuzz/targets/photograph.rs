//! A picture read as a photograph.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let path = svbrdf_fuzz::written("fuzzed.png", bytes);
    let _ = svbrdf_files::read::read_photograph(&svbrdf_files::disk::open::NamedFile::by_user(path), None);
});
