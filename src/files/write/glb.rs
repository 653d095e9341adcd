//! Materials as binary glTF 2.0: a plane of the size of the material, its pictures within the file.

use std::borrow::Cow;
use std::io::{self, Write};

use gltf::Glb;
use gltf::binary::Header;
use rayon::prelude::*;
use serde_json::{Value, json};

use svbrdf_core::material::{Depth, Material};
use svbrdf_core::progress::Progress;

use super::maps::{MapEncoding, WrittenMap};
use super::png::{self, FolderPicture, picture};
use super::surface::{Surface, SurfaceForm, USUAL_IOR};
use crate::disk::atomic::SOFTWARE;

/// The target of a buffer view with attributes of vertices.
const ARRAY_BUFFER: u32 = 34_962;
/// The target of a buffer view with indices.
const ELEMENT_ARRAY_BUFFER: u32 = 34_963;
const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;

pub(super) fn write(
    file: impl Write,
    material: &Material<f32>,
    surface: &Surface,
    depth: Depth,
    progress: &Progress,
) -> io::Result<()> {
    let pictures = pictures(surface, depth);
    let encoded = |picture: &FolderPicture<'_>| {
        let mut bytes = Vec::new();
        png::one(&mut bytes, material, picture, depth == Depth::Sixteen, progress).map(|()| bytes)
    };
    let encoded = pictures.par_iter().map(encoded).collect::<io::Result<Vec<_>>>()?;
    let mut binary = Binary::default();
    let mesh = binary.plane(material.grid().half_extent());
    let images: Vec<Value> = pictures
        .iter()
        .zip(encoded)
        .map(|(picture, bytes)| {
            json!({"name": picture.name, "mimeType": "image/png", "bufferView": binary.view(&bytes, None)})
        })
        .collect();
    let textures: Vec<Value> = (0..images.len()).map(|source| json!({"source": source})).collect();
    let (of_material, extensions) = material_of(material.name(), surface);
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
    write_parts(file, &document, &binary.bytes)
}

/// The two parts of a binary glTF.
fn write_parts(file: impl Write, document: &Value, binary: &[u8]) -> io::Result<()> {
    let json = serde_json::to_vec(document)?;
    // Header and padding of the file and of its two parts.
    const FRAME: usize = 40;
    let length = u32::try_from(json.len().saturating_add(binary.len()).saturating_add(FRAME))
        .map_err(|_| io::Error::other("a .glb holds at most 4 GiB"))?;
    let header = Header { magic: *b"glTF", version: 2, length };
    let glb = Glb { header, json: Cow::Owned(json), bin: Some(Cow::Borrowed(binary)) };
    glb.to_writer(file).map_err(io::Error::other)
}

/// The pictures in the order of the textures in [`material_of`].
fn pictures(surface: &Surface, depth: Depth) -> Vec<FolderPicture<'static>> {
    let of = |name, map| picture(name, map, MapEncoding::SRGB);
    let normal = of("normal", WrittenMap::Normal);
    match surface.form {
        SurfaceForm::Metallic => {
            vec![of("base colour", WrittenMap::Base), of("roughness and metallic", WrittenMap::Orm), normal]
        }
        SurfaceForm::Specular { .. } => vec![
            of("diffuse", WrittenMap::Diffuse),
            of("roughness", WrittenMap::Roughness),
            normal,
            of("specular", WrittenMap::SpecularTint(surface.scale(depth))),
        ],
    }
}

/// The material, and the extensions that it uses.
fn material_of(name: &str, surface: &Surface) -> (Value, Vec<&'static str>) {
    let [base, roughness, normal] = [0, 1, 2].map(|index| json!({"index": index}));
    let mut textured = json!({"baseColorTexture": base, "metallicRoughnessTexture": roughness});
    let SurfaceForm::Specular { ior } = surface.form else {
        return (
            json!({"name": name, "pbrMetallicRoughness": textured, "normalTexture": normal}),
            Vec::new(),
        );
    };
    textured["metallicFactor"] = json!(0.0);
    let mut extensions = json!({"KHR_materials_specular": {"specularColorTexture": {"index": 3}}});
    let mut used = vec!["KHR_materials_specular"];
    if ior != USUAL_IOR {
        extensions["KHR_materials_ior"] = json!({"ior": ior});
        used.push("KHR_materials_ior");
    }
    let material = json!({
        "name": name,
        "pbrMetallicRoughness": textured,
        "normalTexture": normal,
        "extensions": extensions,
    });
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
