//! MaterialX: the file textures of a `standard_surface` or a `gltf_pbr`.

use std::fs;
use std::path::{Path, PathBuf};

use roxmltree::{Document, Node};

use crate::error::Error;
use crate::files::read::assumption::{Assumption, Certainty, What};
use crate::files::read::decode;
use crate::files::read::locate::names::Role;
use crate::files::read::note::{Container, Note, Subject};
use crate::files::read::options::{Albedo, NormalY, ReadOptions};
use crate::files::read::reason::{Known, Reason};
use crate::files::read::storage_convention::StorageConvention;
use crate::files::read::stored::{Inferred, Pictures, StoredMap, StoredMaterial};
use crate::progress::Progress;

/// Deeper than any chain of nodes from an input to its picture.
const DEEPEST: usize = 32;
/// The inputs of the surfaces that are read, with the map that each is and its value where the file has none.
const INPUTS: [(&str, Role, f32); 7] = [
    ("base_color", Role::Base, 0.8),
    ("specular_roughness", Role::Roughness, 0.2),
    ("roughness", Role::Roughness, 1.0),
    ("metalness", Role::Metallic, 0.0),
    ("metallic", Role::Metallic, 1.0),
    ("normal", Role::Normal, 0.0),
    ("opacity", Role::Ignored, 1.0),
];

/// Reads surface number `exemplar` of the file `path`.
///
/// # Errors
/// As `read`.
pub fn open(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<StoredMaterial, Error> {
    let text = fs::read_to_string(path).map_err(|source| Error::unreadable(path, source))?;
    let document = Document::parse(&text).map_err(|e| Error::BadImage {
        path: path.to_owned(),
        problem: format!("expected MaterialX, found: {e}"),
        remedy: "export it again".to_owned(),
    })?;
    let is_surface = |n: &Node<'_, '_>| matches!(n.tag_name().name(), "standard_surface" | "gltf_pbr");
    let surfaces: Vec<_> = document.descendants().filter(is_surface).collect();
    let index = options.exemplar_of(surfaces.len(), path)?;
    let surface = *surfaces.get(index).ok_or_else(|| Error::NotAMaterial {
        path: path.to_owned(),
        expected: "a standard_surface or a gltf_pbr".to_owned(),
        found: "neither".to_owned(),
        remedy: "translate the material to one of them".to_owned(),
    })?;
    let mut pictures = Pictures::default();
    let mut albedo: Inferred<Albedo> = None;
    let gltf = surface.tag_name().name() == "gltf_pbr";
    let mine = |name: &str| {
        if gltf {
            !matches!(name, "specular_roughness" | "metalness")
        } else {
            !matches!(name, "roughness" | "metallic")
        }
    };
    progress.begin(INPUTS.len() as u64);
    for (name, role, usual) in INPUTS.into_iter().filter(|(name, ..)| mine(name)) {
        progress.step()?;
        let Some(bound) = bound(surface, name) else {
            if role != Role::Normal && role != Role::Ignored {
                pictures.add(role, StoredMap::constant(path, &[usual]));
            }
            continue;
        };
        if role == Role::Ignored {
            continue;
        }
        let (source, space) = match bound {
            Bound::Values(values) => (StoredMap::constant(path, &values), Some("lin_rec709".to_owned())),
            Bound::File { file, space, channel } => {
                let whole = decode::decode_one(&resolved(path, &file), Subject::Map(role))?.0;
                let raster = channel.map_or(whole.clone(), |c| whole.channel(c));
                (StoredMap { raster, file: resolved(path, &file), part: String::new() }, space)
            }
        };
        if role == Role::Base {
            albedo = space.as_deref().map(colour_space);
        }
        pictures.add(role, source);
    }
    let name = surface.attribute("name").unwrap_or("material").to_owned();
    let mut found = pictures.assemble(path, name, "", options)?;
    found.files.push(path.to_owned());
    found.files.sort();
    found.files.dedup();
    found.inferred.albedo = albedo;
    found.inferred.normal_y =
        Some((NormalY::Up, StorageConvention::MaterialXNormals.into(), Certainty::Likely));
    let layout =
        Assumption::new(What::Layout, "MaterialX", StorageConvention::ListedTextures, Certainty::Sure);
    found.assumptions.insert(0, layout);
    if surfaces.len() > 1 {
        found.notes.push(Note::Several { container: Container::MaterialX, count: surfaces.len(), index });
    }
    Ok(found)
}

/// What an input is bound to.
enum Bound {
    Values(Vec<f32>),
    /// A picture, its colour space where the file says it, and the one channel that is taken of it.
    File {
        file: String,
        space: Option<String>,
        channel: Option<usize>,
    },
}

/// What input `name` of `node` is bound to, directly or through nodes and graphs.
fn bound(node: Node<'_, '_>, name: &str) -> Option<Bound> {
    let input = node.children().find(|n| n.has_tag_name("input") && n.attribute("name") == Some(name))?;
    follow(input, None, DEEPEST)
}

fn follow(input: Node<'_, '_>, channel: Option<usize>, depth: usize) -> Option<Bound> {
    if depth == 0 {
        return None;
    }
    if let Some(value) = input.attribute("value") {
        let values: Vec<f32> = value.split(',').filter_map(|v| v.trim().parse().ok()).collect();
        return (!values.is_empty()).then_some(Bound::Values(values));
    }
    let root = input.document().root_element();
    let named = |scope: Node<'_, '_>, name: &str| {
        scope.children().find(|n| n.attribute("name") == Some(name)).map(|n| n.id())
    };
    let node = if let Some(graph) = input.attribute("nodegraph") {
        let graph = input.document().get_node(named(root, graph)?)?;
        let is_output = |n: &Node<'_, '_>| n.has_tag_name("output");
        let wanted = input.attribute("output");
        let output =
            graph.children().filter(is_output).find(|n| wanted.is_none() || n.attribute("name") == wanted)?;
        input.document().get_node(named(graph, output.attribute("nodename")?)?)?
    } else {
        let name = input.attribute("nodename")?;
        let scope = input.ancestors().skip(1).find_map(|scope| named(scope, name))?;
        input.document().get_node(scope)?
    };
    let channel = channel.or_else(|| channel_of(input.attribute("output").or(input.attribute("channels"))?));
    through(node, channel, depth - 1)
}

/// The picture that a node reads, or that of the input that it passes on.
fn through(node: Node<'_, '_>, channel: Option<usize>, depth: usize) -> Option<Bound> {
    let input =
        |name: &str| node.children().find(|n| n.has_tag_name("input") && n.attribute("name") == Some(name));
    if let Some(file) = input("file") {
        let inherited = |name: &str| file.ancestors().find_map(|n| n.attribute(name)).map(str::to_owned);
        let name = inherited("fileprefix").unwrap_or_default() + file.attribute("value")?;
        return Some(Bound::File { file: name, space: inherited("colorspace"), channel });
    }
    let index =
        node.children().find(|n| n.attribute("name") == Some("index")).and_then(|n| n.attribute("value"));
    let channel = channel.or(index.and_then(|i| i.parse().ok()));
    follow(input("in").or_else(|| input("in1"))?, channel, depth)
}

/// Output `outg` or channels `g` is channel 1.
fn channel_of(output: &str) -> Option<usize> {
    match output {
        "outr" | "r" | "x" | "outx" => Some(0),
        "outg" | "g" | "y" | "outy" => Some(1),
        "outb" | "b" | "z" | "outz" => Some(2),
        _ => None,
    }
}

fn colour_space(space: &str) -> (Albedo, Reason, Certainty) {
    let (albedo, known, certainty) = match space {
        "srgb_texture" | "srgb" => (Albedo::Srgb, Known::Exactly, Certainty::Sure),
        "lin_rec709" | "none" | "raw" => (Albedo::Linear, Known::Exactly, Certainty::Sure),
        "gamma22" | "g22_rec709" => (Albedo::Gamma22, Known::Exactly, Certainty::Sure),
        "gamma18" | "gamma24" => (Albedo::Gamma22, Known::Nearly, Certainty::Unsure),
        _ => (Albedo::Linear, Known::Unknown, Certainty::Unsure),
    };
    (albedo, Reason::ColourSpace { space: space.to_owned(), known }, certainty)
}

/// A file beside the document, or a path of its own.
fn resolved(path: &Path, file: &str) -> PathBuf {
    let prefix = path.parent().unwrap_or(Path::new(""));
    prefix.join(file)
}
