//! Losses of the predictions over the directions of the light or the view, coarse to fine.

use std::sync::Arc;

use glam::DVec3;

use svbrdf_core::model::scene::Endpoint;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::colour_map::difference_to_display;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::why::{Hemisphere, hemisphere};

use crate::error::Error;
use crate::jobs::why::pair::{self, ComparedPair, PairKey};
use crate::jobs::work::job::Job;
use crate::jobs::work::latest::Latest;
use crate::jobs::work::picture::Picture;
use crate::jobs::work::waker::Waker;

/// Columns and rows of the finest map.
pub const SIDE: usize = 64;

/// What the maps depend on.
#[derive(Clone, Debug, PartialEq)]
struct DirectionsKey {
    pairs: Vec<PairKey>,
    moved: Endpoint,
    /// The unit direction of the light or view that stays.
    fixed: [f64; 3],
}

/// The losses of the predictions over directions, and their pictures.
#[derive(Clone, Debug)]
pub struct DirectionMaps {
    pub map: Hemisphere,
    /// Of each prediction, under one range: the largest of all losses.
    pub losses: Vec<ScaledPicture>,
    /// For each prediction its loss minus that of the best other one; empty where there is no other.
    pub differences: Vec<(usize, ScaledPicture)>,
}

/// A picture in false colours.
#[derive(Clone, Debug)]
pub struct ScaledPicture {
    pub picture: Arc<Picture>,
    /// The amount that has the last colour.
    pub range: f64,
}

/// The maps of all predictions.
#[derive(Debug, Default)]
pub struct DirectionsJob {
    fine: Latest<DirectionsKey, DirectionMaps, DirectionMaps>,
    /// Maps that are coarser than the final ones.
    coarse: Option<(DirectionsKey, DirectionMaps)>,
}

impl DirectionsJob {
    /// Takes over results, and computes what is wanted now; where it is not `displayed`, the latest result stays.
    pub fn follow(
        &mut self,
        waker: &Waker,
        displayed: bool,
        pairs: &[ComparedPair],
        moved: Endpoint,
        scene: &Scene,
    ) -> Option<Error> {
        if !displayed || pairs.is_empty() {
            self.fine.pause();
            return None;
        }
        let coarse = self.fine.updates().and_then(|(key, mut maps)| Some((key.clone(), maps.pop()?)));
        self.coarse = coarse.or_else(|| self.coarse.take());
        let wanted = key(pairs, moved, scene);
        self.fine.follow(Some(wanted), |key| {
            let (pairs, moved, fixed) = (pairs.to_vec(), key.moved, key.fixed);
            Job::stream(waker, Progress::default(), move |worker| {
                let update = |map: &Hemisphere| {
                    // Where the window has dropped this job, its progress ends the work.
                    let _ = worker.replace(DirectionMaps::new(map.clone()));
                };
                let comparison = pair::comparison(&pairs)?;
                let map = hemisphere(&comparison, moved, fixed, SIDE, &worker.progress, update)?;
                Ok(DirectionMaps::new(map))
            })
        })
    }

    /// The finest maps of these pairs, and whether they are up to date; otherwise the latest ones of an earlier light or view.
    pub fn get(
        &self,
        pairs: &[ComparedPair],
        moved: Endpoint,
        scene: &Scene,
    ) -> Option<(&DirectionMaps, bool)> {
        let wanted = key(pairs, moved, scene);
        let fine = self.fine.get();
        let coarse = self.coarse.as_ref().map(|(of, maps)| (of, maps));
        let current = [fine, coarse].into_iter().flatten().find(|(of, _)| **of == wanted);
        let earlier = fine.filter(|(of, _)| of.pairs == wanted.pairs && of.moved == moved);
        match (current, earlier) {
            (Some((_, maps)), _) => Some((maps, true)),
            (None, Some((_, maps))) => Some((maps, false)),
            (None, None) => None,
        }
    }
}

impl DirectionMaps {
    fn new(map: Hemisphere) -> Self {
        let predictions = 0..map.losses.len();
        let largest =
            predictions.clone().filter_map(|k| map.worst(k)).map(|(_, loss)| loss).fold(0.0, f64::max);
        let losses = map.losses.iter().map(|losses| picture(&map, losses, largest, false)).collect();
        let difference = |k: usize| {
            let others = predictions.clone().filter(|other| *other != k);
            let best = others.min_by(|a, b| map.mean(*a).total_cmp(&map.mean(*b)))?;
            let apart: Vec<f64> = map.losses[k].iter().zip(&map.losses[best]).map(|(a, b)| a - b).collect();
            let range = apart.iter().filter(|v| !v.is_nan()).fold(0.0, |most: f64, v| most.max(v.abs()));
            Some((best, picture(&map, &apart, range, true)))
        };
        let differences = predictions.clone().filter_map(difference).collect();
        Self { map, losses, differences }
    }
}

/// Amounts over the cells of a map in false colours; the last colour is that of `range`.
fn picture(map: &Hemisphere, amounts: &[f64], range: f64, is_signed: bool) -> ScaledPicture {
    let range = if range > 0.0 { range } else { 1.0 };
    let colour = |amount: &f64| {
        if amount.is_nan() {
            return Picture::TRANSPARENT;
        }
        Picture::opaque(difference_to_display(*amount as f32, range as f32, is_signed))
    };
    let pixels = amounts.iter().map(colour).collect();
    ScaledPicture { picture: Arc::new(Picture { size: [map.side; 2], pixels }), range }
}

fn key(pairs: &[ComparedPair], moved: Endpoint, scene: &Scene) -> DirectionsKey {
    let fixed = match moved {
        Endpoint::Light => scene.view,
        Endpoint::View => scene.light,
    };
    let fixed = DVec3::from(fixed).normalize().to_array();
    DirectionsKey { pairs: pairs.iter().map(|pair| pair.key).collect(), moved, fixed }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn predictions_share_a_range_and_are_compared_with_the_best_other_one() {
        let row = |values: [f64; 3]| vec![values[0], values[1], f64::NAN, values[2]];
        let map = Hemisphere {
            side: 2,
            directions: vec![Some([0.0, 0.0, 1.0]), Some([0.6, 0.0, 0.8]), None, Some([0.0, 0.6, 0.8])],
            losses: vec![row([0.1, 0.2, 0.3]), row([0.3, 0.1, 0.2]), row([0.9, 0.9, 0.9])],
            standard_errors: vec![vec![0.0; 4]; 3],
        };
        let maps = DirectionMaps::new(map);
        assert!(maps.losses.iter().all(|one| one.range == 0.9));
        let others: Vec<usize> = maps.differences.iter().map(|(other, _)| *other).collect();
        // The first two have the same mean: the first of them is the best of the others of the third.
        assert_eq!(others, [1, 0, 0]);
        let (_, first) = &maps.differences[0];
        assert!((first.range - 0.2).abs() < 1e-12);
        let at = |index: usize| first.picture.pixels[index];
        // 0.1 - 0.3: the first is better, in the cold colours; 0.2 - 0.1: in the warm ones.
        assert!(at(0)[2] > at(0)[0] && at(1)[0] > at(1)[2], "{:?} {:?}", at(0), at(1));
        assert_eq!(at(2), Picture::TRANSPARENT);
    }
}
