//! Histograms of the values in the panes.

use std::sync::Arc;

use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::{Histogram, Statistics};
use svbrdf_core::progress::Progress;

use crate::error::Error;
use crate::jobs::work::context::JobContext;
use crate::jobs::work::job::Job;
use crate::jobs::work::latest::Latest;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::MaterialId;
use crate::model::material::read::ReadMaterial;
use crate::model::view::state::ViewState;

/// Bins of a histogram.
const BINS: usize = 96;

/// What the histograms depend on.
#[derive(Clone, Debug, PartialEq)]
struct HistogramsKey {
    ids: Vec<MaterialId>,
    quantity: Quantity,
    /// Of a rendering.
    scene: Option<Scene>,
    convention: Convention,
}

/// One channel of one material.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    pub histogram: Histogram,
    /// `None` where nothing is finite.
    pub statistics: Option<Statistics>,
}

/// For each channel of the quantity, every material, the ground truth first.
pub type Values = Vec<Vec<Channel>>;

/// The histograms of the values.
#[derive(Debug, Default)]
pub struct HistogramsJob(Latest<HistogramsKey, Values>);

impl HistogramsJob {
    /// Takes over a result, and computes what is needed now; nothing where it is not `is_visible`.
    pub fn follow(&mut self, work: &JobContext<'_>, is_visible: bool) -> Option<Error> {
        let wanted = (is_visible && !work.materials.is_empty()).then(|| key(work.materials, work.view));
        let (scene, convention) = (work.view.scene, work.view.convention());
        self.0.follow(wanted, |key| {
            let (materials, quantity) = (work.materials(), key.quantity);
            Job::start(work.waker, move |progress| {
                values(&materials, quantity, &scene, &convention, progress)
            })
        })
    }

    /// The latest histograms of these materials and this quantity, and whether they are up to date.
    pub fn get(&self, materials: &[LoadedMaterial], state: &ViewState) -> Option<(&Values, bool)> {
        let (of, values) = self.0.get()?;
        let now = key(materials, state);
        (of.ids == now.ids && of.quantity == now.quantity).then_some((values, *of == now))
    }
}

fn key(materials: &[LoadedMaterial], state: &ViewState) -> HistogramsKey {
    HistogramsKey {
        ids: materials.iter().map(LoadedMaterial::id).collect(),
        quantity: state.display.quantity,
        scene: (state.display.quantity == Quantity::Rendering).then_some(state.scene),
        convention: state.convention(),
    }
}

fn values(
    materials: &[Arc<ReadMaterial>],
    quantity: Quantity,
    scene: &Scene,
    convention: &Convention,
    progress: &Progress,
) -> Result<Values, Error> {
    let images = materials
        .iter()
        .map(|loaded| quantity.image(loaded.material(), scene, convention, progress))
        .collect::<Result<Vec<_>, _>>()?;
    let channel = |c: usize| {
        let planes: Vec<Vec<f32>> =
            images.iter().map(|image| image.pixels.iter().map(|pixel| pixel[c]).collect()).collect();
        of_channel(&planes, quantity)
    };
    Ok((0..quantity.channels()).map(channel).collect())
}

/// One channel of every material, on one axis.
fn of_channel(planes: &[Vec<f32>], quantity: Quantity) -> Vec<Channel> {
    let statistics: Vec<Option<Statistics>> = planes.iter().map(|plane| Statistics::of(plane)).collect();
    let axis = match quantity {
        Quantity::Normal => [-1.0, 1.0],
        // Highlights are rare and far away: the axis ends a little beyond the 95th percentile.
        Quantity::Rendering => {
            let most = statistics.iter().flatten().map(|one| one.p95).fold(0.0, f64::max);
            [0.0, if most > 0.0 { 1.5 * most } else { 1.0 }]
        }
        _ => [0.0, 1.0],
    };
    let one = |(plane, statistics): (&Vec<f32>, Option<Statistics>)| Channel {
        histogram: Histogram::of(plane, axis, BINS),
        statistics,
    };
    planes.iter().zip(statistics).map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_texel_is_in_one_bin_of_its_channel_or_beyond_the_axis() {
        let planes = [vec![0.0, 0.25, 0.5, 1.0], vec![0.1; 4]];
        for quantity in [Quantity::Roughness, Quantity::Rendering, Quantity::Normal] {
            for (channel, plane) in of_channel(&planes, quantity).iter().zip(&planes) {
                let Histogram { counts, above, below, .. } = &channel.histogram;
                assert_eq!(counts.iter().sum::<u64>() + above + below, 4, "{quantity:?}");
                assert_eq!(channel.statistics, Statistics::of(plane));
            }
        }
        let roughness = of_channel(&planes, Quantity::Roughness);
        assert_eq!(roughness[1].histogram.counts[9], 4, "0.1 of 96 bins");
    }
}
