//! Metadata of the pictures of `svbrdf photo`.

use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::statistics::Distributions;
use svbrdf_evaluate::photograph::PhotoReport;
use svbrdf_evaluate::report::position;
use svbrdf_files::export::Provenance;

/// The difference that has the last colour: the 99th percentile of the material where it is largest.
pub fn last_colour(report: &PhotoReport, kind: Difference) -> f64 {
    let values: Vec<_> = report.results.iter().map(|result| result.compared.differences(kind)).collect();
    Distributions::of(&values, kind.is_signed()).auto_range
}

/// What a picture of the differences says of itself.
pub fn entries(report: &PhotoReport, kind: Difference, last: f64) -> [(&'static str, String); 7] {
    let PhotoReport { setting, results, .. } = report;
    let names: Vec<_> = results.iter().map(|result| result.material.as_str()).collect();
    let factors: Vec<_> = results.iter().map(|result| result.compared.factor.to_string()).collect();
    let Scene { kind: near, view, light } = setting.scene;
    let shows = format!(
        "{} from the photograph g, {} of renderings p; NaN or gray where the photograph is clipped; {last} the last colour",
        kind.name(),
        kind.unit()
    );
    [
        ("svbrdf:shows", shows),
        ("svbrdf:photograph", setting.source()),
        ("svbrdf:factors", factors.join(" | ")),
        ("svbrdf:sources", names.join(" | ")),
        ("svbrdf:convention", setting.convention.name.to_owned()),
        ("svbrdf:scene", format!("{near}, view {}, light {}", position(view), position(light))),
        ("svbrdf:version", Provenance::SOFTWARE.to_owned()),
    ]
}
