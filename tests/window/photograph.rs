//! A photograph in the place of the ground truth.

use svbrdf_core::model::scene::Kind;
use svbrdf_evaluate::photograph::{PhotographComparison, compare, on_texels};
use svbrdf_files::disk::open::NamedFile;
use svbrdf_files::photograph::SessionPhotograph;
use svbrdf_files::read::{Albedo, read_photograph};

use super::*;

const SCENE: Scene = Scene { kind: Kind::Near, view: [0.0, 0.0, 1.7], light: [0.0, 0.0, 1.7] };

/// Writes the photograph, `factor` times as bright as the rendering of the ground truth; a hundred of its pixels are not finite.
fn photograph(folder: &Path, factor: f32) -> PathBuf {
    let rendering = render_f32(&materials()[0], &SCENE, &PRINTED, &Progress::default()).unwrap();
    let at = |i: usize| match (i % 256, i / 256) {
        (200, ..100) => [f32::NAN; 3],
        _ => rendering.pixels[i].map(|value| factor * value),
    };
    let values: Vec<f32> = (0..256 * 256).flat_map(at).collect();
    let path = folder.join("photo.npy");
    std::fs::write(&path, npy::npy([256, 256, 3], &values)).unwrap();
    path
}

/// The comparisons of the core.
fn expected(path: &Path, falloff: bool) -> Vec<PhotographComparison> {
    let photograph = read_photograph(&NamedFile::by_user(path), None).unwrap();
    let on_texels = on_texels(&photograph, "", [256, 256], falloff.then_some(&SCENE)).unwrap();
    let of = |material| compare(&[(on_texels.clone(), SCENE)], material, "", &PRINTED, &Progress::default());
    materials().iter().map(|material| of(material).unwrap().remove(0)).collect()
}

/// Whether the window compares as the core does: factors and bits of every picture, since NaN is not equal to itself.
fn agrees(window: &Window<'_>, core: &[PhotographComparison]) -> bool {
    let bits = |one: &PhotographComparison| -> (u64, Vec<u32>) {
        let pixels = [&one.photograph, &one.rendering].map(|image| image.pixels.as_flattened()).concat();
        (one.factor.to_bits(), pixels.into_iter().map(f32::to_bits).collect())
    };
    window.against_photograph().unwrap().iter().map(bits).eq(core.iter().map(bits))
}

fn wait_for_it(window: &mut Window<'_>) {
    wait(window, "the photograph", |app| {
        app.against_photograph().is_some() && app.difference_statistics().is_some()
    });
}

/// The window with a photograph under its light, and its folder.
pub(super) fn opened<'a>() -> (Window<'a>, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let path = photograph(folder.path(), 4.0);
    let mut window = built_in();
    edit(&mut window, |model| display::choose_scene(model, SCENE));
    edit(&mut window, |model| opening::open_photograph(model, path));
    wait_for_it(&mut window);
    (window, folder)
}

#[needs(adapter)]
fn renderings_are_compared_with_the_photograph_as_the_core_does() {
    let (mut window, folder) = opened();
    let path = folder.path().join("photo.npy");
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
        edit(&mut window, |model| choose_difference(model, kind));
        wait_for_it(&mut window);
        let all: Vec<_> = core.iter().map(|one| one.statistics(kind).unwrap()).collect();
        assert_eq!(statistics(&mut window), all, "{kind:?}");
        let [truth, other] = [&all[0], &all[1]];
        assert!(truth.mean.abs() < 1e-4 && truth.not_finite == 100 && other.p95 > 1e-3, "{kind:?}: {all:?}");
        window.get_by_label(&format!("Title GROUND TRUTH  worn tiles: {}", kind.name()));
    }
    edit(&mut window, |model| model.photograph.change(|source| source.falloff = true));
    wait(&mut window, "the falloff", |app| {
        app.against_photograph().is_some_and(|all| all[0].factor != core[0].factor)
    });
    assert!(agrees(&window, &expected(&path, true)) && !agrees(&window, &core));
    edit(&mut window, |model| model.photograph.change(|source| source.transfer = Some(Albedo::Srgb)));
    wait(&mut window, "the other curve", |app| app.against_photograph().is_some());
    // Opened again, a file that was replaced is another photograph.
    photograph(folder.path(), 2.0);
    let time = std::time::SystemTime::now() + std::time::Duration::from_secs(5);
    std::fs::File::options().write(true).open(&path).unwrap().set_modified(time).unwrap();
    edit(&mut window, |model| opening::open_photograph(model, path));
    wait(&mut window, "the new photograph", |app| {
        app.against_photograph().is_some_and(|all| (all[0].factor - 0.5).abs() < 1e-6)
    });

    // Without it, the ground truth is compared with again.
    edit(&mut window, |model| model.photograph.set(None));
    assert!(statistics(&mut window).len() == 2 && window.against_photograph().is_none());
    assert!(!has(&window, "PHOTOGRAPH"));
    window.get_by_label("Pane GROUND TRUTH  worn tiles");
}

#[needs(adapter)]
fn panes_readout_pictures_and_sessions_have_the_photograph() {
    let (mut window, folder) = opened();
    let path = folder.path().join("photo.npy");
    let core = expected(&path, false);
    press(&mut window, egui::Key::D);
    press(&mut window, egui::Key::Num0);
    edit(&mut window, |model| display::zoom(model, 4.0, [0.0, 0.0]));
    wait_for_it(&mut window);
    for (slot, title) in [GROUND_TRUTH, PREDICTIONS[0], PREDICTIONS[1]].into_iter().enumerate() {
        let start = if slot == 0 { "GT ".to_owned() } else { format!("{slot} ") };
        assert_texels(&mut window, title, &start, &core[slot].differences(Difference::Log));
        // The photograph stands at the exposure of the chosen prediction.
        let at = pane(&window, title).center();
        hover(&mut window, at);
        let [x, y] = texel_read(&window).unwrap();
        let photo = core[1].photograph.pixels[y * 256 + x].map(|v| format!("{v:8.4}")).join(" ");
        assert_eq!(column(&window, "photo "), format!("photo {photo}"), "{x}, {y}");
    }
    let [picture, session] = ["log.exr", "a.svbrdf-session.json"].map(|name| folder.path().join(name));
    save(&mut window, SaveKind::Renderings, &picture);
    let (width, saved) = read_exr(&picture);
    let gap = svbrdf_files::export::GAP;
    assert_eq!(width, 3 * 256 + 2 * gap);
    for (i, expected) in core[2].difference(Difference::Log).pixels.iter().enumerate() {
        let found = saved[i / 256 * width + i % 256 + 2 * (256 + gap)];
        assert!(found == *expected || (found[0].is_nan() && expected[0].is_nan()), "{i}");
    }
    assert!(file_contains(&picture, "log difference of renderings p from"));
    assert!(file_contains(&picture, "photo.npy as g"));

    save(&mut window, SaveKind::Session, &session);
    assert!(file_contains(&session, r#""path": "photo.npy""#));
    let photograph = Some(SessionPhotograph { path, transfer: None, falloff: false });
    assert_eq!(Session::read(&session).unwrap().photograph, photograph);
    let mut again = on_session(&session);
    wait_for_it(&mut again);
    assert!(agrees(&again, &core));
    assert_eq!(statistics(&mut again).len(), 3);
}

#[needs(adapter)]
fn the_open_dialog_takes_photographs_and_a_list_of_them_has_its_own_lights() {
    let folder = tempfile::tempdir().unwrap();
    let path = photograph(folder.path(), 4.0);
    std::fs::copy(&path, folder.path().join("second.npy")).unwrap();
    let other = Scene { light: [0.3, 0.0, 1.7], ..SCENE };
    let listed = [("photo.npy", SCENE), ("second.npy", other)]
        .map(|(file, scene)| json!({"file": file, "scene": scene}));
    std::fs::write(folder.path().join("capture.json"), json!({"photographs": listed}).to_string()).unwrap();
    let mut window = built_in();
    click(&mut window, "Open");
    click(&mut window, "A photograph in the place of the ground truth");
    let dialog = window.state_mut().parts.model.dialogs.open.as_mut().unwrap();
    dialog.add(folder.path());
    window.run_steps(3);
    click(&mut window, "Open these");
    wait_for_it(&mut window);
    assert_eq!(window.scene(), SCENE);
    let factor = |app: &App| app.against_photograph().map(|all| all[0].factor);
    let before = factor(window.state());
    edit(&mut window, |model| model.photograph.change(|source| source.transfer = Some(Albedo::Srgb)));
    wait_for_it(&mut window);
    choose(&mut window, "Photographs", "second.npy");
    wait(&mut window, "the second", |app| factor(app).is_some() && factor(app) != before);
    assert_eq!(window.scene(), other);
    assert_eq!(window.model().photograph.source().unwrap().transfer, None, "it is read as the list says");
    // A photograph that cannot be read or has another shape is reported, and the ground truth comes back.
    let narrow = folder.path().join("narrow.npy");
    std::fs::write(&narrow, npy::npy([256, 128, 3], &[0.5; 256 * 128 * 3])).unwrap();
    for (path, words) in
        [(folder.path().join("absent.png"), "absent.png"), (narrow, "rectify the photograph")]
    {
        edit(&mut window, |model| opening::open_photograph(model, path));
        wait(&mut window, "the message", |app| !app.messages().is_empty());
        assert!(window.messages()[0].contains(words), "{:?}", window.messages());
        assert!(window.against_photograph().is_none());
        edit(&mut window, |model| model.messages.dismiss_all());
    }
}
