//! Surface models of MaterialX that are read: their inputs, with the values that their specifications give them.

use crate::read::options::Role;

/// An input and its default, linear.
pub(super) type SurfaceInput = (&'static str, f32);

/// A surface of MaterialX.
#[derive(Debug)]
pub(super) struct SurfaceModel {
    pub tag: &'static str,
    pub base: SurfaceInput,
    /// A factor on the base colour.
    pub weight: Option<SurfaceInput>,
    pub metallic: SurfaceInput,
    pub roughness: SurfaceInput,
    pub normal: &'static str,
    /// Factors on the reflectance of the dielectric.
    pub specular: &'static [SurfaceInput],
    pub ior: SurfaceInput,
    /// The share of light that the dielectric transmits, which leaves the rest to diffuse.
    pub transmission: Option<SurfaceInput>,
    /// Inputs that change the look and are not modelled, with the value that turns each off.
    pub not_modelled: &'static [SurfaceInput],
}

pub(super) static MODELS: [SurfaceModel; 4] = [
    SurfaceModel {
        tag: "standard_surface",
        base: ("base_color", 0.8),
        weight: Some(("base", 1.0)),
        metallic: ("metalness", 0.0),
        roughness: ("specular_roughness", 0.2),
        normal: "normal",
        specular: &[("specular", 1.0), ("specular_color", 1.0)],
        ior: ("specular_IOR", 1.5),
        transmission: Some(("transmission", 0.0)),
        not_modelled: &[
            ("coat", 0.0),
            ("transmission", 0.0),
            ("subsurface", 0.0),
            ("sheen", 0.0),
            ("specular_anisotropy", 0.0),
            ("thin_film_thickness", 0.0),
            ("diffuse_roughness", 0.0),
            ("emission", 0.0),
            ("opacity", 1.0),
        ],
    },
    SurfaceModel {
        tag: "gltf_pbr",
        base: ("base_color", 1.0),
        weight: None,
        metallic: ("metallic", 1.0),
        roughness: ("roughness", 1.0),
        normal: "normal",
        specular: &[("specular", 1.0), ("specular_color", 1.0)],
        ior: ("ior", 1.5),
        transmission: Some(("transmission", 0.0)),
        not_modelled: &[
            ("clearcoat", 0.0),
            ("transmission", 0.0),
            ("sheen_color", 0.0),
            ("iridescence", 0.0),
            ("anisotropy_strength", 0.0),
            ("thickness", 0.0),
            ("emissive", 0.0),
        ],
    },
    SurfaceModel {
        tag: "open_pbr_surface",
        base: ("base_color", 0.8),
        weight: Some(("base_weight", 1.0)),
        metallic: ("base_metalness", 0.0),
        roughness: ("specular_roughness", 0.3),
        normal: "geometry_normal",
        specular: &[("specular_weight", 1.0), ("specular_color", 1.0)],
        ior: ("specular_ior", 1.5),
        transmission: Some(("transmission_weight", 0.0)),
        not_modelled: &[
            ("coat_weight", 0.0),
            ("transmission_weight", 0.0),
            ("subsurface_weight", 0.0),
            ("fuzz_weight", 0.0),
            ("specular_roughness_anisotropy", 0.0),
            ("thin_film_weight", 0.0),
            ("base_diffuse_roughness", 0.0),
            ("emission_luminance", 0.0),
            ("geometry_opacity", 1.0),
        ],
    },
    SurfaceModel {
        tag: "UsdPreviewSurface",
        base: ("diffuseColor", 0.18),
        weight: None,
        metallic: ("metallic", 0.0),
        roughness: ("roughness", 0.5),
        normal: "normal",
        specular: &[],
        ior: ("ior", 1.5),
        transmission: None,
        not_modelled: &[("clearcoat", 0.0), ("emissiveColor", 0.0), ("opacity", 1.0)],
    },
];

/// The specular of `UsdPreviewSurface` in its specular workflow.
pub(super) const USD_SPECULAR: SurfaceInput = ("specularColor", 0.0);
/// The input of `UsdPreviewSurface` that chooses its specular workflow.
pub(super) const USE_SPECULAR: &str = "useSpecularWorkflow";

impl SurfaceModel {
    /// The names of all models, for messages.
    pub(super) fn names() -> String {
        MODELS.each_ref().map(|model| model.tag).join(", ")
    }

    /// The inputs that may be bound to pictures, and the maps that these are read as.
    pub(super) fn inputs(&self) -> Vec<(&'static str, Role)> {
        let always = [
            (self.normal, Role::Normal),
            (self.roughness.0, Role::Roughness),
            (self.metallic.0, Role::Metallic),
            (self.base.0, Role::Base),
        ];
        let weight = self.weight.map(|(name, _)| (name, Role::Base));
        let specular = self.specular.iter().chain([&USD_SPECULAR]).map(|(name, _)| (*name, Role::Specular));
        let transmission = self.transmission.map(|(name, _)| (name, Role::Base));
        always.into_iter().chain(weight).chain(specular).chain(transmission).collect()
    }
}
