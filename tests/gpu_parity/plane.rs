//! The plane on which a material is repeated, lit as one.

use glam::DVec3;

use svbrdf_core::material::{Grid, Material};
use svbrdf_core::model::brdf::{self, Model, Texel};
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::render::widened;
use svbrdf_gpu::{DisplayParams, Encoding, Gpu, ShadeParams, Shaded, Tiling};
use svbrdf_needs::needs;

use crate::support::gpu::{bumpy, from_above, gpu, gpu_f32, picture, shaded_by};
use crate::support::tolerance::PLANE;

const SCENE: Scene = Scene { kind: Kind::Near, view: [0.3, -0.2, 1.5], light: [-0.6, 0.5, 1.0] };
/// Even sides, odd ones, whose middle cuts a texel, and the smallest.
const SIZES: [[usize; 2]; 4] = [[12, 8], [9, 7], [8, 5], [1, 1]];

fn shaded(gpu: &Gpu, material: &Material<f32>, quantity: Quantity, repeated: bool) -> Shaded {
    shaded_by(gpu, material, &ShadeParams { scene: SCENE, convention: PRINTED, quantity, repeated })
}

/// The radiances of the cells, row by row, in f64: the plane spans the material, two texels to each of its spacings.
fn cells(material: &Material<f32>) -> Vec<[f64; 3]> {
    let [width, height] = material.size();
    let spacing = 1.0 / (width.max(2) - 1) as f64;
    let [columns, rows] = Grid { width, height }.repeated_cells();
    let cell = |index: usize| {
        // The middle cell, or the middle between two, is at the origin.
        let x = spacing * ((index % columns) as f64 - 0.5 * (columns - 1) as f64);
        let y = spacing * (0.5 * (rows - 1) as f64 - (index / columns) as f64);
        let (column, row) = ((index % columns + width / 2) % width, (index / columns + height / 2) % height);
        let texel = widened(&material.texel(row * width + column));
        let towards = |place: [f64; 3]| (DVec3::from(place) - DVec3::new(x, y, 0.0)).normalize();
        brdf::render(&Model::from(&PRINTED), &texel, towards(SCENE.light), towards(SCENE.view))
    };
    (0..columns * rows).map(cell).collect()
}

/// The largest relative deviation of the shaded cells.
fn largest(gpu: &Gpu, material: &Material<f32>, expected: &[[f64; 3]]) -> f64 {
    let got = shaded(gpu, material, Quantity::Rendering, true).read_back(gpu).unwrap().pixels;
    assert_eq!(got.len(), expected.len());
    let pairs = got.as_flattened().iter().zip(expected.as_flattened());
    pairs.map(|(got, expected)| (f64::from(*got) - expected).abs() / expected.max(1e-3)).fold(0.0, f64::max)
}

#[needs(f32_adapter)]
#[test]
fn every_cell_is_lit_in_its_own_place() {
    let gpu = gpu_f32();
    for [width, height] in SIZES {
        let material = bumpy(width, height);
        let mut expected = cells(&material);
        let off = largest(gpu, &material, &expected);
        assert!(off < PLANE, "{width} x {height}: {off}");
        // Planted: a cell that shows its neighbour.
        let count = expected.len();
        expected.swap(0, count - 1);
        expected.swap(count / 3, count / 2);
        let off = largest(gpu, &material, &expected);
        assert!(off > 100.0 * PLANE, "{width} x {height}: {off}");
    }
}

/// The largest step between neighbours of a row.
fn steepest(row: &[[f32; 3]]) -> f32 {
    row.windows(2).map(|pair| (pair[0][0] - pair[1][0]).abs()).fold(0.0, f32::max)
}

#[needs(f32_adapter)]
#[test]
fn a_constant_material_has_no_seam() {
    let gpu = gpu_f32();
    let texel = Texel { normal: glam::Vec3::Z, diffuse: [0.0; 3], specular: [1.0; 3], roughness: 1.0 };
    let material = Material::uniform("constant", 32, 32, &texel).unwrap();
    let plane = shaded(gpu, &material, Quantity::Rendering, true).read_back(gpu).unwrap();
    let on_plane = steepest(&plane.pixels[32 * 64..33 * 64]);
    // Copies of the material, each lit in the place of the material, begin and end in its middle.
    let once = shaded(gpu, &material, Quantity::Rendering, false).read_back(gpu).unwrap();
    let copies: Vec<[f32; 3]> = (0..64).map(|column| once.pixels[16 * 32 + (column + 16) % 32]).collect();
    assert!(steepest(&copies) > 10.0 * on_plane, "{} and {on_plane}", steepest(&copies));
}

#[needs(adapter)]
#[test]
fn the_plane_shows_the_texels_that_copies_show() {
    let gpu = gpu();
    for size in SIZES {
        let material = bumpy(size[0], size[1]);
        let half = size.map(|side| side as f32 / (size[0].max(2) - 1) as f32);
        let [plane, once] =
            [true, false].map(|repeated| shaded(gpu, &material, Quantity::Roughness, repeated));
        for zoom in [0.7, 2.0, 6.0] {
            let pane = size.map(|side| (side as f32 * zoom).ceil() as u32);
            let params = |tiling| DisplayParams { tiling, ..from_above(half, Encoding::Data) };
            let as_plane = picture(gpu, pane, &plane, &plane, &params(Tiling::Plane));
            let as_copies = picture(gpu, pane, &once, &once, &params(Tiling::Copies));
            let alone = picture(gpu, pane, &once, &once, &params(Tiling::Once));
            // Pixels that cover several texels average over the seam of the plane, but not over that of copies.
            if zoom >= 2.0 {
                assert_eq!(as_plane.pixels, as_copies.pixels, "{size:?} at {zoom}");
            }
            assert!(size == [1, 1] || as_plane.pixels != alone.pixels, "{size:?} at {zoom}");
        }
    }
}
