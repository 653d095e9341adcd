//! Photographs of a material with their lights and views, to be read: a [`Capture`], which may be of one.

mod capture;
mod corners;
mod listed;
mod materialgan;
mod read;

pub use capture::{Capture, CapturedPhotograph, SessionPhotograph};
pub use corners::{Corners, Homography};
pub use materialgan::{Calibration, LightPower};
