//! Choices about stored values, recorded as assumptions.

use std::fmt::Display;

use crate::read::record::{Assumption, Certainty, Reason, What};
use crate::read::stored::Inferred;

/// The `specified` value, else the `inferred`, else the `detected` one; recorded.
pub(crate) fn decide<T: Copy + Display>(
    assumptions: &mut Vec<Assumption>,
    what: What,
    specified: Option<T>,
    inferred: Inferred<T>,
    detected: impl FnOnce() -> (T, Reason, Certainty),
) -> T {
    if let Some(value) = specified {
        assumptions.push(Assumption::given(what, value));
        return value;
    }
    let (value, why, certainty) = inferred.unwrap_or_else(detected);
    assumptions.push(Assumption::new(what, value, why, certainty));
    value
}
