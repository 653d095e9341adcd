//! Changes of a prediction that may explain its loss.

use super::reading::Reading;
use super::symmetry::Symmetry;

/// A change that is tried on a prediction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Change {
    /// Its radiance times 2^stops, for red, green and blue.
    Exposure([f64; 3]),
    /// It is moved back from this displacement (right, down), in texels.
    Shift([i32; 2]),
    Symmetry(Symmetry),
    Reading(Reading),
}
