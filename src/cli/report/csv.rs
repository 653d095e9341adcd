//! One table for spreadsheets (RFC 4180, with a heading); an unknown value is an empty cell.

use svbrdf::loss::Loss;
use svbrdf::model::scene::Kind;

use super::Printed;

const HEADING: &str = "prediction,loss,standard_error,interval95_low,interval95_high,\
    convention,epsilon,width,height,near,distant,seed,sampler,texels,precision,backend,\
    target_error,target_reached,path,ground_truth,ground_truth_path\n";

pub(super) fn write(printed: &Printed) -> String {
    let report = &printed.report;
    let [width, height] = report.size;
    let common = [
        report.convention.name.to_owned(),
        report.convention.epsilon.to_string(),
        width.to_string(),
        height.to_string(),
        report.count(Kind::Near).to_string(),
        report.count(Kind::Distant).to_string(),
        or_empty(report.seed()),
        or_empty(report.sampler()),
        report.texels().to_string(),
        report.precision.to_owned(),
        report.backend.to_owned(),
        or_empty(printed.target().map(|(error, _)| error)),
        or_empty(printed.target().map(|(_, reached)| reached)),
    ]
    .join(",");
    let ground_truth =
        [&*report.ground_truth, printed.ground_truth_path().unwrap_or_default()].map(quoted).join(",");
    let row = |(loss, path): (&Loss, Option<&str>)| {
        format!("{},{common},{},{ground_truth}\n", cells(loss), quoted(path.unwrap_or_default()))
    };
    let rows: String = report.outcome.losses.iter().zip(printed.prediction_paths()).map(row).collect();
    format!("{HEADING}{rows}")
}

fn or_empty(value: Option<impl ToString>) -> String {
    value.map_or(String::new(), |value| value.to_string())
}

fn cells(loss: &Loss) -> String {
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
