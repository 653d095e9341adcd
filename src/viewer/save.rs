//! Saving the view as a picture on a worker, as `svbrdf render` does.

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui;

use super::loaded::Loaded;
use super::slots::Slots;
use super::state::ViewState;
use super::worker::Task;
use crate::files::atomic::Destination;
use crate::picture::export::{Provenance, Shows};
use crate::render;

/// The content of the saved picture.
pub fn shows(state: &ViewState) -> Shows {
    if state.difference { Shows::LogDifference } else { Shows::Radiance }
}

/// Starts to write the renderings of all materials, or the differences of the predictions, side by side to `path`.
pub fn start(ctx: &egui::Context, slots: &Slots, state: &ViewState, path: PathBuf) -> Task<PathBuf> {
    let materials: Vec<Arc<Loaded>> = slots.slots.iter().map(|s| s.loaded.clone()).collect();
    let shows = if materials.len() > 1 { shows(state) } else { Shows::Radiance };
    let provenance = Provenance {
        shows,
        scene: state.scene,
        convention: state.convention(),
        // Exposure does not change a difference.
        exposure_ev: if shows == Shows::LogDifference { 0.0 } else { state.exposure_ev },
        sources: slots.slots.iter().map(|slot| slot.name().to_owned()).collect(),
        renderer: "CPU, f32".to_owned(),
    };
    Task::start(ctx, move |progress| {
        let destination = Destination::new(&path)?;
        let render = |loaded: &Arc<Loaded>| {
            render::render_f32(&loaded.material, &provenance.scene, &provenance.convention, progress)
        };
        let mut panes = materials.iter().map(render).collect::<Result<Vec<_>, _>>()?;
        if provenance.shows == Shows::LogDifference {
            panes = render::log_differences(&panes, provenance.convention.epsilon as f32);
        }
        destination.write(&panes, &provenance, progress)?;
        Ok(path)
    })
}
