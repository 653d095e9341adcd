//! Tables of a data set for papers.

use std::collections::BTreeSet;

use super::metric_summary::{MetricRow, best_by_metric, is_better_larger, method_title};
use super::record::DatasetSettings;
use super::summary::{DatasetReport, FEW, MethodSummary};
use crate::protocols::{Aggregate, Row};
use crate::report::{bold, comments, digits, escaped, float, interval, latex, number};

impl DatasetReport {
    /// Tables for a paper: the best methods in bold, and the same of the metrics. What the numbers depend on is a comment above.
    pub fn latex(&self) -> String {
        let row = |summary: &MethodSummary| {
            let MethodSummary { mean, interval95_materials: known, interval95_scenes, .. } = summary;
            let digits = digits(*mean, known.or(Some(*interval95_scenes)));
            let cells = [
                escaped(&summary.method),
                bold(&number(*mean, digits), summary.ties_with_best),
                known.map_or(FEW.to_owned(), |known| interval(known, digits)),
                number(summary.median, digits),
                difference(summary, digits),
                summary.count(),
            ];
            cells.join(" & ") + " \\\\\n"
        };
        let (compared, lacking): (Vec<_>, Vec<_>) = self.methods.iter().partition(|summary| summary.compared);
        let mut rows: String = compared.into_iter().map(row).collect();
        if !lacking.is_empty() {
            rows += "\\midrule\n";
            rows.extend(lacking.into_iter().map(row));
        }
        let files = self.files.iter().map(|(whose, sha256)| format!("sha256 {sha256} {whose}"));
        let lines = self.conditions().into_iter().chain(files).chain([self.repetition.to_string()]);
        let heading =
            "Method & Mean loss $\\downarrow$ & 95\\% interval & Median & Difference to best & Materials";
        let losses = latex("lrlrlr", heading, &rows);
        comments(lines) + &float(&escaped(&self.caption()), &(losses + &latex_table(self)))
    }

    /// What the numbers depend on, for the caption of a table.
    fn caption(&self) -> String {
        let DatasetSettings { convention, protocol, .. } = &self.settings;
        let protocol = protocol.as_ref().map_or(String::new(), |protocol| {
            let metric = |row: &Row| {
                let mean = if row.over_materials == Aggregate::Median { "median " } else { "" };
                format!("{} is {mean}{}", row.label, words(&row.summary()))
            };
            let metrics: Vec<String> = protocol.metrics.iter().map(metric).collect();
            format!(" Protocol {}: {}.", protocol.name, metrics.join(", "))
        });
        let registrations = self.reading.registrations.iter();
        let registrations: String = registrations.map(|(method, way)| format!(" {method}: {way}.")).collect();
        let masked = if self.reading.mask.is_some() { " Texels of the mask only." } else { "" };
        let decided: String = self.reading.decisions.iter().map(|decision| format!(" {decision}.")).collect();
        let decided = if registrations.is_empty() { decided } else { registrations };
        format!(
            "Rendering loss over {} materials{}: convention {convention}, epsilon {}, {}.{protocol}{masked}{decided} \
             Intervals over materials, 95%, and paired differences; bold: the best and what cannot be told from it.",
            self.compared_materials.len(),
            self.sizes(),
            convention.convention.epsilon,
            self.settings.scenes.description(self.settings.seed),
        )
    }

    /// The sizes of the maps that are compared, behind the number of materials.
    fn sizes(&self) -> String {
        let compared = self.predictions().filter(|(result, one)| self.is_compared(result, one));
        let sizes: BTreeSet<[usize; 2]> = compared.filter_map(|(_, one)| one.size).collect();
        let [first, last] = [sizes.first(), sizes.last()].map(|size| size.map(|[w, h]| format!("{w} x {h}")));
        match first.zip(last) {
            None => String::new(),
            Some((first, last)) if first == last => format!(" of {first} texels"),
            Some((first, last)) => format!(" of {first} to {last} texels"),
        }
    }
}

/// The mean of the paired differences to the best method, with its interval; of few materials on how many it is worse.
fn difference(summary: &MethodSummary, of_mean: usize) -> String {
    let Some(mean) = summary.to_best else { return "--".to_owned() };
    if let Some(known) = summary.to_best_interval95_materials {
        let digits = digits(mean, Some(known));
        return format!("{} {}", number(mean, digits), interval(known, digits));
    }
    let signs =
        summary.worse_on.map_or(String::new(), |[worse, all]| format!(" (worse on {worse} of {all})"));
    number(mean, of_mean) + &signs
}

/// The means over materials as a LaTeX table with a column for each method: in bold the best one and what ties with it. Empty
/// without metrics.
fn latex_table(report: &DatasetReport) -> String {
    let methods = &report.methods;
    let best = best_by_metric(report);
    if best.is_empty() {
        return String::new();
    }
    let line = |(row, best): (&MetricRow, &Vec<bool>)| {
        let cell = |(method, &best): (&MethodSummary, &bool)| {
            row.value(method)
                .map_or("--".to_owned(), |(value, known)| bold(&number(value, digits(value, known)), best))
        };
        let cells: Vec<String> = methods.iter().zip(best).map(cell).collect();
        let arrow = if is_better_larger(&row.metric) { "$\\uparrow$" } else { "$\\downarrow$" };
        let title = row.label.clone().unwrap_or_else(|| words(&row.metric));
        format!("{} {arrow} & {} \\\\\n", escaped(&title), cells.join(" & "))
    };
    let rows: String = best.iter().map(|(row, best)| line((row, best))).collect();
    let names: Vec<String> = methods.iter().map(|summary| escaped(&method_title(summary))).collect();
    let heading = format!("Mean over materials & {}", names.join(" & "));
    format!("\n{}", latex(&format!("l{}", "r".repeat(methods.len())), &heading, &rows))
}

/// The name of a metric in the words of a paper, with its unit.
fn words(metric: &str) -> String {
    const SPACES: [(&str, &str); 7] = [
        ("_srgb", ", sRGB"),
        ("_linear", ", linear"),
        ("_gamma2.2", ", gamma 2.2"),
        ("_minus1_to_1", ", in [-1, 1]"),
        ("_stored", ", as stored"),
        ("_scaled_channels", ", scaled by channel"),
        ("_scaled", ", scaled"),
    ];
    const MEASURES: [(&str, &str, &str); 9] = [
        ("rmse_pooled_", "pooled RMSE of ", ""),
        ("rmse_", "RMSE of ", ""),
        ("l1_", "L1 of ", ""),
        ("psnr_pooled_", "pooled PSNR of ", " (dB)"),
        ("psnr_", "PSNR of ", " (dB)"),
        ("ssim11_gaussian_", "SSIM of ", ""),
        ("ssim7_uniform_", "SSIM (7 x 7) of ", ""),
        ("flip_", "FLIP of ", ""),
        ("angle_normal_", "angle of normals, ", ""),
    ];
    let measure = MEASURES.iter().find(|(begin, ..)| metric.starts_with(begin));
    let (begin, measure, unit) = measure.copied().unwrap_or_default();
    let of = SPACES.iter().fold(metric[begin.len()..].to_owned(), |of, (from, to)| of.replace(from, to));
    let of = of.replace("rendering_clipped", "renderings").replace('_', " ");
    let of = of.replace(" degrees", " (degrees)").replace("p95", "95th percentile");
    format!("{measure}{of}{unit}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn metrics_of_a_paper_have_words_and_units() {
        for (metric, expected) in [
            ("rmse_normal_stored", "RMSE of normal, as stored"),
            ("psnr_base_colour_srgb", "PSNR of base colour, sRGB (dB)"),
            ("ssim11_gaussian_rendering_clipped_srgb", "SSIM of renderings, sRGB"),
            ("angle_normal_p95_degrees", "angle of normals, 95th percentile (degrees)"),
            ("rmse_diffuse_linear_minus1_to_1", "RMSE of diffuse, linear, in [-1, 1]"),
        ] {
            assert_eq!(words(metric), expected);
        }
    }
}
