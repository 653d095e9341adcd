//! Notes on photographs whose shape is not that of a material.

/// A note about each of `sizes` of materials where a photograph of the size (`w`, `h`) has another shape.
pub fn stretched([w, h]: [usize; 2], sizes: impl Iterator<Item = [usize; 2]>, remedy: &str) -> Vec<String> {
    let mut noted: Vec<[usize; 2]> = Vec::new();
    for [width, height] in sizes {
        let ratio = (w * height) as f64 / (h * width) as f64;
        if !(0.99..=1.01).contains(&ratio) && !noted.contains(&[width, height]) {
            noted.push([width, height]);
        }
    }
    let note = |[width, height]: [usize; 2]| {
        format!(
            "note: all {w} x {h} pixels of the photograph are taken as the {width} x {height} texels of the material; \
             {remedy}"
        )
    };
    noted.into_iter().map(note).collect()
}
