//! The photograph: how it was read, where the material is in it, and the factor of each material.

use eframe::egui::{self, RichText};

use svbrdf_files::photograph::Corners;
use svbrdf_files::read::Transfer;

use crate::jobs::photograph::DisplayedPhotograph;
use crate::model::command::{Command, PhotographCommand};
use crate::ui::photograph::corner_editor::CORNER_NAMES;
use crate::ui::photograph::filmstrip;
use crate::ui::widgets::number;
use crate::ui::widgets::texture::PanelTextures;
use crate::ui::widgets::theme;

/// Height of the list of factors, in points.
const FACTORS: f32 = 76.0;

/// What the section shows.
#[derive(Debug)]
pub struct PhotographCard<'a> {
    pub photograph: DisplayedPhotograph<'a>,
    /// Of the materials.
    pub names: Vec<&'a str>,
    /// Whether the panes compare with it.
    pub is_compared: bool,
}

impl PhotographCard<'_> {
    /// While a photograph of a capture is being read, the card keeps the height that it had.
    pub fn ui(&self, ui: &mut egui::Ui, textures: &mut PanelTextures) -> Vec<Command> {
        let (id, top) = (egui::Id::unique("height of the photograph card"), ui.cursor().top());
        let commands = self.contents(ui, textures);
        let height = ui.min_rect().bottom() - top;
        if self.photograph.photograph.is_some() && self.photograph.all.is_some() {
            ui.data_mut(|data| data.insert_temp(id, height));
        } else if self.photograph.source.capture.is_some()
            && let Some(before) = ui.data(|data| data.get_temp::<f32>(id))
        {
            ui.expand_to_include_y(top + before);
        }
        commands
    }

    fn contents(&self, ui: &mut egui::Ui, textures: &mut PanelTextures) -> Vec<Command> {
        let mut commands = Vec::new();
        let source = self.photograph.source;
        ui.horizontal(|ui| {
            ui.strong("Photograph");
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let close = ui.small_button("Close photograph");
                if close.on_hover_text("Compare with the ground truth again").clicked() {
                    commands.push(PhotographCommand::Close.into());
                }
                let name = egui::Label::new(self.photograph.name()).truncate();
                ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| ui.add(name))
                    .inner
                    .on_hover_text(source.path.display().to_string());
            });
        });
        if source.capture.is_some() {
            let strip = self.photograph.filmstrip.map(AsRef::as_ref);
            commands.extend(filmstrip::ui(ui, source, strip, textures));
        }
        if let Some(problem) = self.photograph.problem {
            ui.label(RichText::new(problem).small().color(theme::problem(ui.visuals())));
            return commands;
        }
        let Some(photograph) = self.photograph.photograph else {
            ui.add(egui::Spinner::new());
            return commands;
        };
        let [width, height] = photograph.size();
        ui.horizontal(|ui| {
            ui.label(RichText::new(format!("{width} x {height} pixels,")).small());
            self.transfer(ui, &mut commands);
        });
        if let Some(colour) = source.read.light_colour {
            let [r, g, b] = colour.map(|channel| format!("{channel:.3}"));
            ui.label(RichText::new(format!("Colour of the light divided out: {r} {g} {b}")).small())
                .on_hover_text("light_pow of the capture over the mean of its channels");
        }
        for note in &photograph.notes {
            ui.label(RichText::new(note.to_string()).small().color(ui.visuals().warn_fg_color));
        }
        if !self.is_compared {
            ui.weak("Maps and the error map are compared with the ground truth.");
        }
        self.factors(ui);
        let mut falloff = source.falloff;
        ui.checkbox(&mut falloff, "Divide out falloff").on_hover_text(
            "Divides the photograph by the falloff of a point light, which the renderings do not have: for photographs with \
             a flash or lamp near the material",
        );
        if falloff != source.falloff {
            commands.push(PhotographCommand::SetFalloff(falloff).into());
        }
        let edits = self.photograph.corners.is_some();
        let header = egui::CollapsingHeader::new("Corners of the material").open(Some(edits));
        let header = header.show(ui, |ui| self.corners(ui, photograph.size(), &mut commands));
        let hover = "Shows the photograph as it was taken, with handles to drag";
        if header.header_response.on_hover_text(hover).clicked() {
            commands.push(PhotographCommand::EditCorners(!edits).into());
        }
        commands
    }

    fn transfer(&self, ui: &mut egui::Ui, commands: &mut Vec<Command>) {
        let Some(photograph) = self.photograph.photograph else { return };
        let set = self.photograph.source.read.transfer;
        let mut transfer = set;
        let text = format!("{} {}", photograph.transfer.label(), photograph.transfer_from);
        let combo = egui::ComboBox::from_id_salt("photograph transfer").selected_text(text);
        let response = combo.show_ui(ui, |ui| {
            ui.selectable_value(&mut transfer, None, "auto: by the file");
            for one in Transfer::ALL {
                ui.selectable_value(&mut transfer, Some(one), one.label());
            }
        });
        let response = response.response;
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, "Transfer curve"));
        response.on_hover_text("How the stored samples encode radiance");
        if transfer != set {
            commands.push(PhotographCommand::SetTransfer(transfer).into());
        }
    }

    /// The factor of each material, and what is left out.
    fn factors(&self, ui: &mut egui::Ui) {
        let Some(all) = self.photograph.all else {
            ui.weak("Fitting the exposure...");
            return;
        };
        let hover = "Factor on the photograph: the median of rendering / photograph. It brings the photograph to the exposure \
                     of the rendering.";
        egui::ScrollArea::vertical().id_salt("photograph factors").max_height(FACTORS).show(ui, |ui| {
            for (name, one) in self.names.iter().zip(&all.comparisons) {
                let left = |ui: &mut egui::Ui| drop(ui.label(RichText::new(*name).small()));
                let right = |ui: &mut egui::Ui| {
                    for text in [format!("{:+.2} EV", one.exposure_ev()), format!("x {:.4}", one.factor)] {
                        ui.label(RichText::new(text).monospace().size(11.5)).on_hover_text(hover);
                    }
                };
                egui::Sides::new().shrink_left().truncate().show(ui, left, right);
            }
        });
        if let Some(clipped) = self.photograph.clipped {
            let text = RichText::new(format!("{:.2}% of the texels are clipped", 100.0 * clipped)).small();
            let text = if clipped > 0.05 { text.color(ui.visuals().warn_fg_color) } else { text };
            ui.label(text).on_hover_text(
                "They have a pixel at the largest value that the file can store. They are left out of the factor and of \
                 every difference",
            );
        }
    }

    fn corners(&self, ui: &mut egui::Ui, size: [usize; 2], commands: &mut Vec<Command>) {
        let whole = Corners::whole(size);
        let set = self.photograph.source.corners.unwrap_or(whole);
        let mut corners = set;
        egui::Grid::new("photograph corners").num_columns(3).spacing([8.0, 2.0]).show(ui, |ui| {
            for (index, name) in CORNER_NAMES.into_iter().enumerate() {
                ui.label(name);
                for (axis, letter) in ["x", "y"].into_iter().enumerate() {
                    let label = format!("{name} {letter}");
                    number(ui, &label, &mut corners.0[index][axis], whole.0[index][axis], |drag| {
                        drag.range(0.0..=size[axis] as f64)
                            .speed(0.5)
                            .max_decimals(2)
                            .prefix(format!("{letter} "))
                    })
                    .on_hover_text("In pixels; double-click for the corner of the picture");
                }
                ui.end_row();
            }
        });
        if let Err(problem) = corners.check(size) {
            ui.label(RichText::new(problem.to_string()).small().color(theme::problem(ui.visuals())));
        }
        let all = ui.add_enabled(set != whole, egui::Button::new("Whole picture").small());
        if all.clicked() {
            commands.push(PhotographCommand::SetCorners(None).into());
        } else if corners != set {
            commands.push(PhotographCommand::SetCorners(Some(corners)).into());
        }
    }
}
