//! Actions: a table of keys and gestures with what each does, which is the help that `?` shows, too.

use eframe::egui::{Key, Modifiers};

use crate::model::Effect;
use crate::model::dataset::DatasetState;
use crate::model::dialogs::{OpenDialog, SaveDialog, SaveKind};
use crate::model::ranges::UI_SCALE;
use crate::model::view::AutoExposure;
use crate::model::{Model, display, opening, undo};

/// A key, and what it does.
pub type Action = (Modifiers, Key, Run);
/// What it does.
pub type Run = fn(&mut Model);

/// Gestures or keys, as the help names them and what they do.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    pub keys: &'static str,
    pub effect: &'static str,
    /// Nothing for gestures.
    pub actions: &'static [Action],
}

pub const NONE: Modifiers = Modifiers::NONE;
pub const SHIFT: Modifiers = Modifiers::SHIFT;
pub const COMMAND: Modifiers = Modifiers::COMMAND;
pub const BOTH: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

const fn line(keys: &'static str, effect: &'static str, actions: &'static [Action]) -> Line {
    Line { keys, effect, actions }
}

/// The line of a key, and what it does.
pub fn of((modifiers, key): (Modifiers, Key)) -> Option<(&'static Line, Run)> {
    let lines = HELP.iter().flat_map(|(_, lines)| *lines);
    let with =
        |line: &'static Line| line.actions.iter().map(move |(with, of, run)| ((*with, *of), (line, *run)));
    lines.flat_map(with).find(|(of, _)| *of == (modifiers, key)).map(|(_, found)| found)
}

/// What messages do, too.
pub const OPEN: Run = |model| model.dialogs.open = Some(OpenDialog::default());
pub const SAVE: Run = |model| model.dialogs.save = Some(SaveDialog::new(SaveKind::View));
pub const COPY_PICTURE: Run = |model| model.effects.push(Effect::CopyPicture);

/// Every gesture and key with its effect, in groups, for the help window and docs/window.md.
pub const HELP: &[(&str, &[Line])] = &[
    (
        "Light",
        &[
            line("left-drag", "move the light: its x and y follow the pointer; on maps, pan", &[]),
            line("Shift + wheel", "height of the light", &[]),
            line("Ctrl + Shift + left-drag", "orbit the light", &[]),
            line("Ctrl + Shift + right-drag", "distance of the light", &[]),
            line(
                "H",
                "highlight follows the pointer, on / off",
                &[(NONE, Key::H, |m| m.settings.highlight_follows ^= true)],
            ),
        ],
    ),
    (
        "View",
        &[
            line(
                "right-drag",
                "move the view; in perspective, turn the material, up to 85 degrees off its normal",
                &[],
            ),
            line("Alt + wheel", "height of the view", &[]),
            line(
                "P",
                "flat / perspective",
                &[(NONE, Key::P, |m| m.view.display.projection = m.view.display.projection.other())],
            ),
        ],
    ),
    (
        "Zoom",
        &[
            line("wheel", "zoom at the pointer", &[]),
            line("middle-drag, Space + left-drag", "pan", &[]),
            line("F", "fit the material", &[(NONE, Key::F, |m| m.view.fit())]),
            line(
                "0, Ctrl + 0",
                "one texel per pixel",
                &[
                    (NONE, Key::Num0, |m| display::magnify(m, 1.0)),
                    (COMMAND, Key::Num0, |m| display::magnify(m, 1.0)),
                ],
            ),
            line(
                "R",
                "reset light, view, zoom, exposure and clipping marks",
                &[(NONE, Key::R, display::reset)],
            ),
        ],
    ),
    (
        "Compare",
        &[
            line("1 .. 9", "choose the prediction", &[]),
            line("Shift + 1 .. 9", "make the prediction the ground truth", &[]),
            line(
                "Ctrl + Up / Down",
                "previous / next prediction",
                &[
                    (COMMAND, Key::ArrowUp, |m| display::step_prediction(m, -1)),
                    (COMMAND, Key::ArrowDown, |m| display::step_prediction(m, 1)),
                ],
            ),
            line("Down / Up, Ctrl + Tab", "next / previous prediction; Home / End: first / last", &[]),
            line("G or Shift (hold)", "show the ground truth in every pane", &[]),
            line(
                "Menu, Compare blind",
                "whether one sees the difference of two materials: is X A or B? A / B answers, Esc ends",
                &[],
            ),
            line("X", "swap prediction and ground truth", &[(NONE, Key::X, |m| m.swapped ^= true)]),
            line("C", "layout: side by side, wipe, single", &[(NONE, Key::C, display::cycle_layout)]),
            line(
                "D",
                "value / difference from the ground truth",
                &[(NONE, Key::D, |m| m.view.display.difference ^= true)],
            ),
        ],
    ),
    (
        "Show",
        &[
            line(
                "M / Shift + M",
                "next / previous of rendering and maps",
                &[
                    (NONE, Key::M, |m| display::cycle_quantity(m, 1)),
                    (SHIFT, Key::M, |m| display::cycle_quantity(m, -1)),
                ],
            ),
            line(
                "E / Shift + E",
                "exposure up / down by 0.5 EV",
                &[
                    (NONE, Key::E, |m| display::step_exposure(m, 0.5)),
                    (SHIFT, Key::E, |m| display::step_exposure(m, -0.5)),
                ],
            ),
            line(
                "N / Shift + N",
                "automatic exposure, once / following light and view: the brightest 1% of the ground truth clips",
                &[
                    (NONE, Key::N, |m| display::choose_exposure(m, AutoExposure::Once)),
                    (SHIFT, Key::N, |m| display::choose_exposure(m, AutoExposure::Follow)),
                ],
            ),
            line(
                "V",
                "false colours for roughness, on / off",
                &[(NONE, Key::V, |m| m.view.display.false_colour ^= true)],
            ),
            line(
                "L",
                "mark clipped pixels, on / off",
                &[(NONE, Key::L, |m| m.view.display.show_clipping ^= true)],
            ),
            line(
                "I, Alt + click",
                "pin the texel: all its numbers in a table below; again: remove the pin",
                &[(NONE, Key::I, pin_here)],
            ),
            line(
                "Q, then left-drag; on maps Shift + left-drag",
                "rectangle that a strip magnifies; Esc removes it",
                &[(NONE, Key::Q, |m| m.inspection.is_armed = true)],
            ),
        ],
    ),
    (
        "Data set",
        &[
            line(
                "Page down / Page up",
                "next / previous material of the list, as Down and Up; Home / End: first / last",
                &[],
            ),
            line("Ctrl + F", "find a material by its name; Esc shows all", &[(COMMAND, Key::F, find)]),
            line(
                "A / S",
                "list of materials beside the panes / table with pictures, on / off",
                &[
                    (NONE, Key::A, |m| of_dataset(m, |dataset| dataset.list.is_open ^= true)),
                    (NONE, Key::S, |m| {
                        of_dataset(m, |dataset| dataset.show_table(!dataset.table.has_pictures))
                    }),
                ],
            ),
            line(
                "K",
                "mark the material, or remove its mark",
                &[(NONE, Key::K, |m| of_dataset(m, DatasetState::toggle_mark))],
            ),
            line("Enter, double-click", "a row of the table becomes the panes; Esc returns", &[]),
            line(
                "wheel over the table",
                "size of its pictures, at last the panes; over the names it scrolls",
                &[],
            ),
        ],
    ),
    (
        "Files",
        &[
            line(
                "Ctrl + O / Ctrl + Shift + O",
                "open materials or a session / reopen the last materials",
                &[(COMMAND, Key::O, OPEN), (BOTH, Key::O, |m| opening::reopen(m, 0))],
            ),
            line(
                "Ctrl + S / Ctrl + Shift + C",
                "save view, renderings, strip or session / copy the view as a picture",
                &[(COMMAND, Key::S, SAVE), (BOTH, Key::C, COPY_PICTURE)],
            ),
            line(
                "Ctrl + R",
                "read all files again; of a data set, those of the material and those that are newer",
                &[(COMMAND, Key::R, opening::reload)],
            ),
            line(
                "Ctrl + W",
                "close the chosen prediction",
                &[(COMMAND, Key::W, |m| opening::close(m, m.view.display.prediction + 1))],
            ),
            line("Ctrl + C / Ctrl + V", "copy the scene as JSON / paste a scene", &[]),
        ],
    ),
    (
        "Window",
        &[
            line(
                "Ctrl + Z / Ctrl + Shift + Z",
                "undo / redo light, view, display, materials and photograph (redo also: Ctrl + Y)",
                &[(COMMAND, Key::Z, undo::undo), (BOTH, Key::Z, undo::redo), (COMMAND, Key::Y, undo::redo)],
            ),
            line(
                "Esc",
                "close a dialog, cancel a search or the loss, or show the whole prediction again",
                &[],
            ),
            line("B", "side panel, on / off", &[(NONE, Key::B, Model::toggle_side_panel)]),
            line(
                "Ctrl + plus / minus",
                "size of text and controls",
                &[
                    (COMMAND, Key::Plus, |m| scale(m, 1.0)),
                    (COMMAND, Key::Equals, |m| scale(m, 1.0)),
                    (COMMAND, Key::Minus, |m| scale(m, -1.0)),
                ],
            ),
            line("double-click a number", "reset it to its default", &[]),
            line("?, F1", "this help", &[(NONE, Key::F1, |m| m.help = true)]),
        ],
    ),
];

/// Changes the scale of text and controls by this many tenths.
fn scale(model: &mut Model, steps: f32) {
    let scale = ((10.0 * model.settings.ui_scale).round() + steps) / 10.0;
    model.settings.ui_scale = scale.clamp(*UI_SCALE.start(), *UI_SCALE.end());
}

/// Pins the texel under the pointer, or removes its pin; without one, the texel last under it.
pub fn pin_here(model: &mut Model) {
    if let Some(texel) = model.geometry.texel {
        model.inspection.toggle_pin(texel);
    }
}

/// Shows the list of the data set with the focus in its search.
fn find(model: &mut Model) {
    of_dataset(model, |dataset| (dataset.list.is_open, dataset.finds) = (true, true));
}

/// Edits the data set, where there is one and nothing is before it.
fn of_dataset(model: &mut Model, edit: impl FnOnce(&mut DatasetState)) {
    if model.dataset.open.is_some() && !model.is_modal() {
        edit(&mut model.dataset);
    }
}
