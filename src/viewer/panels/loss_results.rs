//! The losses with their errors, and their differences.

use std::time::Duration;

use eframe::egui::{self, RichText, Sides};

use crate::loss::{Estimate, Loss};
use crate::model::sampler::Sampler;
use crate::viewer::command::{Command, DisplayCommand};
use crate::viewer::loss_run::Losses;
use crate::viewer::theme;

/// The losses, and their differences from that of the chosen prediction; a click chooses another one.
pub(super) fn ui(ui: &mut egui::Ui, latest: &Losses, chosen: usize) -> Vec<Command> {
    let mut commands = Vec::new();
    let losses = &latest.report.outcome.losses;
    for (index, loss) in losses.iter().enumerate() {
        if result(ui, index, loss, index == chosen).clicked() {
            commands.push(DisplayCommand::ChoosePrediction(index).into());
        }
    }
    if let (Some(other), Some(differences)) = (losses.get(chosen), latest.differences.get(chosen)) {
        let all = losses.iter().zip(differences).enumerate();
        for (index, (loss, estimate)) in all.filter(|(index, _)| *index != chosen) {
            let names =
                [(index, loss), (chosen, other)].map(|(i, loss)| format!("{} {}", i + 1, loss.prediction));
            difference(ui, index, &names, estimate);
        }
    }
    ui.label(RichText::new(summary(latest)).weak().small());
    commands
}

/// One prediction's loss.
fn result(ui: &mut egui::Ui, index: usize, loss: &Loss, chosen: bool) -> egui::Response {
    let name = format!("{}  {}", index + 1, loss.prediction);
    let left = |ui: &mut egui::Ui| {
        let hover = format!("{}\nClick to choose this prediction", loss.prediction);
        ui.selectable_label(chosen, name).on_hover_text(hover)
    };
    let right = |ui: &mut egui::Ui| {
        ui.label(RichText::new(accuracy(loss.estimate.relative_error95())).monospace())
            .on_hover_text("Half the width of the 95% interval, relative to the loss")
    };
    let (response, _) = Sides::new().shrink_left().truncate().show(ui, left, right);
    numbers(ui, ("loss result", index), "loss", &loss.estimate, "Mean over the scenes");
    response
}

/// The first loss minus the second, and whether that is significant.
fn difference(ui: &mut egui::Ui, index: usize, [first, second]: &[String; 2], estimate: &Estimate) {
    ui.separator();
    let name = format!("{first} - {second}");
    let verdict = Verdict::of(estimate);
    let colour = match verdict {
        Verdict::Better => theme::accent(ui.visuals()),
        Verdict::Worse => theme::problem(ui.visuals()),
        Verdict::NotSignificant => ui.visuals().weak_text_color(),
    };
    let left = |ui: &mut egui::Ui| ui.label(name);
    let right = |ui: &mut egui::Ui| {
        ui.label(RichText::new(verdict.text()).color(colour)).on_hover_text(verdict.meaning(first, second));
    };
    Sides::new().shrink_left().truncate().show(ui, left, right);
    let meaning = "Mean of the differences over the scenes, which both share";
    numbers(ui, ("loss difference", index), "mean", estimate, meaning);
}

/// A mean with its error, and its interval below.
fn numbers(ui: &mut egui::Ui, id: (&str, usize), label: &str, estimate: &Estimate, meaning: &str) {
    let [mean, error, interval] = estimate.texts();
    egui::Grid::new(id).num_columns(2).spacing([6.0, 5.0]).show(ui, |ui| {
        ui.label(format!("  {label}"));
        ui.label(RichText::new(format!("{mean} +- {error}")).monospace().strong())
            .on_hover_text(format!("{meaning} +- its standard error over the scenes"));
        ui.end_row();
        ui.label("  95%");
        ui.label(RichText::new(interval).monospace());
        ui.end_row();
    });
}

/// What a difference says of its first prediction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    Better,
    Worse,
    NotSignificant,
}

impl Verdict {
    /// By whether the 95% interval excludes 0, and on which side.
    fn of(difference: &Estimate) -> Self {
        match difference.interval95 {
            Some([_, high]) if high < 0.0 => Self::Better,
            Some([low, _]) if low > 0.0 => Self::Worse,
            _ => Self::NotSignificant,
        }
    }

    fn text(self) -> &'static str {
        match self {
            Self::Better => "better",
            Self::Worse => "worse",
            Self::NotSignificant => "no significant difference",
        }
    }

    fn meaning(self, first: &str, second: &str) -> String {
        match self {
            Self::Better => format!("{first} is closer to the ground truth than {second}"),
            Self::Worse => format!("{first} is farther from the ground truth than {second}"),
            Self::NotSignificant => "The 95% interval includes 0: use more scenes".to_owned(),
        }
    }
}

fn summary(latest: &Losses) -> String {
    let report = &latest.report;
    let sampler = match report.sampler() {
        Some(Sampler::Sobol) => "scrambled Sobol",
        _ => "random",
    };
    format!(
        "convention {}, epsilon {}, {sampler} scenes{}, {} on the {}",
        report.convention.name,
        report.convention.epsilon,
        report.seed().map_or(String::new(), |seed| format!(" of seed {seed}")),
        report.precision,
        report.backend,
    )
}

/// Half the width of an interval relative to its mean, in percent with about three digits.
pub(super) fn accuracy(share: f64) -> String {
    match 100.0 * share {
        percent if percent.is_infinite() => "error unknown".to_owned(),
        percent if percent >= 10.0 => format!("+-{percent:.1}%"),
        percent => format!("+-{percent:.2}%"),
    }
}

/// A time with about three digits.
pub(super) fn seconds(time: Duration) -> String {
    match time.as_secs_f64() {
        s if s < 0.01 => format!("{:.1} ms", s * 1e3),
        s if s < 1.0 => format!("{:.0} ms", s * 1e3),
        s => format!("{s:.1} s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_is_a_verdict_only_where_its_interval_excludes_0() {
        let of = |interval95| Verdict::of(&Estimate { mean: 0.0, standard_error: None, interval95 });
        assert_eq!(of(Some([-0.2, -0.1])), Verdict::Better);
        assert_eq!(of(Some([0.1, 0.2])), Verdict::Worse);
        assert_eq!(of(Some([-0.1, 0.2])), Verdict::NotSignificant);
        assert_eq!(of(Some([0.0, 0.0])), Verdict::NotSignificant);
        assert_eq!(of(None), Verdict::NotSignificant);
    }

    #[test]
    fn shares_and_times_keep_about_three_digits() {
        let all = [0.2061, 0.0231, 0.00054, f64::INFINITY].map(accuracy);
        assert_eq!(all, ["+-20.6%", "+-2.31%", "+-0.05%", "error unknown"]);
        let all = [0.00131, 0.0463, 0.9, 12.34].map(|s| seconds(Duration::from_secs_f64(s)));
        assert_eq!(all, ["1.3 ms", "46 ms", "900 ms", "12.3 s"]);
    }
}
