//! Tables of LaTeX for papers.

use svbrdf_core::text::line;

/// A table for the package booktabs: its alignment, its heading, and rows that end with a line break each.
pub fn latex(columns: &str, heading: &str, rows: &str) -> String {
    format!(
        "\\begin{{tabular}}{{{columns}}}\n\\toprule\n{heading} \\\\\n\\midrule\n{rows}\\bottomrule\n\\end{{tabular}}\n"
    )
}

/// A float of tables with its caption above.
pub fn float(caption: &str, tables: &str) -> String {
    format!("\\begin{{table}}\n\\centering\n\\caption{{{}}}\n{tables}\\end{{table}}\n", caption.trim_end())
}

/// The lines of a heading as the sentences of a caption.
pub fn sentences(heading: &str) -> String {
    let sentence = |line: &str| {
        let (first, rest) = line.split_at(line.chars().next().map_or(0, char::len_utf8));
        format!("{}{}. ", first.to_uppercase(), rest.trim_end_matches('.'))
    };
    heading.lines().filter(|line| !line.is_empty()).map(sentence).collect()
}

/// Lines above a table that are not typeset.
pub fn comments(lines: impl IntoIterator<Item = String>) -> String {
    lines.into_iter().map(|comment| format!("% {}\n", line(&comment))).collect()
}

/// How many digits behind the point a number has: two of half of its interval; where that is unknown, three of its own.
pub fn digits(value: f64, interval: Option<[f64; 2]>) -> usize {
    let half = interval.map_or(0.0, |[low, high]| (high - low) / 2.0);
    let (of, count) = if half > 1e-5 * value.abs() { (half, 2.0) } else { (value.abs(), 3.0) };
    if of == 0.0 { 3 } else { (count - 1.0 - of.log10().floor()).clamp(0.0, 6.0) as usize }
}

/// A number with as many digits behind the point; `--` where it is unknown.
pub fn number(value: f64, digits: usize) -> String {
    match value {
        _ if value.is_nan() => "--".to_owned(),
        _ if value.is_infinite() => "$\\infty$".to_owned(),
        _ if value < 0.0 => format!("${value:.digits$}$"),
        _ => format!("{value:.digits$}"),
    }
}

/// An interval with as many digits behind the point.
pub fn interval(ends: [f64; 2], digits: usize) -> String {
    let [low, high] = ends.map(|end| number(end, digits));
    format!("[{low}, {high}]")
}

/// A number in bold, where it is among the best.
pub fn bold(number: &str, best: bool) -> String {
    if best { format!("\\textbf{{{number}}}") } else { number.to_owned() }
}

/// Text with the characters that LaTeX treats in a special way escaped.
pub fn escaped(text: &str) -> String {
    let one = |c: char| match c {
        '&' | '%' | '$' | '#' | '_' | '{' | '}' => format!("\\{c}"),
        '~' => "\\textasciitilde{}".to_owned(),
        '^' => "\\textasciicircum{}".to_owned(),
        '\\' => "\\textbackslash{}".to_owned(),
        '<' => "\\textless{}".to_owned(),
        '>' => "\\textgreater{}".to_owned(),
        _ => c.to_string(),
    };
    text.chars().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_has_two_digits_of_its_interval() {
        for (value, interval, expected) in [
            (0.049_913, Some([0.043_1, 0.057_6]), "0.0499"),
            (21.137, Some([20.1, 22.9]), "21.1"),
            (263.46, Some([120.0, 410.0]), "263"),
            (-0.002_51, Some([-0.01, 0.005]), "$-0.0025$"),
            (0.038_74, None, "0.0387"),
            (36.0891, None, "36.1"),
            (0.5, Some([0.5; 2]), "0.500"),
            (0.0, None, "0.000"),
            (f64::INFINITY, None, "$\\infty$"),
            (f64::NAN, None, "--"),
        ] {
            assert_eq!(number(value, digits(value, interval)), expected);
        }
        assert_eq!(interval([-0.5, 1.25], 1), "[$-0.5$, 1.2]");
    }

    #[test]
    fn text_is_typeset_as_it_is() {
        assert_eq!(escaped("a_b < 5% {x}"), "a\\_b \\textless{} 5\\% \\{x\\}");
        assert_eq!(sentences("loss of é\n\nélan.\n"), "Loss of é. Élan. ");
        assert_eq!(comments(["two\nlines".to_owned()]).lines().count(), 1);
    }
}
