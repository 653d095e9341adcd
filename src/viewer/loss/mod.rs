//! Sampled rendering loss: its settings, its progress, its result.

pub mod losses;
pub mod results;

use std::path::PathBuf;
use std::time::Duration;

use eframe::egui::{self, RichText};

use svbrdf_core::loss::{Ask, FileScenes, LossSettings, Request, Texels};
use svbrdf_core::model::named_scenes::NamedScenes;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_evaluate::analyses::SampledScenes;
use svbrdf_evaluate::report::Report as _;

use crate::jobs::Shown;
use crate::loss::losses::{ComputeLosses, ComputedLosses, DrawnLosses};
use crate::loss::results::Results;
use crate::model::Model;
use crate::model::dialogs::OpenDialog;
use crate::widgets::numbers::{self, seconds};
use crate::widgets::{copy, number, progress, theme};

/// Most scenes of one kind.
const MOST: usize = 100_000;
/// Range of the accuracy, in percent of the loss.
const PERCENT: std::ops::RangeInclusive<f64> = 0.1..=20.0;
/// Range of the time, in milliseconds.
const MILLISECONDS: std::ops::RangeInclusive<u64> = 16..=10_000;

/// Draws the section.
pub fn ui(ui: &mut egui::Ui, shown: Shown<'_>, next: &mut Model) {
    let (materials, job) = (&shown.model.materials, DrawnLosses::ask(shown));
    request(ui, &mut next.settings.loss, &mut next.dialogs.open);
    controls(ui, shown, &job, next);
    if materials.predictions().is_empty() {
        let missing = match materials.ground_truth() {
            Some(_) => "Open a prediction to compare with the ground truth.",
            None => "Open a ground truth and predictions of it.",
        };
        ui.label(missing);
        return;
    }
    // Of other materials or settings, or of other files than there are now.
    let is_stale = !job.is_current || materials.is_stale();
    state(ui, &job, is_stale);
    if let Some((latest, _)) = job.losses() {
        ui.scope(|ui| {
            if is_stale {
                ui.set_opacity(0.5);
            }
            let chosen = shown.model.view.display.prediction;
            let slots = materials.predictions().iter().map(|one| one.slot).collect();
            let results = Results { latest, chosen, slots, stale: materials.stale_predictions() };
            results.ui(ui, next);
            if let Some(note) = &latest.report.note {
                ui.label(RichText::new(format!("Note: {note}.")).small().weak());
            }
        });
    }
}

fn controls(ui: &mut egui::Ui, shown: Shown<'_>, job: &DrawnLosses, next: &mut Model) {
    let answers = &shown.jobs.answers;
    ui.horizontal_wrapped(|ui| {
        let (text, hover) = match job.is_cancelled {
            true => ("Compute loss", "Begin again"),
            false => ("Cancel loss", "Stop, and keep the result so far (Esc)"),
        };
        let button = ui.add_enabled(job.is_cancelled || job.busy().is_some(), button(text));
        match button.on_hover_text(hover).clicked() {
            true if job.is_cancelled => answers.resume::<ComputeLosses>(),
            true => answers.stop::<ComputeLosses>(),
            false => {}
        }
        let losses = job.losses();
        let button = ui.add_enabled(losses.is_some(), egui::Button::new("Copy losses"));
        if button.on_hover_text("As text, as `svbrdf loss` prints it").clicked()
            && let Some((losses, _)) = losses
        {
            copy(ui.ctx(), next, losses.report.text(), "the losses as text");
        }
    });
}

/// One line of constant height, so that the results below stay in place: the progress, or what the loss took.
fn state(ui: &mut egui::Ui, job: &DrawnLosses, is_stale: bool) {
    if let Some((fraction, elapsed, reached)) = job.busy() {
        let doing = if reached { "refining" } else { "first scenes" };
        let text = format!("{doing}, {} s", elapsed.as_secs());
        progress(ui, fraction, text);
        return;
    }
    if let Some(problem) = &job.problem {
        ui.label(RichText::new(&**problem).small().color(theme::problem(ui.visuals())));
        return;
    }
    let text = match job.losses() {
        None => RichText::new("Not computed yet."),
        Some(_) if is_stale && !job.is_starting() => {
            RichText::new("Stale: materials or settings have changed.")
        }
        Some((losses, elapsed)) => outcome(job, losses, elapsed, ui.visuals()),
    };
    ui.horizontal_wrapped(|ui| ui.label(text.small()));
}

/// The accuracy reached, what it took, and whether that meets the request.
fn outcome(
    job: &DrawnLosses,
    losses: &ComputedLosses,
    elapsed: Duration,
    visuals: &egui::Visuals,
) -> RichText {
    let SampledScenes { near, distant, .. } = losses.report.sampled;
    let error = losses.report.outcome.relative_error95();
    let took = format!("{} from {near} + {distant} scenes in {}", numbers::accuracy(error), seconds(elapsed));
    match missed(&losses.request, error, elapsed) {
        _ if job.is_cancelled => RichText::new(format!("Cancelled: {took}")).color(visuals.warn_fg_color),
        Some(missed) if job.is_complete() => {
            RichText::new(format!("{missed}: {took}")).color(theme::problem(visuals))
        }
        _ => RichText::new(took),
    }
}

/// The requested accuracy or time, where it was missed.
fn missed(request: &Request, relative_error: f64, elapsed: Duration) -> Option<String> {
    match *request {
        Request::Accuracy { target, .. } if relative_error > target => {
            Some(format!("Not within {}", numbers::accuracy(target)))
        }
        Request::Time { budget, .. } if elapsed > budget => Some(format!("Not within {}", seconds(budget))),
        _ => None,
    }
}

/// A button of the width of the one that replaces it.
fn button(text: &str) -> egui::Button<'_> {
    egui::Button::new(text).min_size(egui::vec2(96.0, 0.0))
}

/// The settings of the loss: first what decides the number of scenes, then the fields of that choice.
fn request(ui: &mut egui::Ui, settings: &mut LossSettings, dialog: &mut Option<OpenDialog>) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        for (ask, name, meaning) in [
            (Ask::Scenes, "Scenes", "A fixed number of scenes, such as the 6 + 3 of the papers"),
            (Ask::Accuracy, "Accuracy", "As many scenes as this accuracy of every loss takes"),
            (Ask::Time, "Time", "As many scenes as fit into this time"),
        ] {
            ui.selectable_value(&mut settings.ask, ask, name).on_hover_text(meaning);
        }
        if let Some(file) = &settings.file {
            let meaning = format!("The {} scenes of {}, on all texels", file.scenes.len(), file.name);
            let label = if NamedScenes::of(&file.scenes).is_some() { "Named" } else { "File" };
            ui.selectable_value(&mut settings.ask, Ask::File, label).on_hover_text(meaning);
        }
    });
    match settings.ask {
        Ask::Scenes => scenes(ui, settings),
        Ask::Accuracy => accuracy(ui, &mut settings.target_percent),
        Ask::Time => time(ui, &mut settings.time_ms),
        Ask::File => file(ui, settings),
    }
    if settings.ask == Ask::File {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        ui.label("Seed");
        number(ui, "Seed", &mut settings.seed, 0, |d| d.speed(0.2))
            .on_hover_text("The same seed gives the same scenes");
        if settings.ask == Ask::Scenes {
            ui.selectable_value(&mut settings.sampler, Sampler::Random, "random")
                .on_hover_text("Independent random scenes, as in the papers");
            ui.selectable_value(&mut settings.sampler, Sampler::Sobol, "Sobol")
                .on_hover_text("Scrambled Sobol sequences: a smaller error for the same number of scenes");
        }
        if settings.ask == Ask::Scenes {
            let open = ui.small_button("Scene file...");
            let hover =
                "Compute the loss over the scenes of a file (JSON, or render.json of a MaterialGAN capture)";
            if open.on_hover_text(hover).clicked() {
                *dialog = Some(OpenDialog::default());
            }
            named_scenes(ui, settings);
        }
    });
}

/// The menu of the scenes of publications.
fn named_scenes(ui: &mut egui::Ui, settings: &mut LossSettings) {
    let menu = ui.menu_button(RichText::new("Named...").small(), |ui| {
        for named in NamedScenes::ALL {
            let Ok(scenes) = named.scenes() else { continue };
            if ui.button(named.name()).on_hover_text(named.description()).clicked() {
                let name = named.name().to_owned();
                *settings = settings.with_file(Some(FileScenes { name, path: PathBuf::new(), scenes }));
                ui.close();
            }
        }
    });
    menu.response.on_hover_text("Compute the loss over the fixed scenes of a publication");
}

/// Which file the scenes are of, and the button that removes them.
fn file(ui: &mut egui::Ui, settings: &mut LossSettings) {
    let Some(file) = &settings.file else { return };
    let scenes = if file.scenes.len() == 1 { "scene" } else { "scenes" };
    let text = format!("{} {scenes} of {}", file.scenes.len(), file.name);
    ui.horizontal_wrapped(|ui| {
        ui.label(text);
        let remove = ui.small_button("Remove scenes").on_hover_text("Sample the scenes of the loss again");
        if remove.clicked() {
            *settings = settings.with_file(None);
        }
    });
}

fn scenes(ui: &mut egui::Ui, settings: &mut LossSettings) {
    let default = LossSettings::default();
    ui.horizontal_wrapped(|ui| {
        ui.label("Near");
        number(ui, "Near-field scenes", &mut settings.near, default.near, |d| d.speed(0.2).range(0..=MOST))
            .on_hover_text("Number of near-field scenes");
        ui.label("Distant");
        number(ui, "Distant scenes", &mut settings.distant, default.distant, |d| {
            d.speed(0.2).range(0..=MOST)
        })
        .on_hover_text("Number of distant scenes");
        texels(ui, &mut settings.texels);
    });
}

/// How many texels of each scene are compared; 0 stands for all.
fn texels(ui: &mut egui::Ui, texels: &mut Texels) {
    let mut count = match *texels {
        Texels::All => 0,
        Texels::Sampled(count) => count,
    };
    let text = |count: f64, _| if count < 1.0 { "all".to_owned() } else { format!("{count:.0}") };
    let parsed = |text: &str| if text.trim() == "all" { Some(0.0) } else { text.trim().parse().ok() };
    ui.label("Texels");
    number(ui, "Texels of each scene", &mut count, 0, |d| {
        d.speed(1.0).range(0..=MOST).custom_formatter(text).custom_parser(parsed)
    })
    .on_hover_text("An independent random subset of texels per scene; 0 or all: every texel");
    *texels = if count == 0 { Texels::All } else { Texels::Sampled(count) };
}

fn accuracy(ui: &mut egui::Ui, target: &mut f64) {
    let default = LossSettings::default().target_percent;
    ui.horizontal_wrapped(|ui| {
        let hover = "Half the width of the 95% interval of every loss, relative to the loss";
        number(ui, "Accuracy", target, default, |d| {
            d.speed(0.01).range(PERCENT).max_decimals(2).prefix("±").suffix("%")
        })
        .on_hover_text(hover);
        ui.label("at 95%").on_hover_text(hover);
    });
}

fn time(ui: &mut egui::Ui, milliseconds: &mut u64) {
    let default = LossSettings::default().time_ms;
    ui.horizontal_wrapped(|ui| {
        number(ui, "Time", milliseconds, default, |d| d.range(MILLISECONDS).suffix(" ms"))
            .on_hover_text("The loss takes as many scenes as fit into this time");
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missed_accuracy_or_time_is_reported() {
        let of = |request| missed(&request, 0.02, Duration::from_millis(50));
        let accuracy = |target| Request::Accuracy { target, seed: 0 };
        let time = |ms| Request::Time { budget: Duration::from_millis(ms), seed: 0 };
        assert_eq!(of(accuracy(0.01)), Some("Not within ±1.00%".to_owned()));
        assert_eq!(of(time(16)), Some("Not within 16 ms".to_owned()));
        assert_eq!(of(accuracy(0.03)), None);
        assert_eq!(of(time(60)), None);
        assert_eq!(of(Request::default()), None);
    }
}
