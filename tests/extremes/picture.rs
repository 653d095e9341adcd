//! docs/extremes.svg: maps of the error over roughness and the angle between n and h.

use std::fmt::{Display, Write as _};

use glam::DVec3;
use rayon::prelude::*;

use svbrdf_core::model::brdf::Texel;
use svbrdf_core::model::convention::PRINTED;

use super::cases::{Batch, row, turned};
use super::regions::Truth;
use super::rungs::{self, Rgb};
use super::survey::error_of_any;
use crate::support::points::Generator;

const COLUMNS: usize = 70;
const ROWS: usize = 48;
/// Pairs of light and view. A cell shows the largest error over all of them.
const PAIRS: u64 = 24;
/// The ranges of the axes, as decimal logarithms.
const ANGLES: [f64; 2] = [-7.0, 0.0];
const ROUGHNESSES: [f64; 2] = [-4.0, 0.0];

/// Pixels per cell.
const CELL: usize = 4;
const WIDTH: usize = COLUMNS * CELL;
const HEIGHT: usize = ROWS * CELL;
/// Pixels from one panel to the next.
const PITCH: [usize; 2] = [WIDTH + 34, HEIGHT + 66];
const ORIGIN: [usize; 2] = [74, 74];

/// The largest error that each colour stands for. The last one also stands for infinite, NaN and negative results.
const SCALE: [(f64, &str, &str); 9] = [
    (1e-7, "#1f5fa8", "1e-7"),
    (1e-6, "#4a97c9", "1e-6"),
    (1e-5, "#9ecae1", "1e-5"),
    (1e-4, "#e3eef7", "1e-4"),
    (1e-3, "#fee391", "1e-3"),
    (1e-2, "#fe9929", "1e-2"),
    (1e-1, "#d7301f", "0.1"),
    (1.0, "#7f0000", "1"),
    (f64::INFINITY, "#111111", "more"),
];

/// A title and the largest relative error in each cell, row by row from r = 1e-4; empty without an adapter.
struct Panel {
    title: &'static str,
    errors: Vec<f64>,
}

/// The middle of cell `i` of `count` on a logarithmic axis.
fn at([low, high]: [f64; 2], i: usize, count: usize) -> f64 {
    10f64.powf(low + (high - low) * (i as f64 + 0.5) / count as f64)
}

/// White metals of every roughness, rotated from the half vector by every angle at random azimuths, under one pair of
/// light and view within 20 degrees of the zenith.
fn batch(pair: u64) -> Batch {
    let mut g = Generator::new(5, pair);
    let mut near_zenith = || {
        let [angle, azimuth] = [0.35 * g.uniform(), std::f64::consts::TAU * g.uniform()];
        turned(DVec3::Z, angle, azimuth).as_vec3()
    };
    let (w_l, w_v) = (near_zenith(), near_zenith());
    let h = (w_l.as_dvec3() + w_v.as_dvec3()).normalize();
    let texel = |i: usize| {
        let azimuth = std::f64::consts::TAU * g.uniform();
        Texel {
            normal: turned(h, at(ANGLES, i % COLUMNS, COLUMNS), azimuth).as_vec3(),
            diffuse: [0.0; 3],
            specular: [1.0; 3],
            roughness: at(ROUGHNESSES, i / COLUMNS, ROWS) as f32,
        }
    };
    let texels: Vec<_> = (0..COLUMNS * ROWS).map(texel).collect();
    Batch { convention: PRINTED, near: false, material: row(&texels), w_l, w_v }
}

fn panels() -> Vec<Panel> {
    let batches: Vec<Batch> = (0..PAIRS).map(batch).collect();
    let truth: Vec<Vec<Truth>> = batches.par_iter().map(Truth::of).collect();
    let panel = |title, got: Vec<Vec<Rgb>>| {
        let mut errors = vec![0.0f64; if got.is_empty() { 0 } else { COLUMNS * ROWS }];
        for (got, truth) in got.iter().zip(&truth) {
            for ((worst, got), truth) in errors.iter_mut().zip(got).zip(truth) {
                *worst = worst.max(error_of_any(got[0], truth.expected[0]));
            }
        }
        Panel { title, errors }
    };
    let moved = |t: &Truth| t.expected.map(|x| x * (1.0 + t.one_ulp[0]));
    let fused = |level| batches.iter().filter_map(|b| rungs::fused(level, b)).collect();
    let mut all_fused = panel("fused f32", Vec::new());
    for (_, level) in rungs::levels() {
        let one = panel("", fused(level)).errors;
        all_fused.errors.resize(one.len(), 0.0);
        all_fused.errors.iter_mut().zip(one).for_each(|(worst, error)| *worst = worst.max(error));
    }
    vec![
        panel(
            "change by one ulp of the input",
            truth.iter().map(|b| b.iter().map(moved).collect()).collect(),
        ),
        panel("f32", batches.iter().map(rungs::in_f32).collect()),
        all_fused,
        panel("GPU", rungs::on_gpu(&batches).unwrap_or_default()),
        panel("f32, D in the cancelling form", batches.iter().filter_map(rungs::cancelling).collect()),
        panel("clamps of the released codes", batches.iter().filter_map(rungs::clamped).collect()),
    ]
}

/// The picture.
pub fn svg() -> String {
    let (width, height) = (ORIGIN[0] + 3 * PITCH[0], ORIGIN[1] + 2 * PITCH[1] + 44);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
        height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
        <rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n\
        <text x=\"{}\" y=\"24\" font-size=\"16\">Relative error of R over roughness and the angle between n and h</text>\n\
        <text x=\"{}\" y=\"42\" fill=\"#555\">the largest of {PAIRS} pairs of light and view; s = 1, d = 0; \
        dashed: the half width of the highlight, angle = r^2</text>\n",
        ORIGIN[0], ORIGIN[0],
    );
    for (i, panel) in panels().iter().enumerate() {
        let [x, y] = [ORIGIN[0] + i % 3 * PITCH[0], ORIGIN[1] + i / 3 * PITCH[1]];
        let _ = writeln!(svg, "<g transform=\"translate({x} {y})\">");
        draw(&mut svg, panel, i % 3 == 0);
        svg.push_str("</g>\n");
    }
    legend(&mut svg, ORIGIN[1] + 2 * PITCH[1] - 4);
    svg.push_str("</svg>\n");
    svg
}

fn draw(svg: &mut String, panel: &Panel, with_roughness: bool) {
    let _ = writeln!(svg, "<text y=\"-7\" font-weight=\"bold\">{}</text>", panel.title);
    for (row, errors) in panel.errors.chunks(COLUMNS).enumerate() {
        let y = (ROWS - 1 - row) * CELL;
        let mut start = 0;
        // One rectangle for neighbours of one colour.
        for run in errors.chunk_by(|a, b| colour(*a) == colour(*b)) {
            let (x, width, colour) = (start * CELL, run.len() * CELL, colour(run[0]));
            let _ = writeln!(
                svg,
                "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{CELL}\" fill=\"{colour}\"/>"
            );
            start += run.len();
        }
    }
    if panel.errors.is_empty() {
        label(svg, WIDTH / 2, HEIGHT / 2, "middle", "no adapter");
    }
    let _ = writeln!(svg, "<rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"none\" stroke=\"#333\"/>");
    let [low, high] = ANGLES.map(|angle| y_of(angle / 2.0));
    let _ = writeln!(svg, "<path d=\"M0 {low}L{WIDTH} {high}\" stroke=\"black\" stroke-dasharray=\"5 4\"/>");
    axes(svg, with_roughness);
}

fn axes(svg: &mut String, with_roughness: bool) {
    for (angle, text) in [(-7.0, "1e-7"), (-5.0, "1e-5"), (-3.0, "1e-3"), (-1.0, "0.1")] {
        let x = x_of(angle);
        let _ = writeln!(svg, "<path d=\"M{x} {HEIGHT}v4\" stroke=\"#333\"/>");
        label(svg, x, HEIGHT + 17, "middle", text);
    }
    label(svg, WIDTH / 2, HEIGHT + 33, "middle", "angle between n and h (radians)");
    if !with_roughness {
        return;
    }
    for (r, text) in [(1e-4, "1e-4"), (1e-3, "1e-3"), (1.0 / 255.0, "1/255"), (0.1, "0.1"), (1.0, "1")] {
        let y = y_of(f64::log10(r)).round() as usize;
        let _ = writeln!(svg, "<path d=\"M0 {y}h-4\" stroke=\"#333\"/>");
        label(svg, -8, y + 4, "end", text);
    }
    let _ = writeln!(svg, "<g transform=\"translate(-52 {}) rotate(-90)\">", HEIGHT / 2);
    label(svg, 0, 0, "middle", "roughness r");
    svg.push_str("</g>\n");
}

fn label(svg: &mut String, x: impl Display, y: usize, anchor: &str, text: &str) {
    let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{text}</text>");
}

fn x_of(log_angle: f64) -> f64 {
    WIDTH as f64 * (log_angle - ANGLES[0]) / (ANGLES[1] - ANGLES[0])
}

fn y_of(log_roughness: f64) -> f64 {
    HEIGHT as f64 * (ROUGHNESSES[1] - log_roughness) / (ROUGHNESSES[1] - ROUGHNESSES[0])
}

fn colour(error: f64) -> &'static str {
    SCALE.iter().find(|(most, _, _)| error <= *most).map_or("#111111", |(_, colour, _)| colour)
}

fn legend(svg: &mut String, y: usize) {
    let _ = writeln!(svg, "<text x=\"{}\" y=\"{}\">relative error at most</text>", ORIGIN[0], y + 14);
    for (i, (_, colour, label)) in SCALE.iter().enumerate() {
        let x = ORIGIN[0] + 140 + 74 * i;
        let _ = writeln!(
            svg,
            "<rect x=\"{x}\" y=\"{y}\" width=\"24\" height=\"18\" fill=\"{colour}\" stroke=\"#999\"/>\
            <text x=\"{}\" y=\"{}\">{label}</text>",
            x + 30,
            y + 14,
        );
    }
}
