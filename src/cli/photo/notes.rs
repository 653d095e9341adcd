//! Notes on the photographs of a comparison.

use svbrdf_core::material::Material;
use svbrdf_evaluate::photograph::PhotoReport;

use crate::cli::output::exit::tell;

/// What was noticed about the photographs, and where their shape is not that of a material; what several have in common once.
pub fn tell_notes(report: &PhotoReport, materials: &[Material<f32>]) {
    let capture = &report.setting.capture;
    let remedy = match capture.file {
        Some(_) => "the corners in capture.json tell where the material is in it",
        None => "--corners gives the corners of the material in it",
    };
    let mut notes = capture.outside();
    for read in &report.photographs {
        notes.extend(read.notes.iter().map(ToString::to_string));
        let sizes = materials.iter().map(Material::size).filter(|_| read.is_whole);
        notes.extend(sizes.filter_map(|size| stretched(read.size, size, remedy)));
    }
    let mut told = std::collections::HashSet::new();
    notes.iter().filter(|note| told.insert(*note)).for_each(|note| tell(&format!("note: {note}")));
}

/// A note where a photograph of the size (`w`, `h`) has another shape than a material.
fn stretched([w, h]: [usize; 2], [width, height]: [usize; 2], remedy: &str) -> Option<String> {
    let ratio = (w * height) as f64 / (h * width) as f64;
    (!(0.99..=1.01).contains(&ratio)).then(|| {
        format!(
            "all {w} x {h} pixels of the photograph are taken as the {width} x {height} texels of the material; {remedy}"
        )
    })
}
