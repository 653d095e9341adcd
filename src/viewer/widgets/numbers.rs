//! Numbers as text: estimates, accuracies, times.

use std::time::Duration;

use svbrdf_core::loss::Estimate;

/// Numbers below this have an exponent.
const TINY: f64 = 1e-3;
/// The fewest decimals of an estimate.
const FEWEST: f64 = 3.0;

/// A number in about four significant digits and at most seven characters after its sign: with an exponent below 0.001 and
/// from 10,000 on.
pub fn digits(value: f64) -> String {
    match value.abs() {
        v if v > 0.0 && v < TINY => format!("{value:.1e}"),
        v if v >= 1e4 => format!("{value:.2e}"),
        v if v >= 100.0 => format!("{value:.1}"),
        v if v >= 10.0 => format!("{value:.2}"),
        v if v >= 1.0 => format!("{value:.3}"),
        _ => format!("{value:.4}"),
    }
}

/// The numbers of a column, as [`digits`], of one width: their points stand below each other.
pub fn aligned(values: &[f64]) -> Vec<String> {
    let texts: Vec<String> = values.iter().map(|value| digits(*value)).collect();
    let split = |text: &str| text.find('.').map(|point| (point, text.len() - point));
    let parts: Vec<(usize, usize)> = texts.iter().filter_map(|text| split(text)).collect();
    let before = parts.iter().map(|(before, _)| *before).max().unwrap_or(0);
    let after = parts.iter().map(|(_, after)| *after).max().unwrap_or(0);
    let padded = |text: &String| match split(text) {
        Some((point, _)) => format!("{:>before$}{:<after$}", &text[..point], &text[point..]),
        None => format!("{text:>width$}", width = before + after),
    };
    texts.iter().map(padded).collect()
}

/// An estimate as text: its mean in significant digits, and its 95% interval with one digit more; three to five decimals, and
/// exponents below 0.001.
pub fn significant(estimate: &Estimate) -> [String; 2] {
    let Estimate { mean, interval95, .. } = *estimate;
    let Some([low, high]) = interval95 else { return [digits(mean), "[unknown]".to_owned()] };
    if mean != 0.0 && mean.abs() < TINY {
        return [format!("{mean:.1e}"), format!("[{low:.2e}, {high:.2e}]")];
    }
    let half = 0.5 * (high - low);
    let decimals = if half > 0.0 { (-half.log10().floor()).clamp(FEWEST, 4.0) as usize } else { 4 };
    let more = decimals + usize::from(half > 0.0);
    [format!("{mean:.decimals$}"), format!("[{low:.more$}, {high:.more$}]")]
}

/// The means of estimates beside each other, as [`significant`] and [`apart`].
pub fn means(estimates: &[&Estimate]) -> Vec<String> {
    let means: Vec<f64> = estimates.iter().map(|one| one.mean).collect();
    apart(&means, estimates.iter().map(|one| significant(one)[0].clone()).collect())
}

/// The texts of these values. Where values that differ have one text, each has as many digits more as tell it from these, at most six
/// decimals.
pub fn apart(values: &[f64], texts: Vec<String>) -> Vec<String> {
    let longer = |(value, text): (&f64, &String)| {
        let with = |value: f64, more: usize| match value.abs() {
            v if v > 0.0 && v < TINY => format!("{value:.more$e}"),
            _ => format!("{value:.0$}", more + 2),
        };
        let is_like = |(other, its): &(&f64, &String)| *its == text && *other != value;
        let alike: Vec<f64> = values.iter().zip(&texts).filter(is_like).map(|(other, _)| *other).collect();
        let is_apart = |more: &usize| alike.iter().all(|other| with(*other, *more) != with(*value, *more));
        let more = (1..=4).find(is_apart).filter(|_| !alike.is_empty());
        more.map_or_else(|| text.clone(), |more| with(*value, more))
    };
    values.iter().zip(&texts).map(longer).collect()
}

/// Half the width of an interval, in two significant digits: what follows the sign ±.
pub fn half_width(estimate: &Estimate) -> String {
    let Some([low, high]) = estimate.interval95 else { return "?".to_owned() };
    match 0.5 * (high - low) {
        half if half > 0.0 && half < TINY => format!("{half:.1e}"),
        half if half < 0.1 => format!("{half:.4}"),
        half => format!("{half:.2}"),
    }
}

/// A number with a real minus sign, and a plus sign where it is positive.
pub fn signed(text: &str) -> String {
    match text.strip_prefix('-') {
        Some(digits) => format!("\u{2212}{digits}"),
        None => format!("+{text}"),
    }
}

/// Half the width of an interval relative to its mean, in percent with about three digits.
pub fn accuracy(share: f64) -> String {
    match 100.0 * share {
        percent if percent.is_infinite() => "error unknown".to_owned(),
        percent if percent >= 10.0 => format!("±{percent:.1}%"),
        percent => format!("±{percent:.2}%"),
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

/// Characters of a number.
pub const WIDTH: usize = 8;

/// A number in exactly [`WIDTH`] characters, with as many digits as fit, at most 4 behind the point.
pub fn fixed(value: f64) -> String {
    in_width(value, WIDTH, 4)
}

/// A number in `width` characters, at least 6, with as many digits behind the point as fit, at most `digits`; with an exponent where
/// these would leave fewer than two digits of it.
pub fn in_width(value: f64, width: usize, digits: usize) -> String {
    let size = value.abs();
    if !size.is_finite() {
        return format!("{value:>width$}");
    }
    if size > 0.0 && size < 10_f64.powi(1 - digits.min(width - 3) as i32) {
        let fits = |text: &String| text.len() <= width;
        let texts = [2, 1, 0].map(|digits| format!("{value:>width$.digits$e}"));
        return texts.into_iter().find(fits).unwrap_or_else(|| format!("{:>width$}", 0));
    }
    let before = 1 + (1..).take_while(|&power| size >= 10_f64.powi(power)).count();
    // Of the sign and the point.
    let behind = width.saturating_sub(2 + before).min(digits);
    if behind > 0 { format!("{value:>width$.behind$}") } else { format!("{value:>width$.1e}") }
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
    fn points_of_a_column_stand_below_each_other() {
        let column = aligned(&[0.5, 12.25, -0.000_12, f64::NAN]);
        assert_eq!(column, [" 0.5000", "12.25  ", "-1.2e-4", "    NaN"]);
        assert_eq!(aligned(&[]), Vec::<String>::new());
    }

    #[test]
    fn means_have_their_significant_digits_and_intervals_one_more() {
        let of = |mean, interval95| significant(&Estimate { mean, standard_error: None, interval95 });
        assert_eq!(of(0.321_814, Some([0.319_551, 0.324_195])), ["0.322", "[0.3196, 0.3242]"]);
        assert_eq!(of(0.371_2, Some([0.284, 0.473])), ["0.371", "[0.2840, 0.4730]"]);
        assert_eq!(of(-0.117, Some([-0.119_365, -0.114_891])), ["-0.117", "[-0.1194, -0.1149]"]);
        assert_eq!(of(0.0, Some([0.0, 0.0])), ["0.0000", "[0.0000, 0.0000]"]);
        assert_eq!(of(0.5, None), ["0.5000", "[unknown]"]);
        assert_eq!(of(2.52e-5, Some([2.5123e-5, 2.5411e-5])), ["2.5e-5", "[2.51e-5, 2.54e-5]"]);
        assert_eq!(of(0.204_712_3, Some([0.204_712_2, 0.204_712_4])), ["0.2047", "[0.20471, 0.20471]"]);
    }

    #[test]
    fn means_that_look_alike_have_the_digits_that_tell_them_apart() {
        let of = |mean| Estimate { mean, standard_error: None, interval95: Some([mean - 0.01, mean + 0.01]) };
        // Whichever others are between them.
        let all = [of(0.2301), of(0.25), of(0.2303), of(0.2304), of(0.25), of(0.230_44)];
        let texts = ["0.2301", "0.250", "0.2303", "0.23040", "0.250", "0.23044"];
        assert_eq!(means(&all.each_ref()), texts);
        let tiny = [2.51e-5, 2.54e-5, 0.0];
        assert_eq!(apart(&tiny, tiny.map(digits).to_vec()), ["2.51e-5", "2.54e-5", "0.0000"]);
    }

    #[test]
    fn half_widths_have_few_digits_and_signs_are_real() {
        let of = |half: f64| {
            half_width(&Estimate { mean: 0.0, standard_error: None, interval95: Some([-half, half]) })
        };
        assert_eq!(
            [0.0, 2.5e-5, 0.0013, 0.0312, 0.25].map(of),
            ["0.0000", "2.5e-5", "0.0013", "0.0312", "0.25"]
        );
        assert_eq!(["-0.117", "0.2"].map(signed), ["\u{2212}0.117", "+0.2"]);
    }

    #[test]
    fn shares_and_times_keep_about_three_digits() {
        let all = [0.2061, 0.0231, 0.00054, f64::INFINITY].map(accuracy);
        assert_eq!(all, ["±20.6%", "±2.31%", "±0.05%", "error unknown"]);
        let all = [0.00131, 0.0463, 0.9, 12.34].map(|s| seconds(Duration::from_secs_f64(s)));
        assert_eq!(all, ["1.3 ms", "46 ms", "900 ms", "12.3 s"]);
    }

    #[test]
    fn numbers_keep_their_width() {
        for value in
            [0.0, -0.12345, 12.345_678, -99.9999, 123.456, 9_999.9, 65_504.0, 1e30, f64::NAN, f64::INFINITY]
        {
            assert_eq!(fixed(value).len(), WIDTH, "{value}: {:?}", fixed(value));
        }
        assert_eq!([fixed(0.5), fixed(-12.3456)], ["  0.5000", "-12.3456"]);
        // A dim gray is not 0.0001 three times.
        let dim = [1.234e-4, -9.87e-4, 0.001, -4.321e-12, 1e-310].map(fixed);
        assert_eq!(dim, [" 1.23e-4", "-9.87e-4", "  0.0010", "-4.3e-12", "1.0e-310"]);
        let narrow = [4.56e-4, -4.56e-4, -4.56e-14].map(|value| in_width(value, 6, 3));
        assert_eq!(narrow, ["4.6e-4", " -5e-4", "-5e-14"]);
        let narrow = [0.25, -0.123_45, 12.345, -123.45, 1234.5, 1e30].map(|value| in_width(value, 6, 3));
        assert_eq!(narrow, [" 0.250", "-0.123", " 12.35", "-123.5", " 1.2e3", "1.0e30"]);
    }
}
