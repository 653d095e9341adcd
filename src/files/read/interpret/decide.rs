//! One choice about stored values, recorded as an assumption.

use std::fmt::Display;

use crate::files::read::assumption::{Assumption, Certainty, What};
use crate::files::read::reason::Reason;
use crate::files::read::stored::Inferred;

/// What was specified, else what was inferred, else what is `detected`; recorded.
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
