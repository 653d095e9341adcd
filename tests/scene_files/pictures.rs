//! Files of scene files beside their documents: what their decoders notice, buffers, avatars.

use super::extensions::{IMAGES, PLAIN, THREE, document, put};
use super::*;
use crate::support::png::chunk;

/// Adds gAMA of 1 and an EXIF orientation to a PNG.
fn add_chunks(path: &Path) {
    let bytes = std::fs::read(path).unwrap();
    let exif = b"MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0";
    let chunks = [chunk(*b"gAMA", &100_000_u32.to_be_bytes()), chunk(*b"eXIf", exif)].concat();
    // After the signature and IHDR.
    let (head, rest) = bytes.split_at(33);
    std::fs::write(path, [head, &chunks, rest].concat()).unwrap();
}

#[test]
fn decoders_of_the_pictures_of_a_document_are_heard() {
    let folder = textures();
    add_chunks(&folder.path().join(NAMES[0]));
    let mtlx = folder.path().join("a.mtlx");
    std::fs::write(&mtlx, STANDARD_SURFACE).unwrap();
    let gltf = folder.path().join("a.gltf");
    std::fs::write(&gltf, gltf_text()).unwrap();
    let [mtlx, gltf] = [mtlx, gltf].map(|path| open(&path));
    for read in [&mtlx, &gltf] {
        assert_is_of_textures(read, 1.0);
        assert!(says(read, "base colour map has an EXIF orientation"), "{:?}", read.notes);
    }
    // glTF says that they are void.
    assert_eq!([&mtlx, &gltf].map(|read| says(read, "gAMA chunk")), [true, false]);
}

#[test]
fn the_buffer_of_a_gltf_is_one_of_its_files() {
    let folder = textures();
    std::fs::write(folder.path().join("mesh data.bin"), [0; 4]).unwrap();
    let buffers = r#", "buffers": [{"byteLength": 4, "uri": "mesh%20data.bin"},
        {"byteLength": 4, "uri": "absent.bin"}, {"byteLength": 4, "uri": "data:;base64,AAAAAA=="}]"#;
    let read = open(&put(&folder, &document(&IMAGES, THREE, PLAIN, buffers)));
    let names = read.files.iter().map(|file| file.file_name().unwrap().to_str().unwrap());
    assert_eq!(names.collect::<Vec<_>>(), ["a.gltf", NAMES[0], "mesh data.bin", NAMES[1], NAMES[2]]);
}

#[test]
fn an_avatar_opens_as_a_glb() {
    let folder = textures();
    let path = folder.path().join("avatar.vrm");
    std::fs::write(&path, glb(folder.path())).unwrap();
    assert_is_of_textures(&open(&path), 1.0);
}
