//! One table for spreadsheets (RFC 4180, with a heading); an unknown value is an empty cell.

use svbrdf::loss::Loss;
use svbrdf::report::Report;
use svbrdf::scene::Kind;

const HEADING: &str = "prediction,loss,standard_error,interval95_low,interval95_high,\
    convention,epsilon,width,height,near,distant,seed,sampler,texels,precision,backend\n";

pub(super) fn write(report: &Report) -> String {
    let [width, height] = report.size;
    let common = format!(
        "{},{},{width},{height},{},{},{},{},{},{},{}",
        report.convention.name,
        report.convention.epsilon,
        report.count(Kind::Near),
        report.count(Kind::Distant),
        report.seed.map_or(String::new(), |seed| seed.to_string()),
        report.sampler.map_or(String::new(), |sampler| sampler.to_string()),
        report.texels,
        report.precision,
        report.backend,
    );
    let rows: String = report.losses.iter().map(|loss| format!("{},{common}\n", cells(loss))).collect();
    format!("{HEADING}{rows}")
}

fn cells(loss: &Loss) -> String {
    let or_empty = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
    let estimate = &loss.estimate;
    let (low, high) = (estimate.interval95.map(|i| i[0]), estimate.interval95.map(|i| i[1]));
    let numbers = [Some(estimate.mean), estimate.standard_error, low, high].map(or_empty);
    format!("{},{}", quoted(&loss.prediction), numbers.join(","))
}

/// A cell that may hold commas, quotes or line breaks.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn only_cells_that_need_it_are_quoted() {
        assert_eq!(quoted("plain name"), "plain name");
        assert_eq!(quoted("a,b"), "\"a,b\"");
        assert_eq!(quoted("7\" disc"), "\"7\"\" disc\"");
    }
}
