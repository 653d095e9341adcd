//! Scenery: which panes there are, what each displays, and what of it is under the pointer.

use eframe::egui;

use svbrdf_gpu::DisplayMode;

use crate::model::dataset::Missing;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::view::Layout;
use crate::pane::Displayed;
use crate::pane::gpu_view::PaneTexels;
use crate::pane::handles::ndc_from_pos;
use crate::pane::placed::Placed;
use crate::widgets::names::shortened;

/// The content of a pane: the index of the material that it displays, that of the material it is compared with, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaneContent {
    pub index: usize,
    pub reference: usize,
    pub mode: DisplayMode,
    /// Whether the difference from the reference is displayed, in place of the value.
    pub difference: bool,
    pub photograph: PhotographUse,
}

/// What a photograph is in a pane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PhotographUse {
    /// Nothing: materials are compared with each other.
    Absent,
    /// What is displayed, at the exposure of the material.
    Displayed,
    /// What the material is compared with, at its exposure.
    Reference,
}

impl Displayed<'_> {
    /// The index of the material that is displayed in the place of material `index`.
    fn in_place_of(&self, index: usize) -> usize {
        match index {
            _ if self.peeks => 0,
            0 if self.model.swapped => self.chosen(),
            i if self.model.swapped && i == self.chosen() => 0,
            i => i,
        }
    }

    /// The content of every pane. The ground truth is never compared with itself: its pane shows its value.
    pub fn contents(&self) -> Vec<PaneContent> {
        let content = |index, reference, mode| {
            let difference = self.view().display.difference && index != 0;
            let reference = if difference { 0 } else { reference };
            PaneContent { index, reference, mode, difference, photograph: PhotographUse::Absent }
        };
        if self.model.blind.is_some() {
            let value = |index| PaneContent { difference: false, ..content(index, 0, DisplayMode::Value) };
            return (0..self.materials().len()).map(value).collect();
        }
        if self.photograph().is_some() {
            return self.photograph_contents();
        }
        let (ground_truth, chosen) = (self.in_place_of(0), self.in_place_of(self.chosen()));
        match self.view().display.layout {
            Layout::SideBySide => (0..self.materials().len())
                .map(|i| content(self.in_place_of(i), 0, DisplayMode::Value))
                .collect(),
            Layout::Single => vec![content(chosen, 0, DisplayMode::Value)],
            Layout::Wipe => {
                vec![content(chosen, ground_truth, DisplayMode::Wipe(self.view().display.wipe * 2.0 - 1.0))]
            }
        }
    }

    /// The panes of predictions that are not there, side by side with the others.
    pub fn empty(&self) -> impl Iterator<Item = (usize, &Missing)> {
        let is_seen = self.view().display.layout == Layout::SideBySide && self.model.blind.is_none();
        let before = usize::from(self.photograph().is_some());
        self.model
            .dataset
            .missing
            .iter()
            .filter(move |one| is_seen && one.slot > 0)
            .map(move |one| (one.slot + before, one))
    }

    /// The place of pane `number`, which leaves the empty ones free.
    pub fn place(&self, number: usize) -> usize {
        let mut empty: Vec<usize> = self.empty().map(|(place, _)| place).collect();
        empty.sort_unstable();
        empty.into_iter().fold(number, |place, empty| place + usize::from(empty <= place))
    }

    /// The content of every pane beside a photograph: the photograph at the exposure of the chosen material, then every material.
    fn photograph_contents(&self) -> Vec<PaneContent> {
        let difference = self.view().display.difference;
        let material = |index| PaneContent {
            index,
            reference: index,
            mode: DisplayMode::Value,
            difference,
            photograph: PhotographUse::Reference,
        };
        let chosen = material(self.chosen());
        let photograph = PaneContent { difference: false, photograph: PhotographUse::Displayed, ..chosen };
        let mut panes: Vec<PaneContent> = match self.view().display.layout {
            Layout::SideBySide => {
                std::iter::once(photograph).chain((0..self.materials().len()).map(material)).collect()
            }
            Layout::Single => vec![if self.model.swapped { photograph } else { chosen }],
            Layout::Wipe => {
                vec![PaneContent { mode: DisplayMode::Wipe(self.view().display.wipe * 2.0 - 1.0), ..chosen }]
            }
        };
        if self.peeks {
            panes.fill(photograph);
        } else if self.model.swapped && self.view().display.layout == Layout::SideBySide {
            panes.swap(0, self.chosen() + 1);
        }
        panes
    }

    /// The names of what a pane shows, without its difference, and of what it compares with, in about `most` characters.
    pub fn names_of(&self, content: PaneContent, most: usize) -> [String; 2] {
        let all = [(PhotographUse::Displayed, content.index), (PhotographUse::Reference, content.reference)];
        all.map(|(of, index)| match self.photograph() {
            Some(photograph) if content.photograph == of => photograph.title(content.index),
            _ => self.title(index, most),
        })
    }

    /// What the first material is: alone it is the ground truth of nothing.
    fn role(&self) -> &'static str {
        if self.materials().len() == 1 && self.photograph().is_none() { "MATERIAL" } else { "GROUND TRUTH" }
    }

    /// The name of material `index` in titles. Of names that are too long, what all have in common is left out.
    fn title(&self, index: usize, most: usize) -> String {
        if self.model.blind.is_some() {
            return self.materials()[index].name().to_owned();
        }
        let labels: Vec<String> = self.materials().iter().map(LoadedMaterial::label).collect();
        let labels: Vec<&str> = labels.iter().map(String::as_str).collect();
        let (ground_truth, predictions) = labels.split_at(labels.len().min(1));
        match index.checked_sub(1) {
            None => format!("{}  {}", self.role(), shortened(ground_truth, most).concat()),
            Some(prediction) => {
                let slot = self.materials()[index].slot;
                format!("{slot}  {}", shortened(predictions, most)[prediction])
            }
        }
    }
}

/// Whether the key of the ground truth is held: G, or Shift alone, which with the wheel, a button or another key does other things.
pub fn peeks(ctx: &egui::Context) -> bool {
    let (is_held, is_shift) = ctx.input(|i| {
        let is_used =
            !i.keys_down.is_empty() || i.pointer.any_down() || i.smooth_scroll_delta != egui::Vec2::ZERO;
        (i.key_down(egui::Key::G), i.modifiers.shift_only() && !is_used)
    });
    (is_held || is_shift) && !ctx.text_edit_focused()
}

/// What a pane draws and what it compares that with; a hint in its place where that is not there yet.
pub fn texels(shown: &Displayed<'_>, content: PaneContent) -> Result<[PaneTexels; 2], &'static str> {
    let shaded = |index: usize| PaneTexels::Shaded(shown.materials()[index].id());
    let [material, reference] = [content.index, content.reference].map(shaded);
    if content.difference && shown.view().is_computed() {
        let map = shown.computed_maps().and_then(|maps| maps.shaded(content.index));
        let is_error_map = shown.view().is_error_map();
        let hint =
            if is_error_map { "Averaging over the scenes of the loss..." } else { "Computing FLIP..." };
        return Ok([PaneTexels::Given(map.ok_or(hint)?.clone()), reference]);
    }
    let compares = content.difference || content.mode != DisplayMode::Value;
    if content.photograph == PhotographUse::Absent
        || (content.photograph == PhotographUse::Reference && !compares)
    {
        return Ok([material, reference]);
    }
    let photograph = shown.photographs().and_then(|all| all.shaded(content.index));
    let texels = PaneTexels::Given(photograph.ok_or("Reading the photograph...")?.clone());
    let displayed = if content.photograph == PhotographUse::Displayed { texels.clone() } else { material };
    Ok([displayed, texels])
}

/// The index of the material whose value is displayed at this x of a pane, from -1 to 1; the number of materials for a photograph.
pub fn index_at(shown: &Displayed<'_>, content: PaneContent, x: f32) -> usize {
    let photograph = shown.materials().len();
    match (content.mode, content.photograph) {
        (_, PhotographUse::Displayed) => photograph,
        (DisplayMode::Wipe(line), PhotographUse::Reference) if x < line => photograph,
        (DisplayMode::Wipe(line), _) if x < line => content.reference,
        _ => content.index,
    }
}

/// What is under the pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hovered {
    /// The index of the material there; the number of materials for a photograph.
    pub index: usize,
    /// The texel there; `None` beside the material.
    pub texel: Option<[usize; 2]>,
}

impl Hovered {
    /// What is under the pointer, if it is over this pane and nothing lies in between.
    pub fn in_pane(
        ui: &egui::Ui,
        shown: &Displayed<'_>,
        content: PaneContent,
        placed: &Placed,
    ) -> Option<Self> {
        let pos = ui.input(|i| i.pointer.latest_pos()).filter(|pos| placed.rect.contains(*pos))?;
        let covered = ui.ctx().layer_id_at(pos).is_some_and(|layer| layer != ui.layer_id());
        if covered {
            return None;
        }
        let index = index_at(shown, content, ndc_from_pos(placed.rect, pos)[0]);
        placed.point(pos).map(|point| Self { index, texel: placed.grid.texel_at(point) })
    }
}
