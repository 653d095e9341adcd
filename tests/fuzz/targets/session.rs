//! Session files.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let _ = svbrdf_files::session::Session::read(&svbrdf_fuzz::written("fuzzed.svbrdf-session.json", bytes));
});
