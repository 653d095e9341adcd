//! The steps of training runs: which one is shown, and the loss of each.

use eframe::egui::{self, RichText, Slider};
use egui_plot::{
    FilledArea, GridInput, GridMark, Line, MarkerShape, PlotPoint, PlotPoints, PlotResponse, Points, VLine,
};

use svbrdf_core::loss::Estimate;

use crate::jobs::training::RunView;
use crate::model::command::{Command, DisplayCommand, MaterialsCommand, TrainingCommand};
use crate::ui::widgets::numbers::significant;
use crate::ui::widgets::plot::still_plot;
use crate::ui::widgets::theme;

/// Height of the plot, in points.
const HEIGHT: f32 = 170.0;
/// Most steps that could not be read in the list below the plot.
const MOST_PROBLEMS: usize = 3;

/// What the section shows.
#[derive(Debug)]
pub struct TrainingPanel<'a> {
    pub runs: Vec<RunView<'a>>,
    /// The chosen prediction.
    pub chosen: usize,
    pub watch: bool,
    /// The share of the missing losses that is done, while they are computed.
    pub busy: Option<f32>,
}

impl TrainingPanel<'_> {
    /// The steps of the chosen prediction, and the losses of all runs; nothing without runs.
    pub fn ui(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        if self.runs.is_empty() {
            return commands;
        }
        ui.separator();
        ui.horizontal_wrapped(|ui| {
            ui.strong("Training")
                .on_hover_text("The loss of each step, over the scenes that the loss asks for");
            let mut watch = self.watch;
            ui.checkbox(&mut watch, "Watch").on_hover_text(
                "New steps appear by themselves, and the newest is shown unless you have gone back",
            );
            if watch != self.watch {
                commands.push(MaterialsCommand::SetWatch(watch).into());
            }
            if let Some(share) = self.busy {
                ui.add(egui::ProgressBar::new(share).text("losses of steps").desired_width(130.0));
            }
        });
        match self.chosen_run() {
            Some(run) => steps(ui, run, &mut commands),
            None => drop(ui.weak("The chosen prediction is not a training run.")),
        }
        let plot = self.plot(ui);
        if let Some((run, index)) = self.pointed(&plot) {
            let text = step_and_loss(run, index);
            if plot.response.clicked() {
                commands.push(DisplayCommand::ChoosePrediction(run.index - 1).into());
                let number = run.run.steps[index].number;
                commands.push(TrainingCommand::Show { index: run.index, number }.into());
            }
            plot.response.on_hover_text_at_pointer(text + "\nClick to show it");
        }
        self.problems(ui);
        commands
    }

    fn chosen_run(&self) -> Option<&RunView<'_>> {
        self.runs.iter().find(|run| run.index == self.chosen + 1)
    }

    /// The losses of all runs over their steps, with their intervals. A line marks the step of the chosen run that is shown.
    fn plot(&self, ui: &mut egui::Ui) -> PlotResponse<()> {
        let (ink, dark) = (ui.visuals().text_color(), ui.visuals().dark_mode);
        let counter = self.runs.first().map_or(String::new(), |run| run.run.id.counter.to_string());
        still_plot(ui, "training", HEIGHT)
            .include_y(0.0)
            .x_axis_label(counter)
            .x_grid_spacer(few_marks)
            .y_axis_label("loss")
            .show(ui, |plot| {
                if let Some(run) = self.chosen_run() {
                    plot.add(VLine::new("shown", run.number as f64).color(ink).width(1.0).allow_hover(false));
                }
                for run in &self.runs {
                    let colour = theme::series(run.index - 1, dark);
                    let known = known(run);
                    let x: Vec<f64> = known.iter().map(|(_, x, _)| *x).collect();
                    let end = |side: usize| -> Vec<f64> {
                        known
                            .iter()
                            .map(|(_, _, loss)| loss.interval95.map_or(loss.mean, |i| i[side]))
                            .collect()
                    };
                    let name = run.run.id.name.clone();
                    if x.len() > 1 {
                        let band = FilledArea::new(name.clone(), &x, &end(0), &end(1));
                        plot.add(band.fill_color(colour.gamma_multiply(0.3)).allow_hover(false));
                    }
                    let places: Vec<[f64; 2]> = known.iter().map(|(_, x, loss)| [*x, loss.mean]).collect();
                    let line = Line::new(name.clone(), PlotPoints::from(places.clone()));
                    plot.line(line.color(colour).width(1.5).allow_hover(false));
                    let points = Points::new(name, places).shape(MarkerShape::Circle).radius(2.5);
                    plot.points(points.color(colour).allow_hover(false));
                }
            })
    }

    /// The step with a loss that is nearest to the pointer in the plot: its run, and its index there.
    fn pointed(&self, plot: &PlotResponse<()>) -> Option<(&RunView<'_>, usize)> {
        let pointer = plot.response.hover_pos()?;
        let distance = |(_, x, loss): &(usize, f64, Estimate)| {
            let place = plot.transform.position_from_point(&PlotPoint::new(*x, loss.mean));
            (place - pointer).length()
        };
        let of = |run| known(run).into_iter().map(move |step| (run, step));
        let nearest = self.runs.iter().flat_map(of).min_by(|a, b| distance(&a.1).total_cmp(&distance(&b.1)));
        nearest.map(|(run, (index, ..))| (run, index))
    }

    /// The steps that have no loss, with the reason.
    fn problems(&self, ui: &mut egui::Ui) {
        let of = |run: &RunView<'_>| {
            let failed = run.losses.iter().zip(&run.run.steps).filter_map(|(loss, step)| match loss {
                Some(Err(problem)) => Some(format!("{}: {problem}", run.run.id.step_name(step.number))),
                _ => None,
            });
            failed.collect::<Vec<_>>()
        };
        let all: Vec<String> = self.runs.iter().flat_map(of).collect();
        for problem in all.iter().rev().take(MOST_PROBLEMS) {
            ui.label(RichText::new(problem).small().color(theme::problem(ui.visuals())));
        }
        if all.len() > MOST_PROBLEMS {
            ui.weak(format!("and {} more steps without a loss", all.len() - MOST_PROBLEMS));
        }
    }
}

/// Which step is shown, and controls to go to another one.
fn steps(ui: &mut egui::Ui, run: &RunView<'_>, commands: &mut Vec<Command>) {
    let (index, last) = (run.step_index(), run.run.steps.len() - 1);
    ui.horizontal_wrapped(|ui| {
        if arrow(ui, "<", "Previous step", index > 0).on_hover_text("Previous step (,)").clicked() {
            commands.push(TrainingCommand::Move(-1).into());
        }
        let mut to = index;
        ui.spacing_mut().slider_width = 120.0;
        let slider = ui.add_enabled(last > 0, Slider::new(&mut to, 0..=last.max(1)).show_value(false));
        slider.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Slider, true, "Step slider"));
        if to != index {
            let number = run.run.steps[to.min(last)].number;
            commands.push(TrainingCommand::Show { index: run.index, number }.into());
        }
        if arrow(ui, ">", "Next step", index < last).on_hover_text("Next step (.)").clicked() {
            commands.push(TrainingCommand::Move(1).into());
        }
        ui.label(format!("{} {}", run.run.id.counter, run.number));
    });
    ui.horizontal_wrapped(|ui| {
        let place = match last - index {
            0 => "newest".to_owned(),
            newer => format!("{newer} newer"),
        };
        let keep = ui.small_button("Keep");
        let hover = "Open this step as a prediction of its own, to compare others with it";
        if keep.on_hover_text(hover).clicked() {
            commands.push(TrainingCommand::Keep(run.index).into());
        }
        ui.weak(format!("{place}, of {}", last + 1));
        if run.is_reading {
            ui.weak("reading...");
        }
    });
}

fn arrow(ui: &mut egui::Ui, text: &str, name: &str, enabled: bool) -> egui::Response {
    let button = ui.add_enabled(enabled, egui::Button::new(text).small());
    button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, enabled, name));
    button
}

/// The steps with a loss: their indices, numbers and losses.
fn known(run: &RunView<'_>) -> Vec<(usize, f64, Estimate)> {
    let mut known = Vec::new();
    for (index, (loss, step)) in run.losses.iter().zip(&run.run.steps).enumerate() {
        if let Some(Ok(loss)) = loss {
            known.push((index, step.number as f64, *loss));
        }
    }
    known
}

/// Grid lines at multiples of 1, 2 or 5 times a power of ten, so few that their numbers fit.
fn few_marks(input: GridInput) -> Vec<GridMark> {
    /// Most lines.
    const MOST: f64 = 4.0;
    let (low, high) = input.bounds;
    let least = ((high - low) / MOST).max(1.0);
    let power = 10f64.powf(least.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|times| times * power).into_iter().find(|step| *step >= least);
    let step = step.unwrap_or(10.0 * power);
    let marks = (low / step).ceil() as i64..=(high / step).floor() as i64;
    marks.map(|mark| GridMark { value: mark as f64 * step, step_size: step }).collect()
}

/// A step and its loss, in words.
fn step_and_loss(run: &RunView<'_>, index: usize) -> String {
    let name = run.run.id.step_name(run.run.steps[index].number);
    let Some(Ok(loss)) = run.losses[index] else { return name };
    let [mean, interval] = significant(loss);
    format!("{name}: {mean} {interval}")
}
