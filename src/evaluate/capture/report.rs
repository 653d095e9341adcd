//! Materials against the photographs of a capture as text and CSV.

use crate::report::{Cell, Column, Report, Table, aligned_columns};
use svbrdf_core::loss::Estimate;
use svbrdf_core::statistics::median;

use super::comparison::{CaptureExposure, CaptureReport, CaptureSetting, ReadCaptured};
use super::measured::{CaptureGroup, CapturedResult, MaterialResult};

const UNKNOWN: &str = "-";

fn text(value: Option<f64>, format: impl Fn(f64) -> String) -> String {
    value.map_or_else(|| UNKNOWN.to_owned(), format)
}

fn ev(stops: Option<f64>) -> String {
    text(stops, |stops| format!("{stops:+.2}"))
}

fn measure(value: Option<f64>) -> String {
    text(value, |value| format!("{value:.4}"))
}

fn mean(estimate: Option<Estimate>) -> Option<f64> {
    estimate.map(|estimate| estimate.mean)
}

fn interval(estimate: Option<Estimate>) -> Option<[f64; 2]> {
    estimate.and_then(|estimate| estimate.interval95)
}

fn interval_text(estimate: Option<Estimate>) -> String {
    let ends = interval(estimate).map(|[low, high]| format!("{low:.4} to {high:.4}"));
    ends.unwrap_or_else(|| UNKNOWN.to_owned())
}

impl CaptureSetting {
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
            let [own, middle] = beside_median(result, index, |one| one.own_exposure_ev);
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

    fn means(&self) -> String {
        let mut columns: Vec<Column<'_, (&MaterialResult, &CaptureGroup), String>> = vec![
            ("material", |(result, _)| result.material.clone()),
            ("photographs", |(_, group)| format!("{} {}", group.count, group.name).replace(" all", "")),
            ("factor", |(result, _)| measure(result.factor)),
            ("EV", |(result, _)| ev(result.exposure_ev)),
            ("from light_pow", |(result, _)| text(result.declared_ev, |ev| format!("{ev:+.2} EV"))),
            ("log mean", |(_, group)| measure(mean(group.log))),
            ("95% interval", |(_, group)| interval_text(group.log)),
            ("RMSE", |(_, group)| measure(mean(group.rmse))),
            ("95% interval", |(_, group)| interval_text(group.rmse)),
            ("SSIM", |(_, group)| measure(mean(group.ssim))),
            ("95% interval", |(_, group)| interval_text(group.ssim)),
        ];
        columns.retain(|(name, _)| *name != "from light_pow" || self.declared_factor.is_some());
        let rows = self.results.iter().flat_map(|one| one.means.iter().map(move |group| (one, group)));
        aligned_columns(&columns, rows)
    }

    fn each(&self) -> String {
        let columns: [Column<'_, (&MaterialResult, &CapturedResult), String>; 8] = [
            ("photograph", |(_, one)| one.photograph.clone()),
            ("material", |(result, _)| result.material.clone()),
            ("EV alone", |(_, one)| ev(one.own_exposure_ev)),
            ("log mean", |(_, one)| measure(one.log)),
            ("RMSE", |(_, one)| measure(one.rmse)),
            ("SSIM", |(_, one)| measure(one.ssim)),
            ("clipped", |(_, one)| format!("{:.2}%", 100.0 * one.clipped as f64 / one.texels as f64)),
            ("", |(_, one)| {
                let marks = [(one.outlier.is_any(), "outlier"), (one.is_held_out, "held out")];
                marks.into_iter().filter(|(is, _)| *is).map(|(_, mark)| mark).collect::<Vec<_>>().join(", ")
            }),
        ];
        let of = |index: usize| self.results.iter().map(move |result| (result, &result.photographs[index]));
        aligned_columns(&columns, (0..self.photographs.len()).flat_map(of))
    }
}

/// A row of the CSV: the means of a material over a group of photographs, or the material against one of them.
struct Row<'a> {
    report: &'a CaptureReport,
    result: &'a MaterialResult,
    of: RowOf<'a>,
}

#[derive(Clone, Copy)]
enum RowOf<'a> {
    Group(&'a CaptureGroup),
    One(&'a ReadCaptured, &'a CapturedResult),
}

impl<'a> Row<'a> {
    /// What a column has for one photograph alone.
    fn one<T>(&self, value: impl Fn(&'a ReadCaptured, &'a CapturedResult) -> T) -> Option<T> {
        match self.of {
            RowOf::Group(_) => None,
            RowOf::One(read, one) => Some(value(read, one)),
        }
    }

    fn photographs(&self) -> &'static str {
        match self.of {
            RowOf::Group(group) => group.name,
            RowOf::One(_, one) if one.is_held_out => "held out",
            RowOf::One(..) => "fitted",
        }
    }

    fn factor(&self) -> Option<f64> {
        self.one(|_, one| one.factor).unwrap_or(self.result.factor)
    }

    /// A measure: its mean over a group, or that of one photograph, which has no interval.
    fn measure(
        &self,
        of_group: impl Fn(&CaptureGroup) -> Option<Estimate>,
        of_one: impl Fn(&CapturedResult) -> Option<f64>,
    ) -> Option<Estimate> {
        match self.of {
            RowOf::Group(group) => of_group(group),
            RowOf::One(_, one) => {
                of_one(one).map(|mean| Estimate { mean, standard_error: None, interval95: None })
            }
        }
    }

    fn log(&self) -> Option<Estimate> {
        self.measure(|group| group.log, |one| one.log)
    }

    fn rmse(&self) -> Option<Estimate> {
        self.measure(|group| group.rmse, |one| one.rmse)
    }

    fn ssim(&self) -> Option<Estimate> {
        self.measure(|group| group.ssim, |one| one.ssim)
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
            self.means(),
            self.each()
        )
    }

    fn table(&self) -> Table {
        let columns: [Column<'_, Row<'_>>; 25] = [
            ("material", |row| row.result.material.as_str().into()),
            ("photographs", |row| row.photographs().into()),
            ("photograph", |row| row.one(|read, _| read.name.as_str()).into()),
            ("factor", |row| row.factor().into()),
            ("exposure_ev", |row| row.factor().map(f64::log2).into()),
            ("own_exposure_ev", |row| row.one(|_, one| one.own_exposure_ev).into()),
            ("log", |row| mean(row.log()).into()),
            ("log_interval95_low", |row| Cell::low(interval(row.log()))),
            ("log_interval95_high", |row| Cell::high(interval(row.log()))),
            ("rmse", |row| mean(row.rmse()).into()),
            ("rmse_interval95_low", |row| Cell::low(interval(row.rmse()))),
            ("rmse_interval95_high", |row| Cell::high(interval(row.rmse()))),
            ("ssim", |row| mean(row.ssim()).into()),
            ("ssim_interval95_low", |row| Cell::low(interval(row.ssim()))),
            ("ssim_interval95_high", |row| Cell::high(interval(row.ssim()))),
            ("texels", |row| row.one(|_, one| one.texels).into()),
            ("clipped", |row| row.one(|_, one| one.clipped).into()),
            ("outlier", |row| row.one(|_, one| one.outlier.is_any()).into()),
            ("transfer", |row| row.one(|read, _| read.transfer.name()).into()),
            ("exposure", |row| row.report.setting.exposure.name().into()),
            ("declared_ev", |row| row.report.setting.declared_ev(row.factor()).into()),
            ("falloff", |row| row.report.setting.capture.falloff.into()),
            ("capture", |row| row.report.setting.name.as_str().into()),
            ("convention", |row| row.report.setting.convention.name.into()),
            ("epsilon", |row| row.report.setting.convention.epsilon.into()),
        ];
        let rows = self.results.iter().flat_map(|result| {
            let each = self.photographs.iter().zip(&result.photographs);
            let each = each.map(|(read, one)| RowOf::One(read, one));
            let of = result.means.iter().map(RowOf::Group).chain(each);
            of.map(move |of| Row { report: self, result, of })
        });
        Table::of(&columns, rows)
    }
}
