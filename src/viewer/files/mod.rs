//! The materials in the window, and the assumptions in reading each.

pub mod dialog;
pub mod open;
pub mod read_options;
pub mod save;

use eframe::egui::text::{LayoutJob, TextFormat};
use eframe::egui::{self, FontId, RichText, Stroke, vec2};

use svbrdf_evaluate::diagnose::{Finding, sentence_of};
use svbrdf_files::read::{Assumption, Certainty, Note, ReadOptions};
use svbrdf_files::source::Place;

use crate::files::read_options::read_options;
use crate::jobs::Shown;
use crate::jobs::answers::content::ComparedPair;
use crate::model::dataset::{DatasetState, OpenDataset};
use crate::model::material::loaded::{LoadedMaterial, drawable};
use crate::model::{Model, opening};
use crate::why::diagnosis::{is_offered, known_diagnosis, remedy_button};
use crate::widgets::{named, theme};

/// The longer side of the outline of a ground truth, in points.
const PART: f32 = 48.0;

/// Draws the section.
pub fn ui(ui: &mut egui::Ui, shown: Shown<'_>, next: &mut Model) {
    let materials = &shown.model.materials.all;
    ui.horizontal_wrapped(|ui| {
        if ui.button("Reload").on_hover_text("Read all files again (Ctrl+R)").clicked() {
            opening::reload(next);
        }
        ui.checkbox(&mut next.settings.watch, "Watch")
            .on_hover_text("Read files again when they change on disk");
        let built_in = ui.button("Built-in pair");
        if built_in.on_hover_text("Show the materials that come with the program").clicked() {
            opening::open_built_in(next);
        }
    });
    for opening in &shown.model.materials.openings {
        ui.add(egui::ProgressBar::new(opening.fraction()).text(opening.text()));
        let cancel = ui.small_button("Cancel reading");
        if cancel.on_hover_text("What is in the window stays").clicked() {
            next.materials.openings.retain(|one| one.number != opening.number);
        }
    }
    if let Some(open) = &shown.model.dataset.open {
        decisions(ui, open, materials, &mut next.dataset);
    }
    let mask = materials.first().and_then(|truth| truth.read.record.mask.as_ref());
    if let Some((mask, source)) = mask.zip(shown.model.materials.rules.mask.as_ref()) {
        let (kept, all) = (mask.texels().len(), mask.kept().len());
        ui.label(format!("Mask: {}, {kept} of {all} texels", drawable(&source.to_string())))
            .on_hover_text("The others are gray, and not compared");
    }
    let pairs = ComparedPair::all(materials, &shown.model.view);
    for (index, material) in materials.iter().enumerate() {
        ui.separator();
        let pair = index.checked_sub(1).and_then(|prediction| pairs.get(prediction));
        let seed = shown.model.settings.loss.seed;
        let diagnosed = pair.and_then(|pair| known_diagnosis(&shown.jobs.answers, pair, seed));
        let findings: Vec<_> = diagnosed.iter().flat_map(|one| one.marked()).collect();
        let role = match index {
            0 if materials.len() == 1 => "MATERIAL".to_owned(),
            0 => "GROUND TRUTH".to_owned(),
            _ => format!("Prediction {}", material.slot),
        };
        // Its id changes whenever it is read again; what is unfolded stays unfolded.
        ui.push_id(index, |ui| section(ui, (index, &role), material, &findings, next));
    }
}

/// How the methods of a data set are read and lie on their ground truths, and what that rests on. A registration can be declined.
fn decisions(ui: &mut egui::Ui, open: &OpenDataset, materials: &[LoadedMaterial], next: &mut DatasetState) {
    let (accepted, declined) = (&open.reading.registrations, &open.declined);
    if accepted.is_empty() && declined.is_empty() && open.reading.decisions.is_empty() {
        return;
    }
    ui.separator();
    ui.label(RichText::new("DATA SET").small());
    let all = accepted.iter().map(|(method, way)| (method, way, true));
    for (method, way, is_accepted) in
        all.chain(declined.iter().map(|(method, (way, _))| (method, way, false)))
    {
        let mut accepts = is_accepted;
        ui.checkbox(&mut accepts, format!("{}: registration {way}", drawable(method)))
            .on_hover_text("Which part of the ground truth a prediction is, as the maps have decided; without it, sizes have to be equal");
        let slot = open.methods().iter().position(|one| one == method).map(|place| place + 1);
        let prediction = materials.iter().find(|one| Some(one.slot) == slot && is_accepted);
        if let Some([truth, prediction]) =
            prediction.and_then(|one| Some([stored(materials.first()?)?, stored(one)?]))
        {
            part(ui, truth, way.part([truth, prediction]), slot.unwrap_or_default());
        }
        if accepts != is_accepted {
            next.register(method, accepts);
        }
    }
    for decision in &open.reading.decisions {
        ui.label(RichText::new(drawable(decision)).small());
    }
}

/// The size of a material in its files, of which the window may have a part.
fn stored(material: &LoadedMaterial) -> Option<[usize; 2]> {
    material.read.record.maps.iter().map(|map| map.size).max()
}

/// The outline of a ground truth of this size, and the part of it that is compared, in the colour of a slot.
fn part(ui: &mut egui::Ui, truth: [usize; 2], part: [[f32; 2]; 2], slot: usize) {
    let [width, height] = truth.map(|side| side as f32);
    let size = vec2(width, height) * (PART / width.max(height).max(1.0));
    let (whole, _) = ui.allocate_exact_size(size, egui::Sense::hover());
    let corner = |[x, y]: [f32; 2]| whole.min + size * vec2(x, y);
    let (part, colour) = (
        egui::Rect::from_min_max(corner(part[0]), corner(part[1])),
        theme::series(slot, ui.visuals().dark_mode),
    );
    let inside = egui::StrokeKind::Inside;
    ui.painter().rect_stroke(whole, 0.0, Stroke::new(1.0, theme::ground_truth(ui.visuals())), inside);
    ui.painter().rect(part, 0.0, colour.gamma_multiply(0.3), Stroke::new(1.0, colour), inside);
}

/// The names of a file of several materials, to choose one.
fn chooser(ui: &mut egui::Ui, material: &LoadedMaterial, read: &mut ReadOptions) {
    let names = material.read.record.notes.iter().find_map(|note| match note {
        Note::Materials { names, index } => Some((names, *index)),
        _ => None,
    });
    let Some((names, index)) = names else { return };
    let mut chosen = index;
    let text = names.get(index).map_or("", String::as_str);
    let response = egui::ComboBox::from_id_salt((material.id(), "material"))
        .selected_text(format!("material {text}"))
        .show_ui(ui, |ui| {
            for (i, name) in names.iter().enumerate() {
                ui.selectable_value(&mut chosen, i, format!("{i}: {name}"));
            }
        })
        .response;
    named(&response, &format!("material of {}", material.name()));
    response.on_hover_text(format!("The file has {} materials", names.len()));
    if chosen != index {
        read.exemplar = Some(chosen);
    }
}

/// An assumption and its reason, in two rows at most.
fn line(ui: &mut egui::Ui, assumption: &Assumption) {
    const ROWS: usize = 2;
    let (font, small) = (FontId::proportional(12.5), FontId::proportional(11.0));
    let (text, weak) = (ui.visuals().text_color(), ui.visuals().weak_text_color());
    let (panel, warning) = (ui.visuals().panel_fill, ui.visuals().warn_fg_color);
    let mut job = LayoutJob::default();
    job.append(&format!("{}: ", assumption.what.name()), 0.0, TextFormat::simple(font.clone(), weak));
    job.append(&assumption.chosen, 0.0, TextFormat::simple(font, text));
    if assumption.certainty == Certainty::Unsure {
        let badge = TextFormat { background: warning, ..TextFormat::simple(small.clone(), panel) };
        job.append(" unsure ", 6.0, badge);
    }
    job.append(&format!(": {}", assumption.why), 0.0, TextFormat::simple(small, weak));
    job.wrap.max_rows = ROWS;
    ui.label(job);
}

/// A finding about how the material was read, with the button that corrects it.
fn finding_line(
    ui: &mut egui::Ui,
    index: usize,
    material: &LoadedMaterial,
    finding: &Finding,
    next: &mut Model,
) {
    let Some(remedy) = finding.remedy_of_prediction().filter(|remedy| is_offered(material, *remedy)) else {
        return;
    };
    ui.label(RichText::new(sentence_of(finding)).small().color(ui.visuals().warn_fg_color));
    remedy_button(ui, index, material, remedy, next);
}

fn section(
    ui: &mut egui::Ui,
    (index, role): (usize, &str),
    material: &LoadedMaterial,
    findings: &[&Finding],
    next: &mut Model,
) {
    let (record, place) = (&material.read.record, &material.read.source.place);
    let colour = if index == 0 { theme::ground_truth(ui.visuals()) } else { ui.visuals().text_color() };
    ui.horizontal(|ui| {
        ui.label(RichText::new(role).color(colour).small());
        if index > 0 {
            let is_pair = next.dataset.open.is_none();
            let swap = ui.add_enabled(is_pair, egui::Button::new("Make ground truth").small());
            let number = material.slot;
            if swap.on_hover_text(format!("Compare the others with this one (Shift+{number})")).clicked() {
                opening::make_ground_truth(next, index);
            }
            if ui.small_button("Close").on_hover_text("Take it out of the comparison").clicked() {
                opening::close(next, index);
            }
        }
    });
    let [width, height] = record.material.size();
    ui.add(egui::Label::new(RichText::new(material.name()).strong()).truncate());
    let location = match place {
        Place::BuiltIn(_) => "built in".to_owned(),
        Place::Path(path) => drawable(&path.display().to_string()),
    };
    ui.add(
        egui::Label::new(RichText::new(format!("{width} x {height}, {location}")).small().weak()).truncate(),
    );
    if let Some(problem) = &material.problem {
        ui.label(RichText::new(problem).small().color(theme::problem(ui.visuals())));
    }
    record.assumptions.iter().for_each(|assumption| line(ui, assumption));
    findings.iter().for_each(|finding| finding_line(ui, index, material, finding, next));
    // Which file is which map stands in "As stored".
    for note in record.notes.iter().filter(|note| !note.is_routine()) {
        let text = RichText::new(note.to_string()).small();
        ui.label(if note.changes_look() { text.color(ui.visuals().warn_fg_color) } else { text });
    }
    if matches!(place, Place::Path(_)) {
        let mut read = record.options;
        chooser(ui, material, &mut read);
        let change = ui.collapsing("Change...", |ui| {
            read_options(ui, material.name(), &mut read, &record.assumptions);
        });
        change.header_response.on_hover_text("Say how its files are to be read");
        if read != record.options {
            opening::read_as(next, index, read);
        }
    }
    let stored = ui.collapsing("As stored", |ui| {
        for map in &record.maps {
            ui.label(RichText::new(map.to_string()).small());
        }
    });
    stored.header_response.on_hover_text("Which file is which map, and what it holds");
}
