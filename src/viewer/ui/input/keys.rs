//! The keys: a table of commands, and the help that `?` shows.

use eframe::egui::{self, Key, Modifiers};

use crate::model::command::{
    Command, DisplayCommand, InspectionCommand, LossCommand, MaterialsCommand, SceneCommand, WindowCommand,
};

use crate::model::view::state::AutoExposure;

/// A gesture or keys, and what they do.
pub type HelpLine = (&'static str, &'static str);

/// Every gesture and key with its effect, in groups, for the help window and docs/window.md.
pub const HELP: &[(&str, &[HelpLine])] = &[
    (
        "Light",
        &[
            ("left-drag", "move the light: its x and y follow the pointer; on maps, pan"),
            ("Shift + wheel", "height of the light"),
            ("Ctrl + Shift + left-drag", "orbit the light"),
            ("Ctrl + Shift + right-drag", "distance of the light"),
            ("H", "highlight follows the pointer, on / off"),
        ],
    ),
    (
        "View",
        &[
            (
                "right-drag",
                "move the view; in perspective, turn the material, up to 85 degrees off its normal",
            ),
            ("Alt + wheel", "height of the view"),
            ("P", "flat / perspective"),
        ],
    ),
    (
        "Zoom",
        &[
            ("wheel", "zoom at the pointer"),
            ("middle-drag, Space + left-drag", "pan"),
            ("F", "fit the material"),
            ("0", "one texel per pixel"),
            ("R", "reset light, view, zoom, exposure and clipping marks"),
        ],
    ),
    (
        "Compare",
        &[
            ("1 .. 9", "choose the prediction"),
            ("Ctrl + Up / Down", "previous / next prediction"),
            ("G (hold)", "show the ground truth in every pane"),
            ("X", "swap prediction and ground truth"),
            ("C", "layout: side by side, wipe, single"),
            ("D", "value / difference from the ground truth"),
            ("Enter", "compute the loss"),
        ],
    ),
    (
        "Show",
        &[
            ("M / Shift + M", "next / previous of rendering and maps"),
            ("E / Shift + E", "exposure up / down by 0.5 EV"),
            (
                "N / Shift + N",
                "automatic exposure, once / following light and view: the brightest 1% of the ground truth clips",
            ),
            ("V", "false colours for roughness, on / off"),
            ("L", "mark clipped pixels, on / off"),
            ("I, Alt + click", "pin the texel: all its numbers in a table below; again: remove the pin"),
            (
                "Q, then left-drag; on maps Shift + left-drag",
                "rectangle that a strip magnifies; Esc removes it",
            ),
        ],
    ),
    (
        "Data set",
        &[
            ("Page down / Page up", "next / previous material of the list"),
            ("A / S", "list of materials / contact sheet, on / off"),
            ("K", "mark the material, or remove its mark"),
            ("wheel over the sheet", "size of its cells; over the names it scrolls"),
        ],
    ),
    (
        "Files",
        &[
            ("Ctrl + O / Ctrl + Shift + O", "open materials or a session / reopen the last materials"),
            (
                "Ctrl + S / Ctrl + Shift + C",
                "save view, renderings, strip, report or session / copy the view as a picture",
            ),
            ("Ctrl + R", "read all files again"),
            ("Ctrl + C / Ctrl + V", "copy the scene as JSON / paste a scene"),
        ],
    ),
    (
        "Window",
        &[
            (
                "Ctrl + Z / Ctrl + Shift + Z",
                "undo / redo light, view, display, materials and photograph (redo also: Ctrl + Y)",
            ),
            ("Esc", "close a dialog, cancel a search or the loss, or show the whole prediction again"),
            ("B", "side panel, on / off"),
            ("Ctrl + plus / minus / 0", "size of text and controls"),
            ("double-click a number", "reset it to its default"),
            ("?, F1", "this help"),
        ],
    ),
];

/// What the commands of the keys depend on.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// Whether Enter computes the loss: no widget has the focus.
    pub enter_is_free: bool,
    /// The command of Escape.
    pub escape: &'a Command,
    /// Whether panes show the difference, which `D` toggles.
    pub difference: bool,
}

/// The commands of the keys pressed in this frame; none while a text field has the focus.
pub fn commands(ctx: &egui::Context, now: Context<'_>) -> Vec<Command> {
    if ctx.text_edit_focused() {
        return Vec::new();
    }
    // An open menu or drop-down takes Esc for itself.
    let is_taken = |key| key == Key::Escape && egui::Popup::is_any_open(ctx);
    let table: Vec<_> = table(now).into_iter().filter(|(_, key, _)| !is_taken(*key)).collect();
    let mut commands = ctx.input_mut(|input| {
        let mut found = Vec::new();
        for (modifiers, key, command) in table {
            let presses = input.count_and_consume_key(modifiers, key);
            found.extend(std::iter::repeat_n(command, presses));
        }
        found
    });
    commands.extend(ctx.input(|input| input.events.iter().filter_map(event_command).collect::<Vec<_>>()));
    commands
}

/// Copy and paste arrive as events, and `?` is on another key of every keyboard.
fn event_command(event: &egui::Event) -> Option<Command> {
    match event {
        egui::Event::Copy => Some(SceneCommand::Copy.into()),
        egui::Event::Paste(text) => Some(SceneCommand::Paste(text.clone()).into()),
        egui::Event::Text(text) if text == "?" => Some(WindowCommand::ShowHelp(true).into()),
        _ => None,
    }
}

/// Longer chords first: `count_and_consume_key` takes the first that is contained in the one pressed.
fn table(now: Context<'_>) -> Vec<(Modifiers, Key, Command)> {
    let none = Modifiers::NONE;
    let mut table: Vec<(Modifiers, Key, Command)> = vec![
        (Modifiers::COMMAND | Modifiers::SHIFT, Key::Z, DisplayCommand::Redo.into()),
        (Modifiers::COMMAND | Modifiers::SHIFT, Key::O, MaterialsCommand::Reopen(0).into()),
        (Modifiers::COMMAND | Modifiers::SHIFT, Key::C, WindowCommand::CopyPicture.into()),
        (Modifiers::COMMAND, Key::Z, DisplayCommand::Undo.into()),
        (Modifiers::COMMAND, Key::Y, DisplayCommand::Redo.into()),
        (Modifiers::COMMAND, Key::O, WindowCommand::ShowOpen(true).into()),
        (Modifiers::COMMAND, Key::S, WindowCommand::ShowSave(true).into()),
        (Modifiers::COMMAND, Key::R, MaterialsCommand::Reload.into()),
        (Modifiers::COMMAND, Key::ArrowUp, DisplayCommand::StepPrediction(-1).into()),
        (Modifiers::COMMAND, Key::ArrowDown, DisplayCommand::StepPrediction(1).into()),
        (Modifiers::SHIFT, Key::M, DisplayCommand::CycleQuantity(-1).into()),
        (Modifiers::SHIFT, Key::E, DisplayCommand::StepExposure(-0.5).into()),
        (none, Key::M, DisplayCommand::CycleQuantity(1).into()),
        (none, Key::E, DisplayCommand::StepExposure(0.5).into()),
        (Modifiers::SHIFT, Key::N, DisplayCommand::AutoExposure(AutoExposure::Follow).into()),
        (none, Key::N, DisplayCommand::AutoExposure(AutoExposure::Once).into()),
        (none, Key::C, DisplayCommand::CycleLayout.into()),
        (none, Key::D, DisplayCommand::ShowDifference(!now.difference).into()),
        (none, Key::P, DisplayCommand::ToggleProjection.into()),
        (none, Key::V, DisplayCommand::ToggleFalseColour.into()),
        (none, Key::L, DisplayCommand::ToggleClipping.into()),
        (none, Key::H, SceneCommand::ToggleHighlightFollows.into()),
        (none, Key::B, WindowCommand::ToggleSidePanel.into()),
        (none, Key::X, DisplayCommand::Swap.into()),
        (none, Key::F, DisplayCommand::Fit.into()),
        (none, Key::Num0, DisplayCommand::OneToOne.into()),
        (none, Key::R, DisplayCommand::Reset.into()),
        (none, Key::I, InspectionCommand::TogglePinHere.into()),
        (none, Key::Q, InspectionCommand::Arm(true).into()),
        (none, Key::F1, WindowCommand::ShowHelp(true).into()),
        (none, Key::Escape, now.escape.clone()),
    ];
    let digits =
        [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7, Key::Num8, Key::Num9];
    if now.enter_is_free {
        table.push((none, Key::Enter, LossCommand::Compute.into()));
    }
    table.extend(
        digits
            .into_iter()
            .enumerate()
            .map(|(i, key)| (none, key, DisplayCommand::ChoosePrediction(i).into())),
    );
    table
}
