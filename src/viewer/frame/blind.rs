//! Blind comparison: its keys, and its bar, which takes the place of all other parts of the window.

use std::hash::{BuildHasher as _, RandomState};

use eframe::egui::{self, Event, Key};

use svbrdf_evaluate::blind::{BlindTest, TRIALS};

use crate::frame::actions::Run;
use crate::model::Model;
use crate::model::blind::Blind;

/// What a key and a button do.
const ANSWERS: [(&str, Key, Run); 2] = [
    ("X is A  (A)", Key::A, |model| answer(model, false)),
    ("X is B  (B)", Key::B, |model| answer(model, true)),
];

fn answer(model: &mut Model, is_b: bool) {
    model.blind.iter_mut().for_each(|blind| blind.test.answer(is_b));
}

/// Carries out the keys of a blind comparison: no others.
pub fn press(ctx: &egui::Context, model: &mut Model) {
    for event in ctx.input(|input| input.events.clone()) {
        // A key that is held is one answer.
        let Event::Key { key: pressed, pressed: true, repeat: false, .. } = event else { continue };
        let all = ANSWERS.into_iter().chain([("", Key::Escape, end as Run)]);
        all.filter(|(_, key, _)| *key == pressed).for_each(|(.., act)| act(model));
    }
}

/// Draws the question with its answers, or the result.
pub fn ui(ui: &mut egui::Ui, blind: &Blind, next: &mut Model) {
    ui.horizontal_wrapped(|ui| {
        let (text, answers, close) = match blind.test.trial() {
            Some((trial, _)) => {
                (format!("Trial {trial} of {TRIALS}: which is X?"), &ANSWERS[..], "End  (Esc)")
            }
            None => (blind.test.score().to_string(), &[][..], "Close  (Esc)"),
        };
        ui.strong(text);
        for (name, _, act) in answers.iter().chain(&[(close, Key::Escape, end as Run)]) {
            if ui.button(*name).clicked() {
                act(next);
            }
        }
    });
}

/// Compares the chosen prediction with the material at index `other` blind.
pub fn start(model: &mut Model, other: usize) {
    let chosen = model.chosen_prediction().cloned();
    let (Some(chosen), Some(other)) = (chosen, model.materials.all.get(other).cloned()) else { return };
    let test = BlindTest::new(RandomState::new().hash_one(0));
    model.dataset.show_table(false);
    model.blind = Some(Blind::new([chosen, other], test));
}

/// Ends the test, which shows its result; where there is none, or it was shown, the window is as before.
pub fn end(model: &mut Model) {
    match &mut model.blind {
        Some(blind) if blind.test.trial().is_some_and(|(trial, _)| trial > 1) => blind.test.end(),
        _ => model.blind = None,
    }
}
