//! Files that name others by absolute paths: refused, and allowed by a button that names the path.

use super::*;

/// A glTF file that names its picture by an absolute path, and the picture, elsewhere.
fn gltf(folder: &Path, elsewhere: &Path) -> (PathBuf, PathBuf) {
    let picture = elsewhere.join("albedo.png");
    image::RgbImage::from_pixel(256, 256, image::Rgb([90, 120, 150])).save(&picture).unwrap();
    let text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "images": [{{"uri": {:?}}}], "textures": [{{"source": 0}}],
            "materials": [{{"name": "wall", "pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0}}}}}}]}}"#,
        picture.to_str().unwrap()
    );
    let path = folder.join("wall.gltf");
    std::fs::write(&path, text).unwrap();
    (path, picture)
}

#[test]
#[ignore = "allows absolute paths in all of this process: run it alone, as `cargo test outside -- --ignored`"]
fn a_file_outside_is_not_read_before_the_window_has_asked_and_named_it() {
    let [folder, elsewhere] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let (file, picture) = gltf(folder.path(), elsewhere.path());
    let mut window = built_in();
    drop_files(&mut window, [file]);
    wait(&mut window, "the question", |app| !app.messages().is_empty());
    let message = window.state().messages().remove(0);
    assert!(message.contains(picture.to_str().unwrap()), "{message}");
    assert!(!window.state().names().contains(&"wall".to_owned()));
    window.get_by_label("Allow absolute paths").click();
    wait(&mut window, "the material", |app| app.names().iter().any(|name| name.contains("wall")));
    assert!(window.state().messages().is_empty(), "{:?}", window.state().messages());
}
