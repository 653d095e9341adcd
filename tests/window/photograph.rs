//! A photograph in the place of the ground truth.

use std::path::{Path, PathBuf};

use svbrdf_core::material::Material;
use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::colour_map::difference_to_display;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_f32;
use svbrdf_evaluate::photograph::{PhotographComparison, Rectified, flash};
use svbrdf_files::photograph::{Corners, SessionPhotograph};
use svbrdf_files::read::{Transfer, read_photograph};
use svbrdf_files::samples;
use svbrdf_files::scene_file::PhotographLight;
use svbrdf_files::session::Session;
use svbrdf_viewer::model::command::{Command, DisplayCommand, PhotographCommand, WindowCommand};
use svbrdf_viewer::model::settings::save_kind::{SaveKind, SaveRequest};

use super::*;

pub(super) const FOV: f64 = 60.0;
pub(super) const CORNERS: [[f64; 2]; 4] = [[20.0, 10.0], [276.0, 10.0], [276.0, 266.0], [20.0, 266.0]];
/// Of the photograph: 4 times as bright as the rendering of the ground truth, beside it a frame.
pub(super) const SIZE: [usize; 2] = [300, 280];

pub(super) fn materials() -> Vec<Material<f32>> {
    let samples = samples::load::<f32>().unwrap();
    [samples.ground_truth].into_iter().chain(samples.predictions).map(|read| read.material).collect()
}

/// Writes the photograph; some of its pixels are not finite.
pub(super) fn photograph(folder: &Path) -> PathBuf {
    let scene = flash(FOV).unwrap();
    let rendering = render_f32(&materials()[0], &scene, &PRINTED, &Progress::default()).unwrap();
    let at = |i: usize| match ((i % SIZE[0]).checked_sub(20), (i / SIZE[0]).checked_sub(10)) {
        (Some(x), Some(y)) if x == 200 && y < 100 => [f32::NAN; 3],
        (Some(x), Some(y)) if x < 256 && y < 256 => rendering.pixels[y * 256 + x].map(|value| 4.0 * value),
        _ => [7.0; 3],
    };
    let values: Vec<f32> = (0..SIZE[0] * SIZE[1]).flat_map(at).collect();
    let path = folder.join("photo.npy");
    std::fs::write(&path, pictures::npy([SIZE[1] as u64, SIZE[0] as u64, 3], &values)).unwrap();
    path
}

pub(super) fn source(path: &Path) -> SessionPhotograph {
    SessionPhotograph { path: path.to_owned(), corners: Some(Corners(CORNERS)), ..Default::default() }
}

/// The comparisons of the core.
fn expected(path: &Path, falloff: bool) -> Vec<PhotographComparison> {
    expected_of(&SessionPhotograph { falloff, ..source(path) }, &flash(FOV).unwrap())
}

/// The comparisons of the core with a photograph in this scene.
pub(super) fn expected_of(source: &SessionPhotograph, scene: &Scene) -> Vec<PhotographComparison> {
    let photograph = read_photograph(&source.path, &source.read).unwrap();
    let (corners, progress) = (source.corners.unwrap_or(Corners::whole([256; 2])), Progress::default());
    let rectified = Rectified::new(&photograph, &corners, [256, 256], &progress).unwrap();
    let rectified = if source.falloff { rectified.without_falloff(scene) } else { rectified };
    let one = |material| rectified.compare(material, scene, &PRINTED, &progress).unwrap();
    materials().iter().map(one).collect()
}

/// Factors and bits of every picture: NaN is not equal to itself.
fn bits(all: &[PhotographComparison]) -> Vec<(f64, Vec<u32>)> {
    let pixels = |one: &PhotographComparison| {
        let both = one.photograph.pixels.as_flattened().iter().chain(one.rendering.pixels.as_flattened());
        both.map(|value| value.to_bits()).collect()
    };
    all.iter().map(|one| (one.factor, pixels(one))).collect()
}

/// Whether the window compares as the core does.
pub(super) fn agrees(window: &Window<'_>, core: &[PhotographComparison]) -> bool {
    bits(window.state().against_photograph().unwrap()) == bits(core)
}

pub(super) fn apply(window: &mut Window<'_>, command: impl Into<Command>) {
    let (ctx, command) = (window.ctx.clone(), command.into());
    window.state_mut().apply(&ctx, command);
    window.run_steps(2);
}

pub(super) fn wait_for_it(window: &mut Window<'_>) {
    wait(window, "the photograph", |app| {
        app.against_photograph().is_some() && app.difference_statistics().is_some()
    });
}

/// The window with a photograph of a flash, and its folder.
pub(super) fn opened<'a>() -> (Window<'a>, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let photograph = source(&photograph(folder.path()));
    let mut window = built_in();
    let light = Some(PhotographLight::Flash { fov_degrees: FOV });
    apply(&mut window, PhotographCommand::Open { photograph, light });
    wait_for_it(&mut window);
    (window, folder)
}

fn statistics(window: &Window<'_>) -> Vec<svbrdf_core::picture::statistics::Statistics> {
    window.state().difference_statistics().unwrap().iter().map(|one| one.unwrap()).collect()
}

#[needs(adapter)]
#[test]
fn renderings_are_compared_with_the_photograph_as_the_core_does() {
    let (mut window, folder) = opened();
    let path = folder.path().join("photo.npy");
    assert_eq!(window.state().parts.model.view.scene, flash(FOV).unwrap());
    let core = expected(&path, false);
    assert!(agrees(&window, &core));
    assert!((core[0].factor - 0.25).abs() < 1e-6);
    // At the exposure of the chosen prediction.
    window.get_by_label(&format!("Pane PHOTOGRAPH  photo.npy  {:+.2} EV", core[1].exposure_ev()));
    window.get_by_label("Pane GROUND TRUTH  worn tiles");
    window.get_by_label("x 0.2500");
    window.get_by_label("-2.00 EV");
    window.get_by_label("0.15% of the texels are clipped");

    press(&mut window, egui::Key::D);
    for kind in [Difference::Log, Difference::SignedLog, Difference::Absolute, Difference::Relative] {
        apply(&mut window, DisplayCommand::SetDifference(kind));
        wait_for_it(&mut window);
        let all: Vec<_> = core.iter().map(|one| one.statistics(kind).unwrap()).collect();
        assert_eq!(statistics(&window), all, "{kind:?}");
        assert!(
            all[0].mean.abs() < 1e-4 && all[1].p95 > 1e-3 && all[0].not_finite == 100,
            "{kind:?}: {all:?}"
        );
        window.get_by_label(&format!("Title GROUND TRUTH  worn tiles: {}", kind.name()));
        window.get_by_label(&format!("Title 2  wrong roughness: {}", kind.name()));
    }
    apply(&mut window, PhotographCommand::SetFalloff(true));
    wait(&mut window, "the falloff", |app| {
        app.against_photograph().is_some_and(|all| all[0].factor != core[0].factor)
    });
    assert!(agrees(&window, &expected(&path, true)) && !agrees(&window, &core));

    // Without it, the ground truth is compared with again.
    apply(&mut window, PhotographCommand::Close);
    wait(&mut window, "the statistics", |app| app.difference_statistics().is_some());
    assert!(statistics(&window).len() == 2 && window.state().against_photograph().is_none());
    assert_eq!(window.query_all_by_label_contains("PHOTOGRAPH").count(), 0);
    window.get_by_label("Pane GROUND TRUTH  worn tiles");
}

#[needs(adapter)]
#[test]
fn panes_and_readout_have_the_numbers_of_the_photograph() {
    let (mut window, folder) = opened();
    let core = expected(&folder.path().join("photo.npy"), false);
    press(&mut window, egui::Key::D);
    press(&mut window, egui::Key::Num0);
    apply(&mut window, DisplayCommand::Zoom { factor: 4.0, at: [0.0, 0.0] });
    wait_for_it(&mut window);
    let range = window.state().difference_range();
    for (slot, title) in [(0, GROUND_TRUTH), (1, "1  blurred normals"), (2, "2  wrong roughness")] {
        let rect = pane(&window, title);
        let mut reads = Vec::new();
        for share in [vec2(0.12, 0.17), vec2(0.83, 0.31), vec2(0.21, 0.88), vec2(0.62, 0.93)] {
            let at = rect.min + rect.size() * share;
            window.event(egui::Event::PointerMoved(at));
            window.run_steps(3);
            let [x, y] = texel_read(&window).unwrap();
            let value = core[slot].differences(Difference::Log)[y * 256 + x];
            let name = if slot == 0 { "gt ".to_owned() } else { format!("{slot} ") };
            let value_text = format!("{name}{:8.4}", value);
            assert_eq!(column(&window, &name), value_text, "{title} at {x}, {y}");
            // The photograph stands at the exposure of the chosen prediction.
            let photo = core[1].photograph.pixels[y * 256 + x].map(|v| format!("{v:8.4}")).join(" ");
            assert_eq!(column(&window, "photo "), format!("photo {photo}"), "{x}, {y}");
            reads.push((at, value));
        }
        window.event(egui::Event::PointerMoved(egui::pos2(600.0, 20.0)));
        window.run_steps(3);
        let seen = pixels(&mut window, rect);
        for (at, value) in reads {
            let [x, y] = [at.x - rect.left().floor(), at.y - rect.top().floor()];
            let found = seen.get_pixel(x as u32, y as u32).0;
            let expected = difference_to_display(value, range as f32, false);
            let off = (0..3).map(|c| found[c].abs_diff(expected[c])).max().unwrap();
            assert!(off <= 4, "{title}: {found:?} at {at:?}, expected {expected:?}");
        }
    }
}

#[needs(adapter)]
#[test]
fn saved_differences_are_those_from_the_photograph_and_a_session_keeps_it() {
    let (mut window, folder) = opened();
    let core = expected(&folder.path().join("photo.npy"), false);
    press(&mut window, egui::Key::D);
    wait_for_it(&mut window);
    let mut save = |what, name: &str| {
        let path = folder.path().join(name);
        apply(
            &mut window,
            WindowCommand::Save(SaveRequest { kind: what, path: path.clone(), size: [0; 2], handles: true }),
        );
        wait(&mut window, "the file", |app| !app.messages().is_empty());
        assert_eq!(window.state().messages(), [format!("Saved {}", path.display())]);
        apply(&mut window, WindowCommand::DismissMessages);
        path
    };
    let picture = save(SaveKind::Renderings, "log.exr");
    let saved = exr::prelude::read_first_rgba_layer_from_file(
        &picture,
        |size, _| (size.width(), vec![[0f32; 3]; size.area()]),
        |(width, pixels), at, (r, g, b, _): (f32, f32, f32, f32)| {
            pixels[at.y() * *width + at.x()] = [r, g, b]
        },
    );
    let (width, saved) = saved.unwrap().layer_data.channel_data.pixels;
    let gap = svbrdf_files::export::GAP;
    assert_eq!(width, 3 * 256 + 2 * gap);
    let mut left_out = 0;
    for (i, expected) in core[2].difference(Difference::Log).pixels.iter().enumerate() {
        let found = saved[i / 256 * width + i % 256 + 2 * (256 + gap)];
        assert!(found == *expected || (found[0].is_nan() && expected[0].is_nan()), "{i}");
        left_out += usize::from(found[0].is_nan());
    }
    assert_eq!(left_out, 100);
    let bytes = std::fs::read(&picture).unwrap();
    let says = |text: &[u8]| bytes.windows(text.len()).any(|window| window == text);
    assert!(says(b"log difference of renderings p from") && says(b"photo.npy as g"));

    let session = save(SaveKind::Session, "a.svbrdf-session.json");
    assert!(std::fs::read_to_string(&session).unwrap().contains("\"path\": \"photo.npy\""));
    let session = Session::read(&session).unwrap();
    assert_eq!(session.photograph, Some(source(&folder.path().join("photo.npy"))));
    let options = ViewerOptions { session: Some(session), ..ViewerOptions::default() };
    let mut again = super::window(options);
    wait_for_it(&mut again);
    assert!(agrees(&again, &core));
    assert_eq!(statistics(&again).len(), 3);
}

#[needs(adapter)]
#[test]
fn the_dialog_opens_a_photograph_with_its_light_and_says_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let path = photograph(folder.path());
    let mut window = built_in();
    window.get_by_label("Menu").click();
    window.run_steps(4);
    window.get_by_label("Open photograph...").click();
    window.run_steps(4);
    window.input_mut().dropped_files =
        [path.clone()].into_iter().map(|path| std::sync::Arc::new(Dropped(path)) as _).collect();
    window.run_steps(3);
    window.get_by_label("Flash at the camera, field of view").click();
    window.run_steps(3);
    window.get_by_role_and_label(egui::Role::Button, "Open photograph").click();
    window.run_steps(3);
    wait_for_it(&mut window);
    assert_eq!(window.state().parts.model.view.scene, flash(45.0).unwrap());
    apply(&mut window, PhotographCommand::SetTransfer(Some(Transfer::Srgb)));
    wait(&mut window, "the other curve", |app| app.against_photograph().is_some());

    // A photograph that cannot be read is reported, and the ground truth comes back.
    let absent = source(&folder.path().join("absent.png"));
    let light = None;
    apply(&mut window, PhotographCommand::Open { photograph: absent, light });
    wait(&mut window, "the message", |app| !app.messages().is_empty());
    assert!(window.state().messages()[0].contains("absent.png"), "{:?}", window.state().messages());
    assert!(window.state().against_photograph().is_none());
    // So is a scene that is not there.
    let scenes = folder.path().join("scenes.json");
    std::fs::write(&scenes, r#"{"scenes": [{"kind": "near", "view": [0, 0, 2], "light": [1, 0, 2]}]}"#)
        .unwrap();
    apply(&mut window, PhotographCommand::ShowOpen(true));
    let of = |number| PhotographCommand::Open {
        photograph: source(&path),
        light: Some(PhotographLight::File { path: scenes.clone(), number: Some(number) }),
    };
    apply(&mut window, of(1));
    window.get_by_label_contains(
        "it lists 1 scenes, of which a photograph has one, found number 1; give its number from 0 to 0",
    );
    apply(&mut window, of(0));
    wait_for_it(&mut window);
    assert_eq!(window.state().parts.model.view.scene.light, [1.0, 0.0, 2.0]);
    // Corners that make no sense are refused; the earlier ones stay.
    let before = window.state().against_photograph().unwrap().to_vec();
    apply(&mut window, WindowCommand::DismissMessages);
    let [a, b, c, d] = CORNERS;
    apply(&mut window, PhotographCommand::SetCorners(Some(Corners([a, d, c, b]))));
    wait(&mut window, "the message", |app| !app.messages().is_empty());
    assert!(window.state().messages()[0].contains("clockwise"), "{:?}", window.state().messages());
    assert!(agrees(&window, &before));
}

#[needs(adapter)]
#[test]
fn a_photograph_that_was_replaced_is_read_again_when_it_is_opened_again() {
    let (mut window, folder) = opened();
    let path = folder.path().join("photo.npy");
    let factor = |window: &Window<'_>| window.state().against_photograph().unwrap()[0].factor;
    let before = factor(&window);
    // The same picture at half the radiance, and at another time.
    let stored = std::fs::read(&path).unwrap();
    let values: Vec<f32> = stored[stored.len() - 12 * SIZE[0] * SIZE[1]..]
        .chunks_exact(4)
        .map(|bytes| 0.5 * f32::from_le_bytes(bytes.try_into().unwrap()))
        .collect();
    std::fs::write(&path, pictures::npy([SIZE[1] as u64, SIZE[0] as u64, 3], &values)).unwrap();
    let time = std::time::SystemTime::now() + std::time::Duration::from_secs(5);
    std::fs::File::options().write(true).open(&path).unwrap().set_modified(time).unwrap();
    let open = PhotographCommand::Open { photograph: source(&path), light: None };
    apply(&mut window, open);
    wait(&mut window, "the new photograph", |app| {
        app.against_photograph().is_some_and(|all| (all[0].factor / before - 2.0).abs() < 0.01)
    });
}
