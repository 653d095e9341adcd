//! The worst scene.

use glam::DVec3;

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::model::scene::Kind;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::why::{TAIL, worst};

use super::{built_in, printed, uniform};

#[test]
fn the_worst_scene_is_worse_than_any_of_many_sampled_ones() {
    let normal = DVec3::new(0.25, 0.15, 1.0).normalize();
    let [truth, prediction] = [0.6, 0.04].map(|specular| uniform(normal.to_array(), 0.3, specular, 0.15));
    let found = worst(&truth, &prediction, &printed(), 0, TAIL, &Progress::default()).unwrap();
    let comparison = Comparison::new(&truth, &[&prediction], printed()).unwrap();
    let sampled = Sampler::Random.scenes(99, 4000, 2000, &printed());
    let losses = comparison.run(&Request::Listed(sampled), &Progress::default()).unwrap().losses.remove(0);
    let largest = losses.per_scene.iter().copied().fold(0.0, f64::max);
    assert!(found.loss >= largest, "{} is less than {largest}", found.loss);
    let again = comparison.run(&Request::Listed(vec![found.scene]), &Progress::default()).unwrap();
    assert_eq!(again.losses[0].per_scene[0], found.loss);
    assert!(found.loss > 2.0 * found.mean.mean && found.evaluations > 6144, "{found:?}");
    if found.scene.kind == Kind::Distant {
        let [light, view] = [found.scene.light, found.scene.view].map(|d| DVec3::from(d).normalize());
        let half = (light + view).normalize();
        assert!(half.dot(normal) > 0.99, "the highlight is not at {half}");
    }
}

#[test]
fn equal_materials_have_no_worst_scene_above_zero() {
    let [truth, ..] = built_in();
    let small = truth.resized([16, 16]).unwrap();
    let found = worst(&small, &small, &printed(), 0, TAIL, &Progress::default()).unwrap();
    assert_eq!((found.loss, found.mean.mean), (0.0, 0.0));
}
