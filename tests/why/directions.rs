//! The loss over directions, and the worst scene.

use glam::DVec3;

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::model::scene::Endpoint;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::why::{Hemisphere, TAIL, hemisphere, worst};

use super::{built_in, printed, uniform};

/// A tilted normal whose highlight the prediction lacks, and the light under which the view from above sees it.
fn planted() -> (svbrdf_core::material::Material<f64>, svbrdf_core::material::Material<f64>, DVec3) {
    let normal = DVec3::new(0.25, 0.15, 1.0).normalize();
    let light = 2.0 * normal.z * normal - DVec3::Z;
    let material = |specular| uniform(normal.to_array(), 0.3, specular, 0.15);
    (material(0.6), material(0.04), light)
}

fn map(comparison: &Comparison<'_, f64>, moved: Endpoint, side: usize) -> Hemisphere {
    hemisphere(comparison, moved, [0.0, 0.0, 1.0], side, &Progress::default()).unwrap()
}

#[test]
fn a_planted_bad_direction_is_found_by_the_map() {
    let (truth, prediction, light) = planted();
    let comparison = Comparison::new(&truth, &[&prediction], printed()).unwrap();
    for moved in [Endpoint::Light, Endpoint::View] {
        let map = map(&comparison, moved, 64);
        let (worst, loss) = map.worst(0).unwrap();
        // Within two cells, of 2/64 each; reciprocity makes both maps alike.
        let off = (DVec3::from(worst) - light).length();
        assert!(off < 2.0 * 2.0 / 64.0, "{moved:?}: {worst:?}, not {light:?}");
        assert!(loss > 3.0 * map.mean(0), "{loss}, {}", map.mean(0));
        let cell = map.directions.iter().position(|direction| *direction == Some(worst)).unwrap();
        assert_eq!(map.losses[0][cell], loss);
        assert!((DVec3::from(worst) + light).length() > 0.3, "the mirrored direction would pass");
    }
}

#[test]
fn a_cell_of_the_map_is_the_loss_of_its_scene() {
    let [truth, blurred, rough] = built_in();
    let [truth, blurred, rough] = [truth, blurred, rough].map(|m| m.resized([24, 24]).unwrap());
    let comparison = Comparison::new(&truth, &[&blurred, &rough], printed()).unwrap();
    let view = [0.3, -0.2, 1.0];
    let map = hemisphere(&comparison, Endpoint::Light, view, 10, &Progress::default()).unwrap();
    for (index, direction) in map.directions.iter().enumerate() {
        let Some(light) = *direction else {
            assert!(map.losses.iter().all(|losses| losses[index].is_nan()));
            continue;
        };
        let scene = Scene { kind: Kind::Distant, view, light };
        let expected = comparison.run(&Request::Listed(vec![scene]), &Progress::default()).unwrap();
        for (losses, loss) in map.losses.iter().zip(&expected.losses) {
            // 24 x 24 texels are fewer than are sampled: all are compared, in another order.
            assert!((losses[index] - loss.per_scene[0]).abs() < 1e-6, "{light:?}");
        }
    }
    assert_eq!(map.directions.iter().flatten().count(), 76);
    assert_eq!(map.standard_error(0), 0.0);
}

#[test]
fn sampled_texels_give_a_map_within_its_standard_error() {
    let [truth, blurred, _] = built_in().map(|material| material.cast::<f64>());
    let comparison = Comparison::new(&truth, &[&blurred], printed()).unwrap();
    let map = map(&comparison, Endpoint::Light, 16);
    let cells: Vec<usize> = (0..256).filter(|&cell| map.directions[cell].is_some()).collect();
    let scene = |cell: &usize| Scene {
        kind: Kind::Distant,
        view: [0.0, 0.0, 1.0],
        light: map.directions[*cell].unwrap(),
    };
    let request = Request::Listed(cells.iter().map(scene).collect());
    let expected = comparison.run(&request, &Progress::default()).unwrap().losses.remove(0).per_scene;
    let squares = |map: &Hemisphere| {
        let off = |(cell, expected): (&usize, &f64)| (map.losses[0][*cell] - expected).powi(2);
        let sum: f64 = cells.iter().zip(&expected).map(off).sum();
        (sum / cells.len() as f64).sqrt() / map.standard_error(0)
    };
    let ratio = squares(&map);
    assert!(map.standard_error(0) > 0.0 && (0.05..3.0).contains(&ratio), "{ratio}");
    let mut faulty = map.clone();
    for pair in cells.windows(2) {
        faulty.losses[0][pair[0]] = map.losses[0][pair[1]];
    }
    assert!(squares(&faulty) > 3.0, "a map that is moved by a cell is not seen: {}", squares(&faulty));
}

#[test]
fn the_worst_scene_is_worse_than_any_of_many_sampled_ones() {
    let (truth, prediction, _) = planted();
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
        let normal = DVec3::new(0.25, 0.15, 1.0).normalize();
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
