//! The cases: every pair of values of a table's axes, and random points.

use exr::prelude::f16;
use glam::{DVec3, Vec3};

use svbrdf_core::material::{Material, Planes};
use svbrdf_core::model::brdf::Texel;
use svbrdf_core::model::convention::{self, Convention};

use crate::support::points::Generator;

const ROUGHNESS: [f64; 9] = [0.0, 1e-5, 1e-4, 1e-3, 1.0 / 255.0, 0.01, 0.1, 0.5, 1.0];
/// NoH, before the normal is rounded to its format.
const N_DOT_H: [f64; 4] = [1.0, 1.0 - 1.0 / (1 << 24) as f64, 1.0 - 1.0 / (1 << 12) as f64, 0.0];
/// Heights of the unit vector to the light above the plane; the last is below it.
const LIGHT_Z: [f64; 6] = [1.0, 0.5, 0.1, 1e-3, 1e-6, -0.5];
/// Views: at a height above the plane, or relative to the light.
const VIEWS: [View; 9] = [
    View::Height(1.0),
    View::Height(0.5),
    View::Height(1e-3),
    View::Height(1e-6),
    View::Height(-0.5),
    View::Mirror,
    View::AlmostMirror,
    View::Light,
    View::Opposite,
];
/// Specular and diffuse albedo.
const ALBEDO: [f64; 4] = [0.0, 1.0 / (1 << 24) as f64, 0.5, 1.0];
/// Distances of light and view from the texel.
const DISTANCE: [f64; 5] = [1e-4, 1e-2, 1.0, 1e3, 1e6];
/// Storage formats of the maps.
const FORMATS: [Format; 3] = [Format::Bits8, Format::Half, Format::Float];

#[derive(Clone, Copy, Debug)]
enum View {
    Height(f64),
    /// The mirror direction of the light about the normal of the plane.
    Mirror,
    /// v = l.
    Light,
    /// 0.001 radians from the mirror direction.
    AlmostMirror,
    /// v = -l.
    Opposite,
}

#[derive(Clone, Copy, Debug)]
enum Format {
    Bits8,
    Half,
    Float,
}

impl Format {
    /// The value in [0, 1] that a map of this format holds for `x`.
    fn value(self, x: f64) -> f32 {
        match self {
            Self::Bits8 => ((x * 255.0).round() / 255.0) as f32,
            Self::Half => f16::from_f64(x).to_f32(),
            Self::Float => x as f32,
        }
    }

    fn normal(self, n: DVec3) -> Vec3 {
        let component = |x: f64| match self {
            Self::Bits8 => 2.0 * self.value(0.5 + 0.5 * x) - 1.0,
            _ => self.value(x),
        };
        n.to_array().map(component).into()
    }
}

/// Texels that share a convention, a light and a view.
#[derive(Clone)]
pub struct Batch {
    pub convention: Convention,
    /// Near-field: the kernel gets light and view at their distances, over materials of one texel each. Otherwise
    /// distant, over all texels at once.
    pub near: bool,
    /// A row of texels.
    pub material: Material<f32>,
    /// From the texels to the light and to the viewer, of any length.
    pub w_l: Vec3,
    pub w_v: Vec3,
}

impl Batch {
    pub fn texels(&self) -> impl Iterator<Item = Texel<f32>> + '_ {
        (0..self.material.width()).map(|i| self.material.texel(i))
    }
}

/// A material of one row. Its normals are normalized once more.
pub fn row(texels: &[Texel<f32>]) -> Material<f32> {
    let plane = |value: &dyn Fn(&Texel<f32>) -> f32| texels.iter().map(value).collect::<Vec<_>>();
    let planes = Planes {
        normal: [0, 1, 2].map(|c| plane(&|t| t.normal.to_array()[c])),
        diffuse: [0, 1, 2].map(|c| plane(&|t| t.diffuse[c])),
        specular: [0, 1, 2].map(|c| plane(&|t| t.specular[c])),
        roughness: plane(&|t| t.roughness),
    };
    Material::new("cases", texels.len(), 1, planes).unwrap()
}

/// `axis` rotated by `angle` towards the direction at `azimuth` around it. Both in radians.
pub fn turned(axis: DVec3, angle: f64, azimuth: f64) -> DVec3 {
    let other = if axis.x.abs() < 0.5 { DVec3::X } else { DVec3::Y };
    let x = axis.cross(other).normalize();
    let side = x * azimuth.cos() + axis.cross(x) * azimuth.sin();
    axis * angle.cos() + side * angle.sin()
}

/// The half vector, or z where light and view are opposite.
fn half_way(l: DVec3, v: DVec3) -> DVec3 {
    let sum = l + v;
    if sum.length() > 1e-9 { sum.normalize() } else { DVec3::Z }
}

/// The table: for each light and view a batch with every roughness, NoH and pair of albedos. Distances, formats and
/// the azimuths of the normals alternate.
pub fn table() -> impl Iterator<Item = Batch> {
    let rounds = LIGHT_Z.len() * VIEWS.len() * DISTANCE.len();
    (0..rounds * convention::ALL.len()).map(move |i| batch_of_table(i / rounds, i % rounds))
}

fn batch_of_table(convention: usize, i: usize) -> Batch {
    /// Three pairs of albedos fit a texel: six texels hold the 16 pairs, two of them twice.
    const ALBEDO_TEXELS: usize = 6;
    let (light, view, round) = (i % 6, i / 6 % 9, i / 54);
    let (light_distance, view_distance) = (round, (2 * round + light + view + convention) % 5);
    let (l, v) = directions(LIGHT_Z[light], VIEWS[view], 0.7 * i as f64);
    let h = half_way(l, v);
    let texel = |j: usize| {
        let (r, n_dot_h, albedo) = (j % 9, j / 9 % 4, j / 36);
        let pairs = [0, 1, 2].map(|c| (3 * albedo + c) % 16);
        let format = (r + n_dot_h + albedo + light + view + round + convention) % 3;
        let side = (r + albedo + round) % 3;
        let cosine = N_DOT_H[n_dot_h];
        let angle = ((1.0 - cosine) * (1.0 + cosine)).sqrt().atan2(cosine);
        let n = turned(h, angle, 0.1 + std::f64::consts::TAU / 3.0 * side as f64);
        Texel {
            normal: FORMATS[format].normal(n),
            diffuse: pairs.map(|pair| FORMATS[format].value(ALBEDO[pair / 4])),
            specular: pairs.map(|pair| FORMATS[format].value(ALBEDO[pair % 4])),
            roughness: FORMATS[format].value(ROUGHNESS[r]),
        }
    };
    let texels: Vec<_> = (0..ROUGHNESS.len() * N_DOT_H.len() * ALBEDO_TEXELS).map(texel).collect();
    let [w_l, w_v] = [l * DISTANCE[light_distance], v * DISTANCE[view_distance]].map(|w| w.as_vec3());
    let near = (light + view + round).is_multiple_of(4);
    Batch { convention: convention::ALL[convention], near, material: row(&texels), w_l, w_v }
}

/// Unit vectors to a light at height `z` on the side `azimuth`, and to the view.
fn directions(z: f64, view: View, azimuth: f64) -> (DVec3, DVec3) {
    let at = |z: f64, azimuth: f64| {
        let rho = ((1.0 - z) * (1.0 + z)).sqrt();
        DVec3::new(rho * azimuth.cos(), rho * azimuth.sin(), z)
    };
    let l = at(z, azimuth);
    let mirrored = DVec3::new(-l.x, -l.y, l.z);
    let v = match view {
        View::Height(z) => at(z, 2.0 * azimuth),
        View::Mirror => mirrored,
        View::AlmostMirror => turned(mirrored, 1e-3, 1.0),
        View::Light => l,
        View::Opposite => l * -1.0,
    };
    (l, v)
}

/// Texels of a random batch.
pub const RANDOM_TEXELS: usize = 64;

/// The random batch number `index`: normals, directions and roughnesses from anywhere, but mostly near the mirror
/// direction, the horizon, 0 and 1.
pub fn random(index: u64) -> Batch {
    let mut g = Generator::new(4, index);
    let (l, around) = (g.direction(), g.normal());
    let v = g.partner(around, l);
    let h = half_way(l, v);
    let texels: Vec<_> = (0..RANDOM_TEXELS).map(|_| texel(&mut g, h)).collect();
    let mut distance = || 10f64.powf(10.0 * g.uniform() - 4.0);
    let [w_l, w_v] = [l, v].map(|w| (w * distance()).as_vec3());
    let convention = convention::ALL[index as usize % 4];
    Batch { convention, near: (index / 4).is_multiple_of(8), material: row(&texels), w_l, w_v }
}

fn texel(g: &mut Generator, h: DVec3) -> Texel<f32> {
    let [log_angle, azimuth] = [g.uniform(), g.uniform()];
    let normal = match g.pick(4) {
        0 => g.normal(),
        _ => turned(h, 10f64.powf(8.0 * log_angle - 8.0), std::f64::consts::TAU * azimuth),
    };
    let roughness = if g.pick(2) == 0 { g.roughness().into() } else { 10f64.powf(-5.0 * g.uniform()) };
    let format = FORMATS[[0, 1, 2, 2][g.pick(4)]];
    let mut albedo = || [(); 3].map(|()| format.value(g.albedo().into()));
    Texel {
        normal: format.normal(normal),
        diffuse: albedo(),
        specular: albedo(),
        roughness: format.value(roughness),
    }
}
