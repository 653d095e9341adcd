//! The scenes of the loss of the chosen prediction, worst first, and the search for the worst of all.

use eframe::egui::{self, Align2, Color32, FontId, Rect, RichText, Sense, Stroke, pos2, vec2};

use svbrdf_core::loss::Request;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_evaluate::report::comparing;
use svbrdf_evaluate::why::{RankedScene, TAIL, Worst, worst, worst_first};

use crate::error::Error;
use crate::jobs::Shown;
use crate::jobs::answers::content::{ComparedPair, mask_of, refuse_mask};
use crate::jobs::answers::{Question, Work};
use crate::model::dialogs::{SaveDialog, SaveKind};
use crate::model::material::loaded::LoadedMaterial;
use crate::model::{Model, display};
use crate::why::thumbnails::{self, Thumbnails};
use crate::widgets::numbers::digits;
use crate::widgets::paint::PanelTextures;
use crate::widgets::{progress, theme};

/// Side of a thumbnail and height of the number below it, in points.
const SIDE: f32 = 52.0;
const NUMBER: f32 = 15.0;
/// Scenes in the list until more are asked for, and those that one click adds.
const FEW: usize = 10;
const MORE: usize = 20;

/// The section, as high while it is computed as afterwards: what is below does not move by itself.
pub fn ui(
    ui: &mut egui::Ui,
    shown: Shown<'_>,
    pair: &ComparedPair,
    textures: &mut PanelTextures,
    next: &mut Model,
) {
    let scenes = shown.model.settings.loss.listed_scenes();
    let (answers, count) = (&shown.jobs.answers, scenes.count().unwrap_or(0));
    let listed = answers.get(&RankScenes { pair: pair.clone(), scenes });
    let busy = listed.busy();
    let list = listed.ready();
    let pictures = list.as_ref().and_then(|list| {
        let scenes = list.iter().take(thumbnails::MOST).map(|ranked| ranked.scene).collect();
        answers.get(&DrawScenes { pair: pair.clone(), scenes }).ready()
    });
    let pictures = pictures.as_deref().map(|pictures| &pictures.answer);
    let texture =
        pictures.map(|pictures| textures.id(ui.ctx(), &pictures.atlas.picture, egui::TextureOptions::LINEAR));
    let list = list.as_deref().map(|list| list.answer.as_slice());
    listed_scenes(ui, shown, list, count, pictures.zip(texture), next);
    let text = match (pictures, busy) {
        (Some(pictures), _) => format!("log difference, 0 to {}", digits(pictures.range)),
        (None, Some((fraction, _))) => format!("{:.0}% of {count} scenes", 100.0 * fraction),
        (None, None) => "...".to_owned(),
    };
    ui.label(RichText::new(text).small().weak())
        .on_hover_text("From black to light yellow, the same in all thumbnails");
    search(ui, shown, pair, next);
}

fn listed_scenes(
    ui: &mut egui::Ui,
    shown: Shown<'_>,
    list: Option<&[RankedScene]>,
    count: usize,
    thumbnails: Option<(&Thumbnails, egui::TextureId)>,
    next: &mut Model,
) {
    let listed = (FEW + shown.model.more_scenes).min(count);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(5.0, 5.0);
        for rank in 0..listed {
            let Some(ranked) = list.and_then(|list| list.get(rank)) else {
                let (area, _) = ui.allocate_exact_size(vec2(SIDE, SIDE + NUMBER), Sense::hover());
                let fill = ui.visuals().widgets.inactive.weak_bg_fill;
                ui.painter().rect_filled(area.with_max_y(area.top() + SIDE), 0.0, fill);
                continue;
            };
            let part = thumbnails.and_then(|(thumbnails, texture)| {
                let ([least, greatest], _) = thumbnails.atlas.part(rank)?;
                Some((texture, Rect::from_min_max(least.into(), greatest.into())))
            });
            if thumbnail(ui, ranked, rank, part, ranked.scene == shown.model.view.scene).clicked() {
                display::choose_scene(next, ranked.scene);
            }
        }
    });
    ui.horizontal_wrapped(|ui| {
        let most = count.min(thumbnails::MOST);
        if listed < most {
            let more = ui.small_button("More scenes");
            if more.on_hover_text(format!("{listed} of {count} are listed")).clicked() {
                next.more_scenes = listed + MORE - FEW;
            }
        }
        let save = ui.small_button("Save scenes...");
        let hover = "Write these scenes to a scene file, worst first; Open, and --scenes of svbrdf, take it";
        if save.on_hover_text(hover).clicked() {
            next.dialogs.save = Some(SaveDialog::new(SaveKind::Scenes));
        }
    });
}

/// The button that searches, its progress, and what was found, in two rows.
fn search(ui: &mut egui::Ui, shown: Shown<'_>, pair: &ComparedPair, next: &mut Model) {
    let (answers, model) = (&shown.jobs.answers, shown.model);
    let question = FindWorst { pair: pair.clone(), seed: model.settings.loss.seed };
    let busy = model.searched.is_some().then(|| answers.get(&question).busy().unwrap_or_default());
    let known = answers.known(&question);
    let worst = known.as_deref().map(|known| &known.answer);
    ui.horizontal(|ui| {
        if let Some((fraction, elapsed)) = busy {
            if ui.button("Cancel search").on_hover_text("Esc").clicked() {
                next.searched = None;
            }
            let text = format!("{:.0}%, {} s", 100.0 * fraction, elapsed.as_secs());
            progress(ui, fraction, text);
            return;
        }
        let hover =
            "Searches all scenes that the loss samples from for the largest loss, and shows the scene";
        if ui.button("Find worst scene").on_hover_text(hover).clicked() {
            next.searched = next.chosen_prediction().map(LoadedMaterial::id);
        }
        if let Some(worst) = worst {
            let chosen = worst.scene == shown.model.view.scene;
            let label = ui.selectable_label(chosen, times(worst));
            if label.on_hover_text(found(worst)).clicked() {
                display::choose_scene(next, worst.scene);
            }
        }
    });
    let text = match worst {
        Some(worst) => format!("{} scenes tried; mean {:.4}", worst.evaluations, worst.mean.mean),
        None => "Of all scenes that the loss samples from".to_owned(),
    };
    ui.add(egui::Label::new(RichText::new(text).small().weak()).truncate());
}

/// The worst loss, and how far above the mean it is.
fn times(worst: &Worst) -> String {
    let mean = worst.mean.mean;
    if mean > 0.0 {
        format!("{:.4}, {:.1} x the mean", worst.loss, worst.loss / mean)
    } else {
        format!("{:.4}", worst.loss)
    }
}

fn found(worst: &Worst) -> String {
    format!(
        "{}\nThe search compares up to 1,024 texels; the loss is over all. It may miss a maximum that is narrower than \
         the gaps between its first scenes. Click to show this scene again.",
        place(&worst.scene)
    )
}

/// Kind, light and view.
fn place(scene: &Scene) -> String {
    let kind = match scene.kind {
        Kind::Near => "near-field",
        Kind::Distant => "distant",
    };
    let triple = |[x, y, z]: [f64; 3]| format!("({x:.3}, {y:.3}, {z:.3})");
    format!("{kind}, light {}, view {}", triple(scene.light), triple(scene.view))
}

fn thumbnail(
    ui: &mut egui::Ui,
    ranked: &RankedScene,
    rank: usize,
    picture: Option<(egui::TextureId, Rect)>,
    current: bool,
) -> egui::Response {
    let (area, response) = ui.allocate_exact_size(vec2(SIDE, SIDE + NUMBER), Sense::click());
    let loss = ranked.losses[0];
    response.widget_info(|| {
        let label = format!("Scene {}: {loss:.4}", rank + 1);
        egui::WidgetInfo::selected(egui::Role::Button, true, current, label)
    });
    let square = area.with_max_y(area.top() + SIDE);
    let painter = ui.painter();
    match picture {
        Some((texture, part)) => {
            painter.image(texture, square, part, Color32::WHITE);
        }
        None => {
            painter.rect_filled(square, 0.0, ui.visuals().widgets.inactive.weak_bg_fill);
        }
    }
    let visuals = ui.visuals();
    let outline = if current {
        Some(Stroke::new(2.0, theme::accent(visuals)))
    } else if response.hovered() || response.has_focus() {
        Some(Stroke::new(1.5, visuals.text_color()))
    } else {
        None
    };
    if let Some(stroke) = outline {
        painter.rect_stroke(square, 1.0, stroke, egui::StrokeKind::Outside);
    }
    let number = pos2(area.center().x, area.bottom());
    painter.text(number, Align2::CENTER_BOTTOM, digits(loss), FontId::monospace(11.5), visuals.text_color());
    response.on_hover_text(format!(
        "Loss {} from the largest: {loss:.6}\n{}\nClick for this light and view",
        rank + 1,
        place(&ranked.scene)
    ))
}

/// The scenes of the loss of a pair, worst first.
#[derive(Clone, Debug, PartialEq)]
pub struct RankScenes {
    pub pair: ComparedPair,
    pub scenes: Request,
}

impl Question for RankScenes {
    type Answer = Vec<RankedScene>;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Vec<RankedScene>, Error> {
        let read = self.pair.read()?;
        let (truth, prediction) = (read[0].material(), read[1].material());
        comparing(truth, &[prediction], self.pair.convention, mask_of(&read)?, |comparison| {
            Ok(worst_first(&comparison.without_pilot().run(&self.scenes, work.progress())?))
        })
    }
}

/// Pictures of the differences of a pair in these scenes.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawScenes {
    pub pair: ComparedPair,
    pub scenes: Vec<Scene>,
}

impl Question for DrawScenes {
    type Answer = Thumbnails;
    const KEPT: usize = 4;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Thumbnails, Error> {
        let [truth, prediction] = self.pair.read()?;
        let materials = [truth.material(), prediction.material()];
        thumbnails::make(materials, &self.pair.convention, &self.scenes, work.progress())
    }
}

/// The scene with the largest loss of a pair.
#[derive(Clone, Debug, PartialEq)]
pub struct FindWorst {
    pub pair: ComparedPair,
    /// Names the scenes that the search starts from.
    pub seed: u64,
}

impl Question for FindWorst {
    type Answer = Worst;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Worst, Error> {
        let read = self.pair.read()?;
        refuse_mask(&read, "The search is over all texels, and not over those of a mask")?;
        let materials = [read[0].material(), read[1].material()];
        Ok(worst(materials[0], materials[1], &self.pair.convention, self.seed, TAIL, work.progress())?)
    }
}
