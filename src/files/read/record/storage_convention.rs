//! Conventions that files of materials follow.

use std::fmt;

/// A convention that files follow, by their format, names or layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StorageConvention {
    /// This program wrote the file.
    Native,
    /// This program wrote the file, with its encoding in a text chunk.
    NativeText,
    Floats,
    SeparateColours,
    MtlColours,
    DeschaintreOrder,
    MaterialGanOrder,
    MatFusionOrder,
    SvbrdfEvaluationOrder,
    PackedNormals,
    DiffMatNames,
    MaterialGanNames,
    NumberedResults,
    GammadNames,
    DeschaintreNames,
    SurfaceNetFolder,
    Gltf,
    /// The exporter of Microsoft Flight Simulator.
    AsoboNormals,
    MaterialXNormals,
    MaterialXSurface,
    /// The file lists its textures.
    ListedTextures,
    /// Minecraft does not define where y of its normals points.
    TextureSetNormals,
    /// The file lists its textures, and none of normals.
    NoListedNormals,
    LayerNames,
    RoughnessName,
    NvdiffrecPacking,
    /// Specular and glossiness in one picture.
    SpecularGlossiness,
    /// The built-in materials.
    BuiltIn,
}

impl fmt::Display for StorageConvention {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Native => "svbrdf wrote the file",
            Self::NativeText => "svbrdf wrote the file, with its encoding",
            Self::Floats => "floats are linear",
            Self::SeparateColours => "colours in separate files are sRGB by convention",
            Self::MtlColours => "colours of an .mtl are sRGB by convention",
            Self::DeschaintreOrder => "Deschaintre et al. store this order in this way",
            Self::MaterialGanOrder => "MaterialGAN and its successors store this order in this way",
            Self::MatFusionOrder => "MatFusion stores this order in this way",
            Self::SvbrdfEvaluationOrder => "svbrdf-evaluation appears to store this order in this way",
            Self::PackedNormals => "all known sources of packed maps do this",
            Self::DiffMatNames => "DiffMat writes these names and depths, with y down by default",
            Self::MaterialGanNames => "MaterialGAN and its successors use these names and this encoding",
            Self::NumberedResults => "the results of Deschaintre et al. 2020 are numbered in this way",
            Self::GammadNames => "the names contain gammad",
            Self::DeschaintreNames => "the networks of Deschaintre et al. write these names, linear",
            Self::SurfaceNetFolder => "the data sets of SurfaceNet look like this, and are linear",
            Self::AsoboNormals => "the file declares DirectX by ASOBO_normal_map_convention",
            Self::Gltf => "the specification of glTF 2.0 defines it",
            Self::MaterialXSurface => "computed as the specification of the surface defines it",
            Self::MaterialXNormals => "MaterialX defines normals in this way",
            Self::ListedTextures => "the file lists its textures",
            Self::TextureSetNormals => "Minecraft does not define it, and most maps point up",
            Self::NoListedNormals => "the file lists its textures, and none of normals; the surface is flat",
            Self::LayerNames => "the names of the layers name the maps",
            Self::RoughnessName => "the map is named roughness",
            Self::NvdiffrecPacking => "nvdiffrec writes it beside map_Kd",
            Self::SpecularGlossiness => "glTF defines it for specular and glossiness",
            Self::BuiltIn => "the built-in materials are stored in this way",
        })
    }
}
