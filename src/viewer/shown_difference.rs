//! The difference in the panes, whether of the current scene or averaged over the scenes of the loss.

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui;

use super::app::App;
use super::error_map_run::{ErrorMapSummary, ErrorMaps};
use super::photograph::{PhotographScene, Photographs};
use super::save;
use super::slot::Slot;
use super::worker::Task;
use crate::error::Error;
use crate::files::atomic::Destination;
use crate::loss::{Request, Sampling};
use crate::model::sampler::Sampler;
use crate::picture::export::Provenance;
use crate::picture::quantity::Quantity;
use crate::picture::shown::{Shown, ShownDifference};
use crate::picture::statistics::Distributions;

impl App {
    fn current_error_maps(&self) -> Option<&Arc<ErrorMaps>> {
        self.error_map.get(&self.seen, &self.state, self.settings.loss.listed_scenes())
    }

    /// The error maps, where the difference is the error map and they are there.
    pub(super) fn error_maps(&self) -> Option<&Arc<ErrorMaps>> {
        self.state.is_error_map().then(|| self.current_error_maps()).flatten()
    }

    pub(super) fn error_map_summary(&self) -> ErrorMapSummary {
        let scenes = self.settings.loss.listed_scenes().count().unwrap_or(0);
        ErrorMapSummary { scenes, progress: self.error_map.progress() }
    }

    /// The photograph, where the panes compare renderings with one. Maps and the error map are compared with the ground truth.
    pub(super) fn photograph_scene(&self) -> Option<PhotographScene<'_>> {
        let shown = self.state.quantity == Quantity::Rendering && !self.state.is_error_map();
        if shown && !self.seen.is_empty() { self.photograph.scene(&self.seen) } else { None }
    }

    /// The photograph beside every material, where the panes compare renderings with one and it is there.
    pub(super) fn photographs(&self) -> Option<&Arc<Photographs>> {
        self.photograph_scene().and_then(|photograph| photograph.all)
    }

    /// The distributions of the difference in the panes, and whether they are up to date.
    pub(super) fn distributions(&self) -> Option<(&Distributions, bool)> {
        if self.photograph_scene().is_some() {
            return self.photograph.distributions(&self.seen, &self.state);
        }
        if self.state.is_error_map() {
            return self.error_maps().map(|maps| (&maps.distributions, true));
        }
        let distributions = self.difference.distributions(&self.seen, &self.state)?;
        Some((distributions, self.difference.is_current(&self.seen, &self.state)))
    }

    /// The difference that has the last colour: the range set, or the automatic one.
    pub(super) fn range(&self) -> f64 {
        let auto = || self.distributions().map(|(distributions, _)| distributions.auto_range);
        let set = self.state.differences.range(self.state.quantity);
        set.or_else(auto).unwrap_or_else(|| self.state.difference_kind().default_range())
    }

    /// What the metadata of a picture say where it shows error maps.
    pub(super) fn error_map_text(&self) -> Option<String> {
        let loss = &self.settings.loss;
        let scenes = match (loss.listed_scenes(), loss.file_scenes()) {
            (Request::Scenes(Sampling { near, distant, seed, sampler, .. }), _) => {
                let sampler = if sampler == Sampler::Sobol { "scrambled Sobol" } else { "random" };
                format!("{near} near-field and {distant} distant scenes, seed {seed}, {sampler}")
            }
            (_, file) => {
                let (count, name) = file.map_or((0, ""), |file| (file.scenes.len(), file.name.as_str()));
                format!("{count} scenes of {name}")
            }
        };
        (self.state.difference && self.state.is_error_map()).then(|| {
            format!("mean log difference of each texel over {scenes}; {} the last colour", self.range())
        })
    }

    /// What the metadata of a picture say where it shows differences from a photograph.
    pub(super) fn photograph_text(&self) -> Option<String> {
        let kind = self.state.difference_kind();
        let photograph = self.photograph_scene().filter(|_| self.state.difference)?;
        let factors = photograph.all?.comparisons.iter().map(|one| one.factor.to_string());
        Some(format!(
            "{} of renderings p from {} as g: {}, multiplied by {}; NaN or gray where it is clipped; {} the last colour",
            kind.name(),
            photograph.source.path.display(),
            kind.unit(),
            factors.collect::<Vec<_>>().join(" | "),
            self.range()
        ))
    }

    /// Starts to write the photograph and the renderings, or the differences of the renderings from it, side by side to `path`.
    pub(super) fn save_against_photograph(&self, ctx: &egui::Context, path: PathBuf) -> Task<PathBuf> {
        let all = self.photographs().cloned();
        let (kind, difference) = (self.state.difference_kind(), self.state.difference);
        let shown = ShownDifference { kind, range: Some(self.range()) };
        let shown = Shown { quantity: self.state.quantity, difference: difference.then_some(shown) };
        let mut provenance = save::provenance(&self.seen, &self.state, shown);
        let chosen = (self.state.prediction + 1).min(self.seen.len().saturating_sub(1));
        if let (false, Some(photograph)) = (difference, self.photograph_scene()) {
            provenance.sources.insert(0, photograph.title(chosen));
        }
        let text = self.photograph_text();
        Task::start(ctx, move |progress| {
            let destination = Destination::new(&path)?;
            let all = all.ok_or(Error::Incomplete("the comparison with the photograph"))?;
            let images: Vec<_> = if difference {
                all.comparisons.iter().map(|one| one.difference(kind)).collect()
            } else {
                let photograph = all.get(chosen).map(|one| one.photograph.clone());
                let renderings = all.comparisons.iter().map(|one| one.rendering.clone());
                photograph.into_iter().chain(renderings).collect()
            };
            destination.write_described(&images, &provenance, text, progress)?;
            Ok(path)
        })
    }

    /// Starts to write the error maps side by side to `path`, as `svbrdf map` does.
    pub(super) fn save_error_maps(&self, ctx: &egui::Context, path: PathBuf) -> Task<PathBuf> {
        let maps = self.current_error_maps().cloned();
        let sources: Vec<&str> = self.seen.iter().map(Slot::name).collect();
        let entries = [
            ("svbrdf:shows", self.error_map_text().unwrap_or_default()),
            ("svbrdf:sources", sources.join(" | ")),
            ("svbrdf:convention", self.state.convention().name.to_owned()),
            ("svbrdf:version", Provenance::SOFTWARE.to_owned()),
        ];
        let range = self.range() as f32;
        Task::start(ctx, move |progress| {
            let destination = Destination::new(&path)?;
            let maps = maps.ok_or(Error::Incomplete("the error map"))?;
            destination.write_maps(&maps.images, range, &entries, progress)?;
            Ok(path)
        })
    }
}
