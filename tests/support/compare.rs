//! The comparator of numbers: NaN first, then `|got - expected| <= bound`, with the worst case in the message.

/// How far a number may be from what is expected: `atol + rtol * |expected|`.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    pub atol: f64,
    pub rtol: f64,
}

impl Tolerance {
    pub fn bound(self, expected: f64) -> f64 {
        self.atol + self.rtol * expected.abs()
    }
}

/// The largest error of a comparison that held, as a share of its bound.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Worst {
    pub index: usize,
    pub share: f64,
}

/// Compares RGB values; `Err` names the first that is not finite or negative, else the one farthest beyond its bound.
pub fn compare_rgb(got: &[[f32; 3]], expected: &[[f64; 3]], tolerance: Tolerance) -> Result<Worst, String> {
    compare_rgb_with(got, expected, |_, _, value| tolerance.bound(value))
}

/// As [`compare_rgb`] with a bound of each value: `bound(index, channel, expected)`.
pub fn compare_rgb_with(
    got: &[[f32; 3]],
    expected: &[[f64; 3]],
    bound: impl Fn(usize, usize, f64) -> f64,
) -> Result<Worst, String> {
    if got.len() != expected.len() || got.is_empty() {
        return Err(format!("{} values compared with {}", got.len(), expected.len()));
    }
    let mut worst = Worst::default();
    let mut message = String::new();
    for (index, (got, expected)) in got.iter().zip(expected).enumerate() {
        for (channel, (&got, &expected)) in got.iter().zip(expected).enumerate() {
            let got = f64::from(got);
            if !got.is_finite() || got < 0.0 || !expected.is_finite() {
                return Err(format!("value {index}, channel {channel}: got {got}, expected {expected}"));
            }
            let (error, bound) = ((got - expected).abs(), bound(index, channel, expected));
            let share = if error == 0.0 { 0.0 } else { error / bound };
            if share > worst.share {
                worst = Worst { index, share };
                message = format!(
                    "value {index}, channel {channel}: got {got:e}, expected {expected:e}, \
                    error {error:e} > bound {bound:e}"
                );
            }
        }
    }
    if worst.share <= 1.0 { Ok(worst) } else { Err(message) }
}

#[test]
fn the_comparator_goes_red_on_every_planted_fault() {
    let expected = [[1.0, 2.0, 3.0], [0.0, 0.5, 0.25], [4.0, 0.125, 8.0]];
    let good: Vec<[f32; 3]> = expected.iter().map(|v| v.map(|x| x as f32)).collect();
    let tolerance = Tolerance { atol: 1e-9, rtol: 1e-6 };
    let planted = |change: fn(&mut Vec<[f32; 3]>)| {
        let mut faulty = good.clone();
        change(&mut faulty);
        compare_rgb(&faulty, &expected, tolerance)
    };
    assert_eq!(planted(|_| ()), Ok(Worst::default()));
    planted(|v| v[0][0] = -v[0][0]).expect_err("swapped sign");
    planted(|v| v[1] = [0.0, 0.5, 0.2501]).expect_err("one wrong pixel");
    planted(|v| v[2][1] = f32::NAN).expect_err("NaN");
    planted(|v| v[2][1] = f32::INFINITY).expect_err("infinity");
    planted(|v| v[0].swap(0, 2)).expect_err("wrong channel");
    planted(|v| v[1][0] = -1e-12).expect_err("negative, though within the bound");
    planted(|v| v.swap(0, 1)).expect_err("pixels swapped");
    planted(|v| v.truncate(2)).expect_err("a pixel missing");
    compare_rgb(&[], &[], tolerance).expect_err("nothing compared");
}
