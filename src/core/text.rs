//! Numbers as people read them.

/// A time in two digits or three, as people read it.
pub fn time(seconds: f64) -> String {
    match seconds {
        s if s >= 0.9995 => digits(s, "s"),
        s if s >= 0.9995e-3 => digits(s * 1e3, "ms"),
        s => digits(s * 1e6, "us"),
    }
}

/// A share in percent, in two digits.
pub fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    let decimals = if percent > 0.0 { (1.0 - percent.log10().floor()).clamp(0.0, 9.0) as usize } else { 0 };
    let text = format!("{percent:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    format!("{text}%")
}

fn digits(value: f64, unit: &str) -> String {
    let text = if value < 9.95 { format!("{value:.1}") } else { format!("{value:.0}") };
    format!("{} {unit}", text.trim_end_matches(".0"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_shares_have_a_few_digits() {
        assert_eq!([2.345, 0.012_34, 0.000_999_9, 1.2e-5].map(time), ["2.3 s", "12 ms", "1 ms", "12 us"]);
        assert_eq!(
            [0.1, 0.003, 0.012_34, 0.000_056, 1.5, 0.0].map(percent),
            ["10%", "0.3%", "1.2%", "0.0056%", "150%", "0%"]
        );
    }
}
