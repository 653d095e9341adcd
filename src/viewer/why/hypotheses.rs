//! Lines of the hypotheses of a diagnosis: the marked ones, and the others behind one line.

use eframe::egui::{self, RichText, Sense, vec2};
use egui_material_icons::icons;

use svbrdf_evaluate::diagnose::{Change, Finding, Hypothesis};

use crate::model::Model;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::settings::WhySection;
use crate::widgets::numbers::digits;
use crate::widgets::theme;

/// Room before the name of a hypothesis, and height of a line, in points.
const NAME: f32 = 14.0;
const ROW: f32 = 17.0;

/// The lines of one prediction.
#[derive(Debug)]
pub struct HypothesisLines<'a> {
    pub ground_truth: &'a LoadedMaterial,
    pub prediction: &'a LoadedMaterial,
    /// What is found so far; the marked ones come first.
    pub found: &'a [Finding],
    /// The change after which the pane shows the prediction.
    pub corrected: Option<Change>,
    /// Whether the lines without a mark are unfolded.
    pub is_open: bool,
}

impl HypothesisLines<'_> {
    /// The marked lines, or the one that explains most, and the others behind one line. As many rows while it is diagnosed, where at
    /// most one has a mark.
    pub fn ui(&self, ui: &mut egui::Ui, next: &mut Model) {
        let finding = |one: &Hypothesis| self.found.iter().find(|finding| finding.hypothesis == *one);
        let all: Vec<Hypothesis> = Hypothesis::of(&self.prediction.read.storage).collect();
        let first: Vec<Hypothesis> = first(self.found).into_iter().map(|one| one.hypothesis).collect();
        let first = if first.is_empty() { &all[..1] } else { &first };
        first.iter().for_each(|one| self.line(ui, *one, finding(one), next));
        let others: Vec<&Hypothesis> = all.iter().filter(|one| !first.contains(one)).collect();
        let text = match others.iter().all(|one| finding(one).is_some()) {
            true => format!("{} other explanations: none marked", others.len()),
            false => "Other explanations".to_owned(),
        };
        self.header(ui, &text, next);
        others.iter().filter(|_| self.is_open).for_each(|one| self.line(ui, **one, finding(one), next));
    }

    /// The line that unfolds the others.
    fn header(&self, ui: &mut egui::Ui, text: &str, next: &mut Model) {
        let arrow = if self.is_open { icons::ICON_ARROW_DROP_DOWN } else { icons::ICON_ARROW_RIGHT };
        let left = RichText::new(format!("{} {text}", arrow.codepoint)).size(12.5);
        let hover = "The changes that do not lower the loss significantly and by at least 10%";
        let response = row(ui, 0.0, [left, RichText::default()], (text.to_owned(), false, true));
        if response.on_hover_text(hover).clicked() {
            next.settings.sections.toggle(WhySection::Hypotheses);
        }
    }

    /// The line of a hypothesis, whose finding may not be there yet.
    fn line(&self, ui: &mut egui::Ui, hypothesis: Hypothesis, finding: Option<&Finding>, next: &mut Model) {
        let Some(finding) = finding else {
            line(ui, hypothesis, None, false);
            return;
        };
        // What the pane of the prediction can show.
        let change = finding.change.filter(|change| change.fits(self.prediction.material().size()));
        let is_shown = change.is_some() && change == self.corrected;
        let names = [self.ground_truth, self.prediction].map(|one| one.material().name());
        let response = line(ui, hypothesis, Some(finding), is_shown);
        let response = response.on_hover_ui(|ui| {
            details(ui, finding, change, is_shown);
            if let Some(option) = finding.command_option(names) {
                ui.label(format!("Option of the command line: {option}"));
            }
        });
        if change.is_some() && response.clicked() {
            next.view.correct(change.filter(|_| !is_shown));
        }
    }
}

/// The marked findings, or else the one that explains most.
fn first(findings: &[Finding]) -> Vec<&Finding> {
    let marked: Vec<&Finding> = findings.iter().filter(|finding| finding.marked).collect();
    if !marked.is_empty() {
        return marked;
    }
    findings.iter().max_by(|a, b| a.share.total_cmp(&b.share)).into_iter().collect()
}

/// The line of a hypothesis: its name, the value and the share; dots where they are not there yet.
fn line(
    ui: &mut egui::Ui,
    hypothesis: Hypothesis,
    finding: Option<&Finding>,
    is_shown: bool,
) -> egui::Response {
    let name = label(hypothesis);
    let [value, share] = match finding {
        Some(finding) => [value(finding), share(finding)],
        None => ["...", ""].map(str::to_owned),
    };
    let is_marked = finding.is_some_and(|finding| finding.marked);
    let mark = if is_marked { ", marked" } else { "" };
    let is_button = finding.is_some_and(|finding| finding.change.is_some_and(has_maps));
    let ink = if is_marked || is_shown { ui.visuals().text_color() } else { ui.visuals().weak_text_color() };
    let numbers = RichText::new(format!("{value} {share:>7}")).monospace().size(11.5);
    let texts = [RichText::new(name).size(12.5), numbers].map(|text| text.color(ink));
    let name = format!("{name} {value}: {share} of the loss{mark}");
    let response = row(ui, NAME, texts, (name, is_shown, is_button));
    if is_marked {
        let dot = response.rect.left_center() + vec2(7.0, 0.0);
        ui.painter().circle_filled(dot, 3.5, theme::accent(ui.visuals()));
    }
    response
}

/// A line with a text at either end, called `name`.
fn row(
    ui: &mut egui::Ui,
    indent: f32,
    [left, right]: [RichText; 2],
    (name, is_selected, is_button): (String, bool, bool),
) -> egui::Response {
    let (sense, role) = match is_button {
        true => (Sense::click(), egui::Role::Button),
        false => (Sense::hover(), egui::Role::ListItem),
    };
    let row = ui.scope(|ui| {
        (ui.spacing_mut().button_padding, ui.spacing_mut().interact_size.y) = (vec2(indent, 0.0), ROW);
        let button = egui::Button::selectable(is_selected, left).right_text(right).truncate();
        let button = button.stroke(egui::Stroke::NONE).sense(sense);
        ui.add(button.min_size(vec2(ui.available_width(), ROW)))
    });
    row.inner.widget_info(|| egui::WidgetInfo::selected(role, true, is_selected, &name));
    row.inner
}

/// Whether the maps of the prediction change.
fn has_maps(change: Change) -> bool {
    !matches!(change, Change::Exposure(_) | Change::GroundTruth(_))
}

/// All numbers of a finding, and what a click does.
fn details(ui: &mut egui::Ui, finding: &Finding, change: Option<Change>, is_shown: bool) {
    let unit = finding.unit.map(|unit| format!(" {unit}")).unwrap_or_default();
    ui.strong(format!("{}: {}{unit}", label(finding.hypothesis), value_text(finding)));
    let range = |interval: Option<[f64; 2]>, text: &dyn Fn(f64) -> String| {
        interval.map(|[low, high]| format!(", 95% {} to {}", text(low), text(high))).unwrap_or_default()
    };
    ui.label(format!("Loss {}{}", digits(finding.loss), range(finding.interval95, &digits)));
    let interval = range(finding.share_interval95, &percent);
    ui.label(format!("{} of the loss disappears{interval}", share(finding)));
    ui.label(format!("p = {:.2e}, corrected for all hypotheses", finding.p));
    match (finding.change, change) {
        (_, Some(change)) if is_shown => {
            ui.label(format!("Click to show the prediction itself, not {change}"))
        }
        (_, Some(change)) => ui.label(format!("Click to show the prediction {change}")),
        (Some(Change::GroundTruth(_)), None) => ui.label("It changes the ground truth, not the prediction"),
        (Some(_), None) => ui.label("No map shows it: an exposure changes the radiance alone"),
        (None, None) => ui.label("The best value changes nothing"),
    };
}

fn value_text(finding: &Finding) -> String {
    finding.value.to_string().replace('-', "\u{2212}").replace('_', " ")
}

/// The value with its unit where there is room.
fn value(finding: &Finding) -> String {
    match (finding.hypothesis, finding.unit) {
        (Hypothesis::ExposureRgb | Hypothesis::Placement, _) | (_, None) => value_text(finding),
        (_, Some(unit)) => format!("{} {unit}", value_text(finding)),
    }
}

fn share(finding: &Finding) -> String {
    percent(finding.share)
}

fn percent(share: f64) -> String {
    let text = format!("{:.1}%", 100.0 * share);
    let text = if text == "-0.0%" { "0.0%".to_owned() } else { text };
    text.replace('-', "\u{2212}")
}

/// The name of a hypothesis in the window.
fn label(hypothesis: Hypothesis) -> &'static str {
    match hypothesis {
        Hypothesis::Exposure => "Exposure",
        Hypothesis::ExposureRgb => "Exposure, RGB",
        Hypothesis::Shift => "Shift",
        Hypothesis::Placement => "Placement",
        Hypothesis::Symmetry => "Symmetry",
        Hypothesis::DiffuseFactor => "Diffuse factor",
        Hypothesis::SpecularFactor => "Specular factor",
        Hypothesis::NormalY => "Normal Y",
        Hypothesis::NormalX => "Normal X",
        Hypothesis::AlbedoEncoding => "Colour encoding",
        Hypothesis::DiffuseEncoding => "Diffuse encoding",
        Hypothesis::SpecularEncoding => "Specular encoding",
        Hypothesis::Roughness => "Roughness",
        Hypothesis::Channels => "Red and blue",
        Hypothesis::Energy => "Diffuse scaling",
        Hypothesis::GroundTruth => "Ground truth",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_have_a_real_minus_sign_and_none_where_they_round_to_0() {
        assert_eq!([0.83, -0.133, -0.0001, 0.0].map(percent), ["83.0%", "\u{2212}13.3%", "0.0%", "0.0%"]);
    }
}
