//! Values of options: numbers with units, positions, ranges.

use std::str::FromStr;
use std::time::Duration;

/// Largest share that is understood without a percent sign.
const LARGEST_SHARE: f64 = 0.1;

/// A share such as `1%` or `0.01`. A larger number without a percent sign could be meant as percent.
pub fn percent(text: &str) -> Result<f64, String> {
    let (number, scale) = text.strip_suffix('%').map_or((text, 1.0), |number| (number, 0.01));
    let number = number.trim().parse::<f64>().ok();
    match number.map(|number| number * scale).filter(|share| *share > 0.0 && *share < 1.0) {
        Some(share) if scale < 1.0 || share <= LARGEST_SHARE => Ok(share),
        Some(share) => Err(format!(
            "expected a percent sign: {text}% or {:.0}%, which {text} could both mean",
            100.0 * share
        )),
        None => Err("expected more than 0% and less than 100%, as in 1%".to_owned()),
    }
}

/// A time such as `500ms`, `2s` or `0.5` (seconds).
pub fn duration(text: &str) -> Result<Duration, String> {
    let units = [("us", 1e-6), ("ms", 1e-3), ("s", 1.0)];
    let with_unit = units.iter().find_map(|(unit, scale)| Some((text.strip_suffix(unit)?, *scale)));
    let (number, scale) = with_unit.unwrap_or((text, 1.0));
    let seconds = number.trim().parse::<f64>().map(|number| number * scale);
    let time = seconds.ok().filter(|s| *s > 0.0 && *s <= 86_400.0).map(Duration::from_secs_f64);
    time.ok_or(
        "expected a time above 0, at most a day, in us, ms or s (the default), as in 500ms or 2s".to_owned(),
    )
}

/// A number of things, or a seed.
pub fn whole<T: FromStr>(text: &str) -> Result<T, &'static str> {
    text.parse().map_err(|_| "expected a whole number, 0 or more and below 2^64")
}

/// A loss that others are compared with. None is above NaN or infinity.
pub fn loss(text: &str) -> Result<f64, &'static str> {
    let loss = text.parse().ok().filter(|loss: &f64| loss.is_finite() && *loss >= 0.0);
    loss.ok_or("expected a loss, a number of 0 or more, as in 0.25")
}

/// The width of a figure.
pub fn millimetres(text: &str) -> Result<f64, String> {
    among(text, [10.0, 5000.0], "millimetres like 88")
}

/// The size of text.
pub fn points(text: &str) -> Result<f64, String> {
    among(text, [2.0, 100.0], "points like 7")
}

fn among(text: &str, [least, most]: [f64; 2], what: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|number| (least..=most).contains(number));
    number.ok_or_else(|| format!("expected {least} to {most} {what}, found `{text}`"))
}

/// Greatest exposure either way, in stops, as in the window.
const MOST_STOPS: f32 = 20.0;

/// An exposure.
pub fn stops(text: &str) -> Result<f32, String> {
    let stops = text.parse().ok().filter(|stops: &f32| stops.abs() <= MOST_STOPS);
    stops.ok_or_else(|| {
        format!("expected a number of stops from -{MOST_STOPS} to {MOST_STOPS} like -1.5, found `{text}`")
    })
}

/// A position or direction.
pub fn triple(text: &str) -> Result<[f64; 3], String> {
    numbers(text).ok_or_else(|| format!("expected three numbers like 0.4,-0.5,1.2, found `{text}`"))
}

/// `N` finite numbers with commas between them.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let finite = |part: &str| part.trim().parse().ok().filter(|number: &f64| number.is_finite());
    let numbers: Option<Vec<f64>> = text.split(',').map(finite).collect();
    numbers.and_then(|numbers| numbers.try_into().ok())
}

/// An angle of view.
pub fn degrees(text: &str) -> Result<f64, String> {
    let angle = text.parse().ok().filter(|angle| (0.1..=179.0).contains(angle));
    angle.ok_or_else(|| format!("expected an angle of 0.1 to 179 degrees, found `{text}`"))
}

/// The difference that has the last colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    Auto,
    Last(f64),
}

impl FromStr for Range {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match (text, text.parse()) {
            ("auto", _) => Ok(Self::Auto),
            (_, Ok(range)) if range > 0.0 && f64::is_finite(range) => Ok(Self::Last(range)),
            _ => Err("expected auto or a number above 0".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks that all of these are refused with a message that says what is expected.
    fn assert_refused<T, E: ToString>(parse: fn(&str) -> Result<T, E>, texts: &[&str], expected: &str) {
        for text in texts {
            assert!(parse(text).is_err_and(|message| message.to_string().contains(expected)), "{text}");
        }
    }

    #[test]
    fn values_have_their_units_and_ranges() {
        let shares = ["1%", "0.5%", "30%", "0.01", "0.1", "1e-3"].map(|text| percent(text).unwrap());
        assert!(shares.iter().zip([0.01, 0.005, 0.3, 0.01, 0.1, 1e-3]).all(|(a, b)| (a - b).abs() < 1e-15));
        assert_refused(percent, &["0.5"], "0.5% or 50%");
        assert_refused(percent, &["0", "-1%", "1", "100%", "nan", "inf", "", "%", "0.11"], "expected");
        let times = ["100us", "500ms", "2s", "0.5", "1 s"].map(|text| duration(text).unwrap().as_micros());
        assert_eq!(times, [100, 500_000, 2_000_000, 500_000, 1_000_000]);
        assert_refused(duration, &["0", "-1s", "2m", "1e9s", "nan", "s", ""], "above 0");
        assert_eq!([loss("0"), loss("2.5e-1")], [Ok(0.0), Ok(0.25)]);
        assert_refused(loss, &["nan", "inf", "-1", "-inf", "", "x"], "a loss");
        assert_eq!(stops("-1.5"), Ok(-1.5));
        assert_refused(stops, &["nan", "inf", "", "x", "1e20", "-20.5"], "from -20 to 20");
        assert_eq!(triple("1,-2, 3e-1"), Ok([1.0, -2.0, 0.3]));
        assert_refused(triple, &["1,2", "1,2,3,4", "", "a,b,c", "1,,2", "0,0,nan", "0,inf,1"], "three");
        assert_eq!(degrees("45"), Ok(45.0));
        assert_refused(degrees, &["0", "180", "-3", "nan", "wide"], "0.1 to 179");
    }
}
