//! Every n-th texel of a material, shaded while a light moves on a slow adapter.

use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_gpu::{MaterialTextures, ShadeParams, Shading};
use svbrdf_needs::needs;

use crate::support::gpu::{bumpy, gpu, gpu_f32, of_8_bits};

/// A draft shades the texels in the middle of squares, each as it is shaded in full: from the whole material, from its reduced
/// textures, which are all that is read while a light moves, and from those that are sent before the rest.
#[needs(adapter)]
fn a_draft_shades_every_nth_texel_as_it_is_shaded_in_full() {
    // As floats, and as codes.
    [(bumpy(23, 14), 48), (of_8_bits(&bumpy(23, 14)), 16)]
        .into_iter()
        .for_each(|(material, bytes)| drafts_of(&material, bytes));
}

/// Maps of few values are sent as codes, and are the numbers of the core, bit for bit, in whole and reduced textures.
#[needs(adapter)]
fn coded_maps_are_the_numbers_of_the_core_bit_for_bit() {
    let gpu = gpu_f32();
    let material = of_8_bits(&bumpy(70, 61));
    let planes = material.planes();
    let textures = MaterialTextures::upload(gpu, &material).unwrap();
    assert_eq!(textures.texel_bytes(), 16);
    let shading = Shading::new(gpu).unwrap();
    let scene = Scene { kind: Kind::Near, view: [0.3, -0.2, 1.5], light: [-0.6, 0.5, 1.0] };
    let values = |quantity: Quantity, stride: usize| {
        let params = ShadeParams { scene, convention: PRINTED, quantity };
        let maps = shading.reduced_textures(gpu, &textures, [70, 61], stride).unwrap();
        let target = shading.reduced_target(gpu, [70, 61], stride).unwrap();
        shading.draw(gpu, if stride == 1 { &textures } else { &maps }, &params, &target);
        target.read_back(gpu).unwrap().pixels
    };
    let colour = |[r, g, b]: &[Vec<f32>; 3], index: usize| [r[index], g[index], b[index]];
    for (stride, texel) in [(1, 70 * 30 + 11), (3, 70 * 31 + 13)] {
        let columns = 70_usize.div_ceil(stride);
        let place = (texel / 70 / stride) * columns + texel % 70 / stride;
        assert_eq!(values(Quantity::Diffuse, stride)[place], colour(&planes.diffuse, texel));
        assert_eq!(values(Quantity::Specular, stride)[place], colour(&planes.specular, texel));
        assert_eq!(values(Quantity::Roughness, stride)[place], [planes.roughness[texel]; 3]);
        let normal = colour(&planes.normal, texel).map(|one| one * 0.5 + 0.5);
        assert_eq!(values(Quantity::Normal, stride)[place], normal);
    }
    let all: Vec<[f32; 3]> = (0..70 * 61).map(|index| colour(&planes.specular, index)).collect();
    assert_eq!(values(Quantity::Specular, 1), all);
    // A planted fault, another texel: red. And one value too many: floats.
    assert_ne!(values(Quantity::Diffuse, 1)[0], colour(&planes.diffuse, 1));
    let mut many = planes.clone();
    (0..257).for_each(|index| many.roughness[index] = index as f32 / 300.0);
    let many = Material::new("many", 70, 61, many).unwrap();
    assert_eq!(MaterialTextures::upload(gpu, &many).unwrap().texel_bytes(), 48);
}

fn drafts_of(material: &Material<f32>, bytes: usize) {
    let gpu = gpu();
    let [width, height] = material.size();
    let textures = MaterialTextures::upload(gpu, material).unwrap();
    assert_eq!(textures.texel_bytes(), bytes);
    let shading = Shading::new(gpu).unwrap();
    for quantity in [Quantity::Rendering, Quantity::Normal, Quantity::Roughness] {
        let scene = Scene { kind: Kind::Near, view: [0.3, -0.2, 1.5], light: [-0.6, 0.5, 1.0] };
        let params = ShadeParams { scene, convention: PRINTED, quantity };
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
            let sent = MaterialTextures::upload_reduced(gpu, material, stride).unwrap();
            for maps in [&textures, &reduced, &sent] {
                shading.draw(gpu, maps, &params, &target);
                assert_eq!(target.read_back(gpu).unwrap().pixels, expected, "{quantity:?} {stride}");
            }
        }
    }
}
