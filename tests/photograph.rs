//! Photographs that our own renderer makes: what is known of them has to come out.

mod capture_statistics;
mod captures;
mod comparing;
mod materialgan;
mod reading;

use svbrdf_core::image::Image;
use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::Texel;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::photograph::{PhotographComparison, Rectified};
use svbrdf_files::photograph::Corners;
use svbrdf_files::read::{Photograph, Transfer};
use svbrdf_files::samples;

/// A light and a view of a hand-held photograph.
const SCENE: Scene = Scene { kind: Kind::Near, view: [0.2, -0.1, 2.4], light: [0.5, 0.3, 1.6] };

fn photograph(width: usize, height: usize, at: impl Fn(usize, usize) -> [f32; 3]) -> Photograph {
    let pixels: Vec<_> = (0..width * height).map(|i| at(i % width, i / width)).collect();
    let clipped = vec![false; pixels.len()];
    let image = Image { width, height, pixels };
    Photograph {
        image,
        clipped,
        transfer: Transfer::Linear,
        transfer_from: "as specified",
        notes: Vec::new(),
    }
}

fn rectified(photograph: &Photograph, corners: &Corners, material: &Material<f32>) -> Rectified {
    Rectified::new(photograph, corners, material.size(), &Progress::default()).unwrap()
}

fn compared(rectified: &Rectified, material: &Material<f32>) -> PhotographComparison {
    rectified.compare(material, &SCENE, &PRINTED, &Progress::default()).unwrap()
}

/// The built-in ground truth and its predictions, 64 x 64.
fn small() -> [Material<f32>; 3] {
    let built_in = samples::load::<f32>().unwrap();
    let all = std::iter::once(built_in.ground_truth).chain(built_in.predictions);
    let all: Vec<_> = all.map(|read| read.material.resized([64, 64]).unwrap()).collect();
    all.try_into().unwrap()
}

/// A plane of one texel: with a highlight.
fn glossy(roughness: f32) -> Material<f32> {
    let normal = [0.0, 0.0, 1.0].into();
    let texel = Texel { normal, diffuse: [0.4, 0.3, 0.2], specular: [0.08; 3], roughness };
    Material::uniform("glossy", 64, 48, &texel).unwrap()
}
