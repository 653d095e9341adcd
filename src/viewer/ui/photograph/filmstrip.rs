//! The filmstrip: the photographs of a capture, one of which is compared.

use eframe::egui::{self, Color32, Rect, RichText, Sense, Stroke, vec2};

use svbrdf_evaluate::report::position;
use svbrdf_files::photograph::SessionPhotograph;
use svbrdf_files::scene_file::PhotographLight;

use crate::jobs::photograph::filmstrip::Filmstrip;
use crate::model::command::{Command, PhotographCommand};
use crate::ui::widgets::texture::PanelTextures;
use crate::ui::widgets::theme;

/// Side of a thumbnail, and height of the strip with its scroll bar, in points.
const SIDE: f32 = 52.0;
const HEIGHT: f32 = SIDE + 14.0;

/// The strip, which is as high before the photographs have been read.
pub fn ui(
    ui: &mut egui::Ui,
    source: &SessionPhotograph,
    strip: Option<&Filmstrip>,
    textures: &mut PanelTextures,
) -> Option<Command> {
    let current = strip.and_then(|strip| strip.position(&source.path));
    let mut clicked = None;
    let size = vec2(ui.available_width(), HEIGHT);
    ui.allocate_ui_with_layout(size, egui::Layout::left_to_right(egui::Align::Min), |ui| {
        ui.set_min_size(size);
        let Some(strip) = strip else {
            ui.add(egui::Spinner::new().size(0.4 * SIDE));
            return;
        };
        let texture = textures.id(ui.ctx(), &strip.picture, egui::TextureOptions::LINEAR);
        egui::ScrollArea::horizontal().id_salt("filmstrip").auto_shrink([false, false]).show(ui, |ui| {
            ui.horizontal_top(|ui| {
                ui.spacing_mut().item_spacing.x = 5.0;
                ui.add_space(2.0);
                for index in 0..strip.count() {
                    if thumbnail(ui, strip, index, texture, current == Some(index)).clicked() {
                        clicked = Some(index);
                    }
                }
            });
        });
    });
    about(ui, strip, current);
    open(strip?, clicked?)
}

/// The number of the photograph, and what the strip does not tell by itself.
fn about(ui: &mut egui::Ui, strip: Option<&Filmstrip>, current: Option<usize>) {
    let text = match (strip, current) {
        (None, _) => "Reading the capture...".to_owned(),
        (Some(strip), Some(current)) => {
            format!("Photograph {} of {} of the capture", current + 1, strip.count())
        }
        (Some(strip), None) => format!("{} photographs of the capture", strip.count()),
    };
    ui.label(RichText::new(text).small());
    let Some(strip) = strip else { return };
    let warn = |ui: &mut egui::Ui, text: String| {
        ui.label(RichText::new(text).small().color(ui.visuals().warn_fg_color));
    };
    match strip.outside {
        0 => {}
        1 => warn(ui, "A photograph lies outside of the folder of the capture".to_owned()),
        count => warn(ui, format!("{count} photographs lie outside of the folder of the capture")),
    }
}

/// The command that compares with another photograph, in its light and view.
fn open(strip: &Filmstrip, index: usize) -> Option<Command> {
    let (photograph, scene) = strip.capture.session_photograph(index)?;
    Some(PhotographCommand::Open { photograph, light: Some(PhotographLight::Scene(scene)) }.into())
}

fn thumbnail(
    ui: &mut egui::Ui,
    strip: &Filmstrip,
    index: usize,
    texture: egui::TextureId,
    is_current: bool,
) -> egui::Response {
    let one = &strip.capture.photographs[index];
    let (area, response) = ui.allocate_exact_size(vec2(SIDE, SIDE + 2.0), Sense::click());
    let label = format!("Photograph {}: {}", index + 1, one.name);
    response.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, is_current, &label));
    let square = Rect::from_min_size(area.min + vec2(0.0, 2.0), vec2(SIDE, SIDE));
    let (painter, visuals) = (ui.painter(), ui.visuals());
    painter.rect_filled(square, 0.0, visuals.widgets.inactive.weak_bg_fill);
    if let Some([least, greatest]) = strip.part(index) {
        painter.image(texture, square, Rect::from_min_max(least.into(), greatest.into()), Color32::WHITE);
    } else if strip.problem(index).is_some() {
        let (font, colour) = (egui::FontId::proportional(20.0), theme::problem(visuals));
        painter.text(square.center(), egui::Align2::CENTER_CENTER, "\u{d7}", font, colour);
    }
    if is_current {
        let stroke = Stroke::new(2.0, theme::accent(visuals));
        painter.rect_stroke(square, 1.0, stroke, egui::StrokeKind::Outside);
    } else if response.hovered() || response.has_focus() {
        let stroke = Stroke::new(1.5, visuals.text_color());
        painter.rect_stroke(square, 1.0, stroke, egui::StrokeKind::Outside);
    }
    let [light, view] = [one.scene.light, one.scene.view].map(position);
    let action =
        strip.problem(index).unwrap_or("Click to compare with this photograph, in its light and view");
    response.on_hover_text(format!("{}\nlight {light}\nview {view}\n{action}", one.name))
}
