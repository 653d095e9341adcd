//! Question of the loss: a request and the convention it is answered in.

use crate::loss::Request;
use crate::model::convention::Convention;

/// A request and the convention.
#[derive(Clone, Debug, PartialEq)]
pub struct LossQuery {
    pub request: Request,
    pub convention: Convention,
}
