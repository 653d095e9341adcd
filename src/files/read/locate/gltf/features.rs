//! Features of a glTF material: its textures, how they are placed, and extensions that are not modelled.

use gltf::json::{Material, Value};

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
    ("KHR_materials_emissive_strength", "emission", None),
    ("KHR_materials_unlit", "an unlit look", None),
];

/// The material as the file declares it.
fn json(material: &Material) -> Value {
    serde_json::to_value(material).unwrap_or_default()
}

/// The textures that are read of a material, with where they are.
pub(super) fn textures(material: &Material) -> Vec<(String, Value)> {
    let json = json(material);
    let at = |path: &[&str]| path.iter().try_fold(&json, |value, key| value.get(key)).cloned();
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
pub(super) fn transforms_differ(material: &Material) -> Option<String> {
    let textures = textures(material);
    let (first, others) = textures.split_first()?;
    let other = others.iter().find(|other| transform(&other.1) != transform(&first.1))?;
    Some(format!(
        "expected one KHR_texture_transform for all maps, found different ones for {} and {}",
        first.0, other.0
    ))
}

/// Offset, rotation and scale of a texture; of 32 bits, since the library keeps some of them so.
fn transform(texture: &Value) -> [f32; 5] {
    let declared = texture.get("extensions").and_then(|all| all.get("KHR_texture_transform"));
    let number = |value: Option<&Value>, usual: f64| value.and_then(Value::as_f64).unwrap_or(usual) as f32;
    let of = |key: &str, index: usize| declared.and_then(|all| all.get(key)?.get(index));
    let rotation = number(declared.and_then(|all| all.get("rotation")), 0.0);
    let [u, v] = [0, 1].map(|index| number(of("offset", index), 0.0));
    let [across, down] = [0, 1].map(|index| number(of("scale", index), 1.0));
    [u, v, rotation, across, down]
}

/// The features of the material that change its look and are not modelled, by name.
pub(super) fn ignored(material: &Material) -> impl Iterator<Item = String> + use<> {
    let json = json(material);
    NOT_MODELLED.into_iter().filter_map(move |(extension, name, factor)| {
        let declared = json.get("extensions")?.get(extension)?;
        let is_off =
            factor.is_some_and(|factor| declared.get(factor).and_then(Value::as_f64).unwrap_or(0.0) == 0.0);
        (!is_off).then(|| format!("{name} ({extension})"))
    })
}
