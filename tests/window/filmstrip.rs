//! The filmstrip of a capture.

use serde_json::json;

use svbrdf_core::model::convention::PRINTED;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_f32;
use svbrdf_files::photograph::SessionPhotograph;
use svbrdf_files::read::PhotographOptions;
use svbrdf_viewer::model::command::{DisplayCommand, PhotographCommand};

use super::materials::materials;
use super::photograph::{agrees, expected_of, wait_for_it};
use super::*;

fn scene(k: usize) -> Scene {
    let light = [0.4 * k as f64 - 0.8, 0.3, 1.8];
    Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light }
}

/// A capture of the ground truth in five scenes, of which photograph `k` is `k + 1` times as bright.
fn capture() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let truth = &materials()[0];
    let listed = (0..5).map(|k| {
        let rendering = render_f32(truth, &scene(k), &PRINTED, &Progress::default()).unwrap();
        let values: Vec<f32> =
            rendering.pixels.iter().flatten().map(|value| (k + 1) as f32 * value).collect();
        let bytes = pictures::npy([256, 256, 3], &values);
        std::fs::write(folder.path().join(format!("{k}.npy")), bytes).unwrap();
        json!({"file": format!("{k}.npy"), "scene": scene(k)})
    });
    let text = json!({"photographs": listed.collect::<Vec<_>>()}).to_string();
    std::fs::write(folder.path().join("capture.json"), text).unwrap();
    folder
}

fn opened<'a>(folder: &tempfile::TempDir) -> Window<'a> {
    let mut window = built_in();
    let photograph = SessionPhotograph { path: folder.path().to_owned(), ..Default::default() };
    apply(&mut window, PhotographCommand::Open { photograph, light: None });
    wait_for_it(&mut window);
    wait_for_strip(&mut window);
    window
}

fn wait_for_strip(window: &mut Window<'_>) {
    wait(window, "the filmstrip", |app| app.filmstrip_length().is_some());
    window.run_steps(2);
}

fn factor(window: &Window<'_>) -> f64 {
    window.state().against_photograph().unwrap()[0].factor
}

/// Where the controls around the strip are.
fn places(window: &Window<'_>) -> Vec<egui::Rect> {
    let labels = ["Close photograph", "Light and view", "Photograph 1: 0.npy", "Divide out falloff"];
    labels.iter().map(|label| window.get_by_label(label).rect()).collect()
}

#[needs(adapter)]
#[test]
fn a_click_on_the_filmstrip_compares_with_another_photograph_and_moves_nothing() {
    let folder = capture();
    let mut window = opened(&folder);
    let view = |window: &Window<'_>| window.state().parts.model.view.scene;
    assert_eq!(view(&window), scene(0));
    assert!((factor(&window) - 1.0).abs() < 1e-6);
    window.get_by_label("Photograph 1 of 5 of the capture");
    let before = places(&window);

    window.get_by_label("Photograph 3: 2.npy").click();
    // While it is read and compared, too.
    for _ in 0..40 {
        window.step();
        let now = ["Close photograph", "Light and view", "Photograph 1: 0.npy"]
            .map(|label| window.get_by_label(label).rect());
        assert_eq!(now[..], before[..3]);
    }
    wait_for_it(&mut window);
    assert_eq!(view(&window), scene(2));
    assert!((factor(&window) - 1.0 / 3.0).abs() < 1e-6, "{}", factor(&window));
    assert_eq!(places(&window), before);
    window.get_by_label("Photograph 3 of 5 of the capture");

    window.run_steps(30);
    apply(&mut window, DisplayCommand::Undo);
    wait_for_it(&mut window);
    assert_eq!(view(&window), scene(0));
    assert!((factor(&window) - 1.0).abs() < 1e-6);
    apply(&mut window, PhotographCommand::Close);
    assert!(window.query_by_label("Photograph 1: 0.npy").is_none());
    assert!(window.state().messages().is_empty(), "{:?}", window.state().messages());
}

#[needs(adapter)]
#[test]
fn a_session_keeps_the_capture_and_a_broken_one_is_refused() {
    let folder = capture();
    let mut window = opened(&folder);
    let session = window.state().parts.model.session();
    let photograph = session.photograph.as_ref().unwrap();
    assert_eq!(photograph.capture.as_deref(), Some(folder.path().join("capture.json").as_path()));
    apply(&mut window, PhotographCommand::Close);
    window.state_mut().parts.model.open_session(&session);
    wait_for_strip(&mut window);
    window.get_by_label("Photograph 1 of 5 of the capture");

    let text = std::fs::read_to_string(folder.path().join("capture.json")).unwrap();
    std::fs::write(folder.path().join("capture.json"), text.replace("scene", "sene")).unwrap();
    let path = folder.path().to_owned();
    let photograph = SessionPhotograph { path, capture: None, ..photograph.clone() };
    apply(&mut window, PhotographCommand::Open { photograph, light: None });
    let messages = window.state().messages();
    assert!(messages.iter().any(|message| message.contains("unknown key `sene`")), "{messages:?}");
}

#[needs(adapter)]
#[test]
fn a_photograph_that_cannot_be_read_leaves_the_capture_open_and_its_reason_on_the_card() {
    let folder = capture();
    let broken = folder.path().join("2.npy");
    let good = std::fs::read(&broken).unwrap();
    std::fs::write(&broken, "not an array").unwrap();
    let mut window = opened(&folder);
    window.get_by_label("Photograph 3: 2.npy").click();
    see(&mut window, "2.npy: ");
    assert!(window.state().messages().is_empty(), "{:?}", window.state().messages());
    window.get_by_label("Photograph 3 of 5 of the capture");
    // The others are there, and this one once its file is mended.
    window.get_by_label("Photograph 2: 1.npy").click();
    wait_for_it(&mut window);
    assert!((factor(&window) - 0.5).abs() < 1e-6 && !has(&window, "2.npy: "));
    std::fs::write(&broken, good).unwrap();
    window.get_by_label("Photograph 3: 2.npy").click();
    window.run_steps(3);
    wait_for_it(&mut window);
    assert!((factor(&window) - 1.0 / 3.0).abs() < 1e-6, "{}", factor(&window));
    apply(&mut window, PhotographCommand::Close);
    // A photograph of no capture is closed.
    std::fs::write(&broken, "not an array").unwrap();
    let photograph = SessionPhotograph { path: broken, ..Default::default() };
    apply(&mut window, PhotographCommand::Open { photograph, light: None });
    wait(&mut window, "the message", |app| !app.messages().is_empty());
    assert!(window.state().messages().iter().any(|message| message.contains("2.npy")));
    assert!(window.query_by_label("Close photograph").is_none());
}

#[needs(adapter)]
#[test]
fn the_colour_of_the_light_is_divided_out_and_kept_by_a_session() {
    let folder = tempfile::tempdir().unwrap();
    let scene = Scene { kind: Kind::Near, view: [0.0, 0.0, 2.5], light: [0.0, 0.2, 2.5] };
    let colour = [1.0, 0.8, 1.2];
    let picture = image::RgbImage::from_fn(256, 256, |x, y| image::Rgb([x as u8, y as u8, 90]));
    picture.save(folder.path().join("00.png")).unwrap();
    let text = json!({
        "target_dir": ".", "im_size": 2.0, "light_pow": colour.map(|channel| 10.0 * channel),
        "camera_pos": [scene.view], "light_pos": [scene.light],
    });
    std::fs::write(folder.path().join("render.json"), text.to_string()).unwrap();
    let mut window = opened(&folder);
    apply(&mut window, PhotographCommand::SetFalloff(false));
    wait_for_it(&mut window);
    window.get_by_label("Colour of the light divided out: 1.000 0.800 1.200");
    let session = window.state().parts.model.session();
    let source = session.photograph.unwrap();
    assert!(agrees(&window, &expected_of(&source, &scene)));
    assert_eq!(source.read.light_colour, Some([1.0, 0.8, 1.2]));
    let white = PhotographOptions { light_colour: None, ..source.read };
    assert!(!agrees(&window, &expected_of(&SessionPhotograph { read: white, ..source }, &scene)));
}
