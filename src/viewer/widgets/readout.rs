//! Readout: numbers of texels as text, in columns of constant width.

use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;

use crate::jobs::displayed::Displayed;
use crate::jobs::panes::computed_maps::ComputedMaps;
use crate::jobs::panes::photograph::Photographs;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::view::ViewState;

/// Characters of a number.
pub const WIDTH: usize = 8;

/// A number in exactly [`WIDTH`] characters, with as many digits as fit, at most 4 behind the point.
pub fn fixed(value: f64) -> String {
    in_width(value, WIDTH, 4)
}

/// A number in `width` characters, at least 6, with as many digits behind the point as fit, at most `digits`; with an exponent where
/// these would leave fewer than two digits of it.
pub fn in_width(value: f64, width: usize, digits: usize) -> String {
    let size = value.abs();
    if !size.is_finite() {
        return format!("{value:>width$}");
    }
    if size > 0.0 && size < 10_f64.powi(1 - digits.min(width - 3) as i32) {
        let fits = |text: &String| text.len() <= width;
        let texts = [2, 1, 0].map(|digits| format!("{value:>width$.digits$e}"));
        return texts.into_iter().find(fits).unwrap_or_else(|| format!("{:>width$}", 0));
    }
    let before = 1 + (1..).take_while(|&power| size >= 10_f64.powi(power)).count();
    // Of the sign and the point.
    let behind = width.saturating_sub(2 + before).min(digits);
    if behind > 0 { format!("{value:>width$.behind$}") } else { format!("{value:>width$.1e}") }
}

/// What the numbers of texels are read from.
#[derive(Clone, Copy, Debug)]
pub struct Readout<'a> {
    pub materials: &'a [LoadedMaterial],
    pub state: &'a ViewState,
    /// Where the difference is a map that no shader computes, the maps once they are there.
    pub computed_maps: Option<&'a ComputedMaps>,
    /// Where renderings are compared with a photograph, the photograph beside every material.
    pub photographs: Option<&'a Photographs>,
}

impl<'a> Readout<'a> {
    pub fn of(shown: Displayed<'a>) -> Self {
        Self {
            materials: shown.materials(),
            state: shown.view(),
            computed_maps: shown.computed_maps(),
            photographs: shown.photographs().map(|all| &all.answer),
        }
    }
}

/// The numbers of a pane at a texel: its value, or its difference from the ground truth or the photograph where the panes
/// show that.
pub fn numbers(read: Readout<'_>, index: usize, difference: bool, texel: [usize; 2]) -> Vec<f64> {
    let Readout { materials, state, computed_maps, photographs } = read;
    if difference && index > 0 && state.is_computed() {
        return vec![computed_maps.map_or(f64::NAN, |maps| maps.at(index, texel))];
    }
    let convention = state.convention();
    let value = |index: usize| {
        state.display.quantity.at(materials[index].material(), &state.scene, &convention, texel)
    };
    if let (true, Some(photographs)) = (difference, photographs) {
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
pub fn count(read: Readout<'_>, index: usize) -> usize {
    let compared = index > 0 || read.photographs.is_some();
    if read.state.display.difference && compared { 1 } else { read.state.display.quantity.channels() }
}

/// The unit behind a number of a pane.
pub fn unit(state: &ViewState, index: usize) -> &'static str {
    let angle = state.difference_kind() == Difference::Angle && state.display.quantity == Quantity::Normal;
    if state.display.difference && index > 0 && angle { " deg" } else { "" }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_width() {
        for value in
            [0.0, -0.12345, 12.345_678, -99.9999, 123.456, 9_999.9, 65_504.0, 1e30, f64::NAN, f64::INFINITY]
        {
            assert_eq!(fixed(value).len(), WIDTH, "{value}: {:?}", fixed(value));
        }
        assert_eq!([fixed(0.5), fixed(-12.3456)], ["  0.5000", "-12.3456"]);
        // A dim gray is not 0.0001 three times.
        let dim = [1.234e-4, -9.87e-4, 0.001, -4.321e-12, 1e-310].map(fixed);
        assert_eq!(dim, [" 1.23e-4", "-9.87e-4", "  0.0010", "-4.3e-12", "1.0e-310"]);
        let narrow = [4.56e-4, -4.56e-4, -4.56e-14].map(|value| in_width(value, 6, 3));
        assert_eq!(narrow, ["4.6e-4", " -5e-4", "-5e-14"]);
        let narrow = [0.25, -0.123_45, 12.345, -123.45, 1234.5, 1e30].map(|value| in_width(value, 6, 3));
        assert_eq!(narrow, [" 0.250", "-0.123", " 12.35", "-123.5", " 1.2e3", "1.0e30"]);
    }
}
