//! Question of the loss: a request and the convention it is answered in.

use svbrdf_core::loss::Request;
use svbrdf_core::model::convention::Convention;

/// A request and the convention.
#[derive(Clone, Debug, PartialEq)]
pub struct LossQuery {
    pub request: Request,
    pub convention: Convention,
}
