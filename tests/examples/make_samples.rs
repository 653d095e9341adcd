//! Makes the sample materials anew: `cargo xtask bless samples` writes them into `assets/samples/`.

use std::error::Error;
use std::fs::File;
use std::path::Path;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder};

use svbrdf_core::material::Planes;
use svbrdf_files::samples::generate::{SIDE, blurred_normals, ground_truth, pack, wrong_roughness};

fn main() -> Result<(), Box<dyn Error>> {
    let truth = ground_truth();
    write("worn_tiles.png", &truth)?;
    write("blurred_normals.png", &blurred_normals(&truth))?;
    write("wrong_roughness.png", &wrong_roughness(&truth))
}

fn write(name: &str, planes: &Planes<f64>) -> Result<(), Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/samples").join(name);
    let encoder =
        PngEncoder::new_with_quality(File::create(&path)?, CompressionType::Best, FilterType::Adaptive);
    let side = u32::try_from(SIDE)?;
    encoder.write_image(&pack(planes), 4 * side, side, ExtendedColorType::Rgb8)?;
    println!("wrote {name}, {} bytes", path.metadata()?.len());
    Ok(())
}
