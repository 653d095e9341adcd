//! Every n-th texel of a material, shaded while a light moves on a slow adapter.

use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_gpu::{MaterialTextures, ShadeParams, Shading};
use svbrdf_needs::needs;

use crate::support::gpu::{bumpy, gpu};

/// A draft shades the texels in the middle of squares, each as it is shaded in full: from the whole material, from its reduced
/// textures, which are all that is read while a light moves, and from those that are sent before the rest.
#[needs(adapter)]
#[test]
fn a_draft_shades_every_nth_texel_as_it_is_shaded_in_full() {
    let gpu = gpu();
    let [width, height] = [23, 14];
    let material = bumpy(width, height);
    let textures = MaterialTextures::upload(gpu, &material).unwrap();
    let shading = Shading::new(gpu).unwrap();
    for quantity in [Quantity::Rendering, Quantity::Normal, Quantity::Roughness] {
        let scene = Scene { kind: Kind::Near, view: [0.3, -0.2, 1.5], light: [-0.6, 0.5, 1.0] };
        let params = ShadeParams { scene, convention: PRINTED, quantity, repeated: false };
        let whole = shading.target(gpu, [width, height]).unwrap();
        shading.draw(gpu, &textures, &params, &whole);
        let full = whole.read_back(gpu).unwrap();
        for stride in [2, 3, 5, 40] {
            let target = shading.reduced_target(gpu, [width, height], stride).unwrap();
            let reduced = shading.reduced_textures(gpu, &textures, [width, height], stride).unwrap();
            let middle = |i: usize, side: usize| (i * stride + stride / 2).min(side - 1);
            let [columns, rows] = [width, height].map(|side| side.div_ceil(stride));
            let texel = |i: usize| middle(i / columns, height) * width + middle(i % columns, width);
            let expected: Vec<[f32; 3]> = (0..columns * rows).map(|i| full.pixels[texel(i)]).collect();
            let sent = MaterialTextures::upload_reduced(gpu, &material, stride).unwrap();
            for maps in [&textures, &reduced, &sent] {
                shading.draw(gpu, maps, &params, &target);
                assert_eq!(target.read_back(gpu).unwrap().pixels, expected, "{quantity:?} {stride}");
            }
        }
    }
}
