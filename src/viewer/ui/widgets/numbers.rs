//! Numbers as text: estimates, accuracies, times.

use std::time::Duration;

use svbrdf_core::loss::Estimate;

/// A number in four significant digits, at least down to 0.0001.
pub fn digits(value: f64) -> String {
    match value.abs() {
        v if v >= 1e4 => format!("{value:.2e}"),
        v if v >= 100.0 => format!("{value:.1}"),
        v if v >= 10.0 => format!("{value:.2}"),
        v if v >= 1.0 => format!("{value:.3}"),
        _ => format!("{value:.4}"),
    }
}

/// An estimate as text: its mean in significant digits only, and its 95% interval with one digit more.
pub fn significant(estimate: &Estimate) -> [String; 2] {
    let Estimate { mean, interval95, .. } = *estimate;
    let Some([low, high]) = interval95 else { return [format!("{mean:.4}"), "[unknown]".to_owned()] };
    let half = 0.5 * (high - low);
    let decimals = if half > 0.0 { (-half.log10().floor()).clamp(0.0, 12.0) as usize } else { 6 };
    let more = decimals + usize::from(half > 0.0);
    [format!("{mean:.decimals$}"), format!("[{low:.more$}, {high:.more$}]")]
}

/// Half the width of an interval relative to its mean, in percent with about three digits.
pub fn accuracy(share: f64) -> String {
    match 100.0 * share {
        percent if percent.is_infinite() => "error unknown".to_owned(),
        percent if percent >= 10.0 => format!("+-{percent:.1}%"),
        percent => format!("+-{percent:.2}%"),
    }
}

/// A time with about three digits.
pub fn seconds(time: Duration) -> String {
    match time.as_secs_f64() {
        s if s < 0.01 => format!("{:.1} ms", s * 1e3),
        s if s < 1.0 => format!("{:.0} ms", s * 1e3),
        s => format!("{s:.1} s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_about_four_digits() {
        let all = [0.0, -0.123_456, 1.234_56, 45.678_9, 123.456, 123_456.0].map(digits);
        assert_eq!(all, ["0.0000", "-0.1235", "1.235", "45.68", "123.5", "1.23e5"]);
    }

    #[test]
    fn means_have_their_significant_digits_and_intervals_one_more() {
        let of = |mean, interval95| significant(&Estimate { mean, standard_error: None, interval95 });
        assert_eq!(of(0.321_814, Some([0.319_551, 0.324_195])), ["0.322", "[0.3196, 0.3242]"]);
        assert_eq!(of(0.371_2, Some([0.284, 0.473])), ["0.37", "[0.284, 0.473]"]);
        assert_eq!(of(-0.117, Some([-0.119_365, -0.114_891])), ["-0.117", "[-0.1194, -0.1149]"]);
        assert_eq!(of(0.0, Some([0.0, 0.0])), ["0.000000", "[0.000000, 0.000000]"]);
        assert_eq!(of(0.5, None), ["0.5000", "[unknown]"]);
    }

    #[test]
    fn shares_and_times_keep_about_three_digits() {
        let all = [0.2061, 0.0231, 0.00054, f64::INFINITY].map(accuracy);
        assert_eq!(all, ["+-20.6%", "+-2.31%", "+-0.05%", "error unknown"]);
        let all = [0.00131, 0.0463, 0.9, 12.34].map(|s| seconds(Duration::from_secs_f64(s)));
        assert_eq!(all, ["1.3 ms", "46 ms", "900 ms", "12.3 s"]);
    }
}
