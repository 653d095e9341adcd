//! The surface of the sample ground truth: worn glazed tiles in a pattern of stars and crosses, inlaid with metal.
//!
//! The picture spans [-1, 1] x [-1, 1], y up, and holds 2 x 2 stars that touch at their tips.

use super::noise::{clouds, cracks, hash, mix, mix3, noise, step};

const SQRT_HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Half the width of the grout.
const GROUT: f64 = 0.013;
/// Width of the rounded edge of a tile.
const BEVEL: f64 = 0.03;
/// Height of a tile above the grout.
const THICKNESS: f64 = 0.02;
/// Half the width of the brass band along the edge of a star.
const BAND: f64 = 0.016;
/// Distance of the middle of that band from the edge.
const BAND_AT: f64 = 0.1;
/// Size of the medallion in the middle of a star, from its centre to a tip.
const MEDALLION: f64 = 0.22;
/// Size of the diamond in the middle of a cross, from its centre to a tip.
const DIAMOND: f64 = 0.11;

const BRASS: [f64; 3] = [0.89, 0.70, 0.33];
const COPPER: [f64; 3] = [0.93, 0.55, 0.40];
/// Reflectance at normal incidence of everything that is no metal.
const DIELECTRIC: [f64; 3] = [0.04; 3];

/// The surface at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Surface {
    /// In units of half the width of the picture.
    pub height: f64,
    /// Linear RGB in [0, 1].
    pub diffuse: [f64; 3],
    /// Linear RGB in [0, 1].
    pub specular: [f64; 3],
    /// In [0, 1].
    pub roughness: f64,
}

impl Surface {
    /// Covers the surface with something matte, as far as `amount` of [0, 1] says.
    fn cover(&mut self, diffuse: [f64; 3], roughness: f64, amount: f64) {
        self.diffuse = mix3(self.diffuse, diffuse, amount);
        self.specular = mix3(self.specular, DIELECTRIC, amount);
        self.roughness = mix(self.roughness, roughness, amount);
    }
}

/// The surface at (x, y).
pub(super) fn surface(x: f64, y: f64) -> Surface {
    let (p, q) = (from_star(x, y), from_cross(x, y));
    let edge = star(p, 0.5);
    let mut surface = if edge < 0.0 { star_tile(x, y, p, edge) } else { cross_tile(x, y, q, edge) };
    wear(&mut surface, x, y);
    break_edges(&mut surface, x, y, edge.abs());
    fill_joints(&mut surface, x, y, edge.abs());
    stain(&mut surface, x, y);
    surface
}

/// Position relative to the centre of the nearest star.
fn from_star(x: f64, y: f64) -> [f64; 2] {
    [x.abs() - 0.5, y.abs() - 0.5]
}

/// Position relative to the centre of the nearest cross.
fn from_cross(x: f64, y: f64) -> [f64; 2] {
    [x - x.round(), y - y.round()]
}

/// Distance outside (> 0) or inside (< 0) the edge of an eight-pointed star whose tips are `size` from its centre.
fn star([x, y]: [f64; 2], size: f64) -> f64 {
    let (x, y) = (x.abs(), y.abs());
    let diamond = (x + y - size) * SQRT_HALF;
    let square = x.max(y) - size * SQRT_HALF;
    diamond.min(square)
}

/// A glazed tile of `colour`, `inside` its edge: rounded there, uneven within.
fn glazed(x: f64, y: f64, inside: f64, colour: [f64; 3], seed: u64) -> Surface {
    let rounded = step(0.0, BEVEL, inside - GROUT);
    let waves = 0.006 * noise(x * 9.0, y * 9.0, seed) + 0.0007 * noise(x * 27.0, y * 27.0, seed + 1);
    // Glaze runs thin over edges and pools in the hollows between waves.
    let pooled = 0.75 + 0.5 * clouds(x * 5.0, y * 5.0, seed + 2);
    let thin = 0.5 * step(0.4, 0.0, rounded);
    Surface {
        height: THICKNESS * rounded + waves,
        diffuse: mix3(colour.map(|c| c * pooled), [0.5, 0.45, 0.36], thin),
        specular: DIELECTRIC,
        roughness: 0.1 + 0.08 * clouds(x * 7.0, y * 7.0, seed + 3),
    }
}

/// Metal, let into a tile: `inside` its edge, with a groove around it.
fn inlay(tile: &mut Surface, x: f64, y: f64, inside: f64, metal: [f64; 3], dome: f64) {
    const GROOVE: f64 = 0.009;
    let groove = step(GROOVE, 0.0, inside.abs());
    if inside > 0.0 {
        let tarnish = step(0.45, 0.8, clouds(x * 6.0, y * 6.0, 40));
        let polish = 0.1 + 0.08 * noise(x * 40.0, y * 6.0, 41);
        tile.height = THICKNESS + dome;
        tile.diffuse = [0.0; 3];
        tile.specular = metal.map(|c| c * mix(1.0, 0.72, tarnish));
        tile.roughness = mix(polish, 0.34, tarnish);
    }
    tile.height -= 0.006 * groove;
    tile.cover([0.025, 0.02, 0.016], 0.75, 0.85 * groove);
}

/// A star: blue or green glaze, a brass band along its edge, a copper medallion in its middle.
fn star_tile(x: f64, y: f64, p: [f64; 2], edge: f64) -> Surface {
    let colour = if x * y > 0.0 { [0.012, 0.075, 0.30] } else { [0.01, 0.22, 0.20] };
    let seed = if x > 0.0 { 100 } else { 110 } + if y > 0.0 { 0 } else { 5 };
    let mut tile = glazed(x, y, -edge, colour, seed);
    let band = BAND - (-edge - BAND_AT).abs();
    if band > -0.02 {
        inlay(&mut tile, x, y, band, BRASS, 0.006 * step(0.0, BAND, band));
    }
    let medallion = -star(p, MEDALLION);
    if medallion > -0.02 {
        let r2 = (p[0] * p[0] + p[1] * p[1]) / (MEDALLION * MEDALLION);
        let ring = step(0.025, 0.0, (r2.sqrt() - 0.55).abs()) + step(0.022, 0.0, (r2.sqrt() - 0.3).abs());
        inlay(&mut tile, x, y, medallion, COPPER, 0.014 * (1.0 - r2) - 0.003 * ring);
        patina(&mut tile, x, y, medallion, ring);
    }
    tile
}

/// Verdigris where copper stays wet: along its edge and in its engraving.
fn patina(tile: &mut Surface, x: f64, y: f64, inside: f64, engraved: f64) {
    let wet = step(0.05, 0.0, inside).max(0.7 * engraved) * step(-0.004, 0.004, inside);
    let amount = wet * step(0.35, 0.62, clouds(x * 9.0, y * 9.0, 50));
    tile.cover([0.13, 0.36, 0.27], 0.72, 0.9 * amount);
}

/// A cross: ivory glaze with fine cracks, a brass diamond in its middle.
fn cross_tile(x: f64, y: f64, q: [f64; 2], edge: f64) -> Surface {
    let tint = hash((x.round()) as i64, (y.round()) as i64, 60);
    let colour = mix3([0.66, 0.57, 0.40], [0.60, 0.44, 0.27], tint);
    let mut tile = glazed(x, y, edge, colour, 120 + (8.0 * tint) as u64);
    let crack =
        step(0.045, 0.0, cracks(x * 11.0, y * 11.0, 61)) * step(0.3, 0.6, clouds(x * 2.0, y * 2.0, 63));
    tile.diffuse = mix3(tile.diffuse, [0.17, 0.1, 0.05], 0.55 * crack);
    tile.roughness = mix(tile.roughness, 0.5, 0.6 * crack);
    tile.height -= 0.0008 * crack;
    let diamond = (DIAMOND - q[0].abs() - q[1].abs()) * SQRT_HALF;
    if diamond > -0.02 {
        inlay(&mut tile, x, y, diamond, BRASS, 0.012 * step(0.0, 0.06, diamond));
    }
    tile
}

/// Dulls what is walked on most, and scratches it.
fn wear(surface: &mut Surface, x: f64, y: f64) {
    let walked = step(0.5, 0.72, clouds(x * 1.4 + 3.0, y * 1.4, 70));
    let metal = surface.specular[0] > 0.3;
    let dull = if metal { 0.2 } else { 0.46 };
    surface.roughness = mix(surface.roughness, surface.roughness.max(dull), 0.85 * walked);
    if !metal {
        surface.diffuse = mix3(surface.diffuse, [0.34, 0.31, 0.27], 0.1 * walked);
    }
    let scratch = scratches(x, y);
    surface.height -= 0.0016 * scratch;
    surface.roughness = mix(surface.roughness, 0.55, 0.7 * scratch);
    if !metal {
        surface.diffuse = mix3(surface.diffuse, [0.42, 0.38, 0.32], 0.3 * scratch);
    }
}

/// 1 in the middle of a scratch, 0 beside it.
fn scratches(x: f64, y: f64) -> f64 {
    const COUNT: i64 = 26;
    let mut deepest = 0.0_f64;
    for i in 0..COUNT {
        let draw = |what, low, high| mix(low, high, hash(i, what, 80));
        let (x0, y0) = (draw(0, -1.0, 1.0), draw(1, -1.0, 1.0));
        let (dx, dy) = (draw(2, -0.55, 0.55), draw(3, -0.3, 0.5));
        let t = (((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy + 1e-9)).clamp(0.0, 1.0);
        // A slight bow, deepest halfway.
        let bow = draw(4, -0.25, 0.25) * t * (1.0 - t);
        let (ex, ey) = (x - x0 - t * dx + bow * dy, y - y0 - t * dy - bow * dx);
        let depth = step(0.0065, 0.0, (ex * ex + ey * ey).sqrt()) * step(0.0, 0.2, t * (1.0 - t) * 4.0);
        deepest = deepest.max(depth * draw(5, 0.4, 1.0));
    }
    deepest
}

/// Chips tile edges: the clay under the glaze shows.
fn break_edges(surface: &mut Surface, x: f64, y: f64, edge: f64) {
    let reach = 0.05 * step(0.6, 0.85, noise(x * 13.0, y * 13.0, 90)) + 0.006 * noise(x * 50.0, y * 50.0, 91);
    let chipped = step(0.004, -0.004, edge - GROUT - reach) * step(0.6, 0.68, noise(x * 13.0, y * 13.0, 90));
    let clay = [0.42, 0.2, 0.11].map(|c| c * mix(0.8, 1.15, noise(x * 45.0, y * 45.0, 92)));
    surface.cover(clay, 0.88, chipped);
    let rough = 0.003 * noise(x * 40.0, y * 40.0, 93);
    surface.height = mix(surface.height, surface.height.min(0.45 * THICKNESS) + rough, chipped);
}

/// Grout between the tiles, and the dirt beside it.
fn fill_joints(surface: &mut Surface, x: f64, y: f64, edge: f64) {
    let dirt = step(0.07, 0.0, edge - GROUT) * step(0.4, 0.7, clouds(x * 8.0, y * 8.0, 95));
    surface.cover([0.06, 0.05, 0.04], 0.7, 0.55 * dirt);
    let joint = step(0.004, -0.004, edge - GROUT);
    let grain = noise(x * 55.0, y * 55.0, 96);
    let gray = mix(0.05, 0.12, 0.5 * grain + 0.5 * clouds(x * 4.0, y * 4.0, 97));
    surface.cover([gray, gray * 0.93, gray * 0.84], 0.86 + 0.04 * grain, joint);
    surface.height = mix(surface.height, 0.003 * grain, joint);
}

/// Something brown was spilt: dark rims, a dry matte film within.
fn stain(surface: &mut Surface, x: f64, y: f64) {
    let spilt = clouds(x * 1.7 - 5.0, y * 1.7, 98);
    let film = step(0.60, 0.63, spilt);
    let rim = step(0.025, 0.0, (spilt - 0.62).abs());
    let tint = |amount: f64| [1.0 - 0.3 * amount, 1.0 - 0.42 * amount, 1.0 - 0.55 * amount];
    let transmitted = tint((0.5 * film + 0.7 * rim).min(1.0));
    surface.diffuse = [0, 1, 2].map(|c| surface.diffuse[c] * transmitted[c]);
    surface.roughness = mix(surface.roughness, surface.roughness.max(0.42), 0.6 * film);
}
