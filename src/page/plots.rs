//! Plots of the findings as inline SVG, which needs no script.

use std::fmt::Write as _;

use svbrdf_core::loss::Estimate;
use svbrdf_core::picture::colour_map::difference_to_display;
use svbrdf_evaluate::why::Hemisphere;

use super::markup::{escaped, number, place};

/// Width and height of a bar of a table, in pixels.
const BAR: [f64; 2] = [180.0, 16.0];

/// A bar from 0 to `value` with its 95% interval, on an axis from `low` to `high`.
pub(super) fn bar(value: &Estimate, [low, high]: [f64; 2]) -> String {
    let [width, height] = BAR;
    let x = |value: f64| (value - low) / (high - low).max(f64::MIN_POSITIVE) * (width - 4.0) + 2.0;
    let (from, to) = (x(value.mean.min(0.0)), x(value.mean.max(0.0)));
    let sign = if value.mean < 0.0 { " minus" } else { "" };
    let middle = height / 2.0;
    let error = value.interval95.map_or(String::new(), |[low, high]| {
        let (low, high) = (x(low), x(high));
        format!(r#"<line class="error" x1="{low:.1}" x2="{high:.1}" y1="{middle}" y2="{middle}"/>"#)
    });
    let zero = x(0.0);
    let extent = to - from;
    format!(
        r#"<svg class="row" viewBox="0 0 {width} {height}" preserveAspectRatio="none" aria-hidden="true"><rect class="bar{sign}" x="{from:.1}" y="3" width="{extent:.1}" height="10"/>{error}<line class="axis" x1="{zero:.1}" x2="{zero:.1}" y1="0" y2="{height}"/></svg>"#
    )
}

/// The axis on which bars of all `values` and their intervals fit.
pub(super) fn axis<'a>(values: impl Iterator<Item = &'a Estimate>) -> [f64; 2] {
    values.fold([0.0, 0.0], |[low, high], value| {
        let [lower, upper] = value.interval95.unwrap_or([value.mean; 2]);
        [low.min(lower), high.max(upper)]
    })
}

/// The colours from 0 to `most`, with numbers.
pub(super) fn legend(most: f64) -> String {
    const STEPS: usize = 64;
    let mut cells = String::new();
    for i in 0..STEPS {
        let [r, g, b] = difference_to_display(i as f32, (STEPS - 1) as f32, false);
        let x = 4 * i;
        let _ =
            write!(cells, r##"<rect x="{x}" y="0" width="4.2" height="12" fill="#{r:02x}{g:02x}{b:02x}"/>"##);
    }
    let [middle, last] = [most / 2.0, most].map(number);
    format!(
        r#"<svg class="scale" viewBox="0 0 256 28" role="img" aria-label="Colours from 0 to {last}">{cells}<text x="0" y="25">0</text><text x="128" y="25" text-anchor="middle">{middle}</text><text x="256" y="25" text-anchor="end">{last}</text></svg>"#
    )
}

/// The loss of a prediction over the directions of the light, seen from above; `most` has the last colour.
pub(super) fn directions(map: &Hemisphere, prediction: usize, name: &str, most: f64) -> String {
    let side = map.side as f64;
    let size = 2.0 / side;
    // Nothing of the background shines through between two cells.
    let covered = 1.05 * size;
    let mut cells = String::new();
    for (index, loss) in map.losses[prediction].iter().enumerate().filter(|(_, loss)| !loss.is_nan()) {
        let [x, y] = [index % map.side, index / map.side].map(|i| i as f64 * size - 1.0);
        let [r, g, b] = difference_to_display(*loss as f32, most as f32, false);
        let _ = write!(
            cells,
            r##"<rect x="{x:.3}" y="{y:.3}" width="{covered:.3}" height="{covered:.3}" fill="#{r:02x}{g:02x}{b:02x}"/>"##
        );
    }
    let worst = map.worst(prediction);
    let [worst_x, worst_y] = worst.map_or([0.0; 2], |([x, y, _], _)| [x, -y]);
    let label = worst.map_or(String::new(), |(direction, loss)| {
        format!("largest {} at {}", number(loss), place(direction))
    });
    format!(
        r#"<svg class="directions" viewBox="-1.08 -1.08 2.16 2.16" role="img" aria-label="Loss of {} over directions of the light: {label}" shape-rendering="crispEdges">{cells}<circle class="cursor" cx="{worst_x:.3}" cy="{worst_y:.3}" r="0.06" shape-rendering="auto"/></svg>"#,
        escaped(name)
    )
}
