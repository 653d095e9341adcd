//! The statistics of the differences beside their histogram.

use eframe::egui::{self, RichText};

use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::{Histogram, Statistics};

use crate::model::material::loaded::LoadedMaterial;
use crate::pane::legend::{BAR, HISTOGRAM, LegendStrip, STATISTICS};
use crate::widgets::names::{FEWEST, Names, fitted};
use crate::widgets::numbers::{aligned, digits};
use crate::widgets::theme;

/// Width of a name, in points.
const NAME: f32 = 146.0;

impl LegendStrip<'_> {
    /// A row of numbers for each prediction.
    pub fn statistics(&self, ui: &mut egui::Ui) {
        let scenes = self.shown.error_map_scenes();
        let Some((distributions, is_current)) = self.distributions else {
            match (scenes, self.shown.error_map_progress()) {
                (Some(scenes), Some(fraction)) => {
                    let text = format!("{:.0}% of {scenes} scenes", 100.0 * fraction);
                    ui.add(egui::ProgressBar::new(fraction).text(text).desired_width(STATISTICS * 0.6));
                }
                _ => {
                    ui.weak("Computing statistics...");
                }
            }
            return;
        };
        if !is_current {
            ui.set_opacity(0.5);
        }
        let is_rendering = self.quantity == Quantity::Rendering;
        // The scenes that the numbers are of: the loss over all scenes is another one.
        let (of, mean) = match scenes {
            Some(scenes) => (
                format!("over {scenes} scenes"),
                "Mean over the texels: the loss over the scenes of this error map",
            ),
            None if self.shown.photograph().is_some() => {
                ("this scene".to_owned(), "Mean over the texels that are not clipped in the photograph")
            }
            None if is_rendering && self.kind == Difference::Log => {
                ("this scene".to_owned(), "Mean over the texels: the loss in this scene")
            }
            None if is_rendering => ("this scene".to_owned(), "Mean over the texels"),
            None if self.is_masked() => ("in the mask".to_owned(), "Mean over the texels of the mask"),
            None => ("all texels".to_owned(), "Mean over the texels"),
        };
        let heads =
            [("mean", mean), ("median", "50th percentile"), ("95%", "95th percentile"), ("max", "Maximum")];
        let names: Vec<&str> = self.materials.iter().map(LoadedMaterial::name).collect();
        let short = Names::new(&names);
        let height = if self.shown.is_picture { f32::INFINITY } else { HISTOGRAM + BAR + 14.0 };
        egui::ScrollArea::vertical().max_height(height).show(ui, |ui| {
            // Low rows: three of them are seen at once.
            let grid = egui::Grid::new("difference statistics").num_columns(5).min_row_height(0.0);
            grid.spacing([10.0, 2.0]).show(ui, |ui| {
                ui.label(RichText::new(of).small().weak());
                for (head, hover) in heads {
                    ui.label(RichText::new(head).small().weak()).on_hover_text(hover);
                }
                ui.end_row();
                let columns = columns(&distributions.statistics);
                for (index, statistics) in distributions.statistics.iter().enumerate() {
                    let numbers = columns.each_ref().map(|column| column[index].as_str());
                    self.row(
                        ui,
                        index,
                        &short,
                        (statistics.as_ref(), numbers),
                        distributions.histograms.get(index),
                    );
                    ui.end_row();
                }
            });
        });
    }

    /// The colour of the difference in place `index`: the colour of its prediction, or one of its own for the ground truth.
    pub fn series(&self, index: usize) -> usize {
        match self.materials.get(index).map_or(0, |one| one.slot) {
            0 => self.materials.iter().map(|one| one.slot + 1).max().unwrap_or(1),
            slot => slot,
        }
    }

    fn is_masked(&self) -> bool {
        self.materials.iter().any(|one| one.read.record.mask.is_some())
    }

    fn row(
        &self,
        ui: &mut egui::Ui,
        index: usize,
        names: &Names<'_>,
        (statistics, numbers): (Option<&Statistics>, [&str; 4]),
        histogram: Option<&Histogram>,
    ) {
        let colour = theme::series(self.series(index), ui.visuals().dark_mode);
        let Some(material) = self.materials.get(index) else { return };
        let (name, number) = (material.name(), material.number());
        let short = |most| format!("{number}  {}", names.shortened(index, most));
        let font = egui::TextStyle::Body.resolve(ui.style());
        let short = fitted(ui, &font, NAME, short).unwrap_or_else(|| short(FEWEST));
        let text = RichText::new(short).color(colour);
        let text = if self.is_chosen(index) { text.strong().underline() } else { text };
        let label = ui.scope(|ui| {
            ui.set_max_width(NAME);
            ui.add(egui::Label::new(text).truncate())
        });
        let Some(Statistics { minimum, not_finite, .. }) = statistics else {
            ui.label("not finite");
            return;
        };
        let beyond = histogram.map_or(0, |histogram| histogram.below + histogram.above);
        label.inner.on_hover_text(format!(
            "{name}\nminimum {}; {beyond} texels beyond the axis, {not_finite} not finite",
            digits(*minimum)
        ));
        for number in numbers {
            ui.label(RichText::new(number).monospace());
        }
    }
}

/// Mean, median, 95th percentile and maximum of every row, as texts of one width in each column.
fn columns(rows: &[Option<Statistics>]) -> [Vec<String>; 4] {
    let values: [fn(&Statistics) -> f64; 4] = [|s| s.mean, |s| s.median, |s| s.p95, |s| s.maximum];
    values.map(|value| {
        aligned(&rows.iter().map(|row| row.as_ref().map_or(f64::NAN, value)).collect::<Vec<f64>>())
    })
}
