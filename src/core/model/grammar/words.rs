//! The words of the grammar: the choices of each term, named as in its TOML.

use crate::choices;

choices! {
    /// Which maps describe the material.
    Maps, "workflow":
    /// Diffuse and specular colours.
    Diffuse = "ds",
    /// Base colour and metallic.
    Metallic = "metal",
    /// Base colour of a dielectric: metallic is 0.
    Dielectric = "metal0",
}

choices! {
    /// The width of the lobe for a roughness r.
    Alpha, "alpha":
    Square = "r^2",
    Linear = "r",
}

choices! {
    /// How a stored normal becomes the normal of the formulas.
    Normals, "treatment of normals":
    /// Normalized.
    Unit = "unit",
    /// As stored.
    Stored = "stored",
    /// z from x and y.
    FromXy = "xy",
}

choices! {
    /// The direction of +y of a normal map.
    NormalY, "direction of y":
    Up = "up",
    Down = "down",
}

choices! {
    /// The distribution of microfacets.
    Distribution, "distribution":
    Ggx = "ggx",
    Beckmann = "beckmann",
}

choices! {
    /// The shadowing and masking term.
    Shadowing, "shadowing":
    /// Schlick's approximation, separable.
    Schlick = "schlick",
    /// Smith for GGX, separable.
    Smith = "smith",
    /// Smith for GGX, height-correlated, as a visibility term.
    Correlated = "smith_correlated",
    /// Smith for GGX, height-correlated, by the two functions Lambda.
    Lambda = "smith_lambda",
    /// Smith for Beckmann, in the rational approximation of Walter et al. (2007).
    SmithBeckmann = "smith_beckmann",
    None = "none",
}

choices! {
    /// The k of Schlick's shadowing, for the width alpha and the roughness r.
    K, "k":
    HalfAlpha = "alpha/2",
    HalfSquare = "r^2/2",
    Direct = "(r+1)^2/8",
}

choices! {
    /// What the product D F G is divided by.
    Denominator, "denominator":
    /// 4, since the cosines of the shadowing term cancel the others.
    Cancelled = "cancelled",
    Both = "4nlnv",
    Light = "4nl",
    View = "4nv",
}

choices! {
    /// The Fresnel term.
    Fresnel, "Fresnel term":
    /// Schlick's power in base 2 (Karis 2013).
    Base2 = "sg",
    /// Schlick's fifth power.
    Fifth = "schlick5",
    Constant = "constant",
}

choices! {
    /// The cosine that the Fresnel term is taken of.
    FresnelCosine, "cosine of the Fresnel term":
    Half = "v.h",
    View = "n.v",
    NormalHalf = "n.h",
}

choices! {
    /// The Fresnel term at grazing angles.
    F90, "f90":
    One = "1",
    /// 16.5 times the sum of the specular colour, at most 1.
    Filament = "filament",
}

choices! {
    /// The weight of the diffuse term. F is the Fresnel term of the material, Fd of a dielectric, s the specular colour, m metallic.
    Weight, "weight of diffuse":
    One = "1",
    Specular = "1-s",
    Fresnel = "1-F",
    Metallic = "1-m",
    FresnelMetallic = "(1-F)(1-m)",
    DielectricMetallic = "(1-Fd)(1-m)",
    Zero = "0",
}

choices! {
    /// How light gets weaker with the distance.
    Falloff, "falloff":
    None = "none",
    Square = "1/d^2",
}

choices! {
    /// The encoding of the picture.
    Transfer, "transfer":
    Linear = "linear",
    Gamma = "gamma2.2",
    Srgb = "srgb",
}

choices! {
    /// Where texels lie on the plane.
    Sites, "sampling":
    /// The outermost ones on the border.
    Corner = "corner",
    /// In the centres of equal squares.
    Centre = "centre",
}

choices! {
    /// Where row 0 lies.
    Rows, "orientation":
    /// At the greatest y.
    Up = "up",
    /// At the least y.
    Down = "down",
    /// At the least x: rows are columns.
    Transposed = "transposed",
}

choices! {
    /// How the renderings of two materials are compared.
    Norm, "norm":
    LogL1 = "log-l1",
    L1 = "l1",
    Mse = "mse",
    Rmse = "rmse",
    /// Not by this value for value.
    None = "none",
}
