//! Materials as MaterialX: a document with an `open_pbr_surface`, and a new folder of its pictures beside it.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use svbrdf_core::material::{Depth, Material};
use svbrdf_core::progress::Progress;

use super::maps::{MapEncoding, WrittenMap};
use super::picture_exr;
use super::png::{self, FolderPicture, picture};
use super::surface::{Surface, SurfaceForm};
use crate::disk::{atomic, new_folder};
use crate::error::Error;

/// The end of the name of the folder of pictures.
const FOLDER: &str = "_textures";

/// Writes the pictures, then the document: while it is not there, nothing leads to them. A document that is there is replaced,
/// a folder is not.
///
/// # Errors
/// [`Error::Unwritable`], [`Cancelled`](Error::is_cancelled).
pub(super) fn write(
    path: &Path,
    material: &Material<f32>,
    surface: &Surface,
    depth: Depth,
    progress: &Progress,
) -> Result<(), Error> {
    let folder = folder_of(path);
    let inputs = inputs(surface, depth);
    let text = document(reference(path, &folder)?, material.name(), surface, &inputs, depth);
    atomic::check_place(path)?;
    let filled = new_folder::new_folder(&folder, progress, |temporary| {
        inputs.par_iter().try_for_each(|input| {
            let name = temporary.join(file_name(input.picture.name, depth));
            new_folder::new_file(&name, progress, |file| match depth {
                Depth::Eight | Depth::Sixteen => {
                    png::one(file, material, &input.picture, depth == Depth::Sixteen, progress)
                }
                Depth::Half | Depth::Float => {
                    picture_exr::write(file, material, &input.picture, depth == Depth::Half, progress)
                }
            })
        })
    });
    let remedy = "remove the folder, or name another .mtlx in a folder that is writable";
    filled.map_err(|source| Error::unwritten(&folder, source, remedy, progress))?;
    atomic::write_text(path, &text, progress).inspect_err(|_| {
        // It is new, and nothing leads to it.
        let _ = fs::remove_dir_all(&folder);
    })
}

/// `brick_textures` beside `brick.mtlx`.
fn folder_of(path: &Path) -> PathBuf {
    let mut name = OsString::from(path.file_stem().unwrap_or_default());
    name.push(FOLDER);
    path.with_file_name(name)
}

fn file_name(picture: &str, depth: Depth) -> String {
    let extension = if matches!(depth, Depth::Half | Depth::Float) { "exr" } else { "png" };
    format!("{picture}.{extension}")
}

/// A picture, and the input of the surface that it is for.
struct TextureInput {
    name: &'static str,
    kind: &'static str,
    picture: FolderPicture<'static>,
}

/// The inputs in the order of the document.
fn inputs(surface: &Surface, depth: Depth) -> Vec<TextureInput> {
    let encoding = match depth {
        Depth::Half | Depth::Float => MapEncoding::LINEAR,
        Depth::Eight | Depth::Sixteen => MapEncoding::SRGB,
    };
    let input = |name, kind, file, map| TextureInput { name, kind, picture: picture(file, map, encoding) };
    let scale = surface.scale(depth);
    let (base, weight, tint) =
        (WrittenMap::Base, WrittenMap::SpecularWeight(scale), WrittenMap::SpecularTint(scale));
    let mut inputs = match surface.form {
        SurfaceForm::Metallic => vec![
            input("base_color", "color3", "base_color", base),
            input("base_metalness", "float", "metalness", WrittenMap::Metallic),
        ],
        SurfaceForm::Specular { .. } => vec![
            input("base_color", "color3", "base_color", WrittenMap::Diffuse),
            input("specular_weight", "float", "specular_weight", weight),
            input("specular_color", "color3", "specular_color", tint),
        ],
    };
    inputs.push(input("specular_roughness", "float", "roughness", WrittenMap::Roughness));
    inputs.push(input("geometry_normal", "vector3", "normal", WrittenMap::Normal));
    inputs
}

/// The name of the folder in a document.
///
/// # Errors
/// [`Error::Unwritable`] where XML cannot hold it.
fn reference<'a>(path: &Path, folder: &'a Path) -> Result<&'a str, Error> {
    let name = folder.file_name().and_then(|name| name.to_str()).filter(|name| !has_controls(name));
    name.ok_or_else(|| Error::Unwritable {
        path: path.to_owned(),
        source: io::Error::new(io::ErrorKind::InvalidInput, "XML cannot hold its name"),
        remedy: "give it a name of printable Unicode characters",
    })
}

/// The text of a document whose pictures are in `folder`.
fn document(folder: &str, name: &str, surface: &Surface, inputs: &[TextureInput], depth: Depth) -> String {
    let name = identifier(name);
    let nodes: String = inputs.iter().map(|input| nodes(folder, input, depth)).collect();
    let mut bound = String::new();
    for TextureInput { name: input, kind, .. } in inputs {
        bound += &format!(
            "    <input name=\"{input}\" type=\"{kind}\" nodegraph=\"{name}_maps\" output=\"{input}\" />\n"
        );
    }
    if let SurfaceForm::Specular { ior } = surface.form {
        bound += &format!("    <input name=\"specular_ior\" type=\"float\" value=\"{ior}\" />\n");
    }
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<materialx version="1.39" colorspace="lin_rec709">
  <nodegraph name="{name}_maps">
{nodes}  </nodegraph>
  <open_pbr_surface name="{name}" type="surfaceshader">
{bound}  </open_pbr_surface>
  <surfacematerial name="{name}_material" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="{name}" />
  </surfacematerial>
</materialx>
"#
    )
}

/// The nodes of an input: its picture, of normals their decoding, and the output of the graph.
fn nodes(folder: &str, TextureInput { name, kind, picture }: &TextureInput, depth: Depth) -> String {
    let file = escaped(&format!("{folder}/{}", file_name(picture.name, depth)));
    let is_encoded = *kind == "color3" && matches!(depth, Depth::Eight | Depth::Sixteen);
    let space = if is_encoded { r#" colorspace="srgb_texture""# } else { "" };
    let image = format!(
        r#"    <image name="{name}_image" type="{kind}">
      <input name="file" type="filename" value="{file}"{space} />
    </image>
"#
    );
    let (decoded, last) = match *name {
        "geometry_normal" => (
            format!(
                r#"    <normalmap name="{name}_map" type="vector3">
      <input name="in" type="vector3" nodename="{name}_image" />
    </normalmap>
"#
            ),
            "map",
        ),
        _ => (String::new(), "image"),
    };
    format!("{image}{decoded}    <output name=\"{name}\" type=\"{kind}\" nodename=\"{name}_{last}\" />\n")
}

/// The name as MaterialX has them: letters, digits and `_`, no digit first.
fn identifier(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let name: String = name.chars().map(plain).collect();
    if name.starts_with(|c: char| !c.is_ascii_digit()) { name } else { format!("_{name}") }
}

fn has_controls(name: &str) -> bool {
    name.chars().any(|c| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}'))
}

/// The text as XML, for quoted attributes.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_and_materials_are_data() {
        assert_eq!(escaped("a & b\"<c>"), "a &amp; b&quot;&lt;c&gt;");
        assert_eq!(identifier("1 brick/rauh-ß"), "_1_brick_rauh__");
        assert_eq!(identifier(""), "_");
        assert!(has_controls("a\nb") && !has_controls("a b"));
        assert_eq!(folder_of(Path::new("out/brick.v2.mtlx")), Path::new("out/brick.v2_textures"));
    }
}
