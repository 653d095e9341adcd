//! Writing pictures of the materials on a worker, as `svbrdf render` and `svbrdf strip` do.

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui;

use super::loaded::Loaded;
use super::slot::Slot;
use super::state::ViewState;
use super::worker::Task;
use crate::files::atomic::Destination;
use crate::image::Image;
use crate::material::Material;
use crate::picture::export::{PngDestination, Provenance};
use crate::picture::quantity::Quantity;
use crate::picture::shown::{Shown, ShownDifference, ShownPictures};
use crate::picture::strip::{Column, Strip};

/// What the panes show; `range` is the difference that has the last colour.
pub(super) fn shown(slots: &[Slot], state: &ViewState, range: f64) -> Shown {
    let difference = ShownDifference { kind: state.difference_kind(), range: Some(range) };
    let compares = state.difference && slots.len() > 1;
    Shown { quantity: state.quantity, difference: compares.then_some(difference) }
}

/// Where a picture of the materials comes from.
pub(super) fn provenance(slots: &[Slot], state: &ViewState, shown: Shown) -> Provenance {
    Provenance {
        shown,
        scene: state.scene,
        convention: state.convention(),
        exposure_ev: state.exposure_ev,
        sources: names(slots),
        renderer: "CPU, f32".to_owned(),
    }
}

fn names(slots: &[Slot]) -> Vec<String> {
    slots.iter().map(|slot| slot.name().to_owned()).collect()
}

fn materials(slots: &[Slot]) -> Vec<Arc<Loaded>> {
    slots.iter().map(|slot| slot.loaded.clone()).collect()
}

/// Starts to write what `shown` says of all materials, side by side, to `path`.
pub(super) fn renderings(
    ctx: &egui::Context,
    slots: &[Slot],
    state: &ViewState,
    shown: Shown,
    path: PathBuf,
) -> Task<PathBuf> {
    let (all, mut provenance) = (materials(slots), provenance(slots, state, shown));
    Task::start(ctx, move |progress| {
        let destination = Destination::new(&path)?;
        let all: Vec<&Material<f32>> = all.iter().map(|loaded| &loaded.material).collect();
        let ShownPictures { images, shown } =
            shown.pictures(&all, &provenance.scene, &provenance.convention, progress)?;
        provenance.shown = shown;
        destination.write(&images, &provenance, progress)?;
        Ok(path)
    })
}

/// Starts to write the figure of all materials to `path`.
pub(super) fn strip(ctx: &egui::Context, slots: &[Slot], state: &ViewState, path: PathBuf) -> Task<PathBuf> {
    let (all, names) = (materials(slots), names(slots));
    let value = |quantity| Shown { quantity, difference: None };
    let maps = [Quantity::Normal, Quantity::Diffuse, Quantity::Roughness, Quantity::Specular];
    let kind = state.differences.kind(Quantity::Rendering);
    let set = || state.differences.range(Quantity::Rendering);
    let range = if state.differences.is_error_map(Quantity::Rendering) { None } else { set() };
    let difference = Some(ShownDifference { kind, range });
    let mut shown: Vec<Shown> = maps.into_iter().chain([Quantity::Rendering]).map(value).collect();
    if slots.len() > 1 {
        shown.push(Shown { quantity: Quantity::Rendering, difference });
    }
    let columns = shown.into_iter().map(|shown| Column { shown, scene: state.scene }).collect();
    let strip = Strip { columns, convention: state.convention(), exposure_ev: state.exposure_ev };
    Task::start(ctx, move |progress| {
        let destination = PngDestination::new(&path)?;
        let all: Vec<&Material<f32>> = all.iter().map(|loaded| &loaded.material).collect();
        let picture = strip.picture(&all, &names, progress)?;
        destination.write(&picture, &strip.entries(&names), progress)?;
        Ok(path)
    })
}

/// Starts to write a picture of the window to `path`.
pub(super) fn view(
    ctx: &egui::Context,
    picture: egui::ColorImage,
    entries: Vec<(&'static str, String)>,
    path: PathBuf,
) -> Task<PathBuf> {
    Task::start(ctx, move |progress| {
        let destination = PngDestination::new(&path)?;
        let pixels = picture.pixels.iter().map(|pixel| [pixel.r(), pixel.g(), pixel.b()]).collect();
        let [width, height] = picture.size;
        destination.write(&Image { width, height, pixels }, &entries, progress)?;
        Ok(path)
    })
}
