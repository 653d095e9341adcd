//! Depths of the samples of files.

use std::str::FromStr;

use glam::DVec3;
use half::f16;

use crate::error::Error;

/// How samples are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    Eight,
    Sixteen,
    Half,
    Float,
}

impl Depth {
    /// The name for users.
    pub fn name(self) -> &'static str {
        match self {
            Self::Eight => "8",
            Self::Sixteen => "16",
            Self::Half => "half",
            Self::Float => "float",
        }
    }
}

impl FromStr for Depth {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        match name {
            "8" => Ok(Self::Eight),
            "16" => Ok(Self::Sixteen),
            "half" => Ok(Self::Half),
            "float" => Ok(Self::Float),
            _ => Err(Error::unknown_name("depth", name, "8, 16 (PNG), half, float (EXR)")),
        }
    }
}

/// The normal in halves which, once they have been normalized and rounded to halves again, are the same.
pub fn half_normal(normal: [f32; 3]) -> [f16; 3] {
    const MOST_ROUNDS: usize = 16;
    let again =
        |n: [f16; 3]| DVec3::from(n.map(f64::from)).normalize().to_array().map(|x| f16::from_f32(x as f32));
    let mut n = normal.map(f16::from_f32);
    for _ in 0..MOST_ROUNDS {
        let next = again(n);
        if next == n {
            break;
        }
        n = next;
    }
    n
}
