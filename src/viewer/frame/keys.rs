//! Keys: what is pressed, and the files that are dropped.

use std::path::PathBuf;

use eframe::egui::{self, Key, Modifiers};

use svbrdf_files::read::ReadOptions;

use crate::frame::actions::{Action, HELP};
use crate::jobs::answers::Answers;
use crate::loss::losses::ComputeLosses;
use crate::model::{Model, clipboard, display, opening};
use crate::widgets::copy;

/// The keys that choose a prediction.
const DIGITS: [Key; 9] =
    [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7, Key::Num8, Key::Num9];

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
    for (slot, key) in (1..).zip(DIGITS) {
        if ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key)) {
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
            egui::Event::Copy => copy(ctx, model, clipboard::text(model.view.scene), "the scene as JSON"),
            egui::Event::Paste(text) => clipboard::paste(model, &text),
            egui::Event::Text(text) if text == "?" => model.help = true,
            _ => {}
        }
    }
}

/// Carries out keys, and opens files that were dropped on the window: in place of the built-in materials, otherwise as predictions.
pub fn act(ctx: &egui::Context, model: &mut Model, answers: &Answers) {
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
        () if dataset.sheet.is_open => dataset.show_sheet(false),
        () if inspection.is_armed => inspection.is_armed = false,
        () if inspection.region.is_some() => inspection.region = None,
        () if searched.is_some() => *searched = None,
        () if view.display.is_replaced() => view.isolate(None),
        () if dataset.sheet.is_behind => dataset.show_sheet(true),
        () => answers.stop::<ComputeLosses>(),
    }
}
