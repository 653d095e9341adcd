//! Panes: their arrangement, what each displays, its marks and handles, and the gestures of the mouse in them.
//!
//! [`Displayed`] is asked for once a frame: materials, their difference, a photograph, with what else a title tells, and the numbers of
//! texels.

pub mod difference;
pub mod draft;
pub mod gestures;
pub mod gpu_view;
pub mod handles;
pub mod legend;
pub mod marks;
pub mod placed;
pub mod scenery;
pub mod shade;
pub mod shaded;
pub mod snapshot;
pub mod statistics;
pub mod title;
pub mod viewport;

use std::sync::Arc;

use svbrdf_core::loss::Estimate;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::Distributions;

use crate::dataset::matrix;
use crate::jobs::answers::Answered;
use crate::jobs::{Jobs, Shown};
use crate::loss::losses::DrawnLosses;
use crate::model::Model;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::view::ViewState;
use crate::photograph::compared::{DisplayedPhotograph, Photographs};
use crate::why::replacement;
use difference::{ComputedDifference, ErrorMaps};

/// What the panes display in a frame.
#[derive(Clone, Debug)]
pub struct Displayed<'a> {
    pub model: &'a Model,
    pub jobs: &'a Jobs,
    /// Whether this is a picture that is saved: with a caption and without controls.
    pub is_picture: bool,
    /// Whether every pane shows the ground truth, as long as a key is held.
    pub peeks: bool,
    materials: Vec<LoadedMaterial>,
    /// The loss of each prediction in the window, where it is known.
    pub losses: Vec<Option<Estimate>>,
    /// The photograph that is open, perhaps at the exposures of an earlier scene.
    pub open_photograph: Option<DisplayedPhotograph<'a>>,
    /// The difference of the materials, and whether it is of the present scene and exposure.
    difference: Option<(Arc<Answered<ComputedDifference>>, bool)>,
    auto_range: Option<f64>,
}

impl<'a> Displayed<'a> {
    /// What the panes of the window display.
    pub fn ask(shown: Shown<'a>) -> Self {
        if let Some(blind) = &shown.model.blind {
            return Self::plain(shown, blind.materials());
        }
        let losses = match shown.model.dataset.open {
            Some(_) => matrix::of_window(shown),
            None => DrawnLosses::ask(shown).of_predictions(),
        };
        let displayed = Self { losses, ..Self::of(shown, replacement::displayed(shown)) };
        if !shown.model.view.display.is_replaced() {
            return displayed;
        }
        // The range of a mixture or a correction is that of the predictions themselves: all have the same colours.
        let themselves = Self::of(shown, shown.model.materials.all.clone());
        Self { auto_range: themselves.auto_range.or(displayed.auto_range), ..displayed }
    }

    /// Materials alone.
    fn plain(Shown { model, jobs }: Shown<'a>, materials: Vec<LoadedMaterial>) -> Self {
        Self {
            model,
            jobs,
            is_picture: false,
            peeks: false,
            materials,
            losses: Vec::new(),
            open_photograph: None,
            difference: None,
            auto_range: None,
        }
    }

    fn of(shown: Shown<'a>, materials: Vec<LoadedMaterial>) -> Self {
        let open_photograph = DisplayedPhotograph::ask(shown, &materials);
        let mut displayed = Self { open_photograph, ..Self::plain(shown, materials) };
        if displayed.photograph().is_none() {
            displayed.difference = difference::displayed(shown, &displayed.materials);
        }
        displayed.auto_range = displayed.distributions().map(|(all, _)| all.auto_range);
        displayed
    }

    /// The same, where a key may show the ground truth in every pane.
    #[must_use]
    pub fn peeking(self, peeks: bool) -> Self {
        Self { peeks, ..self }
    }

    /// The same, as a picture that is saved.
    #[must_use]
    pub fn picture(&self) -> Self {
        Self { is_picture: true, ..self.clone() }
    }

    /// The model, and what a panel asks.
    pub fn shown(&self) -> Shown<'a> {
        Shown { model: self.model, jobs: self.jobs }
    }

    /// The materials in the panes, the ground truth first: with a replacement of the chosen prediction where one is displayed.
    pub fn materials(&self) -> &[LoadedMaterial] {
        &self.materials
    }

    /// The index of the chosen prediction; the ground truth's where there is no prediction.
    pub fn chosen(&self) -> usize {
        (self.view().display.prediction + 1).min(self.materials.len().saturating_sub(1))
    }

    pub fn view(&self) -> &'a ViewState {
        &self.model.view
    }

    /// The difference in the panes, where no shader computes it and it is there.
    pub fn computed_maps(&self) -> Option<&Arc<Answered<ComputedDifference>>> {
        let (found, _) = self.difference.as_ref()?;
        Some(found).filter(|_| self.view().is_computed())
    }

    /// The scenes of the error map, where the panes show it.
    pub fn error_map_scenes(&self) -> Option<usize> {
        let count = || self.model.settings.loss.listed_scenes().count().unwrap_or(0);
        self.view().is_error_map().then(count)
    }

    /// The share of the texels of error maps that is done, while they are rendered.
    pub fn error_map_progress(&self) -> Option<f32> {
        let answer = self.jobs.answers.get(&ErrorMaps::of(self.shown(), &self.materials));
        answer.busy().map(|(fraction, _)| fraction)
    }

    /// The photograph, where the panes compare renderings with one. Maps, the error map and FLIP are of the ground truth.
    pub fn photograph(&self) -> Option<&DisplayedPhotograph<'a>> {
        let is_rendering = self.view().display.quantity == Quantity::Rendering && !self.view().is_computed();
        self.open_photograph.as_ref().filter(|_| is_rendering && !self.materials.is_empty())
    }

    /// The photograph beside every material, where the panes compare renderings with one and it is there.
    pub fn photographs(&self) -> Option<&Arc<Answered<Photographs>>> {
        self.photograph()?.all.as_ref().map(|(all, _)| all)
    }

    /// The distributions of the difference in the panes, and whether they are up to date.
    pub fn distributions(&self) -> Option<(&Distributions, bool)> {
        if let Some(photograph) = self.photograph() {
            return photograph.distributions(self.view().difference_kind());
        }
        self.difference.as_ref().map(|(found, is_current)| (&found.distributions, *is_current))
    }

    /// The difference that has the last colour: the range set, or the automatic one.
    pub fn range(&self) -> f64 {
        let set = self.view().display.differences.range(self.view().display.quantity);
        set.unwrap_or_else(|| self.auto_range())
    }

    /// The automatic range of the difference.
    pub fn auto_range(&self) -> f64 {
        self.auto_range.unwrap_or_else(|| self.view().difference_kind().default_range())
    }
}

/// The numbers of a pane at a texel: its value, or its difference from the ground truth or the photograph where the panes
/// show that.
pub fn numbers(shown: &Displayed<'_>, index: usize, difference: bool, texel: [usize; 2]) -> Vec<f64> {
    let (materials, state) = (shown.materials(), shown.view());
    if difference && index > 0 && state.is_computed() {
        return vec![shown.computed_maps().map_or(f64::NAN, |maps| maps.at(index, texel))];
    }
    let convention = state.convention();
    let value = |index: usize| {
        state.display.quantity.at(materials[index].material(), &state.scene, &convention, texel)
    };
    if let (true, Some(photographs)) = (difference, shown.photographs()) {
        let kind = state.difference_kind();
        return vec![kind.of_texel(photographs.at(index, texel), value(index), convention.epsilon)];
    }
    if difference && index > 0 {
        return vec![state.difference_kind().of_texel(value(0), value(index), convention.epsilon)];
    }
    value(index)[..state.display.quantity.channels()].iter().map(|v| f64::from(*v)).collect()
}

/// How many numbers a column of the status line has.
pub fn count(shown: &Displayed<'_>, index: usize) -> usize {
    let (display, compared) = (&shown.view().display, index > 0 || shown.photographs().is_some());
    if display.difference && compared { 1 } else { display.quantity.channels() }
}

/// The unit behind a number of a pane.
pub fn unit(state: &ViewState, index: usize) -> &'static str {
    let angle = state.difference_kind() == Difference::Angle && state.display.quantity == Quantity::Normal;
    if state.display.difference && index > 0 && angle { " deg" } else { "" }
}
