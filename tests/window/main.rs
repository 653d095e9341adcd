//! The window without a window: egui_kittest drives it by accessible labels, on a real adapter.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]
#![allow(clippy::disallowed_methods, reason = "a test reads its own files")]

mod animation;
mod assumptions;
mod bar;
mod corners;
mod crash;
mod damaged;
mod device_loss;
mod differences;
mod fields;
mod files;
mod files_tab;
mod filmstrip;
mod flip;
mod gestures;
mod key_presses;
mod loss_panel;
mod mapping;
mod outside;
mod panels;
mod photograph;
mod quantities;
mod reading;
mod reduced;
mod report;
mod saving;
mod scene_files;
mod screenshots;
mod sizes;
mod soak;
mod stillness;
mod study;
mod texels;
mod training;
mod view;
mod why;

#[path = "../support/gpu.rs"]
#[allow(dead_code, reason = "the tests of the core use the rest")]
mod gpu;
#[path = "../support/pictures.rs"]
#[allow(dead_code, reason = "the tests of the core use the rest")]
mod pictures;
#[path = "../support/surroundings.rs"]
mod surroundings;

use eframe::egui::{self, Pos2, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use svbrdf_viewer::ViewerOptions;
use svbrdf_viewer::app::App;

type Window<'a> = Harness<'a, App>;

/// The window on the given materials (none: the built-in pair), once they have been read.
fn window<'a>(options: ViewerOptions) -> Window<'a> {
    scaled_window(options, 1.0)
}

/// The window on a screen with this many pixels per point.
fn scaled_window<'a>(options: ViewerOptions, scale: f32) -> Window<'a> {
    gpu::gpu();
    let mut window = Harness::builder()
        .with_size(vec2(1200.0, 800.0))
        .with_pixels_per_point(scale)
        .with_max_steps(16)
        .with_step_dt(1.0 / 30.0)
        .wgpu()
        .build_eframe(|cc| App::new(cc, options));
    window.set_render_cursor(false);
    wait(&mut window, "the materials to be read", |app| {
        !app.is_reading() && (!app.names().is_empty() || !app.messages().is_empty())
    });
    window
}

/// Runs frames until `done`, or fails after a generous while.
fn wait(window: &mut Window<'_>, what: &str, done: impl Fn(&App) -> bool) {
    for _ in 0..6000 {
        window.step();
        if done(window.state()) {
            window.run_steps(3);
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    panic!("waited in vain for {what}");
}

fn built_in<'a>() -> Window<'a> {
    window(ViewerOptions::default())
}

/// The built-in pair, with the loss over the 6 + 3 scenes of the papers.
fn by_scenes<'a>() -> Window<'a> {
    let mut window = built_in();
    window.get_by_label("Scenes").click();
    window.run_steps(4);
    window
}

/// Opens the menu of light and view.
fn more(window: &mut Window<'_>) {
    window.get_by_label("More of light and view").click();
    window.run_steps(4);
}

/// Opens a tab of the side panel.
fn tab(window: &mut Window<'_>, name: &str) {
    window.get_by_label(&format!("Tab {name}")).click();
    window.run_steps(4);
}

fn pane(window: &Window<'_>, title: &str) -> egui::Rect {
    window.get_by_label(&format!("Pane {title}")).rect()
}

const GROUND_TRUTH: &str = "GROUND TRUTH  worn tiles";

fn press(window: &mut Window<'_>, key: egui::Key) {
    window.key_press(key);
    window.run_steps(3);
}

fn hover(window: &mut Window<'_>, at: Pos2) {
    window.event(egui::Event::PointerMoved(at));
    window.run_steps(2);
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

/// Drags with a button from one point of the pane to another, both as shares of its size.
fn drag(window: &mut Window<'_>, button: egui::PointerButton, rect: egui::Rect, from: Vec2, to: Vec2) {
    let at = |share: Vec2| rect.min + rect.size() * share;
    let event = |pos: Pos2, pressed| egui::Event::PointerButton {
        pos,
        button,
        pressed,
        modifiers: egui::Modifiers::NONE,
    };
    for event in [
        egui::Event::PointerMoved(at(from)),
        event(at(from), true),
        egui::Event::PointerMoved(at((from + to) * 0.5)),
        egui::Event::PointerMoved(at(to)),
        event(at(to), false),
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
    let framing = window.state().parts.model.view.display.framing.unwrap();
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

fn brightness(picture: &image::RgbaImage, centre: Vec2) -> f64 {
    let (cx, cy) = (centre.x * picture.width() as f32, centre.y * picture.height() as f32);
    let near = |x: u32, y: u32| (x as f32 - cx).hypot(y as f32 - cy) < 40.0;
    let all: Vec<f64> = picture
        .enumerate_pixels()
        .filter(|(x, y, _)| near(*x, *y))
        .map(|(_, _, p)| p.0[..3].iter().map(|v| f64::from(*v)).sum())
        .collect();
    all.iter().sum::<f64>() / all.len() as f64
}

/// A file as a window system drops it.
#[derive(Debug)]
struct Dropped(std::path::PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &std::path::Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|e| e.to_string())
    }
}
