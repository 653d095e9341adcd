//! How much of a loss comes from each map.

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::material::{Map, Material};
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::why::{Attribution, attribute};

use super::{built_in, printed};
use crate::support::tolerance::SHAPLEY_SUM;

const COARSE: Request = Request::Accuracy { target: 0.05, seed: 3 };

fn blame(ground_truth: &Material<f32>, prediction: &Material<f32>) -> Attribution {
    attribute(ground_truth, prediction, &printed(), &COARSE, &Progress::default()).unwrap()
}

/// A prediction that is wrong in all maps.
fn all_wrong() -> [Material<f32>; 2] {
    let [truth, blurred, rough] = built_in();
    let mixed = blurred.with_maps_of(&rough, |map| map == Map::Roughness).unwrap();
    let mut planes = mixed.planes().clone();
    planes.diffuse.iter_mut().flatten().for_each(|d| *d *= 0.7);
    planes.specular.iter_mut().flatten().for_each(|s| *s = (1.5 * *s).min(1.0));
    [truth, Material::new("all wrong", mixed.width(), mixed.height(), planes).unwrap()]
}

/// |the sum of the Shapley values - the loss|, over the loss.
fn gap(attribution: &Attribution) -> f64 {
    let sum: f64 = attribution.maps.iter().map(|share| share.shapley.mean).sum();
    (sum / attribution.loss.mean - 1.0).abs()
}

#[test]
fn shapley_values_add_up_to_the_loss_that_is_reported_elsewhere() {
    let [truth, wrong] = all_wrong();
    let found = blame(&truth, &wrong);
    let comparison = Comparison::new(&truth, &[&wrong], printed()).unwrap();
    let loss = comparison.run(&COARSE, &Progress::default()).unwrap().losses.remove(0);
    assert_eq!(found.loss, loss.estimate);
    assert!(gap(&found) < SHAPLEY_SUM, "{}", gap(&found));
    let shares = found.maps.map(|share| share.shapley.mean / found.loss.mean);
    assert!(shares.iter().all(|share| *share > 0.02), "every map is wrong: {shares:?}");

    let mut faulty = found;
    faulty.maps[2].shapley.mean *= 1.001;
    assert!(gap(&faulty) > SHAPLEY_SUM, "a planted fault is not seen");
}

#[test]
fn a_map_that_alone_is_wrong_gets_all_the_blame() {
    let [truth, wrong] = all_wrong();
    for map in Map::ALL {
        let prediction = truth.with_maps_of(&wrong, |taken| taken == map).unwrap();
        let found = blame(&truth, &prediction);
        assert!(found.loss.mean > 0.001, "{map:?}");
        for share in found.maps {
            let [shapley, alone, without] =
                [share.shapley, share.only_wrong, share.only_right].map(|e| e.mean);
            if share.map == map {
                assert!((shapley / found.loss.mean - 1.0).abs() < SHAPLEY_SUM, "{map:?}: {shapley}");
                assert_eq!([alone, without], [found.loss.mean, 0.0], "{map:?}");
            } else {
                assert_eq!(
                    [shapley, alone, without],
                    [0.0, 0.0, found.loss.mean],
                    "{map:?}: {:?}",
                    share.map
                );
            }
        }
    }
}

#[test]
fn only_wrong_and_only_right_are_the_losses_of_these_mixtures() {
    let [truth, wrong] = all_wrong();
    let scenes = Sampler::Random.scenes(5, 4, 2, &printed());
    let request = Request::Listed(scenes);
    let found = attribute(&truth, &wrong, &printed(), &request, &Progress::default()).unwrap();
    for share in found.maps {
        let only_wrong = truth.with_maps_of(&wrong, |map| map == share.map).unwrap();
        let only_right = wrong.with_maps_of(&truth, |map| map == share.map).unwrap();
        let comparison = Comparison::new(&truth, &[&only_wrong, &only_right], printed()).unwrap();
        let losses = comparison.run(&request, &Progress::default()).unwrap().losses;
        let expected = [losses[0].estimate.mean, losses[1].estimate.mean];
        assert_eq!([share.only_wrong.mean, share.only_right.mean], expected, "{:?}", share.map);
        assert_ne!(expected[0], expected[1]);
    }
}

#[test]
fn intervals_of_shapley_values_hold_the_values_over_far_more_scenes() {
    let [truth, wrong] = all_wrong();
    let fine = Request::Accuracy { target: 0.004, seed: 77 };
    let expected = attribute(&truth, &wrong, &printed(), &fine, &Progress::default()).unwrap();
    let mut held = 0;
    for seed in 0..25 {
        let request = Request::Accuracy { target: 0.05, seed };
        let found = attribute(&truth, &wrong, &printed(), &request, &Progress::default()).unwrap();
        for (found, expected) in found.maps.iter().zip(&expected.maps) {
            let [low, high] = found.shapley.interval95.unwrap();
            held += usize::from(low <= expected.shapley.mean && expected.shapley.mean <= high);
        }
    }
    // The 0.1% quantile of 25 independent groups of 4 equal ones at 95% is 76.
    assert!((76..=100).contains(&held), "{held} of 100");
}
