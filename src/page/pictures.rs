//! Pictures of pages as JPEG in data URIs: the still picture of a figure, and thumbnails of materials.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use image::codecs::jpeg::JpegEncoder;
use image::imageops::{self, FilterType};
use image::{Rgb, RgbImage};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::image::Image;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::content::PictureContent;
use svbrdf_core::picture::exposure::automatic;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error;

/// Width of a material in the still picture in pixels, and their largest number in a row.
const STILL: (u32, usize) = (384, 5);
/// Largest exposure of the figure, in stops, in either direction.
const MOST_STOPS: f32 = 8.0;
/// Pixels between pictures that stand side by side.
const GAP: u32 = 2;
const QUALITY: u8 = 86;
/// The gray between pictures.
const BACKGROUND: Rgb<u8> = Rgb([36, 38, 42]);

/// The materials with sides of at most `most` texels, halved.
pub(super) fn reduced(materials: &[&Material<f32>], most: usize) -> Result<Vec<Material<f32>>, CoreError> {
    let one = |material: &&Material<f32>| {
        let [mut width, mut height] = material.size();
        while width.max(height) > most {
            [width, height] = [width.div_ceil(2), height.div_ceil(2)];
        }
        let copy = (*material).clone();
        if copy.size() == [width, height] { Ok(copy) } else { copy.resized([width, height]) }
    };
    materials.iter().map(one).collect()
}

/// The exposure in stops at which the brightest 1% of a rendering of the ground truth just clip, to a step of the figure's control.
pub fn exposure(ground_truth: &Material<f32>, scene: &Scene, convention: &Convention) -> f32 {
    ((2.0 * automatic(ground_truth, scene, convention)).round() / 2.0).clamp(-MOST_STOPS, MOST_STOPS)
}

/// The rendering of a material, at most `width` pixels wide.
pub(super) fn thumbnail(
    material: &Material<f32>,
    scene: &Scene,
    convention: &Convention,
    exposure_ev: f32,
    width: u32,
    progress: &Progress,
) -> Result<String, Error> {
    let image = Quantity::Rendering.image(material, scene, convention, progress)?;
    data_uri(&coloured(&image, PictureContent::default(), exposure_ev, width))
}

/// The content of every material, in rows; of differences the value of the ground truth first.
pub(super) fn still(
    materials: &[&Material<f32>],
    content: PictureContent,
    scene: &Scene,
    convention: &Convention,
    exposure_ev: f32,
) -> Result<String, Error> {
    let (width, columns) = STILL;
    let progress = Progress::default();
    let mut pictures = Vec::new();
    let mut add = |content: PictureContent, materials: &[&Material<f32>]| -> Result<(), CoreError> {
        let shown = content.pictures(materials, scene, convention, exposure_ev, &progress)?;
        let coloured = |image| coloured(image, shown.content, exposure_ev, width);
        pictures.extend(shown.images.iter().map(coloured));
        Ok(())
    };
    if content.difference.is_some() {
        add(PictureContent { difference: None, ..content }, &materials[..1])?;
    }
    add(content, materials)?;
    data_uri(&in_rows(&pictures, columns))
}

/// The colours of a picture, at most `width` pixels wide.
fn coloured(image: &Image<f32>, content: PictureContent, exposure_ev: f32, width: u32) -> RgbImage {
    let picture = RgbImage::from_fn(image.width as u32, image.height as u32, |x, y| {
        Rgb(content.colour(image.pixels[y as usize * image.width + x as usize], exposure_ev))
    });
    if picture.width() <= width {
        return picture;
    }
    let height = (picture.height() * width / picture.width()).max(1);
    imageops::resize(&picture, width, height, FilterType::Triangle)
}

/// The pictures, of one size, in rows of at most `columns`.
fn in_rows(pictures: &[RgbImage], columns: usize) -> RgbImage {
    let columns = pictures.len().clamp(1, columns) as u32;
    let rows = (pictures.len() as u32).div_ceil(columns);
    let [width, height] = pictures.first().map_or([1, 1], |first| [first.width(), first.height()]);
    let side = |count: u32, side: u32| count * (side + GAP) - GAP;
    let mut all = RgbImage::from_pixel(side(columns, width), side(rows.max(1), height), BACKGROUND);
    for (place, picture) in (0..).zip(pictures) {
        let [x, y] = [place % columns * (width + GAP), place / columns * (height + GAP)];
        imageops::replace(&mut all, picture, x.into(), y.into());
    }
    all
}

fn data_uri(picture: &RgbImage) -> Result<String, Error> {
    let mut bytes = Vec::new();
    let encoded = JpegEncoder::new_with_quality(&mut bytes, QUALITY).encode_image(picture);
    encoded.map_err(|problem| Error::Internal(format!("a JPEG cannot be encoded: {problem}")))?;
    Ok(format!("data:image/jpeg;base64,{}", BASE64_STANDARD.encode(bytes)))
}
