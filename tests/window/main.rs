//! The window without a window: egui_kittest drives it by accessible labels, on a real adapter.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]
#![allow(clippy::disallowed_methods, reason = "a test reads its own files")]

mod assumptions;
mod bar;
mod damaged;
mod dataset;
mod differences;
mod fields;
mod files;
mod gestures;
mod key_presses;
mod loss_panel;
mod materials;
mod observed;
mod order;
mod photograph;
mod quantities;
mod reading;
mod saving;
mod scene_files;
mod screenshots;
mod sizes;
mod snapshots;
mod soak;
mod stillness;
mod texels;
mod view;
mod why;

#[path = "../support/gpu.rs"]
#[allow(dead_code, reason = "the tests of the core use the rest")]
mod gpu;
#[path = "../support/npy.rs"]
mod npy;
#[path = "../support/surroundings.rs"]
mod surroundings;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use eframe::egui::accesskit::Role;
use eframe::egui::{self, Modifiers, Pos2, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use materials::{loss_in, losses, losses_in, materials, strip, strips, write_packed};
use observed::Observed as _;
use rand::rngs::ChaCha8Rng;
use rand::{Rng as _, SeedableRng as _};
use serde_json::json;
use soak::below;
use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::colour_map::difference_to_display;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::Statistics;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_f32;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::read::ReadOptions;
use svbrdf_files::session::Session;
use svbrdf_files::session::window::Framing;
use svbrdf_needs::needs;
use svbrdf_viewer::ViewerOptions;
use svbrdf_viewer::frame::keys;
use svbrdf_viewer::frame::storage::Storage;
use svbrdf_viewer::frame::{App, CrashGuard};
use svbrdf_viewer::model::dialogs::{SaveKind, SaveRequest};
use svbrdf_viewer::model::effect::Effect;
use svbrdf_viewer::model::endpoint;
use svbrdf_viewer::model::inspection::{Inspection, Region};
use svbrdf_viewer::model::settings::Tab;
use svbrdf_viewer::model::view::{AutoExposure, Layout, Projection, ViewState};
use svbrdf_viewer::model::{Model, display, exposure, opening, undo as history};

type Window<'a> = Harness<'a, App>;

/// The window on the given materials (none: the built-in pair), once they have been read.
fn window<'a>(options: ViewerOptions) -> Window<'a> {
    scaled_window(options, 1.0)
}

/// The window on a screen with this many pixels per point.
fn scaled_window<'a>(options: ViewerOptions, scale: f32) -> Window<'a> {
    guarded_window(options, CrashGuard::default(), scale)
}

/// The window that reports its end to this guard.
fn guarded_window<'a>(options: ViewerOptions, guard: CrashGuard, scale: f32) -> Window<'a> {
    gpu::gpu();
    let mut window = Harness::builder()
        .with_size(vec2(1200.0, 800.0))
        .with_pixels_per_point(scale)
        .with_max_steps(16)
        .with_step_dt(1.0 / 30.0)
        .wgpu()
        .build_eframe(|cc| App::new(cc, options, Storage::default()).guarded(guard));
    window.set_render_cursor(false);
    // Otherwise a pane tells what a drag does.
    window.state_mut().parts.model.settings.has_dragged = true;
    wait(&mut window, "the materials to be read", |app| {
        !app.is_reading() && (!app.names().is_empty() || !app.messages().is_empty())
    });
    window
}

/// Runs frames until `done`, or fails after a generous while.
fn wait(window: &mut Window<'_>, what: &str, done: impl Fn(&App) -> bool) {
    wait_in(window, what, |window| done(window.state()));
}

/// Runs frames until something that contains `text` is there.
fn see(window: &mut Window<'_>, text: &str) {
    wait_in(window, text, |window| window.query_all_by_label_contains(text).next().is_some());
}

fn wait_in(window: &mut Window<'_>, what: &str, done: impl Fn(&Window<'_>) -> bool) {
    for _ in 0..6000 {
        window.step();
        if done(window) {
            window.run_steps(3);
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    panic!("waited in vain for {what}");
}

/// Frames with time between them, in which work goes on behind the window.
fn rest(window: &mut Window<'_>, frames: usize) {
    for _ in 0..frames {
        window.step();
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
}

fn edit(window: &mut Window<'_>, edit: impl FnOnce(&mut Model)) {
    let ctx = window.ctx.clone();
    window.state_mut().edit(&ctx, edit);
    window.run_steps(2);
}

fn built_in<'a>() -> Window<'a> {
    window(ViewerOptions::default())
}

/// The built-in pair with the differences of its predictions.
fn with_differences<'a>() -> Window<'a> {
    let mut window = built_in();
    press(&mut window, egui::Key::D);
    statistics(&mut window);
    window
}

/// The window on the materials of these files, the ground truth first.
fn on_files<'a>(paths: impl IntoIterator<Item = PathBuf>) -> Window<'a> {
    window(options_of(paths))
}

fn options_of(paths: impl IntoIterator<Item = PathBuf>) -> ViewerOptions {
    let mut paths = paths.into_iter();
    ViewerOptions {
        ground_truth: paths.next().map(Into::into),
        predictions: paths.map(Into::into).collect(),
        ..ViewerOptions::default()
    }
}

/// The built-in pair, with the loss over the 6 + 3 scenes of the papers.
fn by_scenes<'a>() -> Window<'a> {
    let mut window = built_in();
    click(&mut window, "Scenes");
    window
}

/// Opens a tab of the side panel.
fn tab(window: &mut Window<'_>, name: &str) {
    click(window, &format!("Tab {name}"));
}

fn pane(window: &Window<'_>, title: &str) -> egui::Rect {
    window.get_by_label(&format!("Pane {title}")).rect()
}

const GROUND_TRUTH: &str = "GROUND TRUTH  worn tiles";
const PREDICTIONS: [&str; 2] = ["1  blurred normals", "2  wrong roughness"];

fn click(window: &mut Window<'_>, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(4);
}

fn has(window: &Window<'_>, text: &str) -> bool {
    window.query_all_by_label_contains(text).next().is_some()
}

/// Types `text` into the number called `name`.
fn enter(window: &mut Window<'_>, name: &str, text: &str) {
    window.get_by_role_and_label(Role::SpinButton, name).click();
    window.run_steps(2);
    window.get_by_role_and_label(Role::SpinButton, name).type_text(text);
    press(window, egui::Key::Enter);
}

/// Clicks the drop-down `name`, then `choice` in it.
fn choose(window: &mut Window<'_>, name: &str, choice: &str) {
    window.get_by_role_and_label(Role::ComboBox, name).click();
    window.run_steps(4);
    window.get_by_label(choice).click();
    window.run_steps(4);
}

/// Undoes by its keys what was done long enough ago to be a state to return to.
fn undo(window: &mut Window<'_>) {
    window.run_steps(30);
    press_with(window, Modifiers::COMMAND, egui::Key::Z);
}

fn press_with(window: &mut Window<'_>, modifiers: Modifiers, key: egui::Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(3);
}

/// Replaces the text of the field that has the focus.
fn retype(window: &mut Window<'_>, text: &str) {
    press_with(window, Modifiers::COMMAND, egui::Key::A);
    window.event(egui::Event::Text(text.to_owned()));
    window.run_steps(2);
}

/// Saves, and dismisses the message that says so.
fn save(window: &mut Window<'_>, kind: SaveKind, path: &Path) {
    let message = format!("Saved {}", path.display());
    edit(window, |model| model.effects.push(Effect::Save(SaveRequest { kind, path: path.to_owned() })));
    wait(window, "the file", |app| !app.messages().is_empty());
    assert_eq!(window.messages(), [message]);
    edit(window, |model| model.messages.dismiss_all());
}

/// Whether the bytes of a file contain a text.
fn file_contains(path: &Path, text: &str) -> bool {
    std::fs::read(path).unwrap().windows(text.len()).any(|window| window == text.as_bytes())
}

/// The width of an EXR, and its pixels.
fn read_exr(path: &Path) -> (usize, Vec<[f32; 3]>) {
    let read = exr::prelude::read_first_rgba_layer_from_file(
        path,
        |size, _| (size.width(), vec![[0f32; 3]; size.area()]),
        |(width, pixels), at, (r, g, b, _): (f32, f32, f32, f32)| {
            pixels[at.y() * *width + at.x()] = [r, g, b]
        },
    );
    read.unwrap().layer_data.channel_data.pixels
}

/// Opens files in the place of those of before.
fn open(window: &mut Window<'_>, paths: impl Into<Vec<PathBuf>>) {
    let paths = paths.into();
    edit(window, |model| opening::open(model, paths, true, ReadOptions::AUTO));
}

/// The window on a saved session.
fn on_session<'a>(path: &Path) -> Window<'a> {
    let session = Some(Session::read(path).unwrap());
    window(ViewerOptions { session, ..ViewerOptions::default() })
}

/// What the window asks of the system in the next frames.
fn commands(window: &mut Window<'_>) -> Vec<egui::OutputCommand> {
    let mut frame = || {
        window.step();
        window.output().platform_output.commands.clone()
    };
    (0..20).flat_map(|_| frame()).collect()
}

/// Chooses a difference of the quantity.
fn choose_difference(model: &mut Model, kind: Difference) {
    let display = &mut model.view.display;
    display.differences.choose(display.quantity, kind);
}

/// Sets the difference that has the last colour.
fn set_range(model: &mut Model, range: Option<f64>) {
    let display = &mut model.view.display;
    display.differences.set_range(display.quantity, range);
}

/// Drops files on the window.
fn drop_files(window: &mut Window<'_>, paths: impl IntoIterator<Item = PathBuf>) {
    window.input_mut().dropped_files =
        paths.into_iter().map(|path| Arc::new(Dropped::File(path)) as _).collect();
}

/// The statistics of the displayed differences, once they are there.
fn statistics(window: &mut Window<'_>) -> Vec<Statistics> {
    wait(window, "the statistics", |app| app.difference_statistics().is_some());
    window.difference_statistics().unwrap().iter().map(|one| one.unwrap()).collect()
}

/// Asserts that magnified texels of the pane `title` have the readout of the `start` of a column, and the colours, of `values`.
fn assert_texels(window: &mut Window<'_>, title: &str, start: &str, values: &[f32]) {
    let range = window.difference_range() as f32;
    let rect = pane(window, title);
    let mut reads = Vec::new();
    for share in [vec2(0.12, 0.17), vec2(0.83, 0.31), vec2(0.41, 0.88), vec2(0.62, 0.93)] {
        // The middle of a pixel.
        let at = (rect.min + rect.size() * share).floor() + vec2(0.5, 0.5);
        hover(window, at);
        window.run_steps(2);
        let [x, y] = texel_read(window).unwrap();
        let value = values[y * 256 + x];
        let text = column(window, start);
        let read: f32 = text[start.len()..].trim().parse().unwrap();
        // Four decimals, or three digits of what has more zeros.
        let bound = 5.1e-5_f32.max(0.005 * value.abs());
        assert!((read - value).abs() <= bound, "{title} at {x}, {y}: {text}, not {value}");
        reads.push((at, value));
    }
    hover(window, egui::pos2(600.0, 20.0));
    window.run_steps(2);
    let seen = pixels(window, rect);
    let far = |at: Pos2, value: f32| {
        let [x, y] = [at.x - rect.left().floor(), at.y - rect.top().floor()];
        let (found, expected) =
            (seen.get_pixel(x as u32, y as u32).0, difference_to_display(value, range, false));
        (0..3).map(|c| found[c].abs_diff(expected[c])).max().unwrap()
    };
    assert!(reads.iter().all(|(at, value)| far(*at, *value) <= 3), "{title}: {reads:?}");
    assert!(reads.iter().any(|(at, value)| far(*at, 2.0 * value + 0.1) > 20), "a planted fault");
}

/// The means of the channels.
fn means(pixels: &[[f32; 3]]) -> Vec<f32> {
    pixels.iter().map(|rgb| rgb.iter().sum::<f32>() / 3.0).collect()
}

/// Asserts that panes, readout and a saved file have these differences of both predictions; the file in its folder.
fn assert_differences(
    window: &mut Window<'_>,
    maps: &[Vec<[f32; 3]>],
    slack: f32,
) -> (tempfile::TempDir, PathBuf) {
    for (slot, title) in PREDICTIONS.into_iter().enumerate() {
        assert_texels(window, title, &format!("{} ", slot + 1), &means(&maps[slot]));
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("difference.exr");
    save(window, SaveKind::Renderings, &path);
    let (width, saved) = read_exr(&path);
    let gap = svbrdf_files::export::GAP;
    assert_eq!((width, saved.len()), (2 * 256 + gap, 256 * (2 * 256 + gap)));
    for (i, rgb) in maps[1].iter().enumerate().step_by(97) {
        let found = saved[i / 256 * width + 256 + gap + i % 256];
        assert!((0..3).all(|c| (found[c] - rgb[c]).abs() <= slack), "{i}: {found:?}, expected {rgb:?}");
    }
    (folder, path)
}

fn press(window: &mut Window<'_>, key: egui::Key) {
    window.key_press(key);
    window.run_steps(3);
}

fn hover(window: &mut Window<'_>, at: Pos2) {
    window.event(egui::Event::PointerMoved(at));
    window.run_steps(2);
}

/// The magnification in the status line, in pixels per texel.
fn magnification(window: &Window<'_>) -> f64 {
    let field = window.get_by_role_and_label(Role::SpinButton, "Magnification");
    field.accesskit_node().numeric_value().unwrap()
}

/// The text of the status line's column that begins with `start`.
fn column(window: &Window<'_>, start: &str) -> String {
    let mut nodes = window.query_all_by_label_contains(start).filter_map(|node| node.value());
    nodes.find(|text| text.starts_with(start)).unwrap_or_else(|| panic!("no column {start:?}"))
}

/// The (column, row) that the status line names; `None` beside the material.
fn texel_read(window: &Window<'_>) -> Option<[usize; 2]> {
    let text = column(window, "texel ");
    let (column, row) = text.trim_start_matches("texel ").trim().split_once(',')?;
    Some([column.parse().unwrap(), row.parse().unwrap()])
}

fn pointer(pos: Pos2, button: egui::PointerButton, pressed: bool) -> egui::Event {
    egui::Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }
}

fn primary(pos: Pos2, pressed: bool) -> egui::Event {
    pointer(pos, egui::PointerButton::Primary, pressed)
}

fn wheel(delta: Vec2, unit: egui::MouseWheelUnit, modifiers: Modifiers) -> egui::Event {
    let (phase, source) = (egui::TouchPhase::Move, egui::MouseWheelSource::Wheel);
    egui::Event::MouseWheel { unit, delta, phase, source, modifiers }
}

fn drag_primary(window: &mut Window<'_>, rect: egui::Rect, from: Vec2, to: Vec2) {
    drag(window, egui::PointerButton::Primary, rect, from, to);
}

/// Drags with a button from one point of the pane to another, both as shares of its size.
fn drag(window: &mut Window<'_>, button: egui::PointerButton, rect: egui::Rect, from: Vec2, to: Vec2) {
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

/// Pixels per texel at which a material of this size fits into a pane, but for its margin of 3%.
fn fitted_scale(rect: egui::Rect, [width, height]: [usize; 2]) -> f32 {
    (rect.width() / width as f32).min(rect.height() / height as f32) / 1.03
}

/// Asserts that a material of 256 x 256 texels, fitted before, has moved by `by`, in shares of the pane.
fn assert_panned(window: &Window<'_>, rect: egui::Rect, by: [f32; 2]) {
    let framing = window.view().display.framing.unwrap();
    let fitted = fitted_scale(rect, [256, 256]);
    assert!((framing.pixels_per_texel / fitted - 1.0).abs() < 0.01, "{framing:?}, fitted {fitted}");
    let moved = [0, 1].map(|axis| (128.0 - framing.centre[axis]) * fitted / rect.size()[axis]);
    assert!((0..2).all(|axis| (moved[axis] - by[axis]).abs() < 0.01), "{moved:?} for {by:?}: {framing:?}");
}

fn pixels(window: &mut Window<'_>, rect: egui::Rect) -> image::RgbaImage {
    let picture = window.render().unwrap();
    let [x, y, w, h] = [rect.left(), rect.top(), rect.width(), rect.height()].map(|v| v as u32);
    image::imageops::crop_imm(&picture, x, y, w, h).to_image()
}

/// Pixels over the background of a window: that of the tests is transparent, with premultiplied colours.
fn opaque(window: &Window<'_>, pixels: image::RgbaImage) -> image::RgbImage {
    let fill = window.ctx.style_of(egui::Theme::Dark).visuals.panel_fill.to_array();
    let over = |[r, g, b, a]: [u8; 4], c: usize| {
        let rest = 1.0 - f32::from(a) / 255.0;
        (f32::from([r, g, b][c]) + rest * f32::from(fill[c])).min(255.0) as u8
    };
    let pixel = |x, y| image::Rgb([0, 1, 2].map(|c| over(pixels.get_pixel(x, y).0, c)));
    image::RgbImage::from_fn(pixels.width(), pixels.height(), pixel)
}

/// A file as a window system drops it, or a planted fault of the frame that looks at it.
#[derive(Debug)]
enum Dropped {
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
