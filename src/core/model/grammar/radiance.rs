//! The radiance at a point, and the positions of texels.

use std::f64::consts::PI;

use glam::DVec3;

use super::words::{
    Alpha, Denominator, Distribution, F90, Falloff, Fresnel, FresnelCosine, K, Maps, NormalY, Normals, Rows,
    Shadowing, Sites, Transfer, Weight,
};
use super::{GridTerms, MapTerms, RendererTerms, SpecularTerms};

/// A texel with its material in both workflows, and vectors from it to light and camera, not unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    pub normal: [f64; 3],
    pub diffuse: [f64; 3],
    pub specular: [f64; 3],
    pub roughness: f64,
    pub base_color: [f64; 3],
    pub metallic: f64,
    pub light: [f64; 3],
    pub view: [f64; 3],
}

/// The texel as the formulas take it.
struct Surface {
    diffuse: [f64; 3],
    specular: [f64; 3],
    roughness: f64,
    metallic: f64,
    normal: DVec3,
}

/// The factors of the specular term.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors {
    /// n.l, n.v, n.h and v.h before the limits.
    pub cosines: [f64; 4],
    pub d: f64,
    /// Shadowing over n.l n.v: 4 times what D F is multiplied by.
    pub g: f64,
    pub f: [f64; 3],
}

/// The unit vectors, and their products before the limits.
struct Vectors {
    l_z: f64,
    nl: f64,
    nv: f64,
    nh: f64,
    vh: f64,
}

/// The vector over its length.
fn divided(vector: DVec3, epsilon: f64) -> DVec3 {
    vector / (vector.length() + epsilon)
}

impl MapTerms {
    fn surface(&self, point: &Point) -> Surface {
        let clipped = |x: f64| if self.clip_maps { x.clamp(0.0, 1.0) } else { x };
        let mut metallic = point.metallic;
        if self.material == Maps::Dielectric {
            metallic = 0.0;
        }
        let (diffuse, specular) = match self.material {
            Maps::Diffuse => (point.diffuse.map(clipped), point.specular.map(clipped)),
            Maps::Metallic | Maps::Dielectric => {
                let base = point.base_color.map(clipped);
                (base, base.map(|base| self.f0 * (1.0 - metallic) + metallic * base))
            }
        };
        let roughness = clipped(point.roughness).max(self.r_min).min(self.r_max);
        Surface { diffuse, specular, roughness, metallic, normal: self.normal(point.normal) }
    }

    fn normal(&self, stored: [f64; 3]) -> DVec3 {
        let mut normal = DVec3::from(stored);
        if self.normal_y == NormalY::Down {
            normal.y = -normal.y;
        }
        normal = match self.normal {
            Normals::Stored => normal,
            Normals::Unit => divided(normal, self.vec_eps),
            Normals::FromXy => {
                let xy = normal.truncate().clamp(glam::DVec2::NEG_ONE, glam::DVec2::ONE);
                divided(xy.extend((1.0 - xy.length_squared().min(1.0 - 1e-6)).sqrt()), self.vec_eps)
            }
        };
        if self.flip_below && normal.z < 0.0 { -normal } else { normal }
    }
}

impl SpecularTerms {
    fn limited(&self, product: f64, least: f64) -> f64 {
        product.max(least).min(self.dot_max)
    }

    fn distribution(&self, nh: f64, unlimited: f64, a: f64) -> f64 {
        let (a2, nh2) = (a * a, nh * nh);
        let d = match self.d {
            Distribution::Ggx => {
                let sum = if self.d_den_min > 0.0 {
                    (nh2 * (a2 - 1.0) + 1.0).max(self.d_den_min)
                } else {
                    nh2 * a2 + (1.0 - nh2)
                };
                a2 / (PI * sum * sum + self.d_add).max(self.d_den2_min)
            }
            Distribution::Beckmann => (-(1.0 - nh2) / (nh2 * a2)).exp() / (PI * a2 * nh2 * nh2),
        };
        if self.d_xi && unlimited <= 0.0 { 0.0 } else { d.min(self.d_cap) }
    }

    /// The shadowing term over the denominator.
    fn geometry(&self, nl: f64, nv: f64, unlimited_nv: f64, roughness: f64, a: f64) -> f64 {
        let (full, visibility) = self.shadowing(nl, nv, roughness, a);
        match self.denominator {
            Denominator::Cancelled => visibility / (4.0 + self.den_add),
            Denominator::Both => full / (4.0 * nl * nv + self.den_add),
            Denominator::Light => full / (4.0 * nl + self.den_add),
            Denominator::View => full / (4.0 * unlimited_nv.max(self.nv_min)),
        }
    }

    /// The shadowing term, and what it is divided by n.l n.v.
    fn shadowing(&self, nl: f64, nv: f64, roughness: f64, a: f64) -> (f64, f64) {
        let (a2, both) = (a * a, nl * nv);
        let smith = |x: f64| 2.0 / (1.0 + (1.0 + a2 * (1.0 - x * x) / (x * x + self.g_add)).sqrt());
        let of_visibility = |visibility: f64| (visibility * both, visibility);
        let of_full = |full: f64| (full, full / both);
        match self.g {
            Shadowing::None => (1.0, 1.0),
            Shadowing::Schlick => {
                let k = match self.k {
                    K::HalfAlpha => a / 2.0,
                    K::HalfSquare => roughness * roughness / 2.0,
                    K::Direct => (roughness + 1.0) * (roughness + 1.0) / 8.0,
                };
                let k = (k + self.k_add).max(self.k_min);
                let factor = |x: f64| 1.0 / (x * (1.0 - k) + k).max(self.g_den_min);
                of_visibility(factor(nl) * factor(nv))
            }
            Shadowing::Smith => of_full(smith(nl) * smith(nv)),
            Shadowing::SmithBeckmann => of_full(beckmann_factor(nl, a) * beckmann_factor(nv, a)),
            Shadowing::Correlated => {
                let root = |x: f64| (x * x * (1.0 - a2) + a2).sqrt();
                let sum = nl * root(nv) + nv * root(nl);
                of_visibility(if sum > 0.0 { 2.0 / sum.max(self.v_den_min) } else { 0.0 })
            }
            Shadowing::Lambda => {
                let lambda = |x: f64| 0.5 * ((1.0 + a2 * (1.0 - x * x) / (x * x)).sqrt() - 1.0);
                of_full(1.0 / (1.0 + lambda(nl) + lambda(nv)))
            }
        }
    }

    /// Schlick's power for the cosine of the Fresnel term.
    fn fresnel_weight(&self, [nv, nh, vh]: [f64; 3]) -> f64 {
        let x = match self.f_of {
            FresnelCosine::Half => self.limited(vh, self.vh_min),
            FresnelCosine::View => nv,
            FresnelCosine::NormalHalf => nh,
        };
        match self.f {
            Fresnel::Base2 => ((-5.55473 * x - 6.98316) * x).exp2(),
            Fresnel::Fifth => (1.0 - x).max(0.0).powi(5),
            Fresnel::Constant => 0.0,
        }
    }
}

/// Smith's factor for Beckmann, in the rational approximation of Walter et al. (2007).
fn beckmann_factor(x: f64, a: f64) -> f64 {
    let e = x / (a * (1.0 - x * x).max(0.0).sqrt());
    let rational = (3.535 * e + 2.181 * e * e) / (1.0 + 2.276 * e + 2.577 * e * e);
    if e >= 1.6 { 1.0 } else { rational }
}

impl RendererTerms {
    /// The radiance at a point, RGB, as the code gives it out. `is_near`: whether its scene is a near-field one.
    ///
    /// Where the formulas of a code divide by 0, it is not finite.
    pub fn radiance(&self, point: &Point, is_near: bool) -> [f64; 3] {
        let (s, light) = (&self.specular, &self.light);
        let surface = self.material.surface(point);
        let x = self.products(point, surface.normal);
        let irradiance = self.irradiance(&x, DVec3::from(point.light).length_squared(), is_near);
        if light.lz == Some(0.0) && (x.l_z <= 0.0 || x.nl <= 0.0) {
            return self.encoded([0.0; 3]);
        }
        let (diffuse, lobe) = self.terms(&surface, &x);
        let cosine = x.nl.max(light.cos_min).min(light.cos_max.unwrap_or(s.dot_max));
        let mut sum = [0.0; 3];
        for c in 0..3 {
            let mut first = diffuse[c] * cosine * irradiance[c];
            let mut second = lobe[c] * if s.spec_cosine { cosine } else { 1.0 } * irradiance[c];
            if let Some([low, high]) = self.output.clip_terms {
                (first, second) = (first.max(low).min(high), second.max(low).min(high));
            }
            sum[c] = first + second + light.ambient * surface.diffuse[c];
        }
        self.encoded(sum)
    }

    fn products(&self, point: &Point, n: DVec3) -> Vectors {
        let epsilon = self.material.vec_eps;
        let w_l = DVec3::from(point.light);
        let w_v = if self.light.collocated { w_l } else { DVec3::from(point.view) };
        let (l, v) = (divided(w_l, epsilon), divided(w_v, epsilon));
        let h = divided((l + v) / 2.0, epsilon);
        Vectors { l_z: l.z, nl: n.dot(l), nv: n.dot(v), nh: n.dot(h), vh: v.dot(h) }
    }

    /// The factors of the specular term at a point.
    pub fn factors(&self, point: &Point) -> Factors {
        let s = &self.specular;
        let surface = self.material.surface(point);
        let x = self.products(point, surface.normal);
        let (nl, nv) = (s.limited(x.nl, s.nl_min), s.limited(x.nv, s.nv_min));
        let nh = if s.nh_clamped { s.limited(x.nh, s.nh_min) } else { x.nh };
        let a = self.width(surface.roughness);
        let weight = s.fresnel_weight([nv, nh, x.vh]);
        Factors {
            cosines: [x.nl, x.nv, x.nh, x.vh],
            d: s.distribution(nh, x.nh, a),
            g: 4.0 * s.geometry(nl, nv, x.nv, surface.roughness, a),
            f: self.fresnel(&surface, weight),
        }
    }

    fn width(&self, roughness: f64) -> f64 {
        match self.material.alpha {
            Alpha::Square => roughness * roughness,
            Alpha::Linear => roughness,
        }
    }

    fn fresnel(&self, surface: &Surface, weight: f64) -> [f64; 3] {
        let f90 = match self.specular.f90 {
            F90::One => 1.0,
            F90::Filament => (16.5 * surface.specular.iter().sum::<f64>()).clamp(0.0, 1.0),
        };
        surface.specular.map(|specular| specular + (f90 - specular) * weight)
    }

    /// The diffuse and the specular term, without the light.
    fn terms(&self, surface: &Surface, x: &Vectors) -> ([f64; 3], [f64; 3]) {
        let s = &self.specular;
        let (nl, nv) = (s.limited(x.nl, s.nl_min), s.limited(x.nv, s.nv_min));
        let nh = if s.nh_clamped { s.limited(x.nh, s.nh_min) } else { x.nh };
        let weight = s.fresnel_weight([nv, nh, x.vh]);
        let r = surface.roughness;
        let a = self.width(r);
        let is_front = s.front_min.is_none_or(|least| x.nl > least && x.nv > least);
        let lobe = match is_front {
            true => s.distribution(nh, x.nh, a) * s.geometry(nl, nv, x.nv, r, a),
            false => 0.0,
        };
        let dielectric = self.material.f0 + (1.0 - self.material.f0) * weight;
        let fresnel = self.fresnel(surface, weight);
        let share = |c: usize| match self.diffuse.diffuse {
            Weight::One => 1.0,
            Weight::Specular => 1.0 - surface.specular[c],
            Weight::Fresnel => 1.0 - fresnel[c],
            Weight::Metallic => 1.0 - surface.metallic,
            Weight::FresnelMetallic => (1.0 - fresnel[c]) * (1.0 - surface.metallic),
            Weight::DielectricMetallic if self.material.material == Maps::Diffuse => 1.0 - fresnel[c],
            Weight::DielectricMetallic => (1.0 - dielectric) * (1.0 - surface.metallic),
            Weight::Zero => 0.0,
        };
        let (mut diffuse, mut specular) = ([0.0; 3], [0.0; 3]);
        for c in 0..3 {
            (diffuse[c], specular[c]) = (surface.diffuse[c] * share(c) / PI, fresnel[c] * lobe);
        }
        (diffuse, specular)
    }

    /// The light that arrives, without the cosine.
    fn irradiance(&self, x: &Vectors, squared_distance: f64, is_near: bool) -> [f64; 3] {
        let light = &self.light;
        let mut scale = light.factor;
        if light.falloff == Falloff::Square && (is_near || self.grid.distant_is_point) {
            scale /= squared_distance + light.falloff_add;
        }
        if light.spot > 0.0 {
            scale *= x.l_z.clamp(0.0, 1.0).powf(light.spot);
        }
        if let Some(least) = light.lz {
            scale /= x.l_z.max(least);
        }
        let intensity =
            if is_near { light.intensity } else { light.intensity_distant.unwrap_or(light.intensity) };
        intensity.map(|intensity| intensity * scale)
    }

    /// A radiance as the code gives it out.
    fn encoded(&self, mut radiance: [f64; 3]) -> [f64; 3] {
        let output = &self.output;
        let clipped = |x: f64, range: Option<[f64; 2]>| range.map_or(x, |[low, high]| x.max(low).min(high));
        for value in &mut radiance {
            let x = clipped(*value, output.clip) + output.pre_add;
            let x = match output.transfer {
                Transfer::Linear => x,
                Transfer::Gamma => x.powf(1.0 / 2.2),
                Transfer::Srgb if x <= 0.003_130_8 => 12.92 * x,
                Transfer::Srgb => 1.055 * x.powf(1.0 / 2.4) - 0.055,
            };
            *value = clipped(x, output.clip_after);
        }
        radiance
    }
}

impl GridTerms {
    /// The position of a texel in a material of this size, in units of the world.
    pub fn position(&self, column: usize, row: usize, width: usize, height: usize) -> DVec3 {
        // Texels are square, and the width spans [-1, 1].
        let width_in_texels = match self.sampling {
            Sites::Corner => width.max(2) - 1,
            Sites::Centre => width,
        };
        let at =
            |index: usize, count: usize| (2.0 * index as f64 + 1.0 - count as f64) / width_in_texels as f64;
        let (x, y) = (at(column, width), at(row, height));
        let (x, y) = match self.orientation {
            Rows::Up => (x, -y),
            Rows::Down => (x, y),
            Rows::Transposed => (y, -x),
        };
        DVec3::new(x, y, 0.0) * self.half_extent
    }

    /// The vectors from a position to light and view of a scene, whose coordinates are in half extents.
    pub fn vectors(&self, position: DVec3, light: DVec3, view: DVec3, is_near: bool) -> (DVec3, DVec3) {
        let from = |end: DVec3| end * self.half_extent - position;
        match (is_near || self.distant_is_point, self.light_only_distant) {
            (true, _) => (from(light), from(view)),
            (false, true) => (light, from(view)),
            (false, false) => (light, view),
        }
    }
}
