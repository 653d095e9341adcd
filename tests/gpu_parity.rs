//! The adapter: what it holds, shades in part and shows. Its renderings are rungs of `ladder`.
#![cfg(feature = "viewer")]

mod adapter;
mod display;
mod drafts;

use svbrdf_core::model::convention::{Convention, GUIDED_2020, PRINTED};
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_needs::needs;

use crate::support::gpu::{bumpy, gpu_f32, shaded};

#[needs(f32_adapter)]
fn a_member_of_the_grammar_is_drawn_as_the_nearest_of_the_two_models() {
    let scene = Scene { kind: Kind::Near, view: [-0.5, 0.25, 1.5], light: [0.9, 0.8, 0.3] };
    let of = |convention: &Convention| {
        shaded(gpu_f32(), &bumpy(9, 7), &scene, convention).read_back(gpu_f32()).unwrap().pixels
    };
    for (name, nearest, other) in
        [("materialgan-2020", PRINTED, GUIDED_2020), ("matfuse-2024", GUIDED_2020, PRINTED)]
    {
        let drawn = of(&name.parse().unwrap());
        assert!(drawn == of(&nearest) && drawn != of(&other), "{name}");
    }
}
