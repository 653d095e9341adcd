//! Keys: what is pressed, and the files that are dropped.

use std::path::PathBuf;

use eframe::egui::{self, Key, Modifiers, RichText};

use svbrdf_files::read::ReadOptions;

use crate::frame::actions::{Action, HELP, Line};
use crate::frame::{blind, light_and_view};
use crate::jobs::answers::Answers;
use crate::loss::losses::ComputeLosses;
use crate::model::{Model, display, opening};
use crate::widgets::copy;

/// Carries out the keys pressed in this frame; none while a text field has the focus.
fn press(ctx: &egui::Context, model: &mut Model, answers: &Answers) {
    if ctx.text_edit_focused() {
        return;
    }
    let mut actions: Vec<Action> =
        HELP.iter().flat_map(|(_, lines)| *lines).flat_map(|line| line.actions).copied().collect();
    // Longer chords first: the first that is contained in the one pressed takes it.
    actions.sort_by_key(|(modifiers, ..)| !modifiers.command as usize + !modifiers.shift as usize);
    for (modifiers, key, run) in actions {
        let presses = ctx.input_mut(|input| input.count_and_consume_key(modifiers, key));
        (0..presses).for_each(|_| run(model));
    }
    for (slot, key) in (1..=9).filter_map(|slot| Some((slot, Key::from_name(&slot.to_string())?))) {
        if ctx.input(|input| input.events.iter().any(|event| is_with_shift(event, key))) {
            opening::make_ground_truth(model, slot);
        } else if ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key)) {
            display::choose_slot(model, slot);
        }
    }
    // An open menu or drop-down takes Esc for itself.
    if !egui::Popup::is_any_open(ctx)
        && ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape))
    {
        escape(model, answers);
    }
    // Copy and paste arrive as events, and `?` is on another key of every keyboard.
    for event in ctx.input(|input| input.events.clone()) {
        match event {
            egui::Event::Copy => {
                copy(ctx, model, light_and_view::scene_text(model.view.scene), "the scene as JSON")
            }
            egui::Event::Paste(text) => light_and_view::paste(model, &text),
            egui::Event::Text(text) if text == "?" => model.help = true,
            _ => {}
        }
    }
}

/// Whether this is the press of a digit with Shift, which has another sign on it in most layouts.
fn is_with_shift(event: &egui::Event, digit: Key) -> bool {
    let egui::Event::Key { key, physical_key, pressed: true, modifiers, .. } = event else { return false };
    modifiers.shift_only() && (*key == digit || *physical_key == Some(digit))
}

/// Carries out keys, of a blind comparison its own alone, and opens files that were dropped: in place of the built-in materials, or as predictions.
pub fn act(ctx: &egui::Context, model: &mut Model, answers: &Answers) {
    if model.blind.is_some() {
        return blind::press(ctx, model);
    }
    press(ctx, model, answers);
    let paths: Vec<PathBuf> =
        ctx.input(|i| i.raw.dropped_files.iter().map(|f| f.path().to_owned()).collect());
    if !paths.is_empty() {
        let replace = model.materials.only_built_in();
        opening::open(model, paths, replace, ReadOptions::AUTO);
    }
}

/// Closes or cancels the first of these that is there.
fn escape(model: &mut Model, answers: &Answers) {
    let Model { dialogs, dataset, inspection, view, help, searched, .. } = model;
    match () {
        () if *help => *help = false,
        () if dialogs.open.is_some() => dialogs.open = None,
        () if dialogs.save.is_some() => dialogs.save = None,
        () if !dataset.list.search.is_empty() => dataset.list.search.clear(),
        () if inspection.is_armed => inspection.is_armed = false,
        () if inspection.region.is_some() => inspection.region = None,
        () if searched.is_some() => *searched = None,
        () if view.display.is_replaced() => view.isolate(None),
        () if dataset.open.is_some() => dataset.show_table(true),
        () => answers.stop::<ComputeLosses>(),
    }
}

/// Width of the keys and of the list, in points.
const KEYS: f32 = 190.0;
const WIDTH: f32 = 560.0;

/// The help window, while it is `open`.
pub fn help(ctx: &egui::Context, open: &mut bool) {
    let room = ctx.content_rect().size();
    egui::Window::new("Keys and mouse")
        .open(open)
        .collapsible(false)
        .resizable(false)
        .anchor(egui::Align2::CENTER_CENTER, [0.0, 0.0])
        .show(ctx, |ui| {
            ui.set_width(WIDTH.min((room.x - 40.0).max(0.0)));
            egui::ScrollArea::vertical().max_height((room.y - 100.0).max(0.0)).show(ui, |ui| {
                for (name, lines) in HELP {
                    ui.strong(*name);
                    lines.iter().for_each(|one| help_line(ui, one));
                    ui.add_space(8.0);
                }
            });
        });
}

/// A line laid out by itself: a grid measures its rows for a frame, in which keys stand beside effects of others.
fn help_line(ui: &mut egui::Ui, line: &Line) {
    ui.horizontal_top(|ui| {
        ui.allocate_ui(egui::vec2(KEYS, 0.0), |ui| {
            ui.set_width(KEYS);
            ui.add(egui::Label::new(RichText::new(line.keys).monospace().size(11.5)).wrap());
        });
        ui.add(egui::Label::new(line.effect).wrap());
    });
}
