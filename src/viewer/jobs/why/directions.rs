//! Loss of the chosen prediction over the directions of the light or the view, coarse to fine.

use std::sync::Arc;

use glam::DVec3;

use svbrdf_core::error::Error;
use svbrdf_core::model::scene::Endpoint;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::colour_map::difference_to_display;
use svbrdf_core::progress::Progress;
use svbrdf_core::why::{Hemisphere, hemisphere};

use crate::viewer::jobs::why::pair::{ComparedPair, PairKey};
use crate::viewer::jobs::work::job::Job;
use crate::viewer::jobs::work::latest::Latest;
use crate::viewer::jobs::work::picture::Picture;
use crate::viewer::jobs::work::waker::Waker;

/// Columns and rows of the finest map.
pub const SIDE: usize = 64;

/// What a map depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct DirectionsKey {
    pair: PairKey,
    moved: Endpoint,
    /// The unit direction of the light or view that stays.
    fixed: [f64; 3],
}

/// A map over directions, and its picture.
#[derive(Clone, Debug)]
pub struct DirectionMap {
    pub map: Hemisphere,
    pub picture: Arc<Picture>,
    /// The loss that has the last colour: the largest.
    pub largest: f64,
}

/// The map of the chosen prediction.
#[derive(Debug, Default)]
pub struct DirectionsJob {
    fine: Latest<DirectionsKey, DirectionMap, DirectionMap>,
    /// A map that is coarser than the final one.
    coarse: Option<(DirectionsKey, DirectionMap)>,
}

impl DirectionsJob {
    /// Takes over results, and computes what is wanted now; where it is not `displayed`, the latest result stays.
    pub fn follow(
        &mut self,
        waker: &Waker,
        displayed: bool,
        pair: Option<&ComparedPair>,
        moved: Endpoint,
        scene: &Scene,
    ) -> Option<Error> {
        let Some(pair) = pair.filter(|_| displayed) else {
            self.fine.pause();
            return None;
        };
        let coarse = self.fine.updates().and_then(|(key, mut maps)| Some((*key, maps.pop()?)));
        self.coarse = coarse.or_else(|| self.coarse.take());
        let wanted = key(pair, moved, scene);
        self.fine.follow(Some(wanted), |key| {
            let (pair, key) = (pair.clone(), *key);
            Job::stream(waker, Progress::default(), move |worker| {
                let update = |map: &Hemisphere| {
                    // Where the window has dropped this job, its progress ends the work.
                    let _ = worker.replace(DirectionMap::new(map.clone()));
                };
                let comparison = pair.comparison()?;
                let map = hemisphere(&comparison, key.moved, key.fixed, SIDE, &worker.progress, update)?;
                Ok(DirectionMap::new(map))
            })
        })
    }

    /// The finest map of this pair, and whether it is up to date; otherwise the latest one of an earlier light or view.
    pub fn get(&self, pair: &ComparedPair, moved: Endpoint, scene: &Scene) -> Option<(&DirectionMap, bool)> {
        let wanted = key(pair, moved, scene);
        let fine = self.fine.get().map(|(of, map)| (*of, map));
        let coarse = self.coarse.as_ref().map(|(of, map)| (*of, map));
        let current = [fine, coarse].into_iter().flatten().find(|(of, _)| *of == wanted);
        let earlier = fine.filter(|(of, _)| of.pair == wanted.pair && of.moved == moved);
        match (current, earlier) {
            (Some((_, map)), _) => Some((map, true)),
            (None, Some((_, map))) => Some((map, false)),
            (None, None) => None,
        }
    }
}

impl DirectionMap {
    fn new(map: Hemisphere) -> Self {
        let largest = map.worst(0).map_or(0.0, |(_, loss)| loss);
        let range = if largest > 0.0 { largest } else { 1.0 };
        let colour = |loss: &f64| {
            if loss.is_nan() {
                return Picture::TRANSPARENT;
            }
            Picture::opaque(difference_to_display(*loss as f32, range as f32, false))
        };
        let pixels = map.losses[0].iter().map(colour).collect();
        let picture = Arc::new(Picture { size: [map.side; 2], pixels });
        Self { map, picture, largest: range }
    }
}

fn key(pair: &ComparedPair, moved: Endpoint, scene: &Scene) -> DirectionsKey {
    let fixed = match moved {
        Endpoint::Light => scene.view,
        Endpoint::View => scene.light,
    };
    DirectionsKey { pair: pair.key, moved, fixed: DVec3::from(fixed).normalize().to_array() }
}
