//! Time against error of the settings of the loss; a click on a point uses its setting.

use eframe::egui::{self, Color32, Pos2, Rect, RichText, Sense, Vec2, vec2};
use egui_plot::{Corner, GridInput, GridMark, Legend, Line, MarkerShape, PlotPoint, PlotPoints, Points};

use svbrdf_core::loss::Sampling;
use svbrdf_core::text::{percent, time};
use svbrdf_evaluate::study::{Choice, Family, Point, Study};
use svbrdf_files::write::Depth;

use crate::jobs::displayed::Displayed;
use crate::jobs::loss::study::StudyJob;
use crate::model::command::{Command, LossCommand};
use crate::ui::widgets::plot::still_plot;

/// Radius of the clickable area of a point, in points of the screen.
const REACH: f32 = 8.0;

/// What the window shows.
#[derive(Debug)]
pub struct StudyWindow<'a> {
    pub job: &'a StudyJob,
    /// What has been measured, and whether it is of the current materials.
    pub measured: Option<(&'a Study, bool)>,
    /// `None` where an accuracy or a time is requested.
    pub current: Option<Sampling>,
}

impl<'a> StudyWindow<'a> {
    /// The window on the study of the chosen pair.
    pub fn new(displayed: Displayed<'a>) -> Self {
        let (model, job) = (displayed.model, &displayed.jobs.study);
        let measured =
            job.measured(&model.materials, model.view.display.prediction, &model.view.convention());
        Self { job, measured, current: model.settings.loss.sampling() }
    }

    pub fn ui(&self, ctx: &egui::Context) -> Vec<Command> {
        let mut commands = Vec::new();
        let mut open = true;
        egui::Window::new("Study")
            .open(&mut open)
            .collapsible(false)
            .default_size([620.0, 560.0])
            .min_size([380.0, 360.0])
            .default_pos(ctx.content_rect().left_top() + vec2(40.0, 60.0))
            .show(ctx, |ui| {
                self.controls(ui, &mut commands);
                match self.measured {
                    Some((study, _)) if !study.points.is_empty() => self.results(ui, study, &mut commands),
                    _ => {
                        ui.label(
                            "Computing the reference: the loss over many more scenes than any setting samples.",
                        );
                        if let Some(job) = self.job.job() {
                            let text = format!("{:.0}%, {:.0} s", 100.0 * job.fraction(), job.elapsed().as_secs_f32());
                            ui.add(egui::ProgressBar::new(job.fraction()).text(text));
                        }
                        ui.allocate_space(ui.available_size());
                    }
                }
            });
        if !open {
            commands.push(LossCommand::ShowStudy(false).into());
        }
        commands
    }

    fn controls(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        ui.horizontal_wrapped(|ui| {
            if let Some(task) = self.job.job() {
                if ui.button("Cancel study").clicked() {
                    commands.push(LossCommand::CancelStudy.into());
                }
                let text = format!("{:.0} s", task.elapsed().as_secs_f32());
                ui.add(egui::ProgressBar::new(task.fraction()).text(text).desired_width(110.0));
            } else if ui.button("Measure again").clicked() {
                commands.push(LossCommand::StartStudy.into());
            }
            match self.measured {
                Some((study, true)) => ui.label(about(study)),
                Some((study, false)) => ui.weak(format!("Stale: {}", about(study))),
                None => ui.label(""),
            };
        });
    }

    fn results(&self, ui: &mut egui::Ui, study: &Study, commands: &mut Vec<Command>) {
        ui.horizontal_wrapped(|ui| {
            ui.label("Fastest setting for an error of");
            for target in [0.1, 0.03, 0.01, 0.003] {
                self.cheapest(ui, study, target, commands);
            }
        });
        let below = [
            vec!["Click a point to use its scenes and texels. The ring is the current setting.".to_owned()],
            study.variants(),
        ];
        let below = below.concat().join("\n");
        let lines = 1 + below.lines().count();
        let height = ui.available_height() - lines as f32 * ui.text_style_height(&egui::TextStyle::Small);
        for (point, at) in self.plot(ui, study, height.max(200.0)) {
            if is_clicked(ui, point, at) {
                commands.push(LossCommand::UseSampling(point.choice.sampling(0)).into());
            }
        }
        ui.label(RichText::new(below).weak().small());
    }

    /// A button for the fastest setting with an error of at most `target`.
    fn cheapest(&self, ui: &mut egui::Ui, study: &Study, target: f64, commands: &mut Vec<Command>) {
        let Some(point) = study.cheapest(target) else {
            ui.add_enabled(false, egui::Button::new(format!("{}: -", percent(target))))
                .on_disabled_hover_text("No measured setting has so small an error");
            return;
        };
        let setting = point.choice.sampling(self.current.map_or(0, |current| current.seed));
        let text = format!("{}: {}", percent(target), time(point.seconds));
        let button = ui.add(egui::Button::new(text).selected(Some(setting) == self.current));
        if button.on_hover_text(description(point)).clicked() {
            commands.push(LossCommand::UseSampling(setting).into());
        }
    }

    /// Draws the plot; returns where on the screen each point is.
    fn plot<'s>(&self, ui: &mut egui::Ui, study: &'s Study, height: f32) -> Vec<(&'s Point, Pos2)> {
        let (ink, dark) = (ui.visuals().text_color(), ui.visuals().dark_mode);
        let response = still_plot(ui, "study", height)
            .legend(Legend::default().position(Corner::LeftBottom).follow_insertion_order(true))
            .x_grid_spacer(decades)
            .y_grid_spacer(decades)
            .x_axis_label("time of one loss")
            .y_axis_label("error (root mean square)")
            .x_axis_formatter(|mark, _| time(10f64.powf(mark.value)))
            .y_axis_formatter(|mark, _| percent(10f64.powf(mark.value)))
            .show(ui, |plot| {
                let front: Vec<_> = study.front().into_iter().map(place).collect();
                plot.line(
                    Line::new("best for its time", PlotPoints::from(front)).color(ink).allow_hover(false),
                );
                for family in Family::ALL {
                    let points = study.points.iter().filter(|p| p.choice.family() == family);
                    let places: Vec<_> = points.map(place).collect();
                    if !places.is_empty() {
                        plot.points(markers(family, places, dark));
                    }
                }
                if let Some(at) = self.current.and_then(|setting| place_of(study, setting)) {
                    let ring = Points::new("current setting", vec![at]).shape(MarkerShape::Circle);
                    plot.points(ring.radius(10.0).filled(false).color(ink).allow_hover(false));
                }
            });
        let on_screen = |p| response.transform.position_from_point(&PlotPoint::from(place(p)));
        let settings = study.points.iter().filter(|p| p.choice.maps == Depth::Float);
        settings.map(|p| (p, on_screen(p))).collect()
    }
}

/// The points of a family in its colour and shape. Quantized maps are rings around the points of float maps.
fn markers(family: Family, places: Vec<[f64; 2]>, dark: bool) -> Points<'static> {
    let [r, g, b] = family.colour();
    let colour = Color32::from_rgb(r, g, b).lerp_to_gamma(Color32::WHITE, if dark { 0.3 } else { 0.0 });
    let (shape, radius, filled) = match family {
        Family::Sobol => (MarkerShape::Circle, 4.5, true),
        Family::MoreTexels => (MarkerShape::Right, 5.5, true),
        Family::FewTexels => (MarkerShape::Diamond, 5.5, true),
        Family::Random => (MarkerShape::Up, 5.5, true),
        Family::F64 => (MarkerShape::Down, 5.5, true),
        Family::HalfMaps => (MarkerShape::Diamond, 7.0, false),
        Family::EightBitMaps => (MarkerShape::Square, 8.0, false),
    };
    let points = Points::new(family.name(), places).shape(shape).radius(radius).filled(filled);
    points.color(colour).allow_hover(false)
}

/// Whether the point drawn at `at` is clicked. Its accessible name are its options.
fn is_clicked(ui: &mut egui::Ui, point: &Point, at: Pos2) -> bool {
    let area = Rect::from_center_size(at, Vec2::splat(2.0 * REACH));
    let name = point.choice.options();
    let response = ui.interact(area, ui.scope_id().with(&name), Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
    response.on_hover_text(description(point)).clicked()
}

fn description(point: &Point) -> String {
    let Point { choice, seconds, error, seeds, .. } = point;
    let family = choice.family().name();
    let (near, distant) = (choice.near(), choice.distant());
    format!(
        "{} {family}: {near} near-field and {distant} distant\n{}, error {} over {seeds} seeds\n\
         svbrdf loss {}",
        choice.scenes,
        time(*seconds),
        percent(*error),
        choice.options()
    )
}

/// Where a point lies in the plot, whose axes are logarithms to the base 10.
fn place(point: &Point) -> [f64; 2] {
    [point.seconds.log10(), point.error.log10()]
}

/// Where a setting lies: on its point, or between the points of its sampler with fewer and with more scenes.
fn place_of(study: &Study, setting: Sampling) -> Option<[f64; 2]> {
    let Sampling { near, distant, sampler, texels, .. } = setting;
    let scenes = near + distant;
    let drawn = |scenes| Choice { scenes, sampler, texels, ..Choice::default() };
    let of_family = || study.points.iter().filter(|p| p.choice == drawn(p.choice.scenes));
    let below = of_family().rfind(|p| p.choice.scenes <= scenes)?;
    let above = of_family().find(|p| p.choice.scenes >= scenes)?;
    let [from, to, here] = [below.choice.scenes, above.choice.scenes, scenes].map(|n| (n as f64).ln());
    let share = if from == to { 0.0 } else { (here - from) / (to - from) };
    let (a, b) = (place(below), place(above));
    Some([0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis])))
}

/// Grid lines at 1 and 3 times each power of ten, on an axis of logarithms.
fn decades(input: GridInput) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let powers = low.floor() as i32..=high.ceil() as i32;
    let marks = powers.flat_map(|power| {
        let power = f64::from(power);
        [GridMark { value: power, step_size: 1.0 }, GridMark { value: power + 3f64.log10(), step_size: 0.5 }]
    });
    marks.filter(|mark| (low..=high).contains(&mark.value)).collect()
}

fn about(study: &Study) -> String {
    let [ground_truth, prediction] = &study.names;
    format!("{prediction} against {ground_truth}")
}
