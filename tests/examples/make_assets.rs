//! Makes the icons anew: `cargo xtask bless assets` writes them into `assets/`.
//!
//! The icon has the ground truth above its diagonal, and below it the log difference of a prediction.

use std::error::Error;
use std::path::Path;

use image::{Rgba, RgbaImage, imageops};
use svbrdf::{Convention, Kind, Progress, Scene, render};
use svbrdf_core::picture::colour_map::difference_to_display;
use svbrdf_core::picture::difference::{Difference, DifferenceParams};
use svbrdf_core::picture::tone::to_display;

/// Width and height of the largest icon, in pixels.
const SIDE: u32 = 256;
/// Radius of the rounded corners of the icon, in pixels of the largest one.
const RADIUS: f32 = 48.0;

fn main() -> Result<(), Box<dyn Error>> {
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    let scene = Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.5, 0.6, 1.0] };
    let convention = Convention::default();
    let rendered =
        |read: &svbrdf::Read<f32>| render(&read.material, &scene, &convention, &Progress::default());
    let materials = svbrdf::built_in::<f32>()?;
    let [truth, prediction] = [rendered(&materials.ground_truth)?, rendered(&materials.predictions[0])?];
    let params = DifferenceParams { epsilon: convention.epsilon, exposure_ev: 0.0 };
    let differences = Difference::Log.of_images(&truth, &prediction, params);
    let icon = RgbaImage::from_fn(SIDE, SIDE, |x, y| {
        let at = (y * SIDE + x) as usize;
        let [r, g, b] = match x + y < SIDE {
            true => to_display(truth.pixels[at], 1.0),
            false => difference_to_display(differences[at], 1.5, false),
        };
        Rgba([r, g, b, (255.0 * opacity(x, y)).round() as u8])
    });
    for side in [32, 48, 64, 128, 256] {
        let resized = imageops::resize(&icon, side, side, imageops::FilterType::Lanczos3);
        resized.save(assets.join(format!("icons/{side}.png")))?;
    }
    Ok(())
}

/// How much of a pixel is inside of the rounded corners.
fn opacity(x: u32, y: u32) -> f32 {
    let half = SIDE as f32 / 2.0;
    let outside = |at: u32| ((at as f32 + 0.5 - half).abs() - (half - RADIUS)).max(0.0);
    (RADIUS + 0.5 - outside(x).hypot(outside(y))).clamp(0.0, 1.0)
}
