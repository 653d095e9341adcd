//! Which renderers the kernel has: Algorithm 3 with its limits, and that of exact Smith shadowing with a light that falls off.

use crate::model::convention::Convention;
use crate::model::grammar::words::{Denominator, Falloff, Fresnel, Maps, Norm, Normals, Shadowing, Weight};
use crate::model::grammar::{Description, LightTerms, MapTerms, RendererTerms, SpecularTerms};

/// What the kernel computes for a convention.
#[derive(Clone, Copy, Debug)]
pub struct Kernel {
    /// The limits of Algorithm 3, and the epsilon.
    pub limits: Convention,
    pub norm: Norm,
    /// The renderer, where it is not Algorithm 3.
    pub smith: Option<Smith>,
}

/// A renderer with exact separable Smith shadowing, Schlick's fifth power and a light that falls off with the square of the distance,
/// also in distant scenes, whose light and view are points.
#[derive(Clone, Copy, Debug)]
pub struct Smith {
    /// Least n.l, n.v, n.h and v.h.
    pub cosine_floor: f64,
    /// In near-field and in distant scenes.
    pub intensities: [f64; 2],
    /// The specular reflectance of every texel, where it is not that of the maps.
    pub specular: Option<f64>,
    /// Whether diffuse is weighted with 1 - F.
    pub is_weighted: bool,
}

impl Kernel {
    /// `None` where the kernel does not have the renderer.
    pub fn of(convention: &Convention) -> Option<Self> {
        let Some(member) = convention.member else {
            return Some(Self { limits: *convention, norm: Norm::LogL1, smith: None });
        };
        algorithm_3(convention, &member.terms).or_else(|| smith(convention, &member.terms))
    }

    /// Whether the kernel has the norm with the renderer, too.
    pub fn has_norm(&self) -> bool {
        match self.smith {
            None => matches!(self.norm, Norm::LogL1 | Norm::Mse),
            Some(_) => self.norm == Norm::LogL1,
        }
    }
}

/// Terms without what makes no difference here: normals of materials have length 1, and their values lie in [0, 1].
fn of_materials(terms: &RendererTerms) -> RendererTerms {
    let normal = match terms.material.normal {
        Normals::Stored => Normals::Unit,
        other => other,
    };
    RendererTerms { material: MapTerms { clip_maps: false, normal, ..terms.material }, ..*terms }
}

fn is_gray(rgb: [f64; 3]) -> bool {
    rgb == [rgb[0]; 3]
}

fn algorithm_3(convention: &Convention, terms: &RendererTerms) -> Option<Kernel> {
    let RendererTerms { material, specular, light, .. } = terms;
    let limits = Convention {
        intensity: light.factor * light.intensity[0],
        roughness_floor: material.r_min,
        light_z_floor: light.lz?,
        clamp_n_dot_h: specular.nh_clamped,
        d_floor: specular.d_den_min,
        g_floor: specular.g_den_min,
        member: None,
        ..*convention
    };
    let mut expected = Description::from(&limits).terms;
    (expected.light.factor, expected.light.intensity) = (light.factor, light.intensity);
    let is_same = expected == of_materials(terms) && is_gray(light.intensity);
    is_same.then_some(Kernel { limits, norm: convention.norm(), smith: None })
}

fn smith(convention: &Convention, terms: &RendererTerms) -> Option<Kernel> {
    let RendererTerms { material, specular, diffuse, light, .. } = terms;
    let floor = specular.nl_min;
    let mut expected = RendererTerms::BASE;
    expected.material = MapTerms {
        material: material.material,
        f0: material.f0,
        r_min: material.r_min,
        ..RendererTerms::BASE.material
    };
    expected.specular = SpecularTerms {
        d_den_min: specular.d_den_min,
        nl_min: floor,
        nv_min: floor,
        nh_min: floor,
        vh_min: floor,
        g: Shadowing::Smith,
        denominator: Denominator::Both,
        f: Fresnel::Fifth,
        ..RendererTerms::BASE.specular
    };
    expected.diffuse = *diffuse;
    let LightTerms { intensity, intensity_distant, factor, .. } = *light;
    expected.light = LightTerms {
        falloff: Falloff::Square,
        intensity,
        intensity_distant,
        factor,
        ..RendererTerms::BASE.light
    };
    expected.grid.distant_is_point = true;
    let distant = intensity_distant.unwrap_or(intensity);
    // Without limits, mirrors and grazing directions would need paths of their own.
    let is_limited = floor > 0.0 && specular.d_den_min > 0.0;
    let is_known =
        material.material != Maps::Metallic && matches!(diffuse.diffuse, Weight::One | Weight::Fresnel);
    if expected != of_materials(terms) || !is_limited || !is_known || !is_gray(intensity) || !is_gray(distant)
    {
        return None;
    }
    let limits = Convention {
        roughness_floor: material.r_min,
        d_floor: specular.d_den_min,
        member: None,
        ..*convention
    };
    let smith = Smith {
        cosine_floor: floor,
        intensities: [intensity, distant].map(|rgb| factor * rgb[0]),
        specular: (material.material == Maps::Dielectric).then_some(material.f0),
        is_weighted: diffuse.diffuse == Weight::Fresnel,
    };
    Some(Kernel { limits, norm: convention.norm(), smith: Some(smith) })
}
