//! docs/albedo.svg: albedo over view angle, a panel for each convention and material, a curve for each roughness.

use epaint_default_fonts::UBUNTU_LIGHT;
use plotters::prelude::*;
use plotters::style::{FontStyle, register_font};

use super::albedo::{ANGLES, ROUGHNESS};

/// A plot of the figure.
pub struct Panel {
    pub title: String,
    /// For each roughness the albedo at each angle.
    pub curves: Vec<Vec<f64>>,
}

const SIZE: (u32, u32) = (1000, 800);
const COLOURS: [RGBColor; 6] = [
    RGBColor(68, 1, 84),
    RGBColor(65, 68, 135),
    RGBColor(42, 120, 142),
    RGBColor(34, 168, 132),
    RGBColor(122, 189, 40),
    RGBColor(230, 150, 30),
];

/// The figure.
pub fn svg(panels: &[Panel]) -> String {
    assert!(register_font("sans-serif", FontStyle::Normal, UBUNTU_LIGHT).is_ok(), "the font is usable");
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE).unwrap();
        for (area, panel) in area.split_evenly((2, 2)).iter().zip(panels) {
            draw(area, panel);
        }
        area.present().unwrap();
    }
    // As wide as a page of a paper.
    text.replacen(r#"width="1000" height="800""#, r#"width="180mm" height="144mm""#, 1)
}

fn draw(area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>, panel: &Panel) {
    let mut chart = ChartBuilder::on(area)
        .caption(&panel.title, ("sans-serif", 18))
        .margin(12)
        .x_label_area_size(40)
        .y_label_area_size(48)
        .build_cartesian_2d(0.0..90.0, 0.0..2.0)
        .unwrap();
    chart
        .configure_mesh()
        .disable_mesh()
        .x_labels(7)
        .x_label_formatter(&|angle| format!("{angle:.0}"))
        .y_labels(5)
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 15))
        .x_desc("angle between view and normal (degrees)")
        .y_desc("directional albedo")
        .draw()
        .unwrap();
    for ((curve, colour), roughness) in panel.curves.iter().zip(COLOURS).zip(ROUGHNESS) {
        let points = ANGLES.into_iter().zip(curve.iter().copied());
        chart
            .draw_series(LineSeries::new(points, colour.stroke_width(2)))
            .unwrap()
            .label(format!("r = {roughness}"))
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 16, y)], colour.stroke_width(2)));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .border_style(BLACK)
        .draw()
        .unwrap();
}
