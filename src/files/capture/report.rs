//! Materials against the photographs of a capture as text and CSV.

use svbrdf_core::loss::Estimate;
use svbrdf_core::report::{Cell, Report, Table, aligned};
use svbrdf_core::statistics::median;

use super::comparison::{CaptureExposure, CaptureReport, CaptureSetting, ReadCaptured};
use super::measured::{CaptureGroup, CapturedResult, MaterialResult};

const COLUMNS: [&str; 25] = [
    "material",
    "photographs",
    "photograph",
    "factor",
    "exposure_ev",
    "own_exposure_ev",
    "log",
    "log_interval95_low",
    "log_interval95_high",
    "rmse",
    "rmse_interval95_low",
    "rmse_interval95_high",
    "ssim",
    "ssim_interval95_low",
    "ssim_interval95_high",
    "texels",
    "clipped",
    "outlier",
    "transfer",
    "exposure",
    "declared_ev",
    "falloff",
    "capture",
    "convention",
    "epsilon",
];

const UNKNOWN: &str = "-";

fn text(value: Option<f64>, format: impl Fn(f64) -> String) -> String {
    value.map_or_else(|| UNKNOWN.to_owned(), format)
}

fn ev(factor: Option<f64>) -> String {
    text(factor, |factor| format!("{:+.2}", factor.log2()))
}

fn measure(value: Option<f64>) -> String {
    text(value, |value| format!("{value:.4}"))
}

/// A mean and its interval.
fn estimate(estimate: Option<Estimate>) -> [String; 2] {
    let interval = estimate.and_then(|estimate| estimate.interval95);
    let interval = interval.map(|[low, high]| format!("{low:.4} to {high:.4}"));
    [measure(estimate.map(|estimate| estimate.mean)), interval.unwrap_or_else(|| UNKNOWN.to_owned())]
}

impl CaptureSetting {
    /// The stops by which a factor exceeds the one that the power of the light gives.
    pub(super) fn declared_ev(&self, factor: Option<f64>) -> Option<f64> {
        Some((factor? / self.declared_factor()?).log2())
    }

    /// The lines above the tables.
    fn heading(&self, photographs: &[ReadCaptured]) -> String {
        let mut transfers: Vec<String> =
            photographs.iter().map(|one| format!("{} {}", one.transfer, one.transfer_from)).collect();
        transfers.dedup();
        let falloff = if self.capture.falloff { ", falloff of the light divided out" } else { "" };
        let exposure = match self.exposure {
            CaptureExposure::Capture => "one exposure for all photographs",
            CaptureExposure::Photograph => "one exposure for each photograph",
        };
        let held_out = self.held_out();
        let held_out = match (held_out.is_empty(), self.exposure) {
            (true, _) => String::new(),
            (false, CaptureExposure::Capture) => {
                format!(", not fitted to the held-out photographs: {held_out}")
            }
            (false, CaptureExposure::Photograph) => format!("; held out: {held_out}"),
        };
        format!(
            "differences from the {} photographs of {}, {}{falloff}\nconvention {}, epsilon {}\n{exposure}{held_out}\n\
             means over photographs with 95% intervals; RMSE and SSIM of sRGB values\n",
            photographs.len(),
            self.name,
            transfers.join("; "),
            self.convention.name,
            self.convention.epsilon
        )
    }
}

impl CaptureReport {
    /// A line about each photograph that is an outlier for a material.
    fn outliers(&self) -> String {
        (0..self.photographs.len()).filter_map(|index| self.outlier(index)).collect()
    }

    /// The line about the photograph at `index`, with the numbers of the first material for which it is an outlier.
    fn outlier(&self, index: usize) -> Option<String> {
        let is_outlier = |result: &&MaterialResult| result.photographs[index].outlier.is_any();
        let result = self.results.iter().find(is_outlier)?;
        let one = &result.photographs[index];
        let exposure = one.outlier.exposure.then(|| {
            let [own, middle] = beside_median(result, index, CapturedResult::own_ev);
            format!("the exposure that fits it alone is {:+.2} EV from the median", own - middle)
        });
        let difference = one.outlier.difference.then(|| {
            let [log, middle] = beside_median(result, index, |one| one.log);
            format!("its log difference is {log:.4}, the median {middle:.4}")
        });
        let findings: Vec<String> = exposure.into_iter().chain(difference).collect();
        let (count, all) = (self.results.iter().filter(is_outlier).count(), self.results.len());
        let whose = match all {
            1 => String::new(),
            _ => format!(" for {count} of {all} materials (numbers of {})", result.material),
        };
        Some(format!("{} is an outlier{whose}: {}\n", self.photographs[index].name, findings.join("; ")))
    }

    fn means(&self) -> Vec<Vec<String>> {
        let is_declared = self.setting.declared_factor().is_some();
        let mut rows = vec![
            ["material", "photographs", "factor", "EV", "from light_pow", "log mean", "95% interval", "RMSE"]
                .into_iter()
                .chain(["95% interval", "SSIM", "95% interval"])
                .map(str::to_owned)
                .collect::<Vec<_>>(),
        ];
        for result in &self.results {
            rows.extend(result.groups().into_iter().map(|CaptureGroup { name, count, log, rmse, ssim }| {
                let declared = text(self.setting.declared_ev(result.factor), |ev| format!("{ev:+.2} EV"));
                let start = [
                    result.material.clone(),
                    format!("{count} {name}").replace(" all", ""),
                    measure(result.factor),
                    ev(result.factor),
                    declared,
                ];
                start.into_iter().chain([log, rmse, ssim].into_iter().flat_map(estimate)).collect()
            }));
        }
        if !is_declared {
            rows.iter_mut().for_each(|row| drop(row.remove(4)));
        }
        rows
    }

    fn each(&self) -> Vec<Vec<String>> {
        let titles = ["photograph", "material", "EV alone", "log mean", "RMSE", "SSIM", "clipped", ""];
        let mut rows = vec![titles.map(str::to_owned).to_vec()];
        for (index, read) in self.photographs.iter().enumerate() {
            rows.extend(self.results.iter().map(|result| {
                let one = &result.photographs[index];
                let mark = match (one.outlier.is_any(), one.is_held_out) {
                    (true, true) => "outlier, held out",
                    (true, false) => "outlier",
                    (false, true) => "held out",
                    (false, false) => "",
                };
                vec![
                    read.name.clone(),
                    result.material.clone(),
                    ev(one.own_factor),
                    measure(one.log),
                    measure(one.rmse),
                    measure(one.ssim),
                    format!("{:.2}%", 100.0 * one.clipped as f64 / one.texels as f64),
                    mark.to_owned(),
                ]
            }));
        }
        rows
    }

    /// The row of a group of photographs.
    fn group_row(&self, result: &MaterialResult, group: &CaptureGroup) -> Vec<Cell> {
        let start: [Cell; 6] = [
            result.material.as_str().into(),
            group.name.into(),
            Cell::Empty,
            result.factor.into(),
            result.factor.map(f64::log2).into(),
            Cell::Empty,
        ];
        let estimates = [group.log, group.rmse, group.ssim].into_iter().flat_map(|estimate| {
            let end = |end: usize| estimate.and_then(|e| e.interval95).map(|interval| interval[end]);
            [estimate.map(|e| e.mean), end(0), end(1)].map(Cell::from)
        });
        let counted = [Cell::Empty, Cell::Empty, Cell::Empty, Cell::Empty];
        start.into_iter().chain(estimates).chain(counted).chain(self.setting_cells(result.factor)).collect()
    }

    /// The row of one photograph.
    fn photograph_row(&self, result: &MaterialResult, index: usize) -> Vec<Cell> {
        let (read, one) = (&self.photographs[index], &result.photographs[index]);
        let start: [Cell; 6] = [
            result.material.as_str().into(),
            if one.is_held_out { "held out" } else { "fitted" }.into(),
            read.name.as_str().into(),
            one.factor.into(),
            one.factor.map(f64::log2).into(),
            one.own_ev().into(),
        ];
        let measures = [one.log, one.rmse, one.ssim]
            .into_iter()
            .flat_map(|value| [value.into(), Cell::Empty, Cell::Empty]);
        let counted: [Cell; 4] =
            [one.texels.into(), one.clipped.into(), one.outlier.is_any().into(), read.transfer.name().into()];
        start.into_iter().chain(measures).chain(counted).chain(self.setting_cells(one.factor)).collect()
    }

    fn setting_cells(&self, factor: Option<f64>) -> [Cell; 6] {
        let CaptureSetting { name, capture, exposure, convention, .. } = &self.setting;
        [
            exposure.name().into(),
            self.setting.declared_ev(factor).into(),
            capture.falloff.into(),
            name.as_str().into(),
            convention.name.into(),
            convention.epsilon.into(),
        ]
    }
}

/// A quantity of the photograph at `index`, and its median over all photographs.
fn beside_median(
    result: &MaterialResult,
    index: usize,
    of: impl Fn(&CapturedResult) -> Option<f64>,
) -> [f64; 2] {
    let mut known: Vec<f64> = result.photographs.iter().filter_map(&of).collect();
    let middle = median(&mut known).unwrap_or(f64::NAN);
    [of(&result.photographs[index]).unwrap_or(f64::NAN), middle]
}

impl Report for CaptureReport {
    fn text(&self) -> String {
        format!(
            "{}{}\n{}\n{}",
            self.setting.heading(&self.photographs),
            self.outliers(),
            aligned(&self.means()),
            aligned(&self.each())
        )
    }

    fn table(&self) -> Table {
        let rows = self.results.iter().flat_map(|result| {
            let groups = result.groups().into_iter().map(|group| self.group_row(result, &group));
            let each = (0..self.photographs.len()).map(|index| self.photograph_row(result, index));
            groups.chain(each).collect::<Vec<_>>()
        });
        Table::new(COLUMNS, rows)
    }
}
