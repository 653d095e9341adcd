//! A study as a figure: error against time, both logarithmic.

use std::f64::consts::TAU;

use svbrdf_core::text::{percent, time};
use svbrdf_files::export::figure::{Anchor, Figure, TextStyle};

use super::{Family, Point, Study};

/// Width and height of the figure in points: as wide as the text of a page.
const SIZE: [f64; 2] = [510.0, 330.0];
/// Left, top, right and bottom of the plot in it.
const PLOT: [f64; 4] = [40.0, 40.0, 500.0, 295.0];
/// Pixels of a point in a PNG: 300 of an inch.
const SCALE: f64 = 300.0 / 72.0;
const TEXT: f64 = 7.0;
const INK: [u8; 3] = [40; 3];
const GRID: [u8; 3] = [225; 3];

impl Family {
    /// The colour of its markers, distinguishable with any colour vision (Okabe and Ito 2008), and their number of corners.
    fn marker(self) -> ([u8; 3], u32) {
        match self {
            Self::FewTexels => ([0, 114, 178], 4),
            Self::MoreTexels => ([86, 180, 233], 5),
            Self::Sobol => ([0, 158, 115], 20),
            Self::Random => ([213, 94, 0], 3),
        }
    }
}

impl Study {
    /// The name of its figure.
    pub fn title(&self) -> String {
        let [ground_truth, prediction] = &self.names;
        format!("What accuracy costs: {prediction} against {ground_truth}")
    }

    /// The plot of its points, with the Pareto front and the limit of the reference.
    pub fn figure(&self) -> Figure {
        let [left, top, right, bottom] = PLOT;
        let mut figure = Figure::new(SIZE, SCALE);
        write(&mut figure, [left, 8.0], &self.title(), 10.0, Anchor::Left);
        let errors = "error of the loss (root mean square over seeds)";
        write(&mut figure, [left, top - 12.0], errors, TEXT, Anchor::Left);
        let [width, height] = self.size;
        let times = format!("time of one loss, {width} x {height} texels, {} threads", self.threads);
        write(&mut figure, [0.5 * (left + right), bottom + 16.0], &times, TEXT, Anchor::Middle);

        // The label of the fastest point is to its left.
        let (seconds, errors) = (self.span(2.5, |p| p.seconds), self.span(1.5, |p| p.error));
        let x = |value: f64| left + (right - left) * share(value, seconds);
        let y = |value: f64| bottom - (bottom - top) * share(value, errors);
        for tick in ticks(seconds) {
            figure.stroke(vec![[x(tick), top], [x(tick), bottom]], 0.5, GRID);
            write(&mut figure, [x(tick), bottom + 4.0], &time(tick), TEXT, Anchor::Middle);
        }
        for tick in ticks(errors) {
            figure.stroke(vec![[left, y(tick)], [right, y(tick)]], 0.5, GRID);
            write(&mut figure, [left - 4.0, y(tick) - 4.5], &percent(tick), TEXT, Anchor::Right);
        }
        figure.stroke(vec![[left, top], [left, bottom], [right, bottom]], 0.75, INK);

        let place = |point: &Point| [x(point.seconds), y(point.error)];
        let front = self.front();
        figure.stroke(front.iter().map(|point| place(point)).collect(), 1.0, INK);
        let mut legend = vec![("best for its time", None)];
        let limit = self.least_error();
        if limit > errors[0] {
            figure.stroke(vec![[left, y(limit)], [right, y(limit)]], 0.5, INK);
            write(&mut figure, [right, y(limit) - 9.0], "limit of the reference", TEXT, Anchor::Right);
        }
        for family in Family::ALL {
            let points: Vec<_> = self.points.iter().filter(|p| p.family == family).collect();
            legend.extend((!points.is_empty()).then_some((family.name(), Some(family))));
            points.into_iter().for_each(|point| mark(&mut figure, family, place(point)));
        }
        for point in front {
            let ([x, y], label) = (place(point), format!("{} scenes", point.scenes()));
            write(&mut figure, [x - 5.0, y + 2.0], &label, TEXT, Anchor::Right);
        }
        for (line, (name, family)) in (0..).zip(legend) {
            let top = bottom - 60.0 + 11.0 * f64::from(line);
            let [x, y] = [left + 14.0, top + 4.0];
            match family {
                Some(family) => mark(&mut figure, family, [x, y]),
                None => figure.stroke(vec![[x - 6.0, y], [x + 6.0, y]], 1.0, INK),
            }
            write(&mut figure, [x + 12.0, top], name, TEXT, Anchor::Left);
        }
        figure
    }

    /// The range of the values of all points, extended by a factor below and above.
    fn span(&self, room_below: f64, value: impl Fn(&Point) -> f64) -> [f64; 2] {
        const ROOM_ABOVE: f64 = 1.5;
        let values = || self.points.iter().map(&value).filter(|v| *v > 0.0);
        let low = values().fold(f64::INFINITY, f64::min);
        let high = values().fold(0.0, f64::max);
        if low <= high { [low / room_below, high * ROOM_ABOVE] } else { [1e-4, 1.0] }
    }
}

fn write(figure: &mut Figure, at: [f64; 2], text: &str, size: f64, anchor: Anchor) {
    figure.text(at, SIZE[0], text, TextStyle { size, ink: INK, anchor });
}

/// The outline of a marker: a polygon with a corner at its top.
fn mark(figure: &mut Figure, family: Family, [x, y]: [f64; 2]) {
    const RADIUS: f64 = 2.6;
    let (ink, corners) = family.marker();
    let angle = |corner| TAU * f64::from(corner) / f64::from(corners);
    let corner = |corner| [x + RADIUS * f64::sin(angle(corner)), y - RADIUS * f64::cos(angle(corner))];
    figure.stroke((0..=corners).map(corner).collect(), 1.2, ink);
}

/// Where a value lies in a range, on a scale of logarithms.
fn share(value: f64, [low, high]: [f64; 2]) -> f64 {
    (value / low).ln() / (high / low).ln()
}

/// 1 and 3 times each power of ten in a range.
fn ticks([low, high]: [f64; 2]) -> Vec<f64> {
    let powers = low.log10().floor() as i32..=high.log10().ceil() as i32;
    let all = powers.flat_map(|power| [1.0, 3.0].map(|digit| digit * 10f64.powi(power)));
    all.filter(|tick| (low..high).contains(tick)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_1_and_3_times_powers_of_ten() {
        let ticks: Vec<_> = ticks([0.002, 1.5]).into_iter().map(percent).collect();
        assert_eq!(ticks, ["0.3%", "1%", "3%", "10%", "30%", "100%"]);
    }
}
