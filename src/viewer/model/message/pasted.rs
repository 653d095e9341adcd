//! Text of the clipboard: a scene, or files as file managers and terminals copy them.

use std::path::{Path, PathBuf};

use percent_encoding::percent_decode_str;

use svbrdf_core::model::scene::{Scene, SceneFile};

use super::PasteProblem;

/// What a text on the clipboard means.
#[derive(Clone, Debug, PartialEq)]
pub enum Pasted {
    Scene(Scene),
    /// Materials, or a session.
    Files(Vec<PathBuf>),
}

/// The first scene of a scene file, a scene alone, or the paths or `file://` addresses of files and folders, one a line.
///
/// # Errors
/// Where it is none of these, or the scene cannot be rendered.
pub fn pasted(text: &str) -> Result<Pasted, PasteProblem> {
    let of_file = serde_json::from_str::<SceneFile>(text).ok().and_then(|file| file.scenes.first().copied());
    if let Some(scene) = of_file.or_else(|| serde_json::from_str(text).ok()) {
        scene.check().map_err(PasteProblem::Unusable)?;
        return Ok(Pasted::Scene(scene));
    }
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let paths: Vec<PathBuf> = lines.map(path).collect();
    let are_files = !paths.is_empty() && paths.iter().all(|path| path.exists());
    if are_files { Ok(Pasted::Files(paths)) } else { Err(PasteProblem::NoScene) }
}

/// The scene as a scene file of one scene.
pub fn scene_text(scene: Scene) -> String {
    serde_json::to_string_pretty(&SceneFile { scenes: vec![scene] }).unwrap_or_default()
}

/// The path of a line, without the quotes that some terminals add.
fn path(line: &str) -> PathBuf {
    let bare = |quote| line.strip_prefix(quote)?.strip_suffix(quote);
    match line.strip_prefix("file://") {
        Some(address) => PathBuf::from(percent_decode_str(address).decode_utf8_lossy().as_ref()),
        None => Path::new(bare('\'').or_else(|| bare('"')).unwrap_or(line)).to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::view::state::ViewState;

    #[test]
    fn a_copied_scene_can_be_pasted() {
        let scene = ViewState::default().scene;
        assert_eq!(pasted(&scene_text(scene)), Ok(Pasted::Scene(scene)));
        assert_eq!(pasted("{\"scenes\": []}"), Err(PasteProblem::NoScene));
        let below = scene_text(Scene { light: [0.0, 0.0, -1.0], ..scene });
        let Err(PasteProblem::Unusable(problem)) = pasted(&below) else { panic!("it is below") };
        assert!(problem.contains("above the plane"), "{problem}");
    }

    #[test]
    fn paths_and_addresses_of_files_can_be_pasted() {
        let folder = tempfile::tempdir().unwrap();
        let [a, b] = ["a b.png", "c.png"].map(|name| folder.path().join(name));
        for file in [&a, &b] {
            std::fs::write(file, "").unwrap();
        }
        let both = Ok(Pasted::Files(vec![a.clone(), b.clone()]));
        let (a, b) = (a.display().to_string(), b.display().to_string());
        assert_eq!(pasted(&format!("{a}\n{b}\n")), both);
        assert_eq!(pasted(&format!("file://{}\r\nfile://{b}", a.replace(' ', "%20"))), both);
        assert_eq!(pasted(&format!("'{a}'\n\"{b}\"")), both);
        assert_eq!(pasted(&format!("{a}\n{b}.nothing")), Err(PasteProblem::NoScene));
        assert_eq!(pasted("brown fox"), Err(PasteProblem::NoScene));
        assert_eq!(pasted(" \n"), Err(PasteProblem::NoScene));
    }
}
