//! Tables of LaTeX for papers.

/// A table for the package booktabs: its alignment, its heading, and rows that end with a line break each.
pub fn latex(columns: &str, heading: &str, rows: &str) -> String {
    format!(
        "\\begin{{tabular}}{{{columns}}}\n\\toprule\n{heading} \\\\\n\\midrule\n{rows}\\bottomrule\n\\end{{tabular}}\n"
    )
}

/// A float of tables with its caption above.
pub fn float(caption: &str, tables: &str) -> String {
    format!("\\begin{{table}}\n\\centering\n\\caption{{{caption}}}\n{tables}\\end{{table}}\n")
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
        _ => c.to_string(),
    };
    text.chars().map(one).collect()
}
