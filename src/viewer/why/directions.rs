//! The loss of the chosen prediction over the directions of the light or the view, computed on a worker, coarse to fine.

use std::sync::{Arc, Mutex, PoisonError};

use eframe::egui::{self, Color32, ColorImage};
use glam::DVec3;

use super::pair::{ComparedPair, PairKey};
use crate::error::Error;
use crate::model::scene::Scene;
use crate::picture::colour_map::difference_to_display;
use crate::viewer::latest::Latest;
use crate::viewer::panel_texture::PanelTexture;
use crate::viewer::worker::Task;
use crate::why::{Hemisphere, Moved, hemisphere};

/// Columns and rows of the finest map.
pub(super) const SIDE: usize = 64;

/// What a map depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct DirectionsKey {
    pair: PairKey,
    moved: Moved,
    /// The unit direction of the light or view that stays.
    fixed: [f64; 3],
}

/// A map over directions, and its picture.
#[derive(Clone, Debug)]
pub(crate) struct DirectionMap {
    pub map: Hemisphere,
    pub texture: PanelTexture,
    /// The loss that has the last colour: the largest.
    pub largest: f64,
}

/// A map that is coarser than the final one.
type Coarse = Arc<Mutex<Option<(DirectionsKey, DirectionMap)>>>;

/// The map of the chosen prediction.
#[derive(Debug, Default)]
pub(crate) struct DirectionsRun {
    fine: Latest<DirectionsKey, DirectionMap>,
    /// Left by the worker.
    arriving: Coarse,
    coarse: Option<(DirectionsKey, DirectionMap)>,
}

impl DirectionsRun {
    /// Takes over results, and computes what is wanted now; where nothing is `shown`, the latest result is kept.
    pub(crate) fn follow(
        &mut self,
        ctx: &egui::Context,
        shown: bool,
        pair: Option<&ComparedPair>,
        moved: Moved,
        scene: &Scene,
    ) -> Option<Error> {
        let Some(pair) = pair.filter(|_| shown) else {
            self.fine.rest();
            return None;
        };
        let arrived = self.arriving.lock().unwrap_or_else(PoisonError::into_inner).take();
        self.coarse = arrived.or_else(|| self.coarse.take());
        let wanted = key(pair, moved, scene);
        let arriving = self.arriving.clone();
        self.fine.follow(ctx, Some(wanted), |key| {
            let (pair, key, with) = (pair.clone(), *key, ctx.clone());
            Task::start(ctx, move |progress| {
                let update = |map: &Hemisphere| {
                    let coarse = DirectionMap::new(&with, map.clone());
                    *arriving.lock().unwrap_or_else(PoisonError::into_inner) = Some((key, coarse));
                    with.request_repaint();
                };
                let comparison = pair.comparison()?;
                let map = hemisphere(&comparison, key.moved, key.fixed, SIDE, progress, update)?;
                Ok(DirectionMap::new(&with, map))
            })
        })
    }

    /// The finest map of this pair, and whether it is up to date; otherwise the latest one of an earlier light or view.
    pub(crate) fn get(
        &self,
        pair: &ComparedPair,
        moved: Moved,
        scene: &Scene,
    ) -> Option<(&DirectionMap, bool)> {
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
    fn new(ctx: &egui::Context, map: Hemisphere) -> Self {
        let largest = map.worst(0).map_or(0.0, |(_, loss)| loss);
        let range = if largest > 0.0 { largest } else { 1.0 };
        let colour = |loss: &f64| {
            if loss.is_nan() {
                return Color32::TRANSPARENT;
            }
            let [r, g, b] = difference_to_display(*loss as f32, range as f32, false);
            Color32::from_rgb(r, g, b)
        };
        let pixels = map.losses[0].iter().map(colour).collect();
        let picture = ColorImage::new([map.side; 2], pixels);
        let texture = PanelTexture::new(ctx, "directions", picture, egui::TextureOptions::NEAREST);
        Self { map, texture, largest: range }
    }
}

fn key(pair: &ComparedPair, moved: Moved, scene: &Scene) -> DirectionsKey {
    let fixed = match moved {
        Moved::Light => scene.view,
        Moved::View => scene.light,
    };
    DirectionsKey { pair: pair.key, moved, fixed: DVec3::from(fixed).normalize().to_array() }
}
