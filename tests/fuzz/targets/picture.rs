//! Every decoder of pictures and arrays, chosen by the first bytes.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| svbrdf_fuzz::picture(bytes));
