//! Where and by what the chosen prediction is wrong: the work behind the tab *Why*.

mod attribution;
mod directions;
mod pair;
mod scenes;
mod search;
mod sections;
mod thumbnails;

use crate::error::Error;
use crate::loss::Request;
use crate::viewer::work_context::WorkContext;
use crate::why::{Moved, Worst};

pub(super) use attribution::{ATTRIBUTION_TARGET, Attributed, AttributionRun};
pub(super) use directions::{DirectionMap, DirectionsRun};
pub(super) use pair::ComparedPair;
pub(super) use scenes::{SceneList, ScenesRun};
pub(super) use search::SearchRun;
pub(super) use sections::{WhySection, WhySections};
pub(super) use thumbnails::{MOST as MOST_THUMBNAILS, Thumbnails};

/// Scenes in the panel until more are asked for.
const FEW: usize = 10;

/// What the computations depend on besides the pair and the scene.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct WhyAsked {
    pub sections: WhySections,
    /// The scenes that are listed.
    pub scenes: Request,
    /// Names the scenes of the attribution.
    pub seed: u64,
}

/// The computations, and what of them is shown.
#[derive(Debug)]
pub(super) struct Why {
    pub attribution: AttributionRun,
    pub scenes: ScenesRun,
    pub directions: DirectionsRun,
    pub search: SearchRun,
    /// What moves over the hemisphere.
    pub moved: Moved,
    /// Number of listed scenes.
    pub listed: usize,
}

impl Default for Why {
    fn default() -> Self {
        Self {
            attribution: AttributionRun::default(),
            scenes: ScenesRun::default(),
            directions: DirectionsRun::default(),
            search: SearchRun::default(),
            moved: Moved::Light,
            listed: FEW,
        }
    }
}

impl Why {
    /// Takes over results, and computes what is wanted now; nothing new where the tab is not `shown`.
    pub(super) fn follow(&mut self, work: &WorkContext<'_>, shown: bool, asked: WhyAsked) -> Vec<Error> {
        let pair = ComparedPair::of(work.slots, work.state);
        let (ctx, pair, scene) = (work.ctx, pair.as_ref(), &work.state.scene);
        let shown = |section| shown && asked.sections.is_open(section);
        let errors = [
            self.attribution.follow(ctx, shown(WhySection::Maps), pair, asked.seed),
            self.scenes.follow(ctx, shown(WhySection::Scenes), pair, asked.scenes),
            self.directions.follow(ctx, shown(WhySection::Directions), pair, self.moved, scene),
        ];
        errors.into_iter().flatten().collect()
    }

    /// Takes over the result of the search for the worst scene, once.
    pub(super) fn poll_search(&mut self, work: &WorkContext<'_>) -> Option<Result<Worst, Error>> {
        self.search.poll(work.ctx, ComparedPair::of(work.slots, work.state).as_ref())
    }
}
