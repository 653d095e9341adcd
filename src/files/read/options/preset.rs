//! Presets: bundles of options for sources of materials.

use super::tiles::Order;
use svbrdf_core::choices;

choices! {
    /// A source of materials: a research code, a data set, a library or a tool.
    Preset, "preset":
    /// Deschaintre et al. 2019-2020, mworchel: N D R S, all linear.
    Deschaintre = "deschaintre",
    /// Deschaintre et al. 2018: the same; only their photos, which are ignored here, are linear, too.
    Deschaintre18 = "deschaintre18",
    /// Gao et al. 2019: N D R S, only D with gamma 2.2.
    Gao = "gao",
    /// MaterialGAN and svbrdf-diff-renderer: D, S and R with gamma 2.2.
    MaterialGan = "materialgan",
    /// Zhou & Kalantari 2022: D N R S, D and S with gamma 2.2, R as it is.
    LookAhead = "lookahead",
    /// MatFusion: D S R N, D and S with gamma 2.2; of base colour and metallic s = 0.04 + b m.
    MatFusion = "matfusion",
    /// SurfaceNet and MatFuse: files of raw values.
    SurfaceNet = "surfacenet",
    /// DiffMat: metallic, base colour with gamma 2.2, y down.
    DiffMat = "diffmat",
    /// OpenSVBRDF: linear, GGX widths ax and ay.
    OpenSvbrdf = "opensvbrdf",
    /// glTF 2.0: metallic, base colour sRGB, y up.
    Gltf = "gltf",
    /// Poly Haven: as glTF.
    PolyHaven = "polyhaven",
    /// ambientCG: as glTF.
    AmbientCg = "ambientcg",
    /// Ubisoft CHORD: metallic, base colour sRGB, y up.
    Chord = "chord",
    /// MaterialPalette: diffuse with gamma 2.2, roughness as it is, y up.
    MaterialPalette = "materialpalette",
    /// StableMaterials: as glTF, with heights.
    StableMaterials = "stablematerials",
    /// MatE: as glTF, with heights.
    MatE = "mate",
    /// Substance, specular and glossiness: colours sRGB.
    SubstanceSg = "substance-sg",
}

impl Preset {
    /// The order in which it packs maps, where it does.
    pub(crate) fn order(self) -> Option<Order> {
        match self {
            Self::Deschaintre | Self::Deschaintre18 | Self::Gao => Some(Order::NDRS),
            Self::MaterialGan | Self::LookAhead => Some(Order::DNRS),
            Self::MatFusion => Some(Order::DSRN),
            _ => None,
        }
    }
}
