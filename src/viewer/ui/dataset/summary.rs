//! Summary of a data set: what `svbrdf rank --dataset` prints, and the losses of all materials at a glance.

use std::ops::RangeInclusive;

use eframe::egui::{self, Color32, Rangef, RichText};
use egui_material_icons::icons;
use egui_plot::{AxisHints, GridMark, Line, PlotPoint, Points};

use svbrdf_evaluate::dataset::DatasetReport;
use svbrdf_evaluate::report::{Cell, Reader, Report as _, Table};

use super::rows::Rows;
use crate::jobs::displayed::Displayed;
use crate::model::command::{Command, DatasetCommand};
use crate::model::dataset::OpenDataset;
use crate::model::material::loaded::drawable;
use crate::ui::widgets::numbers::digits;
use crate::ui::widgets::order;
use crate::ui::widgets::plot::still_plot;
use crate::ui::widgets::theme;

/// Heights of the plots, in points.
const STRIP: f32 = 22.0;
const SCATTER: f32 = 250.0;
/// Distances of the numbers of an axis, in points: from none to all of its colour.
const SPACING: Rangef = Rangef { min: 24.0, max: 32.0 };
/// Distance in points within which a material is the one under the pointer.
const NEAR: f32 = 8.0;

/// What is chosen in the tab.
#[derive(Debug, Default)]
pub struct SummaryUi {
    /// The column that the table is sorted by, and whether the largest is first; `None` for the order of the ranking.
    sorted: Option<(usize, bool)>,
    /// The two methods of the scatter plot.
    pair: Option<[usize; 2]>,
}

/// A material in a plot: its place, and which it is.
type Placed = ([f64; 2], usize);

impl SummaryUi {
    pub fn ui(&mut self, ui: &mut egui::Ui, displayed: Displayed<'_>, rows: &Rows) -> Vec<Command> {
        let Some(open) = displayed.model.dataset.open.as_deref() else { return Vec::new() };
        let jobs = &displayed.jobs.dataset;
        let Some(report) = jobs.summary.get() else {
            ui.weak("No loss is known yet.");
            return Vec::new();
        };
        let (known, all) = (jobs.losses.count(), open.cases.len());
        if known < all {
            let bar = egui::ProgressBar::new(known as f32 / all as f32);
            ui.add(bar.text(format!("losses of {known} of {all} materials")));
        }
        self.table(ui, report);
        for condition in report.conditions() {
            ui.label(RichText::new(drawable(&condition)).small().weak());
        }
        let mut commands = Vec::new();
        if open.methods().len() > 1 {
            commands.extend(order::fold(ui, displayed.model.asks_order, &jobs.order));
        }
        ui.add_space(8.0);
        let mut clicked = strips(ui, displayed, open);
        if open.methods().len() > 1 {
            ui.add_space(8.0);
            clicked = clicked.or(self.scatter(ui, displayed, open));
        }
        let shown = clicked.map(|case| {
            let ahead =
                rows.row(case).and_then(|row| rows.at(row)).map(|(_, ahead)| ahead).unwrap_or_default();
            DatasetCommand::Show { case, ahead }.into()
        });
        commands.extend(shown);
        commands
    }

    /// The table of the ranking; a click on a title sorts by its column.
    fn table(&mut self, ui: &mut egui::Ui, report: &DatasetReport) {
        let table = report.table(Reader::Person);
        ui.horizontal(|ui| {
            if ui.small_button("Copy").on_hover_text("The table as text, with its settings").clicked() {
                ui.copy_text(report.text());
            }
            if ui.small_button("LaTeX").on_hover_text("Copies the table for a paper").clicked() {
                ui.copy_text(report.latex());
            }
        });
        egui::ScrollArea::horizontal().id_salt("ranking").show(ui, |ui| {
            egui::Grid::new("ranking").striped(true).spacing([8.0, 2.0]).min_row_height(0.0).show(ui, |ui| {
                for (column, title) in table.columns.iter().enumerate() {
                    let arrow = match self.sorted {
                        Some((of, true)) if of == column => icons::ICON_ARROW_DOWNWARD.codepoint,
                        Some((of, false)) if of == column => icons::ICON_ARROW_UPWARD.codepoint,
                        _ => "",
                    };
                    let title = egui::Button::new(RichText::new(format!("{title} {arrow}")).small().strong())
                        .frame(false);
                    if ui.add(title).on_hover_text("Sort by this column").clicked() {
                        self.sorted = match self.sorted {
                            Some((of, true)) if of == column => Some((column, false)),
                            Some((of, false)) if of == column => None,
                            _ => Some((column, true)),
                        };
                    }
                }
                ui.end_row();
                for row in sorted(&table, self.sorted) {
                    for cell in row {
                        let text = RichText::new(drawable(&cell.text())).small();
                        match cell {
                            Cell::Text(_) => ui.label(text),
                            _ => ui.label(text.monospace()),
                        };
                    }
                    ui.end_row();
                }
            });
        });
    }

    /// The losses of two methods against each other: below the diagonal the second one is better.
    fn scatter(&mut self, ui: &mut egui::Ui, displayed: Displayed<'_>, open: &OpenDataset) -> Option<usize> {
        let count = open.methods().len();
        let [mut a, mut b] = self.pair.unwrap_or([0, 1]).map(|method| method.min(count - 1));
        ui.horizontal(|ui| {
            for (name, method) in [("of the axis to the right", &mut a), ("of the axis upwards", &mut b)] {
                let combo = egui::ComboBox::from_id_salt(name)
                    .width(120.0)
                    .selected_text(drawable(&open.methods()[*method]));
                let combo = combo.show_ui(ui, |ui| {
                    for (index, method_name) in open.methods().iter().enumerate() {
                        ui.selectable_value(method, index, drawable(method_name));
                    }
                });
                let label = format!("Method {name}");
                combo.response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, &label));
            }
        });
        self.pair = Some([a, b]);
        let losses = &displayed.jobs.dataset.losses;
        let of = |case: usize| {
            let row = losses.row(case)?;
            let loss = |method: usize| row.by_method.get(method).copied().flatten().map(|known| known.loss);
            Some(([loss(a)?, loss(b)?], case))
        };
        let points: Vec<Placed> = (0..open.cases.len()).filter_map(of).collect();
        let wins = points.iter().filter(|([a, b], _)| b < a).count();
        ui.label(
            RichText::new(format!(
                "{} is better on {wins} of {} materials",
                drawable(&open.methods()[b]),
                points.len()
            ))
            .small(),
        );
        let largest = losses.largest.max(f64::MIN_POSITIVE);
        let axis = |hints: AxisHints<'static>, method: usize| {
            hints.label(drawable(&open.methods()[method])).label_spacing(SPACING)
        };
        let plot = still_plot(ui, "scatter", SCATTER)
            .data_aspect(1.0)
            .custom_x_axes(vec![axis(AxisHints::new_x(), a)])
            .custom_y_axes(vec![axis(AxisHints::new_y(), b)])
            .include_x(0.0)
            .include_y(0.0)
            .include_x(largest)
            .include_y(largest);
        let (weak, accent) = (ui.visuals().weak_text_color(), theme::accent(ui.visuals()));
        let shown = displayed.model.dataset.wanted;
        let response = plot.show(ui, |plot| {
            plot.line(
                Line::new("equal", vec![[0.0, 0.0], [largest, largest]]).color(weak).allow_hover(false),
            );
            draw(plot, &points, shown, (plot_colour(weak), accent));
            nearest(plot, &points)
        });
        named(response.response, response.inner, &points, open, |[x, y]| {
            format!("{} | {}", digits(x), digits(y))
        })
    }
}

/// A strip a method: a point a material, its loss to the right.
fn strips(ui: &mut egui::Ui, displayed: Displayed<'_>, open: &OpenDataset) -> Option<usize> {
    let losses = &displayed.jobs.dataset.losses;
    let largest = losses.largest.max(f64::MIN_POSITIVE);
    let count = open.methods().len();
    let of = |method: usize, case: usize| {
        let known = losses.row(case)?.by_method.get(method).copied().flatten()?;
        // Points of one loss do not hide each other: a place of its own within the strip, the same in each.
        let shift = (case as f64 * 0.618_034).fract() * 0.6 - 0.3;
        Some(([known.loss, -(method as f64) + shift], case))
    };
    let points: Vec<Placed> = (0..count)
        .flat_map(|method| (0..open.cases.len()).filter_map(move |case| of(method, case)))
        .collect();
    let names: Vec<String> = open.methods().iter().map(|method| drawable(method)).collect();
    ui.label(RichText::new("Losses of all materials by method").small());
    let name_of = move |mark: GridMark, _: &RangeInclusive<f64>| {
        let method = -mark.value.round();
        let is_whole = (mark.value - mark.value.round()).abs() < 1e-6 && method >= 0.0;
        is_whole.then(|| names.get(method as usize).cloned()).flatten().unwrap_or_default()
    };
    let upwards = AxisHints::new_y().formatter(name_of).label_spacing(Rangef::new(2.0, 4.0));
    let plot = still_plot(ui, "strips", STRIP * count as f32 + 34.0)
        .custom_x_axes(vec![AxisHints::new_x().label("loss").label_spacing(SPACING)])
        .custom_y_axes(vec![upwards])
        .include_x(0.0)
        .include_x(largest)
        .include_y(0.5)
        .include_y(0.5 - count as f64)
        .y_grid_spacer(egui_plot::uniform_grid_spacer(|_| [1.0, 1.0, 1.0]));
    let (weak, accent) = (ui.visuals().weak_text_color(), theme::accent(ui.visuals()));
    let shown = displayed.model.dataset.wanted;
    let response = plot.show(ui, |plot| {
        draw(plot, &points, shown, (plot_colour(weak), accent));
        nearest(plot, &points)
    });
    named(response.response, response.inner, &points, open, |[loss, _]| digits(loss))
}

fn plot_colour(weak: Color32) -> Color32 {
    weak.gamma_multiply(0.8)
}

/// All points, that of the material in the window in the accent.
fn draw(
    plot: &mut egui_plot::PlotUi<'_>,
    points: &[Placed],
    shown: usize,
    (weak, accent): (Color32, Color32),
) {
    let of = |is_shown: bool| -> Vec<[f64; 2]> {
        points.iter().filter(|(_, case)| (*case == shown) == is_shown).map(|(at, _)| *at).collect()
    };
    plot.points(Points::new("materials", of(false)).radius(2.0).color(weak).allow_hover(false));
    plot.points(Points::new("shown", of(true)).radius(4.0).color(accent).allow_hover(false));
}

/// The place in `points` of the one under the pointer.
fn nearest(plot: &egui_plot::PlotUi<'_>, points: &[Placed]) -> Option<usize> {
    let pointer = plot.pointer_coordinate()?;
    let pointer = plot.screen_from_plot(pointer);
    let distance = |[x, y]: [f64; 2]| plot.screen_from_plot(PlotPoint::new(x, y)).distance(pointer);
    let distances = points.iter().enumerate().map(|(index, (at, _))| (index, distance(*at)));
    let near = distances.filter(|(_, distance)| *distance < NEAR);
    near.min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(index, _)| index)
}

/// Names the material under the pointer; which it is, where it is clicked.
fn named(
    response: egui::Response,
    index: Option<usize>,
    points: &[Placed],
    open: &OpenDataset,
    text: impl Fn([f64; 2]) -> String,
) -> Option<usize> {
    let (at, case) = *points.get(index?)?;
    let clicked = response.clicked();
    response.on_hover_text_at_pointer(format!("{}\n{}", drawable(open.name(case)), text(at)));
    clicked.then_some(case)
}

/// The rows of the table by a column, numbers by their values; those without one last.
fn sorted(table: &Table, by: Option<(usize, bool)>) -> Vec<&Vec<Cell>> {
    let mut rows: Vec<&Vec<Cell>> = table.rows.iter().collect();
    let Some((column, descends)) = by else { return rows };
    let number = |row: &Vec<Cell>| row.get(column).and_then(|cell| cell.text().parse::<f64>().ok());
    let text = |row: &Vec<Cell>| row.get(column).map(Cell::text).unwrap_or_default();
    rows.sort_by(|a, b| match (number(a), number(b)) {
        (Some(a), Some(b)) => {
            if descends {
                b.total_cmp(&a)
            } else {
                a.total_cmp(&b)
            }
        }
        (a, b) if a.is_some() != b.is_some() => b.is_some().cmp(&a.is_some()),
        _ if descends => text(b).cmp(&text(a)),
        _ => text(a).cmp(&text(b)),
    });
    rows
}
