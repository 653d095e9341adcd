//! The surfaces of MaterialX that are read: their inputs, with the values that their specifications give them.

use roxmltree::Node;

use super::graph::input;

/// An input and its value where a file does not say it, linear.
pub(super) type Input = (&'static str, f32);

/// A surface of MaterialX.
#[derive(Debug)]
pub(super) struct SurfaceModel {
    pub tag: &'static str,
    pub base: Input,
    /// A factor on the base colour.
    pub weight: Option<Input>,
    pub metallic: Input,
    pub roughness: Input,
    pub normal: &'static str,
    /// Factors on the reflectance of the dielectric.
    pub specular: &'static [Input],
    pub ior: Input,
    /// What changes the look and is not modelled, with the value that turns it off.
    pub not_modelled: &'static [Input],
}

const MODELS: [SurfaceModel; 4] = [
    SurfaceModel {
        tag: "standard_surface",
        base: ("base_color", 0.8),
        weight: Some(("base", 1.0)),
        metallic: ("metalness", 0.0),
        roughness: ("specular_roughness", 0.2),
        normal: "normal",
        specular: &[("specular", 1.0), ("specular_color", 1.0)],
        ior: ("specular_IOR", 1.5),
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
        not_modelled: &[("clearcoat", 0.0), ("emissiveColor", 0.0), ("opacity", 1.0)],
    },
];

/// The specular of `UsdPreviewSurface` in its specular workflow.
pub(super) const USD_SPECULAR: Input = ("specularColor", 0.0);

impl SurfaceModel {
    /// The model of a node, if it is a surface that is read.
    pub(super) fn of(node: Node<'_, '_>) -> Option<&'static Self> {
        const ALL: &[SurfaceModel] = &MODELS;
        ALL.iter().find(|model| node.has_tag_name(model.tag))
    }

    /// The names of all models, for messages.
    pub(super) fn names() -> String {
        MODELS.map(|model| model.tag).join(", ")
    }

    /// What `surface` has that changes its look and is not modelled.
    pub(super) fn ignored(&self, surface: Node<'_, '_>) -> Vec<String> {
        let is_on = |(name, off): &&Input| {
            let Some(input) = input(surface, name) else { return false };
            let values = input.attribute("value").map(|v| v.split(',').map(|v| v.trim().parse::<f32>()));
            values.is_none_or(|mut values| values.any(|value| value.is_ok_and(|value| value != *off)))
        };
        self.not_modelled.iter().filter(is_on).map(|(name, _)| (*name).to_owned()).collect()
    }
}
