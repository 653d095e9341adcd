//! The window without a window: egui_kittest drives it by accessible labels, on a real adapter.

use eframe::egui::{self, Pos2, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use svbrdf::loss::{self, LossParams};
use svbrdf::material::Material;
use svbrdf::progress::Progress;
use svbrdf::samples;
use svbrdf::viewer::ViewerOptions;
use svbrdf::viewer::app::App;
use svbrdf::viewer::state::{Layout, Projection};
use svbrdf::view::Shown;

use crate::support::gpu;

type Window<'a> = Harness<'a, App>;

/// The window on the given materials (none: the built-in pair), once they have been read.
fn window<'a>(options: ViewerOptions) -> Option<Window<'a>> {
    gpu::gpu()?;
    let mut window = Harness::builder()
        .with_size(vec2(1200.0, 800.0))
        .with_max_steps(16)
        .wgpu()
        .build_eframe(|cc| App::new(cc, options));
    window.set_render_cursor(false);
    wait(&mut window, "the materials to be read", |app| !app.names().is_empty() || !app.messages().is_empty());
    Some(window)
}

/// Runs frames until `done`, or fails after a generous while.
fn wait(window: &mut Window<'_>, what: &str, done: impl Fn(&App) -> bool) {
    for _ in 0..600 {
        window.step();
        if done(window.state()) {
            window.run_steps(3);
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    panic!("waited in vain for {what}");
}

fn built_in<'a>() -> Option<Window<'a>> {
    window(ViewerOptions::default())
}

fn pane(window: &Window<'_>, title: &str) -> egui::Rect {
    window.get_by_label(&format!("Pane {title}")).rect()
}

const GROUND_TRUTH: &str = "GROUND TRUTH  worn tiles";

fn press(window: &mut Window<'_>, key: egui::Key) {
    window.key_press(key);
    window.run_steps(3);
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

#[test]
fn the_window_starts_on_the_built_in_pair() {
    let Some(mut window) = built_in() else { return };
    assert_eq!(window.state().names(), ["worn tiles", "blurred normals", "wrong roughness"]);
    let rect = pane(&window, GROUND_TRUTH);
    let picture = pixels(&mut window, rect);
    let colours: std::collections::HashSet<_> = picture.pixels().map(|p| p.0).collect();
    assert!(colours.len() > 1000, "a rendering has many colours, this has {}", colours.len());
}

#[test]
fn dragging_the_light_changes_the_rendering_where_it_goes() {
    let Some(mut window) = built_in() else { return };
    let rect = pane(&window, GROUND_TRUTH);
    let (from, to) = (vec2(0.7, 0.3), vec2(0.3, 0.7));
    let before = pixels(&mut window, rect);
    drag(&mut window, egui::PointerButton::Primary, rect, from, to);
    let after = pixels(&mut window, rect);
    let [x, y, z] = window.state().state.scene.light;
    assert!(x < -0.2 && y < -0.2 && z == 1.2, "the light is at {x}, {y}, {z}");
    assert!(brightness(&after, to) > 1.2 * brightness(&before, to), "it is brighter where the light went");
    assert!(brightness(&after, from) < brightness(&before, from), "it is darker where the light was");
}

#[test]
fn a_right_drag_moves_the_view_and_a_middle_drag_pans() {
    let Some(mut window) = built_in() else { return };
    let rect = pane(&window, GROUND_TRUTH);
    let before = window.state().state.clone();
    drag(&mut window, egui::PointerButton::Secondary, rect, vec2(0.5, 0.5), vec2(0.6, 0.4));
    let moved = window.state().state.clone();
    assert!(moved.scene.view[0] > 0.1 && moved.scene.view[1] > 0.1, "{:?}", moved.scene);
    assert_eq!(moved.scene.light, before.scene.light);
    drag(&mut window, egui::PointerButton::Middle, rect, vec2(0.5, 0.5), vec2(0.6, 0.4));
    let panned = window.state().state.clone();
    assert_eq!(panned.scene, moved.scene);
    assert!((panned.pan[0] - 0.2).abs() < 0.02 && (panned.pan[1] - 0.2).abs() < 0.02, "{:?}", panned.pan);
}

#[test]
fn every_letter_does_what_the_help_says() {
    let Some(mut window) = built_in() else { return };
    let expect = |window: &mut Window<'_>, key, what: &str, holds: &dyn Fn(&App) -> bool| {
        press(window, key);
        assert!(holds(window.state()), "{key:?}: {what}");
    };
    expect(&mut window, egui::Key::C, "wipe", &|a| a.state.layout == Layout::Wipe);
    expect(&mut window, egui::Key::C, "single", &|a| a.state.layout == Layout::Single);
    expect(&mut window, egui::Key::C, "difference", &|a| a.state.layout == Layout::Difference);
    expect(&mut window, egui::Key::C, "side by side", &|a| a.state.layout == Layout::SideBySide);
    expect(&mut window, egui::Key::M, "normal", &|a| a.state.shown == Shown::Normal);
    expect(&mut window, egui::Key::P, "perspective", &|a| a.state.projection == Projection::Perspective);
    expect(&mut window, egui::Key::E, "brighter", &|a| a.state.exposure_ev == 0.5);
    expect(&mut window, egui::Key::Num2, "second prediction", &|a| a.state.prediction == 1);
    expect(&mut window, egui::Key::L, "clipping", &|a| a.state.show_clipping);
    expect(&mut window, egui::Key::H, "highlight", &|a| a.settings.highlight_follows);
    expect(&mut window, egui::Key::R, "reset", &|a| a.state.exposure_ev == 0.0 && !a.state.show_clipping);
    expect(&mut window, egui::Key::B, "no panel", &|a| !a.settings.side_panel);
}

#[test]
fn undo_and_redo_go_through_the_changes() {
    let Some(mut window) = built_in() else { return };
    window.run_steps(8);
    press(&mut window, egui::Key::E);
    window.run_steps(8);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    window.run_steps(3);
    assert_eq!(window.state().state.exposure_ev, 0.0);
    window.key_press_modifiers(egui::Modifiers::COMMAND | egui::Modifiers::SHIFT, egui::Key::Z);
    window.run_steps(3);
    assert_eq!(window.state().state.exposure_ev, 0.5);
}

#[test]
fn letters_typed_into_a_field_are_no_commands() {
    let Some(mut window) = built_in() else { return };
    window.get_by_label("Open").click();
    window.run_steps(4);
    let before = window.state().state.clone();
    let field = "Files, folders or name prefixes, one a line:";
    window.get_by_role_and_label(egui::accesskit::Role::MultilineTextInput, field).type_text("mcexp");
    press(&mut window, egui::Key::M);
    assert_eq!(window.state().state, before);
}

#[test]
fn the_loss_button_yields_the_number_that_the_core_gives() {
    let Some(mut window) = built_in() else { return };
    window.get_by_label("Auto").click();
    window.run_steps(3);
    press(&mut window, egui::Key::Escape);
    window.get_by_role_and_label(egui::accesskit::Role::SpinButton, "Seed").click();
    window.run_steps(2);
    window.get_by_role_and_label(egui::accesskit::Role::SpinButton, "Seed").type_text("7");
    press(&mut window, egui::Key::Enter);
    assert_eq!(window.state().settings.seed, 7);
    assert_eq!(window.state().losses(), None, "the loss of another seed is no loss of this one");
    window.get_by_label("Compute loss").click();
    window.run_steps(2);
    wait(&mut window, "the loss", |app| app.losses().is_some());
    let samples = samples::load::<f32>().unwrap();
    let predictions: Vec<&Material<f32>> = samples.predictions.iter().map(|r| &r.material).collect();
    let params = LossParams { seed: 7, ..LossParams::default() };
    let expected = loss::losses(
        &samples.ground_truth.material,
        &predictions,
        &params.scenes().unwrap(),
        &params.convention,
        &Progress::default(),
    )
    .unwrap();
    assert_eq!(window.state().losses().unwrap(), expected);
    for loss in &expected {
        let [mean, error, interval] = loss.estimate.texts();
        window.get_by_label(&format!("{mean} +- {error}"));
        window.get_by_label(&interval);
    }
}

#[test]
fn auto_computes_again_when_the_convention_changes() {
    let Some(mut window) = built_in() else { return };
    wait(&mut window, "the first loss", |app| app.losses().is_some());
    let before = window.state().losses().unwrap()[0].estimate.mean;
    window.get_by_role_and_label(egui::accesskit::Role::ComboBox, "Convention").click();
    window.run_steps(4);
    window.get_by_label("guided-2020").click();
    window.run_steps(4);
    assert_eq!(window.state().state.convention, "guided-2020");
    wait(&mut window, "the second loss", |app| app.losses().is_some());
    assert!(window.state().losses().unwrap()[0].estimate.mean > before);
}

#[test]
fn a_file_that_is_not_there_is_an_error_in_the_window_and_keeps_what_was_open() {
    let Some(mut window) = built_in() else { return };
    window.get_by_label("Open").click();
    window.run_steps(4);
    let field = "Files, folders or name prefixes, one a line:";
    window.get_by_role_and_label(egui::accesskit::Role::MultilineTextInput, field).type_text("no/such/brick.png");
    window.run_steps(3);
    window.get_by_label("Open these").click();
    wait(&mut window, "the error", |app| !app.messages().is_empty());
    let message = window.state().messages()[0].clone();
    assert!(message.contains("no/such/brick.png"), "{message}");
    assert_eq!(window.state().names().len(), 3);
    window.get_by_label(&message);
    window.get_by_label("Dismiss").click();
    window.run_steps(3);
    assert!(window.state().messages().is_empty());
}

#[test]
fn the_saved_view_is_written_and_said_so() {
    let Some(mut window) = built_in() else { return };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("view.png");
    window.get_by_label("Save").click();
    window.run_steps(4);
    let label = "To file (.png as displayed, .exr as linear floats):";
    let field = || egui::accesskit::Role::TextInput;
    window.get_by_role_and_label(field(), label).focus();
    window.run_steps(2);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.run_steps(2);
    window.get_by_role_and_label(field(), label).type_text(&path.display().to_string());
    window.run_steps(2);
    window.get_by_label("Save picture").click();
    wait(&mut window, "the file", |app| !app.messages().is_empty());
    assert_eq!(window.state().messages(), [format!("Saved {}", path.display())]);
    let picture = image::open(&path).unwrap();
    assert_eq!((picture.width(), picture.height()), (3 * 256 + 2 * 4, 256));
}
