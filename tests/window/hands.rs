//! What the hand does in a window: clicks, keys, drags and dropped files.

use super::*;

/// Opens a tab of the side panel.
pub fn tab(window: &mut Window<'_>, name: &str) {
    click(window, &format!("Tab {name}"));
}

pub fn click(window: &mut Window<'_>, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(4);
}

/// Types `text` into the number called `name`.
pub fn enter(window: &mut Window<'_>, name: &str, text: &str) {
    window.get_by_role_and_label(Role::SpinButton, name).click();
    window.run_steps(2);
    window.get_by_role_and_label(Role::SpinButton, name).type_text(text);
    press(window, egui::Key::Enter);
}

/// Clicks the drop-down `name`, then `choice` in it.
pub fn choose(window: &mut Window<'_>, name: &str, choice: &str) {
    window.get_by_role_and_label(Role::ComboBox, name).click();
    window.run_steps(4);
    window.get_by_label(choice).click();
    window.run_steps(4);
}

/// Undoes by its keys what was done long enough ago to be a state to return to.
pub fn undo(window: &mut Window<'_>) {
    window.run_steps(30);
    press_with(window, Modifiers::COMMAND, egui::Key::Z);
}

pub fn press_with(window: &mut Window<'_>, modifiers: Modifiers, key: egui::Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(3);
}

/// Replaces the text of the field that has the focus.
pub fn retype(window: &mut Window<'_>, text: &str) {
    press_with(window, Modifiers::COMMAND, egui::Key::A);
    window.event(egui::Event::Text(text.to_owned()));
    window.run_steps(2);
}

/// Drops files on the window.
pub fn drop_files(window: &mut Window<'_>, paths: impl IntoIterator<Item = PathBuf>) {
    window.input_mut().dropped_files =
        paths.into_iter().map(|path| Arc::new(Dropped::File(path)) as _).collect();
}

pub fn press(window: &mut Window<'_>, key: egui::Key) {
    window.key_press(key);
    window.run_steps(3);
}

pub fn hover(window: &mut Window<'_>, at: Pos2) {
    window.event(egui::Event::PointerMoved(at));
    window.run_steps(2);
}

pub fn pointer(pos: Pos2, button: egui::PointerButton, pressed: bool) -> egui::Event {
    egui::Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }
}

pub fn primary(pos: Pos2, pressed: bool) -> egui::Event {
    pointer(pos, egui::PointerButton::Primary, pressed)
}

pub fn wheel(delta: Vec2, unit: egui::MouseWheelUnit, modifiers: Modifiers) -> egui::Event {
    let (phase, source) = (egui::TouchPhase::Move, egui::MouseWheelSource::Wheel);
    egui::Event::MouseWheel { unit, delta, phase, source, modifiers }
}

pub fn drag_primary(window: &mut Window<'_>, rect: egui::Rect, from: Vec2, to: Vec2) {
    drag(window, egui::PointerButton::Primary, rect, from, to);
}

/// Drags with a button from one point of the pane to another, both as shares of its size.
pub fn drag(window: &mut Window<'_>, button: egui::PointerButton, rect: egui::Rect, from: Vec2, to: Vec2) {
    let at = |share: Vec2| rect.min + rect.size() * share;
    for event in [
        egui::Event::PointerMoved(at(from)),
        pointer(at(from), button, true),
        egui::Event::PointerMoved(at((from + to) * 0.5)),
        egui::Event::PointerMoved(at(to)),
        pointer(at(to), button, false),
    ] {
        window.event(event);
        window.run_steps(2);
    }
}

/// A file as a window system drops it, or a planted fault of the frame that looks at it.
#[derive(Debug)]
pub enum Dropped {
    File(PathBuf),
    Panic,
    LostDevice(svbrdf_gpu::Gpu),
}

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        match self {
            Self::File(path) => path,
            Self::Panic => panic!("a planted fault"),
            Self::LostDevice(gpu) => {
                gpu.lose();
                // On another thread, as by a driver: it wakes the window, whose input is locked here.
                let told = gpu.clone();
                std::thread::spawn(move || told.loss_by_now().is_some());
                while gpu.loss().is_none() {
                    std::thread::yield_now();
                }
                Path::new("none.png")
            }
        }
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(self.path()).map_err(|e| e.to_string())
    }
}
