//! Long use: a seeded monkey presses, drags, scrolls, types and clicks everything, while files change underneath.

use egui::{Key, PointerButton};
use rand::rngs::ChaCha8Rng;
use rand::{Rng as _, SeedableRng as _};

use super::*;

/// Events that are played.
const EVENTS: usize = 500;
/// Most pixels of textures of panels and fonts, of which an egui window of this size needs a few million.
const MOST_TEXTURE_PIXELS: usize = 40_000_000;

/// What a person types into fields.
const TEXTS: [&str; 8] = ["0.5", "-1e9", "NaN", "12", "no/such/file.png", "\u{202e}abc", "", "1, 2, 3"];

/// The materials on disk, which change.
struct Files {
    _folder: tempfile::TempDir,
    names: Vec<PathBuf>,
}

impl Files {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let names = ["truth.png", "a.png", "b.png"].map(|name| folder.path().join(name)).into();
        let files = Self { _folder: folder, names };
        (0..3).for_each(|index| files.write(index, index as f64));
        files
    }

    /// Writes a material whose albedo depends on `shift`.
    fn write(&self, index: usize, shift: f64) {
        let strip = pictures::packed(|value| (value + 0.03 * shift).fract());
        strip.save(&self.names[index]).unwrap();
    }

    /// Changes one file as programs do: other pixels, another size, half of it, gone, or back.
    fn change(&self, random: &mut ChaCha8Rng) {
        let index = below(random, 3);
        let path = &self.names[index];
        match below(random, 6) {
            0 => std::fs::write(path, b"no picture").unwrap(),
            1 => drop(std::fs::remove_file(path)),
            2 => image::RgbImage::from_pixel(128, 32, image::Rgb([128, 128, 255])).save(path).unwrap(),
            3 => {
                self.write(index, 1.0);
                let bytes = std::fs::read(path).unwrap();
                std::fs::write(path, &bytes[..bytes.len() / 2]).unwrap();
            }
            _ => self.write(index, below(random, 20) as f64),
        }
    }
}

pub fn below(random: &mut ChaCha8Rng, limit: usize) -> usize {
    random.next_u32() as usize % limit.max(1)
}

/// A point of the window.
fn place(window: &Window<'_>, random: &mut ChaCha8Rng) -> Pos2 {
    let size = window.ctx.content_rect().size();
    let mut share = || (random.next_u32() as f32 / u32::MAX as f32).clamp(0.001, 0.999);
    egui::pos2(size.x * share(), size.y * share())
}

/// The middle of a control or of a field.
fn control(window: &Window<'_>, random: &mut ChaCha8Rng) -> Pos2 {
    let fields = [Role::TextInput, Role::MultilineTextInput, Role::Link];
    let fields = fields.into_iter().flat_map(|role| window.query_all_by_role(role));
    let mut all: Vec<Pos2> = super::bar::controls(window).into_iter().map(|(_, at)| at).collect();
    all.extend(fields.map(|node| node.rect().center()));
    if all.is_empty() { place(window, random) } else { all[below(random, all.len())] }
}

fn modifiers(random: &mut ChaCha8Rng) -> Modifiers {
    match below(random, 8) {
        0 | 1 => Modifiers::COMMAND,
        2 => Modifiers::SHIFT,
        3 => Modifiers::COMMAND | Modifiers::SHIFT,
        4 => Modifiers::ALT,
        _ => Modifiers::NONE,
    }
}

fn click_at(window: &mut Window<'_>, at: Pos2, button: PointerButton) {
    window.event(egui::Event::PointerMoved(at));
    window.event(pointer(at, button, true));
    window.step();
    window.event(pointer(at, button, false));
}

/// One event, and its name.
fn event(window: &mut Window<'_>, files: &Files, random: &mut ChaCha8Rng) -> String {
    let button =
        [PointerButton::Primary, PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle]
            [below(random, 4)];
    match below(random, 20) {
        0..=5 => {
            let (key, with) = (Key::ALL[below(random, Key::ALL.len())], modifiers(random));
            window.key_press_modifiers(with, key);
            format!("{with:?} {key:?}")
        }
        6..=9 => {
            let at = control(window, random);
            click_at(window, at, PointerButton::Primary);
            format!("control at {at:?}")
        }
        10 => {
            let at = place(window, random);
            click_at(window, at, button);
            format!("{button:?} at {at:?}")
        }
        11..=14 => {
            let (from, to) = (place(window, random), place(window, random));
            window.event(egui::Event::PointerMoved(from));
            window.event(pointer(from, button, true));
            for share in [0.3, 0.7, 1.0] {
                window.step();
                window.event(egui::Event::PointerMoved(from + (to - from) * share));
            }
            window.step();
            window.event(pointer(to, button, false));
            format!("drag {button:?} {from:?} {to:?}")
        }
        15 | 16 => {
            let at = place(window, random);
            window.event(egui::Event::PointerMoved(at));
            let delta = vec2(0.0, [-120.0, -10.0, 10.0, 120.0][below(random, 4)]);
            window.event(wheel(delta, egui::MouseWheelUnit::Point, modifiers(random)));
            format!("wheel {delta:?}")
        }
        17 => {
            let text = TEXTS[below(random, TEXTS.len())];
            window.event(egui::Event::Text(text.to_owned()));
            format!("text {text:?}")
        }
        18 => {
            let size = [vec2(1200.0, 800.0), vec2(640.0, 420.0), vec2(1500.0, 500.0)][below(random, 3)];
            window.set_size(size);
            format!("size {size:?}")
        }
        _ => {
            files.change(random);
            "a file changes".to_owned()
        }
    }
}

/// Opens the materials again, as a person does after the window has lost all of them.
fn reopen(window: &mut Window<'_>, files: &Files) {
    (0..3).for_each(|index| files.write(index, 0.0));
    drop_files(window, files.names.clone());
}

/// Pixels of the textures of panels and fonts.
fn texture_pixels(window: &Window<'_>) -> usize {
    let textures = window.ctx.tex_manager();
    textures.read().allocated().map(|(_, meta)| meta.size[0] * meta.size[1]).sum()
}

#[needs(adapter)]
fn five_hundred_events_of_a_monkey_crash_nothing() {
    let files = Files::new();
    // Nothing is saved beside them but what the monkey saves itself.
    let mut window = on_files(files.names.clone());
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut last = Vec::new();
    for number in 0..EVENTS {
        last.push(event(&mut window, &files, &mut random));
        if last.len() > 8 {
            last.remove(0);
        }
        window.run_steps(1 + below(&mut random, 3));
        assert!(!window.state().has_crashed(), "event {number}: {last:#?}");
        // Nothing is written where the tests run.
        window.state_mut().parts.ui.dialogs.save = None;
        if number % 100 == 99 {
            let (pixels, messages) = (texture_pixels(&window), window.state().messages().len());
            assert!(pixels < MOST_TEXTURE_PIXELS && messages < 60, "{pixels} pixels, {messages} messages");
            if window.state().names().len() < 2 {
                reopen(&mut window, &files);
            }
        }
        if number % 25 == 24 {
            window.render().unwrap();
        }
    }
}
