//! Tiles of a packed image: what the pixels of one contradict, and the borders around all.

use crate::read::options::Role;
use crate::read::raster::{Raster, Samples};

/// Channels of a gray tile differ by no more, but for few texels: compression, and networks of three outputs.
const NOISE: f64 = 0.08;
const COLOURED: f64 = 0.05;
/// Most of a tile that is 0.
const BLACK: f64 = 0.01;
/// The share of the texels from which on a tile is of 0 and 1 alone, or at 0.04.
const NEARLY_ALL: f64 = 0.98;

/// Why a tile cannot be the map of this role; `None` where it can.
pub(super) fn contradiction(tile: &Raster, role: Role) -> Option<&'static str> {
    if !matches!(role, Role::Roughness | Role::Metallic | Role::Specular) {
        return None;
    }
    // Read once: in a large picture each is far from the others.
    let texels: Vec<[f64; 3]> = tile.sampled().map(|index| tile.rgb(index)).collect();
    let share = |is: &dyn Fn([f64; 3]) -> bool| {
        texels.iter().filter(|rgb| is(**rgb)).count() as f64 / texels.len().max(1) as f64
    };
    let within =
        |low: f64, high: f64| move |rgb: [f64; 3]| rgb.into_iter().all(|value| (low..=high).contains(&value));
    let [is_zero, is_one] = [within(-NOISE, NOISE / 2.0), within(1.0 - NOISE / 2.0, 1.0 + NOISE)];
    let is_coloured = share(&|[r, g, b]| r.max(g).max(b) - r.min(g).min(b) > NOISE) > COLOURED;
    let (zeros, ones) = (share(&is_zero), share(&is_one));
    let is_mask = zeros + ones > NEARLY_ALL && zeros.min(ones) > 0.0;
    match role {
        Role::Roughness | Role::Metallic if is_coloured => Some("has colours"),
        Role::Roughness | Role::Specular if share(&within(-NOISE, BLACK)) > NEARLY_ALL => Some("is 0"),
        Role::Roughness | Role::Specular if is_mask => Some("has 0 and 1 alone"),
        Role::Roughness if share(&within(0.03, 0.06)) > NEARLY_ALL => Some("is 0.04, as specular is"),
        _ => None,
    }
}

/// Most texels of a border.
const WIDEST: usize = 8;

/// The tiles alone of a grid that has a border of one colour around each, as `save_image` of torchvision writes them, with its width.
pub(super) fn without_borders(image: &Raster) -> Option<(Raster, usize)> {
    let size = image.size();
    let is_border = |x: usize, y: usize| {
        image.channels.iter().all(|plane| plane.stored(y * size[0] + x) == plane.stored(0))
    };
    let is_line = |axis: usize, at: usize| {
        (0..size[1 - axis]).all(|other| if axis == 0 { is_border(at, other) } else { is_border(other, at) })
    };
    if !(is_line(0, 0) && is_line(1, 0)) || image.channels.iter().all(Samples::is_constant) {
        return None;
    }
    let tilings = (1..=WIDEST).flat_map(|border| (1..=WIDEST).map(move |rows| (border, rows)));
    let (border, counts, tile) = tilings.into_iter().find_map(|(border, rows)| {
        let inside = size.map(|side| side.saturating_sub(border));
        let step = inside[1] / rows;
        let is_divided = step > 2 * border && inside.iter().all(|side| side.is_multiple_of(step));
        let counts = inside.map(|side| side / step.max(1));
        let are_lines = |axis: usize| {
            (0..=counts[axis]).all(|number| (0..border).all(|at| is_line(axis, number * step + at)))
        };
        let fits = is_divided && counts[0] * counts[1] > 2 && (0..2).all(are_lines);
        fits.then(|| (border, counts, step - border))
    })?;
    let [width, height] = counts.map(|count| count * tile);
    let stored = |at: usize| at / tile * (tile + border) + border + at % tile;
    let plane = |index: usize| stored(index / width) * size[0] + stored(index % width);
    let channels = image.channels.iter().map(|one| one.picked(width * height, plane)).collect();
    Some((Raster { width, height, channels, ..image.without_samples() }, border))
}
