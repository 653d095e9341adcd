//! Differences as colours, against the numbers of the core.

use glam::Vec3;

use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::Texel;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::picture::colour_map::{diverging, heat};
use svbrdf_core::picture::difference::{Difference, DifferenceParams};
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::progress::Progress;
use svbrdf_gpu::{DisplayParams, DisplayedDifference, Shaded};
use svbrdf_needs::needs;

use super::{ABOVE, faults, levels, shaded, whole};
use crate::support::gpu::{bumpy, gpu_f32, picture};

/// The differences of two materials of 8 x 8 texels under [`ABOVE`], from the core.
fn differences_of(kind: Difference, quantity: Quantity, pair: &[Material<f32>; 2]) -> Vec<f32> {
    let image =
        |material| quantity.image(material, &ABOVE, &PRINTED, &Progress::default()).expect("rendered");
    let [prediction, ground_truth] = pair.each_ref().map(image);
    kind.of_images(
        &ground_truth,
        &prediction,
        DifferenceParams { epsilon: PRINTED.epsilon, exposure_ev: 0.0 },
    )
}

/// Their colours.
fn colours_of(values: &[f32], DisplayedDifference { kind, range, .. }: DisplayedDifference) -> Vec<[u8; 3]> {
    let map = if kind.is_signed() { diverging } else { heat };
    values.iter().map(|value| levels(map(value / range).map(f64::from))).collect()
}

#[needs(f32_adapter)]
fn differences_have_the_colours_of_the_core_s_numbers_at_any_exposure() {
    let gpu = gpu_f32();
    let up = Texel {
        normal: Vec3::new(0.0, 0.0, 1.0),
        diffuse: [0.3, 0.5, 0.2],
        specular: [0.3; 3],
        roughness: 0.4,
    };
    let pair = [bumpy(8, 8), Material::uniform("flat", 8, 8, &up).expect("valid")];
    for quantity in Quantity::ALL {
        let [shown, reference] = pair.each_ref().map(|material| shaded(gpu, material, quantity));
        for &kind in Difference::pointwise(quantity) {
            let values = differences_of(kind, quantity, &pair);
            let largest = values.iter().fold(0.0, |largest: f32, value| largest.max(value.abs()));
            let difference = DisplayedDifference { kind, range: 0.9 * largest, is_computed: false };
            let drawn = |reference: &Shaded| {
                let whole = whole([8, 8], quantity);
                let params = DisplayParams { difference: Some(difference), exposure_ev: 3.0, ..whole };
                picture(gpu, [8, 8], &shown, reference, &params)
            };
            let expected = colours_of(&values, difference);
            let off = faults(&drawn(&reference), |column, row| Some(expected[row * 8 + column]));
            assert_eq!(off, Vec::<String>::new(), "{kind:?} of {quantity:?}");
            let zero = faults(&drawn(&shown), |_, _| Some([0; 3]));
            assert_eq!(zero, Vec::<String>::new(), "a picture does not differ from itself");
            // A planted fault: the same numbers in another range are other colours.
            let narrower = DisplayedDifference { range: 0.8 * difference.range, ..difference };
            let planted = colours_of(&values, narrower);
            assert!(!faults(&drawn(&reference), |x, y| Some(planted[y * 8 + x])).is_empty(), "{kind:?}");
        }
    }
}
