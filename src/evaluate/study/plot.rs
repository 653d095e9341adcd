//! A study as a plot: error against time, both logarithmic.

use std::io::{self, Write};
use std::ops::Range;
use std::path::Path;

use epaint_default_fonts::UBUNTU_LIGHT;
use plotters::coord::Shift;
use plotters::element::ComposedElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, register_font};

use crate::study::{Family, Point, Study};
use svbrdf_core::progress::Progress;
use svbrdf_core::text::{percent, time};
use svbrdf_files::Error;

use svbrdf_files::disk::atomic::Destination;

/// Width and height of the picture in pixels.
const SIZE: (u32, u32) = (1200, 780);
/// The family name of the registered font; viewers of an SVG substitute their own.
const FONT: &str = "sans-serif";
const INK: RGBColor = RGBColor(40, 40, 40);
const GRID: RGBColor = RGBColor(225, 225, 225);

/// Pixels, relative to a point of the plot.
type Pixel = (i32, i32);

/// The file formats of plots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlotFormat {
    Svg,
    Png,
}

/// The destination of a plot. Checks `path` before there is anything to write.
///
/// # Errors
/// [`UnknownName`](svbrdf_core::error::Error::UnknownName) for an extension other than svg and png, [`Error::Unwritable`] where
/// its folder is missing or it is itself a folder.
pub fn destination(path: &Path) -> Result<Destination<PlotFormat>, Error> {
    let format = |extension: &str| match extension {
        "svg" => Some(PlotFormat::Svg),
        "png" => Some(PlotFormat::Png),
        _ => None,
    };
    Destination::among(path, format, "extension of a plot", ".svg, .png")
}

/// Writes the plot of `study`; the file appears when it is complete, or not at all.
///
/// # Errors
/// [`Error::Unwritable`], [`Cancelled`](Error::is_cancelled).
pub fn write(study: &Study, destination: &Destination<PlotFormat>, progress: &Progress) -> Result<(), Error> {
    destination.replace(progress, |file| match destination.format {
        PlotFormat::Svg => file.write_all(svg(study)?.as_bytes()),
        PlotFormat::Png => png(file, &rgb(study)?),
    })
}

fn svg(study: &Study) -> io::Result<String> {
    let mut text = String::new();
    draw(SVGBackend::with_string(&mut text, SIZE), study)?;
    Ok(printed(&text))
}

/// The picture as wide as a page of a paper, where its texts have 7 points: `plotters` knows pixels alone.
fn printed(svg: &str) -> String {
    const MILLIMETRES: f64 = 180.0;
    let (width, height) = SIZE;
    let high = MILLIMETRES * f64::from(height) / f64::from(width);
    let pixels = format!(r#"width="{width}" height="{height}""#);
    svg.replacen(&pixels, &format!(r#"width="{MILLIMETRES}mm" height="{high}mm""#), 1)
}

/// Rows of 8-bit RGB.
fn rgb(study: &Study) -> io::Result<Vec<u8>> {
    let mut bytes = vec![0; 3 * (SIZE.0 * SIZE.1) as usize];
    draw(BitMapBackend::with_buffer(&mut bytes, SIZE), study)?;
    Ok(bytes)
}

fn png(file: impl Write, bytes: &[u8]) -> io::Result<()> {
    let mut encoder = png::Encoder::new(file, SIZE.0, SIZE.1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(bytes)?;
    Ok(writer.finish()?)
}

/// Draws with an embedded font: machines without a display may have no fonts.
fn draw<B: DrawingBackend>(backend: B, study: &Study) -> io::Result<()> {
    register_font(FONT, FontStyle::Normal, UBUNTU_LIGHT)
        .map_err(|_| io::Error::other("the font is damaged"))?;
    let area = backend.into_drawing_area();
    chart(&area, study).and_then(|()| area.present()).map_err(|problem| io::Error::other(problem.to_string()))
}

fn chart<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    study: &Study,
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    area.fill(&WHITE)?;
    let [ground_truth, prediction] = &study.names;
    let title = format!("What accuracy costs: {prediction} against {ground_truth}");
    // The label of the fastest point is to its left.
    let (x, y) = (span(study, 2.5, |p| p.seconds), span(study, 1.5, |p| p.error));
    let mut chart = ChartBuilder::on(area)
        .caption(title, (FONT, 24).into_font().color(&INK))
        .margin(16)
        .margin_right(28)
        .x_label_area_size(52)
        .y_label_area_size(76)
        .build_cartesian_2d(
            x.clone().log_scale().with_key_points(ticks(&x)),
            y.clone().log_scale().with_key_points(ticks(&y)),
        )?;
    let [width, height] = study.size;
    chart
        .configure_mesh()
        .x_desc(format!("time of one loss, {width} x {height} texels, {} threads", study.threads))
        .y_desc("error of the loss (root mean square over seeds)")
        .x_label_formatter(&|seconds| time(*seconds))
        .y_label_formatter(&|error| percent(*error))
        .axis_desc_style((FONT, 18).into_font().color(&INK))
        .label_style((FONT, 17).into_font().color(&INK))
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .axis_style(INK)
        .draw()?;

    let front = study.front();
    chart
        .draw_series(LineSeries::new(front.iter().map(|p| place(p)), INK.stroke_width(2)))?
        .label("best for its time")
        .legend(|(x, y)| PathElement::new([(x, y), (x + 20, y)], INK.stroke_width(2)));
    if study.least_error() > y.start {
        let line = [x.start, x.end].map(|seconds| (seconds, study.least_error()));
        chart
            .draw_series(DashedLineSeries::new(line, 6, 6, INK.stroke_width(1)))?
            .label("limit of the reference")
            .legend(|(x, y)| PathElement::new([(x, y), (x + 20, y)], INK.stroke_width(1)));
    }
    for family in Family::ALL {
        let points = || study.points.iter().filter(|p| p.choice.family() == family);
        if points().next().is_none() {
            continue;
        }
        chart
            .draw_series(points().map(|p| marker(family, place(p))))?
            .label(family.name())
            .legend(move |(x, y)| marker(family, (x + 10, y)));
    }
    let text = (FONT, 16).into_font().color(&INK).pos(Pos::new(HPos::Right, VPos::Top));
    chart.draw_series(
        front.iter().map(|p| EmptyElement::at(place(p)) + Text::new(label(p), (-7, 4), text.clone())),
    )?;
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::LowerLeft)
        .background_style(WHITE)
        .border_style(GRID)
        .label_font((FONT, 17).into_font().color(&INK))
        .draw()
}

/// The marker of a family. Shapes differ, not only colours. Families of stored maps are rings around their base.
fn marker<B: DrawingBackend, C>(
    family: Family,
    at: C,
) -> ComposedElement<C, B, Polygon<Pixel>, PathElement<Pixel>> {
    let [r, g, b] = family.colour();
    let colour = RGBColor(r, g, b);
    let (corners, turn, radius, opacity) = match family {
        Family::Sobol => (20, 0.0, 5.0, 1.0),
        Family::MoreTexels => (5, -0.25, 6.0, 1.0),
        Family::FewTexels => (4, 0.0, 6.0, 1.0),
        Family::Random => (3, -0.25, 6.0, 1.0),
        Family::F64 => (3, 0.25, 6.0, 1.0),
        Family::HalfMaps => (4, 0.0, 10.0, 0.0),
        Family::EightBitMaps => (4, 0.125, 11.0, 0.0),
    };
    let angle = |i| std::f64::consts::TAU * (f64::from(i) / f64::from(corners) + turn);
    let corner = |i| [angle(i).cos(), angle(i).sin()].map(|c| (radius * c).round() as i32).into();
    let outline: Vec<Pixel> = (0..=corners).map(corner).collect();
    EmptyElement::at(at)
        + Polygon::new(outline.clone(), colour.mix(opacity).filled())
        + PathElement::new(outline, colour.stroke_width(2))
}

/// The label of a point of the front; its marker tells the family.
fn label(point: &Point) -> String {
    format!("{} scenes", point.choice.scenes)
}

fn place(point: &Point) -> (f64, f64) {
    (point.seconds, point.error)
}

/// The range of the values of all points, extended by a factor below and above.
fn span(study: &Study, room_below: f64, value: impl Fn(&Point) -> f64) -> Range<f64> {
    const ROOM_ABOVE: f64 = 1.5;
    let values = || study.points.iter().map(&value).filter(|v| *v > 0.0);
    let low = values().fold(f64::INFINITY, f64::min);
    let high = values().fold(0.0, f64::max);
    if low <= high { low / room_below..high * ROOM_ABOVE } else { 1e-4..1.0 }
}

/// 1 and 3 times each power of ten in `range`.
fn ticks(range: &Range<f64>) -> Vec<f64> {
    let powers = range.start.log10().floor() as i32..=range.end.log10().ceil() as i32;
    let all = powers.flat_map(|power| [1.0, 3.0].map(|digit| digit * 10f64.powi(power)));
    all.filter(|tick| range.contains(tick)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_1_and_3_times_powers_of_ten() {
        let ticks: Vec<_> = ticks(&(0.002..1.5)).into_iter().map(percent).collect();
        assert_eq!(ticks, ["0.3%", "1%", "3%", "10%", "30%", "100%"]);
    }
}
