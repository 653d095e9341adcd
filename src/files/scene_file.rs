//! Files of scenes: the project's own, and the captures of MaterialGAN.

use std::path::{Path, PathBuf};

use svbrdf_core::loss::FileScenes;
use svbrdf_core::model::scene::{Scene, SceneFile};
use svbrdf_core::text::of_json;

use crate::disk::atomic::Destination;
use crate::disk::inputs;
use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::photograph::Calibration;
use crate::session::Session;

/// Reads a scene file: JSON, `{"scenes": [{"kind": "near", "view": [x, y, z], "light": [x, y, z]}, ...]}`, or the
/// `render.json` (later `parameters.json`) of a MaterialGAN capture.
///
/// A capture lists positions in centimetres, with the width of the material as `im_size` (later `image_size`); they are scaled so
/// that the width is 2. `idx` chooses and orders them, where it is there. The power of its light is not used.
///
/// # Errors
/// Where the file cannot be read, is not of that form, has no scene, or has one that [`Scene::check`] refuses.
pub fn read(path: &Path) -> Result<Vec<Scene>, Error> {
    let text = NamedFile::by_user(path).text()?;
    inputs::protect(path);
    parse(&text).map_err(|problem| Error::BadScene { path: path.to_owned(), problem })
}

/// Whether `path` is named like a scene file: JSON, but no session.
pub fn is_named(path: &Path) -> bool {
    let is_json = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json"));
    is_json && !Session::is_named(path)
}

/// The destination of a scene file. Checks `path` before there is anything to write.
///
/// # Errors
/// [`UnknownName`](svbrdf_core::error::Error::UnknownName) where it is not named like a scene file, [`Error::Unwritable`] where
/// its folder is missing or it is itself a folder.
pub fn destination(path: &Path) -> Result<Destination, Error> {
    let extensions: &[&str] = if is_named(path) { &["json"] } else { &[] };
    Destination::new(path, extensions, "name of a scene file", "NAME.json, other than a session file")
}

/// Reads the scenes of a file, with its name.
///
/// # Errors
/// Those of [`read`].
pub fn read_named(path: &Path) -> Result<FileScenes, Error> {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    Ok(FileScenes { name, path: path.to_owned(), scenes: read(path)? })
}

/// Reads the only one of some scene files; `None` without any.
///
/// # Errors
/// As [`read`], and [`Error::SeveralSceneFiles`].
pub fn read_one(paths: &[PathBuf]) -> Result<Option<FileScenes>, Error> {
    match paths {
        [] => Ok(None),
        [path] => read_named(path).map(Some),
        [first, second, ..] => Err(Error::SeveralSceneFiles { first: first.clone(), second: second.clone() }),
    }
}

fn parse(text: &str) -> Result<Vec<Scene>, String> {
    let scenes = match serde_json::from_str::<Calibration>(text) {
        Ok(calibration) => calibration.scenes()?,
        Err(_) => serde_json::from_str::<SceneFile>(text).map_err(|e| of_json(&e))?.scenes,
    };
    if scenes.is_empty() {
        return Err("it lists no scene".to_owned());
    }
    for (i, scene) in scenes.iter().enumerate() {
        scene.check().map_err(|problem| format!("scene {i}: {problem}"))?;
    }
    Ok(scenes)
}

#[cfg(test)]
mod tests {
    use svbrdf_core::model::scene::Kind;

    use super::*;

    const CAPTURE: &str = r#"{"im_size": 4, "idx": [2, 0], "camera_pos": [[-3, 3, 16], [0, 3, 16], [3, 1, 16]],
        "light_pos": [[-1, 3, 16], [0, 3, 16], [3, 2, 8]], "light_pow": [1500, 1500, 1500]}"#;

    #[test]
    fn a_capture_of_materialgan_is_a_list_of_scenes_in_half_widths() {
        let scenes = parse(CAPTURE).unwrap();
        let expected = [
            Scene { kind: Kind::Near, view: [1.5, 0.5, 8.0], light: [1.5, 1.0, 4.0] },
            Scene { kind: Kind::Near, view: [-1.5, 1.5, 8.0], light: [-0.5, 1.5, 8.0] },
        ];
        assert_eq!(scenes, expected);
        let later = CAPTURE.replace("im_size", "image_size").replace(r#""idx": [2, 0],"#, "");
        assert_eq!(parse(&later).unwrap().len(), 3);
    }

    #[test]
    fn captures_that_cannot_be_used_are_refused() {
        for (wrong, problem) in [
            (CAPTURE.replace("[2, 0]", "[2, 3]"), "idx names position 3 of 3"),
            (CAPTURE.replace("\"im_size\": 4", "\"im_size\": 0"), "not a width"),
            (CAPTURE.replace("[0, 3, 16], [3, 2, 8]", "[3, 2, 8]"), "3 camera_pos and 2 light_pos"),
            (CAPTURE.replace("[3, 2, 8]", "[3, 2, -8]"), "scene 0"),
            ("{}".to_owned(), "no key `scenes`"),
        ] {
            let refusal = parse(&wrong).unwrap_err();
            assert!(refusal.contains(problem), "{refusal}");
        }
    }

    #[test]
    fn a_scene_file_is_json_that_is_no_session() {
        for name in ["scenes.json", "a/render.JSON"] {
            assert!(is_named(Path::new(name)), "{name}");
        }
        for name in ["a.png", "json", "a.svbrdf-session.json"] {
            assert!(!is_named(Path::new(name)), "{name}");
        }
    }
}
