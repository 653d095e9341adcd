//! The numbers of every quantity below the panes: statistics and histograms of differences, against values written out in f64.

use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::Histogram;
use svbrdf_core::progress::Progress;
use svbrdf_core::render;
use svbrdf_viewer::model::view::state::ViewState;

use super::materials::materials;
use super::*;

/// How far numbers from f32 may be off, in units of 1 + the number.
const CLOSE: f64 = 1e-4;

/// The quantity of every texel of the built-in materials, the ground truth first.
fn values(quantity: Quantity) -> Vec<Vec<[f64; 3]>> {
    let scene = ViewState::default().scene;
    let of = |material: Material<f64>| match quantity {
        Quantity::Rendering => {
            render::render(&material, &scene, &PRINTED, &Progress::default()).unwrap().pixels
        }
        _ => (0..material.width() * material.height())
            .map(|i| {
                let texel = material.texel(i);
                match quantity {
                    Quantity::Normal => texel.normal.to_array(),
                    Quantity::Diffuse => texel.diffuse,
                    Quantity::Specular => texel.specular,
                    _ => [texel.roughness; 3],
                }
            })
            .collect(),
    };
    materials().iter().map(|material| of(material.cast())).collect()
}

/// The difference of one texel, written out.
fn difference(kind: Difference, g: [f64; 3], p: [f64; 3]) -> f64 {
    let mean = |of: &dyn Fn(f64, f64) -> f64| (0..3).map(|c| of(g[c], p[c])).sum::<f64>() / 3.0;
    let epsilon = PRINTED.epsilon;
    let log = |g: f64, p: f64| ((p + epsilon) / (g + epsilon)).ln();
    match kind {
        Difference::Log => mean(&|g, p| log(g, p).abs()),
        Difference::SignedLog => mean(&log),
        Difference::Absolute => mean(&|g, p| (p - g).abs()),
        Difference::Signed => mean(&|g, p| p - g),
        Difference::Relative => mean(&|g, p| (p - g).abs() / (g + epsilon)),
        Difference::Angle => {
            let dot: f64 = (0..3).map(|c| g[c] * p[c]).sum();
            let chord: f64 = (0..3).map(|c| (g[c] - p[c]).powi(2)).sum::<f64>().sqrt();
            // Of unit vectors: the arc cosine loses half of the digits where they are close.
            if dot > 0.0 { 2.0 * (chord / 2.0).asin().to_degrees() } else { dot.acos().to_degrees() }
        }
        Difference::Flip => f64::NAN,
    }
}

fn is_close(measured: f64, expected: f64) -> bool {
    (measured - expected).abs() <= CLOSE * (1.0 + expected.abs())
}

/// The quantile of sorted values, interpolated between its two neighbours as NumPy does.
fn quantile(sorted: &[f64], probability: f64) -> f64 {
    let place = probability * (sorted.len() - 1) as f64;
    let [low, high] = [place.floor(), place.ceil()].map(|place| sorted[place as usize]);
    low * (1.0 - place.fract()) + high * place.fract()
}

/// Whether these are the statistics of `sorted`.
fn are_statistics_of(measured: &Statistics, sorted: &[f64]) -> bool {
    let at = |share: f64| quantile(sorted, share);
    let mean = sorted.iter().sum::<f64>() / sorted.len() as f64;
    let expected = [mean, at(0.0), at(0.5), at(0.95), at(1.0)];
    let measured = [measured.mean, measured.minimum, measured.median, measured.p95, measured.maximum];
    measured.iter().zip(expected).all(|(measured, expected)| is_close(*measured, expected))
}

/// Whether as many of `sorted` are below each edge of the histogram as it says, up to values next to the edge.
fn is_histogram_of(measured: &Histogram, sorted: &[f64]) -> bool {
    let below = |edge: f64| sorted.partition_point(|value| *value < edge) as u64;
    let width = (measured.high - measured.low) / measured.counts.len() as f64;
    let mut seen = measured.below;
    let mut edges = measured.counts.iter().enumerate().map(|(bin, count)| {
        let edge = measured.low + bin as f64 * width;
        let near = CLOSE * (1.0 + edge.abs());
        let holds = (below(edge - near)..=below(edge + near)).contains(&seen);
        seen += count;
        holds
    });
    let holds = edges.by_ref().all(|holds| holds);
    holds && measured.counts.iter().sum::<u64>() + measured.below + measured.above == sorted.len() as u64
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values
}

#[needs(adapter)]
fn every_difference_of_every_quantity_has_its_statistics_histogram_and_range() {
    let mut window = built_in();
    press(&mut window, egui::Key::D);
    for quantity in Quantity::ALL {
        let values = values(quantity);
        for &kind in Difference::pointwise(quantity) {
            let state = &mut window.state_mut().parts.model.view;
            state.display.quantity = quantity;
            state.display.differences.choose(quantity, kind);
            window.run_steps(2);
            wait(&mut window, "the statistics", |app| app.difference_distributions().is_some());
            let measured = window.state().difference_distributions().unwrap();
            let mut largest = 0.0_f64;
            let what = format!("{} of {}", kind.name(), quantity.name());
            for prediction in [1, 2] {
                let texels = values[0].iter().zip(&values[prediction]);
                let expected = sorted(texels.map(|(g, p)| difference(kind, *g, *p)));
                let magnitudes = sorted(expected.iter().map(|value| value.abs()));
                largest = largest.max(quantile(&magnitudes, 0.99));
                let index = prediction - 1;
                let statistics = measured.statistics[index].as_ref().unwrap();
                assert!(are_statistics_of(statistics, &expected), "{what} of {prediction}: {statistics:?}");
                let histogram = &measured.histograms[index];
                assert!(is_histogram_of(histogram, &expected), "{what} of {prediction}");
                // Planted faults: everything a little larger, or more than a bin further.
                let faulty: Vec<f64> = expected.iter().map(|value| value * 1.01 + 2e-3).collect();
                assert!(!are_statistics_of(statistics, &faulty), "{what} of {prediction}");
                let bin = (histogram.high - histogram.low) / histogram.counts.len() as f64;
                let moved: Vec<f64> = expected.iter().map(|value| value + 1.5 * bin).collect();
                assert!(!is_histogram_of(histogram, &moved), "{what} of {prediction}");
            }
            let largest = if largest > 0.0 { largest } else { 1.0 };
            assert!(is_close(measured.auto_range, largest), "{what}: {} for {largest}", measured.auto_range);
            assert_eq!(window.state().difference_range(), measured.auto_range, "{what}");
        }
    }
}
