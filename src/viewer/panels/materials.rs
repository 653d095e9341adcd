//! The materials in the window, and what was assumed in reading each.

use eframe::egui::{self, RichText};

use crate::files::read::{Certainty, Sidecar};
use crate::viewer::command::Command;
use crate::viewer::loaded::Origin;
use crate::viewer::slots::{Slot, Slots};
use crate::viewer::theme;

/// What the section shows.
#[derive(Debug)]
pub struct MaterialsPanel<'a> {
    pub slots: &'a Slots,
    pub watch: bool,
}

impl MaterialsPanel<'_> {
    pub fn ui(&self, ui: &mut egui::Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        ui.horizontal_wrapped(|ui| {
            if ui.button("Reload").on_hover_text("Read all files again (Ctrl+R)").clicked() {
                commands.push(Command::Reload);
            }
            let mut watch = self.watch;
            ui.checkbox(&mut watch, "Watch").on_hover_text("Read files again when they change on the disk");
            if watch != self.watch {
                commands.push(Command::SetWatch(watch));
            }
            let mut fit = self.slots.rules.fit;
            ui.checkbox(&mut fit, "Fit sizes")
                .on_hover_text("Resize predictions that are opened from now on to the ground truth");
            if fit != self.slots.rules.fit {
                commands.push(Command::SetFit(fit));
            }
            if ui.button("Built-in pair").clicked() {
                commands.push(Command::OpenBuiltIn);
            }
        });
        for opening in &self.slots.openings {
            let text = format!("reading {}", opening.what);
            ui.add(egui::ProgressBar::new(opening.job.fraction()).text(text));
            if ui.small_button("Cancel reading").clicked() {
                opening.job.cancel();
            }
        }
        for (index, slot) in self.slots.slots.iter().enumerate() {
            ui.separator();
            ui.push_id(slot.id, |ui| material(ui, index, slot, &mut commands));
        }
        commands
    }
}

/// The button that keeps what is chosen; without anything new there is nothing to keep.
fn keep(ui: &mut egui::Ui, index: usize, slot: &Slot, commands: &mut Vec<Command>) {
    let (Origin::Path(path), loaded) = (&slot.loaded.origin, &slot.loaded) else { return };
    if loaded.read == loaded.kept {
        return;
    }
    let button = ui.button("Keep with the material");
    let name = format!("Keep with {}", slot.name());
    button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
    let place = Sidecar::path_for(path);
    let why = format!(
        "Write what is chosen here into {}: it then holds whenever the material is opened",
        place.display()
    );
    if button.on_hover_text(why).clicked() {
        commands.push(Command::Keep { slot: index });
    }
}

fn material(ui: &mut egui::Ui, index: usize, slot: &Slot, commands: &mut Vec<Command>) {
    let loaded = &slot.loaded;
    let role = if index == 0 { "GROUND TRUTH".to_owned() } else { format!("Prediction {index}") };
    let colour = if index == 0 { theme::accent(ui.visuals()) } else { ui.visuals().text_color() };
    ui.horizontal(|ui| {
        ui.label(RichText::new(role).color(colour).small());
        if index > 0 {
            if ui.small_button("Make ground truth").clicked() {
                commands.push(Command::MakeGroundTruth(index));
            }
            if ui.small_button("Close").clicked() {
                commands.push(Command::ClosePrediction(index));
            }
        }
    });
    let [width, height] = loaded.material.size();
    ui.add(egui::Label::new(RichText::new(slot.name()).strong()).truncate());
    let origin = match &loaded.origin {
        Origin::BuiltIn => "built in".to_owned(),
        Origin::Path(path) => path.display().to_string(),
    };
    ui.add(
        egui::Label::new(RichText::new(format!("{width} x {height}, {origin}")).small().weak()).truncate(),
    );
    if matches!(loaded.origin, Origin::Path(_)) {
        let mut read = loaded.read;
        super::read_options(ui, slot.name(), &mut read, &loaded.assumptions);
        if read != loaded.read {
            commands.push(Command::ReadAs { slot: index, read });
        }
        keep(ui, index, slot, commands);
    }
    for assumption in &loaded.assumptions {
        let text = RichText::new(assumption.to_string()).small();
        let unsure = assumption.certainty == Certainty::Unsure;
        ui.label(if unsure { text.color(ui.visuals().warn_fg_color) } else { text });
    }
    for note in &loaded.notes {
        ui.label(RichText::new(note.to_string()).small());
    }
    ui.collapsing("As stored", |ui| {
        for map in &loaded.maps {
            ui.label(RichText::new(map.to_string()).small());
        }
    });
}
