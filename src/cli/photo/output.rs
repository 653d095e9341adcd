//! Metadata of the pictures of `svbrdf photo`.

use svbrdf_core::image::Image;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::statistics::Distributions;
use svbrdf_evaluate::photograph::PhotoReport;
use svbrdf_evaluate::report::position;
use svbrdf_files::export::Provenance;

/// The difference of each material from a single photograph, and the one that has the last colour: the 99th percentile of the
/// material where it is largest.
pub fn panes(report: &PhotoReport, kind: Difference) -> (Vec<Image<f32>>, f64) {
    let compared: Vec<_> = report.compared().collect();
    let values: Vec<_> = compared.iter().map(|one| one.differences(kind)).collect();
    let panes = compared.iter().map(|one| one.difference(kind)).collect();
    (panes, Distributions::of(&values, kind.is_signed()).auto_range)
}

/// What a picture of the differences says of itself.
pub fn entries(report: &PhotoReport, kind: Difference, last: f64) -> [(&'static str, String); 7] {
    let PhotoReport { setting, results, .. } = report;
    let names: Vec<_> = results.iter().map(|result| result.material.as_str()).collect();
    let factors: Vec<_> = report.compared().map(|one| one.factor.to_string()).collect();
    let scenes = setting.capture.photographs.iter().map(|one| {
        let Scene { kind, view, light } = one.scene;
        format!("{kind}, view {}, light {}", position(view), position(light))
    });
    let shows = format!(
        "{} from the photograph g, {} of renderings p; NaN or gray where the photograph is clipped; {last} the last colour",
        kind.name(),
        kind.unit()
    );
    [
        ("svbrdf:shows", shows),
        ("svbrdf:photograph", report.source()),
        ("svbrdf:factors", factors.join(" | ")),
        ("svbrdf:sources", names.join(" | ")),
        ("svbrdf:convention", setting.convention.name.to_owned()),
        ("svbrdf:scene", scenes.collect()),
        ("svbrdf:version", Provenance::SOFTWARE.to_owned()),
    ]
}
