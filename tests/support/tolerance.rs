//! Every tolerance of the tests, each with the worst case that was measured beside it.
