//! Sidecar files of a packed picture.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let folder = svbrdf_fuzz::folder();
    let path = folder.join("packed.png");
    svbrdf_fuzz::written("packed.svbrdf.json", bytes);
    let _ = svbrdf_files::read::read::<f32>(&path, &Default::default(), &Default::default());
});
