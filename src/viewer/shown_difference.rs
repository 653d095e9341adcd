//! The difference in the panes, whether of the current scene or averaged over the scenes of the loss.

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui;

use super::app::App;
use super::error_map_run::{ErrorMapSummary, ErrorMaps};
use super::slot::Slot;
use super::worker::Task;
use crate::error::Error;
use crate::files::atomic::Destination;
use crate::loss::{Request, Sampling};
use crate::model::sampler::Sampler;
use crate::picture::export::Provenance;
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

    /// The distributions of the difference in the panes, and whether they are up to date.
    pub(super) fn distributions(&self) -> Option<(&Distributions, bool)> {
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
            let maps = maps.ok_or_else(|| {
                Error::Usage("the error map is still being computed: save it once it is shown".to_owned())
            })?;
            destination.write_maps(&maps.images, range, &entries, progress)?;
            Ok(path)
        })
    }
}
