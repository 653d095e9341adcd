//! The keys: one table that is obeyed, and shown by `?`.

use eframe::egui::{self, Key, Modifiers};

use super::command::Command;

/// Every gesture and key, for the help window and the README: (what to do, what it does).
pub const HELP: &[(&str, &str)] = &[
    ("left-drag", "move the light (its x, y follow the pointer)"),
    ("right-drag", "move the view (in perspective: orbit it)"),
    ("Shift + wheel", "height of the light"),
    ("Alt + wheel", "height of the view"),
    ("Ctrl + Shift + left-drag", "orbit the light"),
    ("Ctrl + Shift + right-drag", "distance of the light"),
    ("H", "highlight follows the pointer, on / off"),
    ("wheel", "zoom at the pointer"),
    ("middle-drag, Space + left-drag", "pan"),
    ("F / 0 / R", "fit / one texel per pixel / reset light, view, zoom, exposure and clipping marks"),
    ("G (hold)", "peek at the ground truth in every pane"),
    ("X", "swap prediction and ground truth"),
    ("1 .. 9", "choose the prediction"),
    ("C", "layout: side by side, wipe, single, log difference"),
    ("P", "flat / perspective"),
    ("M / Shift + M", "next / previous map shown"),
    ("E / Shift + E", "exposure up / down by 0.5 EV"),
    ("N", "normalize the exposure to the ground truth"),
    ("L", "mark clipped pixels, on / off"),
    ("Enter", "compute the loss"),
    ("Esc", "close a window, or cancel the loss"),
    ("B", "side panel, on / off"),
    ("Ctrl + O / Ctrl + S", "open / save the view as a picture"),
    ("Ctrl + R", "read all files again"),
    ("Ctrl + Z / Ctrl + Shift + Z", "undo / redo light, view and display"),
    ("Ctrl + C / Ctrl + V", "copy / paste the scene as JSON"),
    ("double-click a number", "back to its default"),
    ("?", "this help"),
];

/// What the command of a key depends on.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// Whether no button has the focus, which Enter would press.
    pub enter_is_free: bool,
    /// What Escape does.
    pub escape: &'a Command,
}

/// The commands of the keys pressed in this frame. While a text field has the focus there are none.
pub fn commands(ctx: &egui::Context, now: Context<'_>) -> Vec<Command> {
    if ctx.text_edit_focused() {
        return Vec::new();
    }
    let mut commands = ctx.input_mut(|input| {
        let mut found = Vec::new();
        for (modifiers, key, command) in table(now) {
            let presses = input.count_and_consume_key(modifiers, key);
            found.extend(std::iter::repeat_n(command, presses));
        }
        found
    });
    commands.extend(ctx.input(|input| input.events.iter().filter_map(event_command).collect::<Vec<_>>()));
    commands
}

/// Copy and paste reach a program as events of their own, and `?` is another key on every keyboard.
fn event_command(event: &egui::Event) -> Option<Command> {
    match event {
        egui::Event::Copy => Some(Command::CopyScene),
        egui::Event::Paste(text) => Some(Command::PasteScene(text.clone())),
        egui::Event::Text(text) if text == "?" => Some(Command::SetHelp(true)),
        _ => None,
    }
}

/// Longer chords first: `count_and_consume_key` takes a shorter one for them.
fn table(now: Context<'_>) -> Vec<(Modifiers, Key, Command)> {
    use Command as C;
    let none = Modifiers::NONE;
    let mut table = vec![
        (Modifiers::COMMAND | Modifiers::SHIFT, Key::Z, C::Redo),
        (Modifiers::COMMAND, Key::Z, C::Undo),
        (Modifiers::COMMAND, Key::O, C::ShowOpen(true)),
        (Modifiers::COMMAND, Key::S, C::ShowSave(true)),
        (Modifiers::COMMAND, Key::R, C::Reload),
        (Modifiers::SHIFT, Key::M, C::CycleShown(-1)),
        (Modifiers::SHIFT, Key::E, C::StepExposure(-0.5)),
        (none, Key::M, C::CycleShown(1)),
        (none, Key::E, C::StepExposure(0.5)),
        (none, Key::N, C::Normalize),
        (none, Key::C, C::CycleLayout),
        (none, Key::P, C::ToggleProjection),
        (none, Key::L, C::ToggleClipping),
        (none, Key::H, C::ToggleHighlightFollows),
        (none, Key::B, C::ToggleSidePanel),
        (none, Key::X, C::SwapSides),
        (none, Key::F, C::Fit),
        (none, Key::Num0, C::OneToOne),
        (none, Key::R, C::Reset),
        (none, Key::Escape, now.escape.clone()),
    ];
    let digits =
        [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7, Key::Num8, Key::Num9];
    if now.enter_is_free {
        table.push((none, Key::Enter, C::ComputeLoss));
    }
    table.extend(digits.into_iter().enumerate().map(|(i, key)| (none, key, C::ChoosePrediction(i))));
    table
}
