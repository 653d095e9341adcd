//! The view as a picture, written by the core on a worker: what `svbrdf render` writes for the same numbers.

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui;

use super::slots::{Loaded, Slots};
use super::state::ViewState;
use super::worker::Job;
use crate::export::{Destination, Provenance};
use crate::render;

/// Starts to render all materials and to write them side by side to `path`.
pub fn start(ctx: &egui::Context, slots: &Slots, state: &ViewState, path: PathBuf) -> Job<PathBuf> {
    let materials: Vec<Arc<Loaded>> = slots.slots.iter().map(|s| s.loaded.clone()).collect();
    let provenance = Provenance {
        scene: state.scene,
        convention: state.convention(),
        exposure_ev: state.exposure_ev,
        sources: materials.iter().map(|l| l.material.name().to_owned()).collect(),
        renderer: "CPU, f32".to_owned(),
    };
    Job::start(ctx, move |progress| {
        let destination = Destination::new(&path)?;
        let render = |loaded: &Arc<Loaded>| {
            render::render_f32(&loaded.material, &provenance.scene, &provenance.convention, progress)
        };
        let panes = materials.iter().map(render).collect::<Result<Vec<_>, _>>()?;
        destination.write(&panes, &provenance, progress)?;
        Ok(path)
    })
}
