//! Tables of text, and the line about scenes above them.

use crate::loss::Sampling;
use crate::model::sampler::Sampler;
use crate::model::scene::{Kind, Scene};

/// Lines of aligned columns, the first to the left, the others to the right. Rows may be shorter than others.
pub fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |c| rows.iter().filter_map(|row| row.get(c)).map(|cell: &String| cell.chars().count()).max();
    let widths: Vec<usize> = (0..columns).map(|c| width(c).unwrap_or(0)).collect();
    let cell = |(c, cell): (usize, &String)| match c {
        0 => format!("{cell:<w$}", w = widths[0]),
        _ => format!("  {cell:>w$}", w = widths[c]),
    };
    let line =
        |row: &Vec<String>| row.iter().enumerate().map(cell).collect::<String>().trim_end().to_owned() + "\n";
    rows.iter().map(line).collect()
}

/// The numbers of scenes, how they were sampled and the texels of each, for materials of `size`: a line. `None` for `sampling`: the
/// scenes are of a file.
pub fn scenes_line(sampling: Option<&Sampling>, scenes: &[Scene], size: [usize; 2]) -> String {
    let count = |kind| scenes.iter().filter(|scene| scene.kind == kind).count();
    let counts = format!("{} near-field and {} distant scenes", count(Kind::Near), count(Kind::Distant));
    let Some(sampling) = sampling else { return counts + " from a file\n" };
    let sampler = if sampling.sampler == Sampler::Sobol { ", scrambled Sobol" } else { "" };
    let texels = match sampling.texels.sampled(size) {
        None => String::new(),
        Some(1) => ", 1 random texel per scene".to_owned(),
        Some(count) => format!(", {count} random texels per scene"),
    };
    format!("{counts}, seed {}{sampler}{texels}\n", sampling.seed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loss::Texels;

    #[test]
    fn a_line_about_scenes_has_the_texels_that_are_compared() {
        let line = |texels| {
            let sampling = Sampling { texels, ..Sampling::default() };
            scenes_line(Some(&sampling), &[], [2, 2])
        };
        let of_all = "0 near-field and 0 distant scenes, seed 0\n";
        assert_eq!(line(Texels::All), of_all);
        assert_eq!(line(Texels::Sampled(4)), of_all, "the maps have no more");
        assert!(line(Texels::Sampled(3)).ends_with(", 3 random texels per scene\n"));
        assert!(line(Texels::Sampled(1)).ends_with(", 1 random texel per scene\n"));
        assert_eq!(scenes_line(None, &[], [2, 2]), "0 near-field and 0 distant scenes from a file\n");
    }
}
