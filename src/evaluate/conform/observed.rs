//! Radiances as a renderer gave them out: how they are stored, where they are clipped, and what they are in linear units.

use svbrdf_core::model::grammar::words::Transfer;

/// The levels of an 8-bit picture.
const LEVELS: f64 = 255.0;
/// Equal largest or least values from which on they are clipped.
const EQUAL: usize = 12;
/// The largest half float.
const LARGEST_HALF: f64 = 65504.0;

/// How precisely radiances are stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Storage {
    Double,
    Single,
    Half,
    /// 8 bits of this encoding.
    Levels(Transfer),
}

impl Storage {
    /// By the values themselves.
    pub fn of(values: &[f64]) -> Self {
        let used: Vec<f64> = values.iter().copied().filter(|x| x.is_finite() && *x > 0.0).collect();
        let all = |is: &dyn Fn(f64) -> bool| !used.is_empty() && used.iter().all(|x| is(*x));
        for transfer in [Transfer::Linear, Transfer::Srgb, Transfer::Gamma] {
            let is_level = |x: f64| {
                let level = LEVELS * encoded(transfer, x);
                level < LEVELS + 1e-3 && (level - level.round()).abs() < 1e-3
            };
            if all(&is_level) {
                return Self::Levels(transfer);
            }
        }
        // Half floats have 11 significant bits; the least are multiples of 2^-24.
        let is_half = |x: f64| {
            let step = (x.log2().floor() - 10.0).max(-24.0).exp2();
            x <= LARGEST_HALF && (x / step).fract() == 0.0
        };
        if all(&is_half) {
            return Self::Half;
        }
        if all(&|x| f64::from(x as f32) == x) { Self::Single } else { Self::Double }
    }

    /// In words.
    pub fn label(self) -> &'static str {
        match self {
            Self::Double => "float64",
            Self::Single => "float32",
            Self::Half => "float16",
            Self::Levels(Transfer::Linear) => "8 bits",
            Self::Levels(Transfer::Srgb) => "8 bits of sRGB",
            Self::Levels(Transfer::Gamma) => "8 bits of a power of 2.2",
        }
    }

    /// The unit roundoff of the arithmetic that is behind it, at best.
    pub fn roundoff(self) -> f64 {
        match self {
            Self::Double => f64::EPSILON,
            _ => f64::from(f32::EPSILON) / 2.0,
        }
    }

    /// The values that are stored as `x`: from, to.
    fn interval(self, x: f64) -> [f64; 2] {
        match self {
            Self::Double | Self::Single => [x, x],
            Self::Half => {
                let half = (x.abs().log2().floor() - 11.0).max(-25.0).exp2();
                [x - half, x + half]
            }
            Self::Levels(transfer) => {
                let level = (LEVELS * encoded(transfer, x)).round();
                [-0.5, 0.5].map(|half| decoded(transfer, ((level + half) / LEVELS).max(0.0)))
            }
        }
    }
}

/// What a value tells about the radiance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    Value,
    AtLeast,
    AtMost,
    /// It is not finite.
    Missing,
}

/// One radiance in linear units.
#[derive(Clone, Copy, Debug)]
pub struct Reading {
    pub value: f64,
    /// Half the interval that is stored as this value.
    pub half: f64,
    pub bound: Bound,
}

/// Radiances of all points under an assumed encoding.
#[derive(Clone, Debug)]
pub struct Observed {
    pub transfer: Transfer,
    /// The range that radiances are clipped to, in linear units, where they are.
    pub clip: Option<[f64; 2]>,
    pub readings: Vec<[Reading; 3]>,
}

impl Observed {
    /// The radiances `raw`, decoded.
    pub fn new(raw: &[[f64; 3]], storage: Storage, transfer: Transfer) -> Self {
        let finite = || raw.as_flattened().iter().copied().filter(|x| x.is_finite());
        let repeated = |end: f64| finite().filter(|x| *x == end).count() >= EQUAL;
        let top = finite().fold(f64::NEG_INFINITY, f64::max);
        let low = finite().fold(f64::INFINITY, f64::min);
        let is_top = match storage {
            Storage::Levels(of) => LEVELS * encoded(of, top) > LEVELS - 0.5,
            _ => repeated(top),
        };
        let top = (is_top && top > 0.0).then_some(top);
        let low = (repeated(low) && low > 0.0).then_some(low);
        let reading = |x: f64| {
            let (edge, bound) = match x {
                x if Some(x) == top => (storage.interval(x)[0], Bound::AtLeast),
                x if Some(x) == low => (storage.interval(x)[1], Bound::AtMost),
                x if x == f64::INFINITY && storage == Storage::Half => (LARGEST_HALF, Bound::AtLeast),
                x if x.is_finite() => (x, Bound::Value),
                _ => return Reading { value: 0.0, half: 0.0, bound: Bound::Missing },
            };
            if bound != Bound::Value {
                return Reading { value: decoded(transfer, edge), half: 0.0, bound };
            }
            let [from, to] = storage.interval(edge).map(|x| decoded(transfer, x));
            Reading { value: (from + to) / 2.0, half: (to - from) / 2.0, bound }
        };
        let readings = raw.iter().map(|rgb| rgb.map(reading)).collect();
        let clip = (top.is_some() || low.is_some()).then(|| {
            [
                low.map_or(0.0, |low| decoded(transfer, low)),
                top.map_or(f64::INFINITY, |top| decoded(transfer, top)),
            ]
        });
        Self { transfer, clip, readings }
    }
}

fn encoded(transfer: Transfer, x: f64) -> f64 {
    match transfer {
        Transfer::Linear => x,
        Transfer::Gamma => x.max(0.0).powf(1.0 / 2.2),
        Transfer::Srgb if x <= 0.003_130_8 => 12.92 * x,
        Transfer::Srgb => 1.055 * x.powf(1.0 / 2.4) - 0.055,
    }
}

fn decoded(transfer: Transfer, x: f64) -> f64 {
    match transfer {
        Transfer::Linear => x,
        Transfer::Gamma => x.max(0.0).powf(2.2),
        Transfer::Srgb if x <= 0.040_45 => x / 12.92,
        Transfer::Srgb => ((x + 0.055) / 1.055).powf(2.4),
    }
}
