//! Long use: a seeded monkey presses, drags, scrolls, types and clicks everything, while files change underneath.

use egui::{Key, PointerButton};

use super::*;

/// Events that are played.
const EVENTS: usize = 500;
/// Most pixels of textures of panels and fonts, of which an egui window of this size needs a few million.
const MOST_TEXTURE_PIXELS: usize = 40_000_000;

/// What a person types into fields.
const TEXTS: [&str; 8] = ["0.5", "-1e9", "NaN", "12", "no/such/file.png", "\u{202e}abc", "", "1, 2, 3"];

pub fn below(random: &mut ChaCha8Rng, limit: usize) -> usize {
    random.next_u32() as usize % limit.max(1)
}

fn one_of<T: Copy>(random: &mut ChaCha8Rng, all: &[T]) -> T {
    all[below(random, all.len())]
}

/// Writes a material whose albedo depends on `shift`.
pub fn write(path: &Path, shift: usize) {
    write_packed(path, 16, |tile, x, y| {
        let [u, v] = [x, y].map(|at| 16 * at as u8);
        let albedo = u.wrapping_add(8 * shift as u8);
        [[64 + u / 2, 64 + v / 2, 220], [albedo, 76, v], [50 + v / 2; 3], [10, 10 + u / 10, 10]]
            [tile as usize]
    });
}

/// Changes a file as programs do: other pixels, another size, half of it, gone, or back.
fn change(path: &Path, random: &mut ChaCha8Rng) {
    match below(random, 6) {
        0 => std::fs::write(path, b"no picture").unwrap(),
        1 => drop(std::fs::remove_file(path)),
        2 => image::RgbImage::from_pixel(128, 32, image::Rgb([128, 128, 255])).save(path).unwrap(),
        3 => {
            write(path, 1);
            let bytes = std::fs::read(path).unwrap();
            std::fs::write(path, &bytes[..bytes.len() / 2]).unwrap();
        }
        _ => write(path, below(random, 20)),
    }
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
    if all.is_empty() { place(window, random) } else { one_of(random, &all) }
}

/// One event, and its description.
fn event(window: &mut Window<'_>, files: &[PathBuf], random: &mut ChaCha8Rng) -> String {
    const MODIFIERS: [Modifiers; 8] = [
        Modifiers::COMMAND,
        Modifiers::COMMAND,
        Modifiers::SHIFT,
        Modifiers::COMMAND.plus(Modifiers::SHIFT),
        Modifiers::ALT,
        Modifiers::NONE,
        Modifiers::NONE,
        Modifiers::NONE,
    ];
    const BUTTONS: [PointerButton; 4] =
        [PointerButton::Primary, PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle];
    let (modifiers, button) = (one_of(random, &MODIFIERS), one_of(random, &BUTTONS));
    let (from, to) = (place(window, random), place(window, random));
    match below(random, 20) {
        0..=5 => {
            let key = one_of(random, Key::ALL);
            window.key_press_modifiers(modifiers, key);
            format!("{modifiers:?} {key:?}")
        }
        action @ 6..=10 => {
            let (at, button) =
                if action < 10 { (control(window, random), PointerButton::Primary) } else { (from, button) };
            window.event(egui::Event::PointerMoved(at));
            window.event(pointer(at, button, true));
            window.step();
            window.event(pointer(at, button, false));
            format!("{button:?} at {at:?}")
        }
        11..=14 => {
            let screen = egui::Rect::from_min_size(Pos2::ZERO, vec2(1.0, 1.0));
            drag(window, button, screen, from.to_vec2(), to.to_vec2());
            format!("drag {button:?} {from:?} {to:?}")
        }
        15 | 16 => {
            window.event(egui::Event::PointerMoved(from));
            let delta = vec2(0.0, one_of(random, &[-120.0, -10.0, 10.0, 120.0]));
            window.event(wheel(delta, egui::MouseWheelUnit::Point, modifiers));
            format!("wheel {delta:?}")
        }
        17 => {
            let text = one_of(random, &TEXTS);
            window.event(egui::Event::Text(text.to_owned()));
            format!("text {text:?}")
        }
        18 => {
            let size = one_of(random, &[vec2(1200.0, 800.0), vec2(640.0, 420.0), vec2(1500.0, 500.0)]);
            window.set_size(size);
            format!("size {size:?}")
        }
        _ => {
            change(&files[below(random, files.len())], random);
            "a file changes".to_owned()
        }
    }
}

#[needs(adapter)]
fn five_hundred_events_of_a_monkey_crash_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let files = ["truth.png", "a.png", "b.png"].map(|name| folder.path().join(name));
    files.iter().enumerate().for_each(|(index, path)| write(path, index));
    // Nothing is saved beside them but what the monkey saves itself.
    let mut window = on_files(files.clone());
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut played = Vec::new();
    for number in 0..EVENTS {
        played.push(event(&mut window, &files, &mut random));
        window.run_steps(1 + below(&mut random, 3));
        let last = &played[number.saturating_sub(7)..];
        assert!(!window.state().has_crashed(), "event {number}: {last:#?}");
        // Nothing is written where the tests run.
        window.state_mut().parts.model.dialogs.save = None;
        if number % 100 == 99 {
            let textures = window.ctx.tex_manager();
            let textures = textures.read();
            let pixels: usize = textures.allocated().map(|(_, meta)| meta.size[0] * meta.size[1]).sum();
            let messages = window.messages().len();
            assert!(pixels < MOST_TEXTURE_PIXELS && messages < 60, "{pixels} pixels, {messages} messages");
            // Opened again, as a person does after the window has lost all of them.
            if window.names().len() < 2 {
                files.iter().for_each(|path| write(path, 0));
                drop_files(&mut window, files.clone());
            }
        }
        if number % 25 == 24 {
            window.render().unwrap();
        }
    }
}
