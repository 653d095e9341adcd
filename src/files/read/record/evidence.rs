//! Evidence for or against linear colours, and conventions that files of materials follow.

use derive_more::Display;

/// One piece of evidence for or against linear colours.
#[derive(Clone, Copy, Debug, PartialEq, Display)]
pub enum Evidence {
    #[display("colours of integers are encoded by convention")]
    Prior,
    /// Sets of diffuse, specular and roughness.
    #[display(
        "colours of integers are encoded by convention, but some research codes store diffuse and specular linear"
    )]
    Research,
    #[display("JPEG holds encoded colours")]
    Jpeg,
    /// Share of the texels.
    #[display("specular is near a linear 0.04 in {:.0}% of the texels", 100.0 * _0)]
    LinearDielectrics(f64),
    /// Share of the texels.
    #[display("specular is near an encoded 0.04 in {:.0}% of the texels", 100.0 * _0)]
    EncodedDielectrics(f64),
    /// Share of the texels.
    #[display("linear colours would reflect too much light in {:.0}% of the texels", 100.0 * _0)]
    TooBright(f64),
    /// Share of the texels.
    #[display("linear colours would be those of no material in {:.0}% of the texels", 100.0 * _0)]
    NoMaterial(f64),
    /// If it is encoded, darker than most materials are. Stored median.
    #[display("the median of the colour is {_0:.3}, which suggests linear colours")]
    Dark(f64),
    /// The median of the specular of metals, as stored, and the log odds of linear: what metals reflect is known.
    #[display(
        "the specular of metals has a median of {median:.3}, which suggests {} colours",
        suggested(*log_odds)
    )]
    Metals { median: f64, log_odds: f64 },
}

fn suggested(log_odds: f64) -> &'static str {
    if log_odds > 0.0 { "linear" } else { "encoded" }
}

impl Evidence {
    /// Whether it is a custom of files, not a measurement.
    pub fn is_custom(&self) -> bool {
        matches!(self, Self::Prior | Self::Research | Self::Jpeg)
    }
}

/// A convention that files follow, by their format, names or layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Display)]
pub enum StorageConvention {
    #[display("svbrdf wrote the file")]
    Native,
    #[display("svbrdf wrote the file, with its encoding")]
    NativeText,
    #[display("floats are linear")]
    Floats,
    #[display("colours in separate files are sRGB by convention")]
    SeparateColours,
    #[display("colours of an .mtl are sRGB by convention")]
    MtlColours,
    #[display("Deschaintre et al. store this order in this way")]
    DeschaintreOrder,
    #[display("MaterialGAN and its successors store this order in this way")]
    MaterialGanOrder,
    #[display("MatFusion stores this order in this way")]
    MatFusionOrder,
    #[display("svbrdf-evaluation appears to store this order in this way")]
    SvbrdfEvaluationOrder,
    #[display("all known sources of packed maps do this")]
    PackedNormals,
    #[display("DiffMat writes these names and depths, with y down by default")]
    DiffMatNames,
    #[display("MaterialGAN and its successors use these names and this encoding")]
    MaterialGanNames,
    #[display("the results of Deschaintre et al. 2020 are numbered in this way")]
    NumberedResults,
    #[display("the names contain gammad")]
    GammadNames,
    #[display("the networks of Deschaintre et al. write these names, linear")]
    DeschaintreNames,
    #[display("the data sets of SurfaceNet look like this, and are linear")]
    SurfaceNetFolder,
    #[display("the specification of glTF 2.0 defines it")]
    Gltf,
    #[display("MaterialX defines normals in this way")]
    MaterialXNormals,
    #[display("computed as the specification of the surface defines it")]
    MaterialXSurface,
    /// A colour of MaterialX.
    #[display(
        "the file declares no colorspace, and MaterialX converts nothing then; colours of 8 bits are mostly sRGB"
    )]
    NoColourSpace,
    #[display("Texture Haven names the level of specular so, beside diff and rough; F0 is named so, too")]
    TextureHavenNames,
    #[display("the file lists its textures")]
    ListedTextures,
    #[display("the file lists its textures, and none of normals; the surface is flat")]
    NoListedNormals,
    #[display("the names of the layers name the maps")]
    LayerNames,
    #[display("the map is named roughness")]
    RoughnessName,
    #[display("nvdiffrec writes it beside map_Kd")]
    NvdiffrecPacking,
    /// Specular and glossiness in one picture.
    #[display("glTF defines it for specular and glossiness")]
    SpecularGlossiness,
    #[display("the built-in materials are stored in this way")]
    BuiltIn,
}
