//! Vertex colours of the meshes of a glTF, which multiply the base colour of their material (glTF 2.0, 3.9.2).

use gltf::json::Value;

use super::document::array;
use super::textures::GltfFile;

/// Whether a primitive with material number `material` has colours other than white, or such that cannot be read.
pub(super) fn has(file: &GltfFile, material: usize) -> bool {
    let number = |value: Option<&Value>| value.and_then(Value::as_u64).and_then(|n| usize::try_from(n).ok());
    let primitives = array(&file.declared, "meshes").iter().flat_map(|mesh| array(mesh, "primitives"));
    let of_material = primitives.filter(|primitive| number(primitive.get("material")) == Some(material));
    let mut accessors: Vec<usize> =
        of_material.filter_map(|primitive| number(primitive.pointer("/attributes/COLOR_0"))).collect();
    accessors.sort_unstable();
    accessors.dedup();
    let all = array(&file.declared, "accessors");
    accessors.into_iter().any(|index| !all.get(index).and_then(|one| is_white(file, one)).unwrap_or(false))
}

/// Whether red, green and blue of an accessor are 1 everywhere; `None` where its values cannot be read.
fn is_white(file: &GltfFile, accessor: &Value) -> Option<bool> {
    let number = |name: &str| accessor.get(name).and_then(Value::as_u64);
    let bound = |name: &str| -> Option<Vec<f64>> {
        accessor.get(name)?.as_array()?.iter().take(3).map(Value::as_f64).collect()
    };
    let (bytes, one): (usize, &[u8]) = match number("componentType")? {
        5126 => (4, &[0, 0, 128, 63]),
        5123 => (2, &[255; 2]),
        5121 => (1, &[255]),
        _ => return None,
    };
    let white = if bytes == 4 { 1.0 } else { f64::from((1_u32 << (8 * bytes)) - 1) };
    if accessor.get("sparse").is_some() {
        return None;
    }
    if let (Some(least), Some(most)) = (bound("min"), bound("max")) {
        return Some(least.iter().chain(&most).all(|value| (value - white).abs() < 1e-6));
    }
    let channels = match accessor.get("type")?.as_str()? {
        "VEC3" => 3,
        "VEC4" => 4,
        _ => return None,
    };
    let size = |value: Option<u64>| usize::try_from(value.unwrap_or(0)).ok();
    let view = file.document.views().nth(usize::try_from(number("bufferView")?).ok()?)?;
    let stride = view.stride().unwrap_or(channels * bytes);
    let data = file.view(&view).ok()??;
    let (from, count) = (size(number("byteOffset"))?, size(number("count"))?);
    let mut whites = (0..count).map(|index| {
        let place = index.checked_mul(stride)?.checked_add(from)?;
        let rgb = data.get(place..place.checked_add(3 * bytes)?)?;
        Some(rgb.chunks(bytes).all(|value| value == one))
    });
    whites.try_fold(true, |all, white| Some(all && white?))
}
