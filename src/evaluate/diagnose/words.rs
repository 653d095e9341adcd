//! Displacements in words.

/// `3 texels left and 1 texel down`; a direction without a displacement is left out.
pub(super) fn displacement([right, down]: [f64; 2]) -> String {
    let parts = [(right, ["right", "left"]), (down, ["down", "up"])];
    let parts = parts.into_iter().filter(|(count, _)| *count != 0.0);
    parts.map(|(count, names)| texels(count, names)).collect::<Vec<_>>().join(" and ")
}

fn texels(count: f64, [positive, negative]: [&str; 2]) -> String {
    let unit = if count.abs() == 1.0 { "texel" } else { "texels" };
    format!("{} {unit} {}", count.abs(), if count < 0.0 { negative } else { positive })
}
