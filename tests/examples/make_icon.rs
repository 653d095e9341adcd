//! Makes the icons anew: `cargo xtask bless icons` writes them into `assets/icons/`.
//!
//! Above the diagonal stands the built-in ground truth, below it the log difference of a prediction from it.

use std::error::Error;
use std::path::Path;

use image::imageops::{FilterType, resize};
use image::{Rgba, RgbaImage};
use svbrdf::{Convention, Kind, Progress, Scene, built_in, render};
use svbrdf_core::picture::colour_map::difference_to_display;
use svbrdf_core::picture::difference::{Difference, DifferenceParams};
use svbrdf_core::picture::tone::to_display;

const SIDE: u32 = 256;
/// Radius of the rounded corners, in pixels of the largest icon.
const RADIUS: f32 = 48.0;

fn main() -> Result<(), Box<dyn Error>> {
    let materials = built_in::<f32>()?;
    let scene = Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.5, 0.6, 1.0] };
    let convention = Convention::default();
    let rendered = |material| render(material, &scene, &convention, &Progress::default());
    let ground_truth = rendered(&materials.ground_truth.material)?;
    let prediction = rendered(&materials.predictions[0].material)?;
    let params = DifferenceParams { epsilon: convention.epsilon, exposure_ev: 0.0 };
    let differences = Difference::Log.of_images(&ground_truth, &prediction, params);
    let icon = RgbaImage::from_fn(SIDE, SIDE, |x, y| {
        let at = (y * SIDE + x) as usize;
        let [r, g, b] = if x + y < SIDE {
            to_display(ground_truth.pixels[at], 1.0)
        } else {
            difference_to_display(differences[at], 1.5, false)
        };
        Rgba([r, g, b, (255.0 * opacity(x, y)).round() as u8])
    });
    for side in [32, 48, 64, 128, 256] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/icons");
        resize(&icon, side, side, FilterType::Lanczos3).save(folder.join(format!("{side}.png")))?;
    }
    Ok(())
}

/// How much of a pixel is inside of the rounded corners.
fn opacity(x: u32, y: u32) -> f32 {
    let outside = |at: u32| {
        let from_middle = (at as f32 + 0.5 - SIDE as f32 / 2.0).abs();
        (from_middle - (SIDE as f32 / 2.0 - RADIUS)).max(0.0)
    };
    (RADIUS + 0.5 - outside(x).hypot(outside(y))).clamp(0.0, 1.0)
}
