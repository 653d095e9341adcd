//! The numbers of every quantity below the panes: statistics of differences, against values written out in f64.

use svbrdf_core::render;

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

/// Whether these are the statistics of the values.
fn are_statistics_of(measured: &Statistics, values: &[f64]) -> bool {
    let values: Vec<f32> = values.iter().map(|value| *value as f32).collect();
    let numbers = |of: &Statistics| [of.mean, of.minimum, of.median, of.p95, of.maximum];
    let expected = numbers(&Statistics::of(&values).unwrap());
    numbers(measured).iter().zip(expected).all(|(measured, expected)| is_close(*measured, expected))
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
            let measured = window.difference_distributions().unwrap();
            let mut largest = 0.0_f64;
            let what = format!("{} of {}", kind.name(), quantity.name());
            for prediction in [1, 2] {
                let texels = values[0].iter().zip(&values[prediction]);
                let expected: Vec<f64> = texels.map(|(g, p)| difference(kind, *g, *p)).collect();
                let mut magnitudes: Vec<f64> = expected.iter().map(|value| value.abs()).collect();
                magnitudes.sort_by(f64::total_cmp);
                // Interpolated between its two neighbours, as NumPy does.
                let place = 0.99 * (magnitudes.len() - 1) as f64;
                let [low, high] = [place.floor(), place.ceil()].map(|place| magnitudes[place as usize]);
                largest = largest.max(low * (1.0 - place.fract()) + high * place.fract());
                let index = prediction - 1;
                let statistics = measured.statistics[index].as_ref().unwrap();
                assert!(are_statistics_of(statistics, &expected), "{what} of {prediction}: {statistics:?}");
                let counts: u64 = measured.histograms[index].counts.iter().sum();
                assert!(counts > 60_000, "{what} of {prediction}: {counts} texels in the histogram");
                // A planted fault: everything a little larger.
                let faulty: Vec<f64> = expected.iter().map(|value| value * 1.01 + 2e-3).collect();
                assert!(!are_statistics_of(statistics, &faulty), "{what} of {prediction}");
            }
            let largest = if largest > 0.0 { largest } else { 1.0 };
            assert!(is_close(measured.auto_range, largest), "{what}: {} for {largest}", measured.auto_range);
            assert_eq!(window.difference_range(), measured.auto_range, "{what}");
        }
    }
}
