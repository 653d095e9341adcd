//! A photograph in the place of the ground truth.

use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_f32;
use svbrdf_evaluate::photograph::{PhotographComparison, Rectified, flash};
use svbrdf_files::photograph::{Corners, SessionPhotograph};
use svbrdf_files::read::{Transfer, read_photograph};
use svbrdf_files::scene_file::PhotographLight;
use svbrdf_files::session::Session;
use svbrdf_viewer::model::command::{DisplayCommand, PhotographCommand};

use super::materials::materials;
use super::*;

pub(super) const FOV: f64 = 60.0;
pub(super) const CORNERS: [[f64; 2]; 4] = [[20.0, 10.0], [276.0, 10.0], [276.0, 266.0], [20.0, 266.0]];
/// Of the photograph: 4 times as bright as the rendering of the ground truth, beside it a frame.
pub(super) const SIZE: [usize; 2] = [300, 280];

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
    write(&path, &values);
    path
}

fn write(path: &Path, values: &[f32]) {
    std::fs::write(path, pictures::npy([SIZE[1] as u64, SIZE[0] as u64, 3], values)).unwrap();
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
        assert_eq!(statistics(&mut window), all, "{kind:?}");
        let [truth, other] = [&all[0], &all[1]];
        assert!(truth.mean.abs() < 1e-4 && truth.not_finite == 100 && other.p95 > 1e-3, "{kind:?}: {all:?}");
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
    assert!(statistics(&mut window).len() == 2 && window.state().against_photograph().is_none());
    assert!(!has(&window, "PHOTOGRAPH"));
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
    for (slot, title) in [GROUND_TRUTH, PREDICTIONS[0], PREDICTIONS[1]].into_iter().enumerate() {
        let start = if slot == 0 { "gt ".to_owned() } else { format!("{slot} ") };
        assert_texels(&mut window, title, &start, &core[slot].differences(Difference::Log));
        // The photograph stands at the exposure of the chosen prediction.
        let at = pane(&window, title).center();
        hover(&mut window, at);
        let [x, y] = texel_read(&window).unwrap();
        let photo = core[1].photograph.pixels[y * 256 + x].map(|v| format!("{v:8.4}")).join(" ");
        assert_eq!(column(&window, "photo "), format!("photo {photo}"), "{x}, {y}");
    }
}

#[needs(adapter)]
#[test]
fn saved_differences_are_those_from_the_photograph_and_a_session_keeps_it() {
    let (mut window, folder) = opened();
    let core = expected(&folder.path().join("photo.npy"), false);
    press(&mut window, egui::Key::D);
    wait_for_it(&mut window);
    let [picture, session] = ["log.exr", "a.svbrdf-session.json"].map(|name| folder.path().join(name));
    save(&mut window, SaveKind::Renderings, &picture);
    let (width, saved) = read_exr(&picture);
    let gap = svbrdf_files::export::GAP;
    assert_eq!(width, 3 * 256 + 2 * gap);
    let mut left_out = 0;
    for (i, expected) in core[2].difference(Difference::Log).pixels.iter().enumerate() {
        let found = saved[i / 256 * width + i % 256 + 2 * (256 + gap)];
        assert!(found == *expected || (found[0].is_nan() && expected[0].is_nan()), "{i}");
        left_out += usize::from(found[0].is_nan());
    }
    assert_eq!(left_out, 100);
    assert!(file_contains(&picture, "log difference of renderings p from"));
    assert!(file_contains(&picture, "photo.npy as g"));

    save(&mut window, SaveKind::Session, &session);
    assert!(file_contains(&session, r#""path": "photo.npy""#));
    let session = Session::read(&session).unwrap();
    assert_eq!(session.photograph, Some(source(&folder.path().join("photo.npy"))));
    let options = ViewerOptions { session: Some(session), ..ViewerOptions::default() };
    let mut again = super::window(options);
    wait_for_it(&mut again);
    assert!(agrees(&again, &core));
    assert_eq!(statistics(&mut again).len(), 3);
}

#[needs(adapter)]
#[test]
fn the_dialog_opens_a_photograph_with_its_light_and_says_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let path = photograph(folder.path());
    let mut window = built_in();
    click(&mut window, "Menu");
    click(&mut window, "Open photograph...");
    drop_files(&mut window, [path.clone()]);
    window.run_steps(3);
    click(&mut window, "Flash at the camera, field of view");
    window.get_by_role_and_label(Role::Button, "Open photograph").click();
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
    window.get_by_label_contains("there is no scene 1: it has one scene, number 0");
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
    write(&path, &values);
    let time = std::time::SystemTime::now() + std::time::Duration::from_secs(5);
    std::fs::File::options().write(true).open(&path).unwrap().set_modified(time).unwrap();
    let open = PhotographCommand::Open { photograph: source(&path), light: None };
    apply(&mut window, open);
    wait(&mut window, "the new photograph", |app| {
        app.against_photograph().is_some_and(|all| (all[0].factor / before - 2.0).abs() < 0.01)
    });
}
