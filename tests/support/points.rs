//! Random and extreme points of the BRDF, the same on every rung of precision, and how far f32 may be off there.

use glam::DVec3;
use rand::rngs::ChaCha8Rng;
use rand::{Rng as _, SeedableRng as _};

use svbrdf_core::model::brdf::{self, Model, Texel};

/// Half the distance of 1 and the next f32.
pub const U: f64 = 1.0 / (1 << 24) as f64;

/// Random parts of points, now and then at an edge of the domain.
pub struct Generator(ChaCha8Rng);

impl Generator {
    /// Stream `stream` of `seed`.
    pub fn new(seed: u64, stream: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(stream);
        Self(random)
    }

    /// A number in [0, 1].
    pub fn uniform(&mut self) -> f64 {
        f64::from(self.0.next_u32()) / f64::from(u32::MAX)
    }

    /// A whole number below `choices`.
    pub fn pick(&mut self, choices: usize) -> usize {
        self.0.next_u32() as usize % choices
    }

    fn one_of<const N: usize>(&mut self, values: [f64; N]) -> f64 {
        values[self.pick(N)]
    }

    fn azimuth(&mut self, z: f64) -> DVec3 {
        let phi = std::f64::consts::TAU * self.uniform();
        let rho = (1.0 - z * z).max(0.0).sqrt();
        DVec3::new(rho * phi.cos(), rho * phi.sin(), z)
    }

    /// A unit direction: anywhere above the plane, at the zenith, grazing, or below the plane.
    pub fn direction(&mut self) -> DVec3 {
        let z = match self.pick(8) {
            0 => 1.0,
            1 => self.one_of([1e-6, 1e-5, 1e-4, 1e-3, 0.01]),
            2 => -self.uniform(),
            _ => self.uniform(),
        };
        self.azimuth(z)
    }

    /// Mostly out of the plane; now and then exactly along z, or nearly in the plane.
    pub fn normal(&mut self) -> DVec3 {
        let z = match self.pick(4) {
            0 => 1.0,
            1 => self.uniform(),
            _ => 0.5 + 0.5 * self.uniform(),
        };
        self.azimuth(z)
    }

    /// An albedo in [0, 1]: any, 0 or 1.
    pub fn albedo(&mut self) -> f32 {
        let value = self.uniform();
        self.one_of([0.0, 1.0, value, value]) as f32
    }

    pub fn roughness(&mut self) -> f32 {
        let (value, square) = (self.uniform(), self.uniform().powi(4));
        self.one_of([0.0, 1e-5, 1e-4, 1e-3, 1.0 / 255.0, 0.01, 0.1, 0.5, 1.0, value, value, square]) as f32
    }

    /// A direction for a light along `l`: any, its mirror image on `n`, `l` itself, or its opposite, the last
    /// three a little off.
    pub fn partner(&mut self, n: DVec3, l: DVec3) -> DVec3 {
        let exact = match self.pick(6) {
            0 | 1 => n * (2.0 * n.dot(l)) - l,
            2 => l,
            3 => l * -1.0,
            _ => return self.direction(),
        };
        let off = self.one_of([0.0, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1]);
        (exact + self.direction() * off).normalize()
    }
}

/// How far each channel of `brdf::render` may be off where every operation, on vectors of length about 1, is off by
/// `ulps` * [`U`] at most.
///
/// Not one condition number: where the lobe is narrower than that error (r < 0.002 or so), the radiance is not
/// linear in it. So D is taken over all half vectors within reach; the other factors are smooth, and taken to first
/// order. Where l is nearly -v, the half vector's reach grows as 1 / |l + v|.
pub fn error_bound(model: &Model<f64>, texel: &Texel<f64>, w_l: DVec3, w_v: DVec3, ulps: f64) -> [f64; 3] {
    let e = ulps * U;
    let (n, l, v) = (texel.normal, w_l.normalize(), w_v.normalize());
    let n_dot_l = n.dot(l);
    if n_dot_l <= -e || l.z <= 0.0 {
        return [0.0; 3];
    }
    let reach = (e * (1.0 + 1.0 / (l + v).length())).min(2.0);
    let h = brdf::half_vector(n, l, v);
    let a = texel.roughness.max(model.roughness_floor).powi(2);
    let k = 0.5 * a;
    let sine = n.cross(h).length();
    let d = |sine: f64| {
        let cosine_squared = (1.0 - sine * sine).max(0.0);
        let denominator = sine * sine + a * a * cosine_squared;
        let ratio = a / denominator.max(model.d_floor);
        std::f64::consts::FRAC_1_PI * ratio * ratio
    };
    let spread = (d((sine - reach).max(0.0)) - d((sine + reach).min(1.0))) * (1.0 + e);
    let largest = d((sine - reach).max(0.0));

    let cosines = [n_dot_l.max(0.0), n.dot(v).max(0.0)];
    let factors = cosines.map(|c| brdf::geometry_factor(model, c, k));
    let g = factors[0] * factors[1];
    let g_off = g * ((1.0 + e * factors[0]) * (1.0 + e * factors[1]) - 1.0);

    // The slope of the logarithm of the Fresnel weight is at most ln 2 (2 * 5.55473 + 6.98316) < 13.
    let f_off = (13.0 * reach).min(f64::MAX).exp_m1();
    let weight = brdf::fresnel_weight(v.dot(h).clamp(0.0, 1.0));
    let scale = model.intensity / l.z.max(model.light_z_floor);
    let (light, light_off) = (cosines[0] * scale, e * scale);

    let channel = |c: usize| {
        let f = brdf::fresnel(texel.specular[c], weight);
        let f_off = ((1.0 - texel.specular[c]) * weight * f_off).min(1.0);
        let lobe = 0.25 * f * g * d(sine);
        let lobe_off = 0.25 * (f * g * spread + (f * g_off + f_off * (g + g_off)) * largest);
        let diffuse = brdf::lambert(texel.diffuse[c], texel.specular[c]);
        let value = lobe + diffuse;
        let off = lobe_off + e * value;
        (light + light_off) * off + light_off * value
    };
    [channel(0), channel(1), channel(2)]
}
