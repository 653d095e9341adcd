//! Readout: the numbers of texels in the panes.

use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;

use crate::model::view::ViewState;
use crate::pane::displayed::Displayed;
use crate::photograph::compared::Photographs;

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

/// The photograph at a texel, at the exposure of material `index`.
pub fn photograph(photographs: &Photographs, index: usize, texel: [usize; 2]) -> Vec<f64> {
    photographs.at(index, texel).map(f64::from).to_vec()
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
