//! Features of a glTF material that are not modelled: how its textures are placed, extensions, and vertex colours.

use serde_json::{Map, Value};

use super::document::{GltfDocument, SOURCES, array};
use super::material::{GltfMaterial, TextureInfo};
use crate::read::options::Role;

/// Extensions that change the look and are not modelled. Each has a factor whose 0 turns it off, where it has one.
const NOT_MODELLED: [(&str, &str, Option<&str>); 11] = [
    ("KHR_materials_clearcoat", "a clear coat", Some("clearcoatFactor")),
    ("KHR_materials_transmission", "transmission", Some("transmissionFactor")),
    ("KHR_materials_diffuse_transmission", "diffuse transmission", Some("diffuseTransmissionFactor")),
    ("KHR_materials_sheen", "sheen", None),
    ("KHR_materials_anisotropy", "anisotropy", Some("anisotropyStrength")),
    ("KHR_materials_iridescence", "iridescence", Some("iridescenceFactor")),
    ("KHR_materials_volume", "a volume", Some("thicknessFactor")),
    ("KHR_materials_dispersion", "dispersion", Some("dispersion")),
    ("KHR_materials_subsurface", "subsurface scattering", None),
    ("KHR_materials_unlit", "an unlit look", None),
    ("KHR_texture_procedurals", "a procedural texture, of which the fallback is read", None),
];

/// Other extensions that are read, or that emission shows.
const READ: [&str; 2] = ["KHR_materials_emissive_strength", "KHR_texture_transform"];

/// The problem where textures are placed differently: then the maps do not lie over one another.
pub(super) fn transforms_differ(material: &GltfMaterial) -> Option<String> {
    let textures = material.textures();
    let (first, others) = textures.split_first()?;
    let other = others.iter().find(|other| !is_same(transform(other.2), transform(first.2)))?;
    Some(format!(
        "expected one KHR_texture_transform for all maps, found different ones for {} and {}",
        first.0, other.0
    ))
}

/// The textures of a material whose coordinates are not those of the first, by their sets: the maps may not lie over one another.
fn unlike_coordinates(material: &GltfMaterial) -> Option<String> {
    let set = |texture: &TextureInfo| {
        let transform = texture.extensions.get("KHR_texture_transform");
        transform.and_then(|all| all.get("texCoord")?.as_u64()).unwrap_or(texture.tex_coord)
    };
    let textures = material.textures();
    let (first, others) = textures.split_first()?;
    let other = others.iter().find(|other| set(other.2) != set(first.2))?;
    let named =
        |(name, _, texture): &(&str, Role, &TextureInfo)| format!("TEXCOORD_{} of {name}", set(texture));
    Some(format!(
        "coordinates of different sets ({}, {}): the maps are read as if both were one",
        named(first),
        named(other)
    ))
}

/// Whether two transforms place textures alike: but for rounding, whole turns, and whole tiles, which repeat.
fn is_same(a: [f64; 5], b: [f64; 5]) -> bool {
    const ROUNDING: f64 = 1e-6;
    let periods = [1.0, 1.0, std::f64::consts::TAU, f64::INFINITY, f64::INFINITY];
    a.into_iter().zip(b).zip(periods).all(|((a, b), period)| {
        let difference = (a - b).abs();
        let rest = if period.is_finite() { difference % period } else { difference };
        rest.min(period - rest) < ROUNDING
    })
}

/// Offset, rotation and scale of a texture.
fn transform(texture: &TextureInfo) -> [f64; 5] {
    let declared = texture.extensions.get("KHR_texture_transform");
    let number = |value: Option<&Value>, usual: f64| value.and_then(Value::as_f64).unwrap_or(usual);
    let of = |key: &str, index: usize| declared.and_then(|all| all.get(key)?.get(index));
    let rotation = number(declared.and_then(|all| all.get("rotation")), 0.0);
    let [u, v] = [0, 1].map(|index| number(of("offset", index), 0.0));
    let [across, down] = [0, 1].map(|index| number(of("scale", index), 1.0));
    [u, v, rotation, across, down]
}

/// The features of material number `index` that change its look and are not modelled, by name.
pub(super) fn ignored(file: &GltfDocument, index: usize) -> Vec<String> {
    let material = &file.materials[index];
    let modelled = |(extension, declared): (&String, &Value)| {
        let known = NOT_MODELLED.iter().find(|(name, ..)| name == extension);
        let Some((_, name, factor)) = known else {
            return is_unknown(extension).then(|| format!("an extension that is not known ({extension})"));
        };
        let is_off =
            factor.is_some_and(|factor| declared.get(factor).and_then(Value::as_f64).unwrap_or(0.0) == 0.0);
        (!is_off).then(|| format!("{name} ({extension})"))
    };
    let is_emissive = material.emissive_factor != [0.0; 3];
    let emission = is_emissive.then(|| "emission (emissiveFactor)".to_owned());
    let occlusion = material.occlusion_texture.as_ref().map(|_| "occlusion (occlusionTexture)".to_owned());
    let mut names: Vec<_> = extensions(file, material).into_iter().filter_map(modelled).collect();
    names.extend(emission.into_iter().chain(occlusion));
    names.dedup();
    if has_vertex_colours(file, index) {
        names.push(
            "vertex colours (COLOR_0), which multiply the base colour unless they are white".to_owned(),
        );
    }
    names.extend(unlike_coordinates(material));
    names
}

/// The first extension that the file requires, that the material uses, and that is not known.
pub(super) fn unknown_required(file: &GltfDocument, material: &GltfMaterial) -> Option<String> {
    let required = file.array("extensionsRequired");
    let mut used = extensions(file, material).into_iter().map(|(name, _)| name);
    let is_required = |name: &str| required.iter().any(|one| one.as_str() == Some(name));
    used.find(|name| is_required(name) && (is_unknown(name) || *name == "KHR_texture_procedurals")).cloned()
}

fn is_unknown(extension: &str) -> bool {
    let is_modelled = NOT_MODELLED.iter().any(|(name, ..)| *name == extension);
    !is_modelled && !READ.contains(&extension) && !SOURCES.contains(&extension)
}

/// The extensions of a material and of its textures, with what they declare, each once; without those of factors that are read.
fn extensions<'a>(file: &'a GltfDocument, material: &'a GltfMaterial) -> Vec<(&'a String, &'a Value)> {
    let infos = material.textures();
    let sources = infos.iter().filter_map(|(.., info)| file.extensions_of(info.index));
    let places =
        [&material.extensions.others].into_iter().chain(infos.iter().map(|(.., info)| &info.extensions));
    let mut found: Vec<(&String, &Value)> = Vec::new();
    for (name, value) in places.chain(sources).flat_map(Map::iter) {
        if found.iter().all(|(other, _)| *other != name) {
            found.push((name, value));
        }
    }
    found
}

/// Whether a primitive with material number `material` has colours of its vertices (glTF 2.0, 3.9.2).
fn has_vertex_colours(file: &GltfDocument, material: usize) -> bool {
    let primitives = file.array("meshes").iter().flat_map(|mesh| array(mesh, "primitives"));
    let is_of_material =
        |primitive: &&Value| primitive.get("material").and_then(Value::as_u64) == Some(material as u64);
    primitives.filter(is_of_material).any(|primitive| primitive.pointer("/attributes/COLOR_0").is_some())
}
