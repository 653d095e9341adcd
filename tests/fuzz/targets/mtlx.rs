//! MaterialX files.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| svbrdf_fuzz::material("fuzzed.mtlx", bytes));
