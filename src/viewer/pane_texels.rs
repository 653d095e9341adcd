//! The texels that a pane draws.

use super::gpu_view::{GpuView, PaneTexels};
use super::panes::{Content, PhotographUse, Scenery};
use crate::gpu::DisplayMode;

/// What a pane draws and what it compares that with; a hint in its place where that is not there yet.
pub(super) fn texels(
    gpu: &mut GpuView,
    scenery: &Scenery<'_>,
    content: Content,
) -> Result<[PaneTexels; 2], &'static str> {
    let [shown, reference] = [content.slot, content.reference].map(|i| scenery.slots[i].id);
    let material = PaneTexels::Shaded(shown);
    if content.difference && scenery.state.is_error_map() {
        let map = scenery.error_maps.and_then(|maps| maps.shaded(content.slot));
        gpu.give(shown, map.ok_or("Averaging over the scenes of the loss...")?);
        return Ok([PaneTexels::Differences(shown), PaneTexels::Shaded(reference)]);
    }
    let compares = content.difference || content.mode != DisplayMode::Value;
    if content.photograph == PhotographUse::Absent
        || (content.photograph == PhotographUse::Reference && !compares)
    {
        return Ok([material, PaneTexels::Shaded(reference)]);
    }
    let photograph = scenery.photograph.and_then(|photograph| photograph.all?.shaded(content.slot));
    gpu.give_photograph(shown, photograph.ok_or("Reading the photograph...")?);
    let photograph = PaneTexels::Photograph(shown);
    Ok([if content.photograph == PhotographUse::Shown { photograph } else { material }, photograph])
}

/// The slot whose value is shown at this x of a pane, from -1 to 1; the number of slots for a photograph.
pub(super) fn slot_at(scenery: &Scenery<'_>, content: Content, x: f32) -> usize {
    let photograph = scenery.slots.len();
    match (content.mode, content.photograph) {
        (_, PhotographUse::Shown) => photograph,
        (DisplayMode::Wipe(line), PhotographUse::Reference) if x < line => photograph,
        (DisplayMode::Wipe(line), _) if x < line => content.reference,
        _ => content.slot,
    }
}
