//! Materials of engines, whose files are not read: which pictures they name, so that a message can tell what to open instead.

use std::io::Read as _;
use std::path::Path;

use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::names::listing;
use crate::read::options::extensions::{self, PICTURES};

/// Extensions of these files, and what they are.
const KINDS: [(&str, &str); 17] = [
    ("vmat", "a material of Source 2"),
    ("vmt", "a material of Source"),
    ("tres", "a resource of Godot"),
    ("material", "a material of an engine"),
    ("mat", "a material of Unity"),
    ("xml", "an XML file, such as a material of Urho3D"),
    ("uasset", "an asset of Unreal"),
    ("blend", "a file of Blender"),
    ("usd", "a scene of USD"),
    ("usda", "a scene of USD"),
    ("usdc", "a scene of USD"),
    ("usdz", "a scene of USD (a zip archive)"),
    ("sbs", "a graph of Substance"),
    ("sbsar", "an archive of Substance, which computes its maps"),
    ("mdl", "a material of MDL"),
    ("axf", "a measured material of AxF"),
    ("pbrt", "a scene of pbrt"),
];
/// Extensions of files of arrays, and what they are.
const ARRAYS: [(&str, &str); 5] = [
    ("safetensors", "arrays of safetensors"),
    ("pt", "arrays of PyTorch"),
    ("pth", "arrays of PyTorch"),
    ("ckpt", "arrays of PyTorch"),
    ("pkl", "a pickle of Python"),
];
/// Longest file in bytes whose text is searched.
const LONGEST: u64 = 1 << 20;

/// The refusal of the file `path`; `None` where its name is not that of a material of an engine.
pub(super) fn refusal(path: &Path) -> Option<Error> {
    let extension = extensions::of_name(path);
    let of = |kinds: &[(&str, &'static str)]| {
        kinds.iter().find(|(known, _)| *known == extension).map(|(_, kind)| *kind)
    };
    if let Some(kind) = of(&ARRAYS) {
        return Some(Error::NotAMaterial {
            path: path.to_owned(),
            expected: "pictures, or arrays of NumPy (.npy, .npz)".to_owned(),
            found: kind.to_owned(),
            remedy: "save each map as an array of rows, columns and channels".to_owned(),
        });
    }
    let kind = of(&KINDS).filter(|_| !is_of_matlab(path))?;
    let is_short = path.metadata().is_ok_and(|meta| meta.len() <= LONGEST);
    let bytes = if is_short { NamedFile::by_user(path).bytes().unwrap_or_default() } else { Vec::new() };
    let pictures = pictures(&String::from_utf8_lossy(&bytes));
    let (found, remedy) = match pictures.is_empty() {
        true => (
            kind.to_owned(),
            "open the folder of its pictures, or export it as glTF; save arrays as .npy or .npz",
        ),
        false => (
            format!("{kind} that names {}", listing(&pictures)),
            "open the folder of these pictures, or specify each map by its file and channel",
        ),
    };
    Some(Error::NotAMaterial {
        path: path.to_owned(),
        expected: "pictures, or a glTF, MTL or MaterialX file or a texture set of Minecraft that lists them"
            .to_owned(),
        found,
        remedy: remedy.to_owned(),
    })
}

/// Whether it holds arrays of MATLAB, whose extension is that of a material of Unity: then its first bytes name it.
fn is_of_matlab(path: &Path) -> bool {
    let Ok(file) = NamedFile::by_user(path).reader() else { return false };
    let mut head = Vec::new();
    file.take(6).read_to_end(&mut head).is_ok() && head == b"MATLAB"
}

/// The names of pictures in a text, each once.
fn pictures(text: &str) -> Vec<String> {
    let is_border = |c: char| c.is_control() || "\"'<>=;,()[]{}@".contains(c);
    let mut names = Vec::new();
    for word in text.split(is_border).map(str::trim) {
        let name = word.strip_prefix("res://").unwrap_or(word).to_owned();
        let is_picture = PICTURES.contains(&extensions::of_name(&name).as_str());
        if is_picture && name.len() < 256 && !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_found_in_the_texts_of_engines() {
        let urho = r#"<material><texture unit="diffuse" name="Textures/Lid/Colour.jpg" /></material>"#;
        assert_eq!(pictures(urho), ["Textures/Lid/Colour.jpg"]);
        let godot = "[ext_resource type=\"Texture2D\" path=\"res://lid/colour.png\" id=\"1\"]\n";
        assert_eq!(pictures(godot), ["lid/colour.png"]);
        let source = "Layer0\n{\n\tTextureColor \"materials/lid.tga\"\n\tTextureNormal \"materials/lid.tga\"";
        assert_eq!(pictures(source), ["materials/lid.tga"]);
    }
}
