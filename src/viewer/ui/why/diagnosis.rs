//! Whether an error of exposure, alignment or reading explains the loss of each prediction.

use eframe::egui::text::{LayoutJob, TextFormat};
use eframe::egui::{self, Align2, Color32, FontId, Rect, RichText, Sense, pos2, vec2};

use svbrdf_core::diagnose::{Change, Diagnosis, Finding, Hypothesis, sentence};
use svbrdf_core::loss::LossSettings;

use crate::viewer::jobs::why::{ComparedPair, Diagnosed, WhyJobs};
use crate::viewer::model::command::{Command, DisplayCommand};
use crate::viewer::model::material::loaded::LoadedMaterial;
use crate::viewer::model::view::state::ViewState;
use crate::viewer::ui::widgets::names::shortened;
use crate::viewer::ui::widgets::numbers::{digits, seconds};
use crate::viewer::ui::widgets::remedy::{is_offered, remedy_button};
use crate::viewer::ui::widgets::theme;

/// Height of a row, in points.
const ROW: f32 = 17.0;
/// Rows of the sentence.
const SENTENCE: usize = 3;
/// Where the value and the share of a line end, in points from the right.
const VALUE: f32 = 62.0;
const SHARE: f32 = 4.0;
/// Where the name of a hypothesis begins and ends, in points from the left.
const NAME: [f32; 2] = [14.0, 128.0];
/// Characters of the name of a prediction.
const CHARACTERS: usize = 20;

/// The section, with what it depends on.
#[derive(Debug)]
pub struct DiagnosisSection<'a> {
    pub state: &'a ViewState,
    pub jobs: &'a WhyJobs,
    pub settings: &'a LossSettings,
    /// The ground truth and each prediction, and the predictions.
    pub pairs: &'a [ComparedPair],
    pub predictions: &'a [LoadedMaterial],
}

impl DiagnosisSection<'_> {
    pub fn ui(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let chosen = self.state.display.prediction;
        let (Some(pair), Some(prediction)) = (self.pairs.get(chosen), self.predictions.get(chosen)) else {
            return;
        };
        let diagnosed = self.diagnosed(pair);
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            if self.pairs.len() > 1 {
                self.predictions(ui, commands);
            }
            ui.add_space(4.0);
            self.sentence(ui, pair, diagnosed);
            self.remedy(ui, prediction, diagnosed, commands);
            self.lines(ui, pair, diagnosed, commands);
        });
        self.state_line(ui, pair, diagnosed);
    }

    fn diagnosed(&self, pair: &ComparedPair) -> Option<&Diagnosed> {
        self.jobs.diagnosis.get(pair, self.settings.seed)
    }

    /// A row per prediction with its first mark.
    fn predictions(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let names: Vec<&str> = self.predictions.iter().map(LoadedMaterial::name).collect();
        for (index, (pair, name)) in self.pairs.iter().zip(shortened(&names, CHARACTERS)).enumerate() {
            let diagnosed = self.diagnosed(pair);
            let first = diagnosed.and_then(|diagnosed| diagnosed.diagnosis.marked().next());
            let text = match (diagnosed, first) {
                (None, _) => "...".to_owned(),
                (Some(_), None) => "no mark".to_owned(),
                (_, Some(finding)) => format!("{} {}", label(finding.hypothesis), share(finding)),
            };
            let change = first.and_then(|finding| self.shown_change(finding, pair));
            let is_chosen = index == self.state.display.prediction;
            let row = Row { label: format!("Diagnosis of {}: {text}", names[index]), selected: is_chosen };
            let (response, area) = row.ui(ui, true);
            let ink = ui.visuals().text_color();
            let (font, painter) = (FontId::proportional(12.5), ui.painter());
            let left = pos2(area.left() + 4.0, area.center().y);
            painter.text(left, Align2::LEFT_CENTER, format!("{}  {name}", index + 1), font.clone(), ink);
            let colour = match first {
                Some(_) if is_chosen => ink,
                Some(_) => theme::accent(ui.visuals()),
                None => weak(ui),
            };
            painter.text(area.right_center() - vec2(SHARE, 0.0), Align2::RIGHT_CENTER, text, font, colour);
            let response = response.on_hover_text(match (diagnosed, change) {
                (None, _) => "It is being diagnosed".to_owned(),
                (Some(diagnosed), None) => self.words(pair, &diagnosed.diagnosis),
                (Some(diagnosed), Some(_)) => {
                    format!("{}\nClick to show it corrected", self.words(pair, &diagnosed.diagnosis))
                }
            });
            if response.clicked() {
                commands.push(DisplayCommand::ChoosePrediction(index).into());
                let command = if is_chosen { self.toggle(change) } else { DisplayCommand::Correct(change) };
                commands.push(command.into());
            }
        }
    }

    fn words(&self, pair: &ComparedPair, diagnosis: &Diagnosis) -> String {
        sentence(diagnosis, self.jobs.diagnosis.floor(pair, self.settings.seed))
    }

    /// The finding in words, in rows of constant height.
    fn sentence(&self, ui: &mut egui::Ui, pair: &ComparedPair, diagnosed: Option<&Diagnosed>) {
        let text = diagnosed.map(|diagnosed| self.words(pair, &diagnosed.diagnosis)).unwrap_or_default();
        let font = FontId::proportional(13.0);
        let height = SENTENCE as f32 * ui.fonts_mut(|fonts| fonts.row_height(&font));
        let mut job =
            LayoutJob::single_section(text.clone(), TextFormat::simple(font, ui.visuals().text_color()));
        job.wrap.max_rows = SENTENCE;
        ui.allocate_ui(vec2(ui.available_width(), height), |ui| {
            ui.set_min_height(height);
            if !text.is_empty() {
                ui.label(job).on_hover_text(text);
            }
        });
    }

    /// The button that corrects the reading, in a row of constant height.
    fn remedy(
        &self,
        ui: &mut egui::Ui,
        prediction: &LoadedMaterial,
        diagnosed: Option<&Diagnosed>,
        commands: &mut Vec<Command>,
    ) {
        let height = ui.spacing().interact_size.y;
        ui.allocate_ui(vec2(ui.available_width(), height), |ui| {
            ui.set_min_height(height);
            let marked = diagnosed.into_iter().flat_map(|diagnosed| diagnosed.diagnosis.marked());
            let remedy = marked.filter_map(|finding| finding.remedy).find(|one| is_offered(prediction, *one));
            if let Some(remedy) = remedy {
                let index = self.state.display.prediction + 1;
                commands.extend(remedy_button(ui, index, prediction, remedy));
            }
        });
    }

    /// A line per hypothesis, the marked ones first.
    fn lines(
        &self,
        ui: &mut egui::Ui,
        pair: &ComparedPair,
        diagnosed: Option<&Diagnosed>,
        commands: &mut Vec<Command>,
    ) {
        let Some(Diagnosed { diagnosis, .. }) = diagnosed else {
            for hypothesis in Hypothesis::of(pair.prediction_storage()) {
                line(ui, hypothesis, None, false);
            }
            return;
        };
        let others = diagnosis.findings.iter().filter(|finding| !finding.marked);
        for finding in diagnosis.marked().chain(others) {
            let change = self.shown_change(finding, pair);
            let is_shown = change.is_some() && change == self.state.display.corrected;
            let response = line(ui, finding.hypothesis, Some(finding), is_shown);
            let response = response.on_hover_ui(|ui| details(ui, finding, change, is_shown));
            if change.is_some() && response.clicked() {
                commands.push(self.toggle(change).into());
            }
        }
    }

    /// The change that the pane of the prediction can show.
    fn shown_change(&self, finding: &Finding, pair: &ComparedPair) -> Option<Change> {
        finding.change.filter(|change| change.fits(pair.prediction().size()))
    }

    /// Shows the prediction after this change, or itself where it is shown so.
    fn toggle(&self, change: Option<Change>) -> DisplayCommand {
        DisplayCommand::Correct(change.filter(|change| self.state.display.corrected != Some(*change)))
    }

    /// One line of constant height: the progress, or the floor and what it took.
    fn state_line(&self, ui: &mut egui::Ui, pair: &ComparedPair, diagnosed: Option<&Diagnosed>) {
        let height = ui.spacing().interact_size.y;
        let Some(Diagnosed { elapsed, .. }) = diagnosed else {
            let (fraction, elapsed) = self.jobs.diagnosis.busy().unwrap_or_default();
            let text = format!("Trying changes, {} s", elapsed.as_secs());
            ui.add(egui::ProgressBar::new(fraction).text(text).desired_height(height).corner_radius(3.0));
            return;
        };
        let floor = self.jobs.diagnosis.floor(pair, self.settings.seed).map(|floor| digits(floor.mean));
        let floor = floor.map(|floor| format!("Floor {floor}, ")).unwrap_or_default();
        let text = format!("{floor}128 + 64 scenes, {}", seconds(*elapsed));
        ui.allocate_ui(vec2(ui.available_width(), height), |ui| {
            ui.set_min_height(height);
            ui.add(egui::Label::new(RichText::new(text).small().weak()).truncate()).on_hover_text(
                "The part of the loss that each change removes, in scenes other than those that its value was fitted in. A dot marks \
                 changes that lower the loss significantly and by at least 10%. The floor is the loss that the steps of the maps of \
                 the ground truth leave: smaller losses are not resolvable. Folding this section cancels the work.",
            );
        });
    }
}

/// A row that can be clicked.
struct Row {
    label: String,
    selected: bool,
}

impl Row {
    fn ui(self, ui: &mut egui::Ui, is_button: bool) -> (egui::Response, Rect) {
        let sense = if is_button { Sense::click() } else { Sense::hover() };
        let (area, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), sense);
        let role = if is_button { egui::Role::Button } else { egui::Role::Label };
        response.widget_info(|| egui::WidgetInfo::selected(role, true, self.selected, &self.label));
        let (visuals, painter) = (ui.visuals(), ui.painter());
        if self.selected {
            painter.rect_filled(area, 3.0, visuals.selection.bg_fill);
        } else if is_button && response.hovered() {
            painter.rect_filled(area, 3.0, visuals.widgets.hovered.weak_bg_fill);
        }
        if response.has_focus() {
            painter.rect_stroke(area, 3.0, visuals.selection.stroke, egui::StrokeKind::Inside);
        }
        (response, area)
    }
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
    let row = Row { label: format!("{name} {value}: {share} of the loss{mark}"), selected: is_shown };
    let is_button = finding.is_some_and(|finding| finding.change.is_some_and(|one| !is_exposure(one)));
    let (response, area) = row.ui(ui, is_button);
    let ink = if is_marked || is_shown { ui.visuals().text_color() } else { weak(ui) };
    let (middle, painter) = (area.center().y, ui.painter());
    if is_marked {
        painter.circle_filled(pos2(area.left() + 7.0, middle), 3.5, theme::accent(ui.visuals()));
    }
    let [left, end] = NAME.map(|x| area.left() + x);
    painter.text(pos2(left, middle), Align2::LEFT_CENTER, name, FontId::proportional(12.5), ink);
    let font = FontId::monospace(11.5);
    let at = pos2(area.right() - SHARE, middle);
    painter.text(at, Align2::RIGHT_CENTER, share, font.clone(), ink);
    let width = area.right() - VALUE - end;
    let galley = egui::WidgetText::from(RichText::new(value).font(font.clone()).color(ink)).into_galley(
        ui,
        Some(egui::TextWrapMode::Truncate),
        width,
        font,
    );
    let at = pos2(area.right() - VALUE - galley.size().x, middle - 0.5 * galley.size().y);
    ui.painter().galley(at, galley, ink);
    response
}

fn weak(ui: &egui::Ui) -> Color32 {
    ui.visuals().weak_text_color()
}

fn is_exposure(change: Change) -> bool {
    matches!(change, Change::Exposure(_))
}

/// All numbers of a finding, and what a click does.
fn details(ui: &mut egui::Ui, finding: &Finding, change: Option<Change>, is_shown: bool) {
    let unit = finding.unit.map(|unit| format!(" {unit}")).unwrap_or_default();
    ui.strong(format!("{}: {}{unit}", label(finding.hypothesis), value_text(finding)));
    if let Some(loss) = finding.loss {
        let range = |interval: Option<[f64; 2]>, text: &dyn Fn(f64) -> String| {
            interval.map(|[low, high]| format!(", 95% {} to {}", text(low), text(high))).unwrap_or_default()
        };
        ui.label(format!("Loss {}{}", digits(loss), range(finding.interval95, &digits)));
        let interval = range(finding.share_interval95, &percent);
        ui.label(format!("{} of the loss disappears{interval}", share(finding)));
    }
    match finding.p {
        Some(p) => ui.label(format!("p = {p:.2e}, corrected for all hypotheses")),
        None => ui.label("Reported, not tested"),
    };
    if let Some(remedy) = finding.remedy {
        ui.label(format!("Option of the command line: {remedy}"));
    }
    match (finding.change, change) {
        (_, Some(change)) if is_shown => {
            ui.label(format!("Click to show the prediction itself, not {change}"))
        }
        (_, Some(change)) => ui.label(format!("Click to show the prediction {change}")),
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
        (Hypothesis::ExposureRgb | Hypothesis::Subtexel, _) | (_, None) => value_text(finding),
        (_, Some(unit)) => format!("{} {unit}", value_text(finding)),
    }
}

fn share(finding: &Finding) -> String {
    finding.share.map_or_else(String::new, percent)
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
        Hypothesis::Subtexel => "Shift, fractions",
        Hypothesis::Symmetry => "Symmetry",
        Hypothesis::Resampling => "Resampling",
        Hypothesis::NormalY => "Normal Y",
        Hypothesis::NormalX => "Normal X",
        Hypothesis::AlbedoEncoding => "Colour encoding",
        Hypothesis::SpecularEncoding => "Specular encoding",
        Hypothesis::Roughness => "Roughness",
        Hypothesis::Channels => "Red and blue",
        Hypothesis::Energy => "Diffuse scaling",
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
