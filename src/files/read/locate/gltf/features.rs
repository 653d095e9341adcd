//! Features of a glTF material: its textures, how they are placed, and extensions that are not modelled.

use gltf::json::Value;

use super::textures::SOURCES;

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

/// Extensions that are read, or that emission shows.
const READ: [&str; 5] = [
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_emissive_strength",
    "KHR_texture_transform",
];

/// The textures that are read of a material, with where they are.
pub(super) fn textures(json: &Value) -> Vec<(String, Value)> {
    let at = |path: &[&str]| path.iter().try_fold(json, |value, key| value.get(key)).cloned();
    let gloss = ["extensions", "KHR_materials_pbrSpecularGlossiness"];
    let specular = ["extensions", "KHR_materials_specular"];
    let rough = ["pbrMetallicRoughness", ""];
    let places: Vec<[&str; 3]> = if at(&gloss).is_some() {
        ["diffuseTexture", "specularGlossinessTexture"].map(|name| [gloss[0], gloss[1], name]).to_vec()
    } else {
        let base = ["baseColorTexture", "metallicRoughnessTexture"].map(|name| [rough[0], name, ""]);
        let more = ["specularTexture", "specularColorTexture"].map(|name| [specular[0], specular[1], name]);
        base.into_iter().chain(more).collect()
    };
    let places = places.into_iter().chain([["normalTexture", "", ""]]);
    let texture = |place: [&str; 3]| {
        let keys: Vec<&str> = place.into_iter().filter(|key| !key.is_empty()).collect();
        Some(((*keys.last()?).to_owned(), at(&keys).filter(Value::is_object)?))
    };
    places.filter_map(texture).collect()
}

/// The problem where textures are placed differently: then the maps do not lie over one another.
pub(super) fn transforms_differ(material: &Value) -> Option<String> {
    let textures = textures(material);
    let (first, others) = textures.split_first()?;
    let other = others.iter().find(|other| !is_same(transform(&other.1), transform(&first.1)))?;
    Some(format!(
        "expected one KHR_texture_transform for all maps, found different ones for {} and {}",
        first.0, other.0
    ))
}

/// The textures of a material whose coordinates are not those of the first, by their sets: the maps may not lie over one another.
pub(super) fn unlike_coordinates(material: &Value) -> Option<String> {
    let set = |texture: &Value| {
        let transform = texture.pointer("/extensions/KHR_texture_transform/texCoord");
        transform.or(texture.get("texCoord")).and_then(Value::as_u64).unwrap_or(0)
    };
    let textures = textures(material);
    let (first, others) = textures.split_first()?;
    let other = others.iter().find(|other| set(&other.1) != set(&first.1))?;
    let named = |(name, texture): &(String, Value)| format!("TEXCOORD_{} of {name}", set(texture));
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
fn transform(texture: &Value) -> [f64; 5] {
    let declared = texture.get("extensions").and_then(|all| all.get("KHR_texture_transform"));
    let number = |value: Option<&Value>, usual: f64| value.and_then(Value::as_f64).unwrap_or(usual);
    let of = |key: &str, index: usize| declared.and_then(|all| all.get(key)?.get(index));
    let rotation = number(declared.and_then(|all| all.get("rotation")), 0.0);
    let [u, v] = [0, 1].map(|index| number(of("offset", index), 0.0));
    let [across, down] = [0, 1].map(|index| number(of("scale", index), 1.0));
    [u, v, rotation, across, down]
}

/// The features of the material that change its look and are not modelled, by name; `all` are the textures of the file.
pub(super) fn ignored(material: &Value, all: &[Value]) -> Vec<String> {
    let modelled = |(extension, declared): &(String, Value)| {
        let known = NOT_MODELLED.iter().find(|(name, ..)| name == extension);
        let Some((_, name, factor)) = known else {
            return is_unknown(extension).then(|| format!("an extension that is not known ({extension})"));
        };
        let is_off =
            factor.is_some_and(|factor| declared.get(factor).and_then(Value::as_f64).unwrap_or(0.0) == 0.0);
        (!is_off).then(|| format!("{name} ({extension})"))
    };
    let factor = material.get("emissiveFactor").and_then(Value::as_array);
    let is_emissive = factor.is_some_and(|rgb| rgb.iter().any(|value| value.as_f64() != Some(0.0)));
    let emission = is_emissive.then(|| "emission (emissiveFactor)".to_owned());
    let occlusion = material.get("occlusionTexture").map(|_| "occlusion (occlusionTexture)".to_owned());
    let mut names: Vec<_> = extensions(material, all).iter().filter_map(modelled).collect();
    names.extend(emission.into_iter().chain(occlusion));
    names.dedup();
    names
}

/// The first extension that is `required`, used by the material, and not known.
pub(super) fn unknown_required(material: &Value, all: &[Value], required: &[String]) -> Option<String> {
    let mut used = extensions(material, all).into_iter().map(|(name, _)| name);
    used.find(|name| required.contains(name) && (is_unknown(name) || name == "KHR_texture_procedurals"))
}

fn is_unknown(extension: &str) -> bool {
    let is_modelled = NOT_MODELLED.iter().any(|(name, ..)| *name == extension);
    !is_modelled && !READ.contains(&extension) && !SOURCES.contains(&extension)
}

/// The extensions of a material and of its textures, with what they declare, each once.
fn extensions(material: &Value, all: &[Value]) -> Vec<(String, Value)> {
    let infos = textures(material);
    let index = |info: &Value| usize::try_from(info.get("index")?.as_u64()?).ok();
    let sources = infos.iter().filter_map(|(_, info)| all.get(index(info)?));
    let places = [material].into_iter().chain(infos.iter().map(|(_, info)| info)).chain(sources);
    let declared = places.filter_map(|place| place.get("extensions")?.as_object()).flatten();
    let mut found: Vec<(String, Value)> = Vec::new();
    for (name, value) in declared {
        if found.iter().all(|(other, _)| other != name) {
            found.push((name.clone(), value.clone()));
        }
    }
    found
}
