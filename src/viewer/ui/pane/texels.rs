//! Texels that a pane draws.

use svbrdf_gpu::DisplayMode;

use crate::ui::pane::scenery::{PaneContent, PhotographUse, Scenery};
use crate::ui::shading::gpu_view::{GpuView, PaneTexels};

/// What a pane draws and what it compares that with; a hint in its place where that is not there yet.
pub fn texels(
    gpu: &mut GpuView,
    scenery: &Scenery<'_>,
    content: PaneContent,
) -> Result<[PaneTexels; 2], &'static str> {
    let [material_id, reference] = [content.index, content.reference].map(|i| scenery.materials[i].id());
    let material = PaneTexels::Shaded(material_id);
    if content.difference && scenery.state.is_computed() {
        let map = scenery.computed_maps.and_then(|maps| maps.shaded(content.index));
        let is_error_map = scenery.state.is_error_map();
        let hint =
            if is_error_map { "Averaging over the scenes of the loss..." } else { "Computing FLIP..." };
        gpu.give(material_id, map.ok_or(hint)?);
        return Ok([PaneTexels::Differences(material_id), PaneTexels::Shaded(reference)]);
    }
    let compares = content.difference || content.mode != DisplayMode::Value;
    if content.photograph == PhotographUse::Absent
        || (content.photograph == PhotographUse::Reference && !compares)
    {
        return Ok([material, PaneTexels::Shaded(reference)]);
    }
    let photograph = scenery.photograph.and_then(|photograph| photograph.all?.shaded(content.index));
    gpu.give_photograph(material_id, photograph.ok_or("Reading the photograph...")?);
    let photograph = PaneTexels::Photograph(material_id);
    Ok([if content.photograph == PhotographUse::Displayed { photograph } else { material }, photograph])
}

/// The index of the material whose value is displayed at this x of a pane, from -1 to 1; the number of materials for a photograph.
pub fn index_at(scenery: &Scenery<'_>, content: PaneContent, x: f32) -> usize {
    let photograph = scenery.materials.len();
    match (content.mode, content.photograph) {
        (_, PhotographUse::Displayed) => photograph,
        (DisplayMode::Wipe(line), PhotographUse::Reference) if x < line => photograph,
        (DisplayMode::Wipe(line), _) if x < line => content.reference,
        _ => content.index,
    }
}
