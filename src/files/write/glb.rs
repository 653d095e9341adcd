//! Materials as binary glTF 2.0: a plane of the size of the material, its pictures within the file.
//!
//! Diffuse and specular become base colour and metallic where these keep them to a step of 8 bits, since every program reads them;
//! else diffuse is the base colour, and `KHR_materials_specular` has specular as a part of the reflectance at an index of refraction.

use std::io::{self, Write};

use rayon::prelude::*;
use serde_json::{Value, json};

use svbrdf_core::material::{DIELECTRIC, Material, Planes, base_and_metallic};
use svbrdf_core::progress::Progress;

use super::png::{self, NamedMap, WrittenMap, code};
use crate::disk::atomic::SOFTWARE;
use crate::read::Albedo;
use crate::read::options::transfer::{encoded, linear};

/// The index of refraction of the reflectance [`DIELECTRIC`].
const USUAL_IOR: f64 = 1.5;
/// The largest reflectance that an index is computed for: that of 2,000. Larger ones need indices without end.
const MOST_REFLECTANCE: f64 = 0.998;
/// The target of a buffer view with attributes of vertices.
const ARRAY_BUFFER: u32 = 34_962;
/// The target of a buffer view with indices.
const ELEMENT_ARRAY_BUFFER: u32 = 34_963;
const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;

/// The index of refraction whose reflectance specular is stored as a part of; `None` where base colour and metallic express the material.
pub(super) fn ior(material: &Material<f32>, sixteen: bool) -> Option<f64> {
    (!is_metallic(material, sixteen)).then(|| {
        let largest = material.planes().specular.iter().flatten().fold(0.0, |most: f32, s| most.max(*s));
        let root = f64::from(largest).clamp(DIELECTRIC, MOST_REFLECTANCE).sqrt();
        // In four decimals, as stored: 1.2 / 0.8 is not 1.5 to the last bit.
        ((1.0 + root) / (1.0 - root) * 1e4 - 1e-6).ceil() / 1e4
    })
}

/// Whether diffuse and specular change by at most a step of 8 bits in sRGB where they are read again from base colour and metallic.
fn is_metallic(material: &Material<f32>, sixteen: bool) -> bool {
    const STEP: u16 = 257;
    let top = if sixteen { u16::MAX } else { 255 };
    let stored = |value: f64, top: u16| code(encoded(value, Albedo::Srgb), top);
    let decoded: Vec<f64> =
        (0..=top).map(|code| linear(f64::from(code) / f64::from(top), Albedo::Srgb)).collect();
    let Planes { diffuse, specular, .. } = material.planes();
    (0..material.width() * material.height()).into_par_iter().all(|index| {
        let [d, s] = [diffuse, specular].map(|map| map.each_ref().map(|plane| f64::from(plane[index])));
        let (base, metallic) = base_and_metallic(d, s);
        let base = base.map(|b| decoded[usize::from(stored(b, top))]);
        let m = (f64::from(top) * metallic).round() / f64::from(top);
        let fine = |value: f64| stored(value.min(1.0), u16::MAX);
        let is_kept = |value: f64, of: f64| fine(value).abs_diff(fine(of)) <= STEP;
        (0..3).all(|c| {
            is_kept(base[c] * (1.0 - m), d[c]) && is_kept(DIELECTRIC * (1.0 - m) + base[c] * m, s[c])
        })
    })
}

/// Writes the material with the [`ior`] that its specular needs.
pub(super) fn write(
    mut file: impl Write,
    material: &Material<f32>,
    ior: Option<f64>,
    sixteen: bool,
    progress: &Progress,
) -> io::Result<()> {
    let pictures = pictures(ior);
    let encoded = |(_, map): &NamedMap| {
        let mut bytes = Vec::new();
        png::one(&mut bytes, material, *map, sixteen, progress).map(|()| bytes)
    };
    let encoded = pictures.par_iter().map(encoded).collect::<io::Result<Vec<_>>>()?;
    let mut binary = Binary::default();
    let mesh = binary.plane(material.grid().half_extent());
    let images: Vec<Value> = pictures
        .iter()
        .zip(encoded)
        .map(|((name, _), bytes)| {
            json!({"name": name, "mimeType": "image/png", "bufferView": binary.view(&bytes, None)})
        })
        .collect();
    let textures: Vec<Value> = (0..images.len()).map(|source| json!({"source": source})).collect();
    let (of_material, extensions) = material_of(material.name(), ior);
    let mut document = json!({
        "asset": {"version": "2.0", "generator": SOFTWARE},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": material.name(), "mesh": 0}],
        "meshes": [mesh],
        "materials": [of_material],
        "textures": textures,
        "images": images,
        "accessors": binary.accessors,
        "bufferViews": binary.views,
        "buffers": [{"byteLength": binary.bytes.len()}],
    });
    if !extensions.is_empty() {
        document["extensionsUsed"] = json!(extensions);
    }
    let json = serde_json::to_vec(&document)?;
    let parts = [(b"JSON", &json, b' '), (b"BIN\0", &binary.bytes, 0)];
    let padded = |bytes: &[u8]| bytes.len().next_multiple_of(4);
    let total = parts.iter().fold(12, |sum: usize, (_, bytes, _)| sum.saturating_add(8 + padded(bytes)));
    let total = u32::try_from(total).map_err(|_| io::Error::other("a .glb holds at most 4 GiB"))?;
    file.write_all([*b"glTF", 2_u32.to_le_bytes(), total.to_le_bytes()].as_flattened())?;
    for (kind, bytes, padding) in parts {
        let length = padded(bytes);
        file.write_all(&(length as u32).to_le_bytes())?;
        file.write_all(kind)?;
        file.write_all(bytes)?;
        file.write_all(&[padding; 3][..length - bytes.len()])?;
    }
    Ok(())
}

/// The pictures in the order of the textures in [`material_of`].
fn pictures(ior: Option<f64>) -> Vec<NamedMap> {
    let normal = ("normal", WrittenMap::Normal);
    match ior {
        None => vec![("base colour", WrittenMap::Base), ("roughness and metallic", WrittenMap::Orm), normal],
        Some(ior) => {
            let tint = WrittenMap::SpecularTint(((ior - 1.0) / (ior + 1.0)).powi(2));
            let roughness = ("roughness", WrittenMap::Roughness);
            vec![("diffuse", WrittenMap::Diffuse), roughness, normal, ("specular", tint)]
        }
    }
}

/// The material, and the extensions that it uses.
fn material_of(name: &str, ior: Option<f64>) -> (Value, Vec<&'static str>) {
    let [base, roughness, normal] = [0, 1, 2].map(|index| json!({"index": index}));
    let textured = json!({"baseColorTexture": base, "metallicRoughnessTexture": roughness});
    let mut material = json!({"name": name, "pbrMetallicRoughness": textured, "normalTexture": normal});
    let mut used = Vec::new();
    if let Some(ior) = ior {
        material["pbrMetallicRoughness"]["metallicFactor"] = json!(0.0);
        // The extension scales the reflectance by the tint and leaves that at grazing angles 1, as here.
        material["extensions"] = json!({"KHR_materials_specular": {"specularColorTexture": {"index": 3}}});
        used.push("KHR_materials_specular");
        if ior != USUAL_IOR {
            material["extensions"]["KHR_materials_ior"] = json!({"ior": ior});
            used.push("KHR_materials_ior");
        }
    }
    (material, used)
}

/// The binary part, with what leads into it.
#[derive(Default)]
struct Binary {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Binary {
    /// Adds a view of these bytes; returns its number. Views begin at multiples of 4.
    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut view = json!({"buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len()});
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.bytes.extend_from_slice(bytes);
        self.views.push(view);
        self.views.len() - 1
    }

    /// Adds an accessor of `N` numbers for each vertex; returns its number.
    fn attribute<const N: usize>(&mut self, vertices: &[[f32; N]; 4]) -> usize {
        let bytes: Vec<u8> = vertices.as_flattened().iter().flat_map(|number| number.to_le_bytes()).collect();
        let bound = |of: fn(f32, f32) -> f32| -> Vec<f32> {
            (0..N).map(|c| vertices[1..].iter().fold(vertices[0][c], |bound, v| of(bound, v[c]))).collect()
        };
        let accessor = json!({
            "bufferView": self.view(&bytes, Some(ARRAY_BUFFER)), "componentType": FLOAT, "count": 4,
            "type": format!("VEC{N}"), "min": bound(f32::min), "max": bound(f32::max),
        });
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Adds the plane z = 0 with material 0: x to the right, y up, row 0 of the pictures on top. Returns the mesh.
    fn plane(&mut self, [x, y]: [f32; 2]) -> Value {
        let position = self.attribute(&[[-x, -y, 0.0], [x, -y, 0.0], [x, y, 0.0], [-x, y, 0.0]]);
        let normal = self.attribute(&[[0.0, 0.0, 1.0]; 4]);
        // The bitangent, normal x tangent, points up, as y of the normals does.
        let tangent = self.attribute(&[[1.0, 0.0, 0.0, 1.0]; 4]);
        let coordinates = self.attribute(&[[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]);
        let indices: Vec<u8> = [0_u16, 1, 2, 0, 2, 3].into_iter().flat_map(u16::to_le_bytes).collect();
        let view = self.view(&indices, Some(ELEMENT_ARRAY_BUFFER));
        self.accessors
            .push(json!({"bufferView": view, "componentType": UNSIGNED_SHORT, "count": 6, "type": "SCALAR"}));
        let attributes = json!({
            "POSITION": position, "NORMAL": normal, "TANGENT": tangent, "TEXCOORD_0": coordinates,
        });
        json!({"primitives": [{
            "attributes": attributes, "indices": self.accessors.len() - 1, "material": 0,
        }]})
    }
}
