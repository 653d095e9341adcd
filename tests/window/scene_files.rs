//! Scene files: the scenes of the loss, from a file and to one.

use svbrdf_core::loss::Request;
use svbrdf_core::model::named_scenes::flash_9;
use svbrdf_files::read::ReadOptions;
use svbrdf_files::scene_file;
use svbrdf_files::session::Session;
use svbrdf_viewer::model::command::{DisplayCommand, LossCommand, MaterialsCommand};

use super::materials::losses;
use super::*;

const CAPTURE: &str = r#"{"im_size": 4, "camera_pos": [[-3, 3, 16], [0, 3, 16], [3, 1, 16]],
    "light_pos": [[-1, 3, 16], [0, 3, 16], [3, 2, 8]]}"#;

fn open(window: &mut Window<'_>, path: &Path) {
    let (paths, read) = (vec![path.to_owned()], ReadOptions::AUTO);
    apply(window, MaterialsCommand::Open { paths, replace: false, read });
}

/// Whether the loss is over so many listed scenes.
fn is_over(count: usize) -> impl Fn(&App) -> bool {
    move |app| app.losses().is_some_and(|losses| losses[0].per_scene.len() == count)
}

fn capture(folder: &tempfile::TempDir) -> PathBuf {
    let path = folder.path().join("render.json");
    std::fs::write(&path, CAPTURE).unwrap();
    path
}

#[needs(adapter)]
fn the_scenes_of_a_file_are_those_of_the_loss_until_they_are_removed() {
    let folder = tempfile::tempdir().unwrap();
    let path = capture(&folder);
    let scenes = scene_file::read(&path).unwrap();
    let mut window = built_in();
    window.run_steps(30);
    open(&mut window, &path);
    wait(&mut window, "the loss over the file", is_over(3));
    assert_eq!(window.state().losses().unwrap(), losses(&Request::Listed(scenes)));
    window.get_by_label("3 scenes of render.json");
    assert_eq!(window.state().names().len(), 3, "the materials stay");
    let listed = |app: &App| app.listed_scenes().is_some_and(|(scenes, _)| scenes.len() == 3);
    tab(&mut window, "Why");
    wait(&mut window, "the list of the file", listed);
    tab(&mut window, "Loss");
    click(&mut window, "Remove scenes");
    window.run_steps(26);
    assert!(window.query_by_label("3 scenes of render.json").is_none());
    assert!(window.state().parts.model.settings.loss.file.is_none());
    apply(&mut window, DisplayCommand::Undo);
    wait(&mut window, "the loss over the file", is_over(3));
    apply(&mut window, LossCommand::RemoveFileScenes);
    wait(&mut window, "the loss to +-1%", |app| app.losses().is_some());

    // What is no scene file is an error, and changes nothing.
    let wrong = folder.path().join("wrong.json");
    std::fs::write(&wrong, "{}").unwrap();
    open(&mut window, &wrong);
    wait(&mut window, "the error", |app| {
        app.messages().iter().any(|text| text.contains("not a usable scene file"))
    });
    assert!(window.state().parts.model.settings.loss.file.is_none());
}

#[needs(adapter)]
fn the_saved_scenes_are_a_scene_file_worst_first_and_a_session_keeps_them() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = by_scenes();
    tab(&mut window, "Why");
    wait(&mut window, "the scenes", |app| app.listed_scenes().is_some());
    let ranked = window.state().listed_scenes().unwrap().0.to_vec();
    wait(&mut window, "the loss", is_over(9));
    let mean = ranked.iter().map(|ranked| ranked.losses[0]).sum::<f64>() / 9.0;
    let loss = window.state().losses().unwrap()[0].estimate.mean;
    assert!(ranked.len() == 9 && (mean / loss - 1.0).abs() < 1e-12, "{mean} and {loss}");
    let path = folder.path().join("scenes.json");
    save(&mut window, SaveKind::Scenes, &path);
    let saved = scene_file::read(&path).unwrap();
    assert_eq!(saved, ranked.iter().map(|ranked| ranked.scene).collect::<Vec<_>>());
    let json: serde_json::Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    let of_chosen: Vec<f64> = ranked.iter().map(|ranked| ranked.losses[0]).collect();
    assert_eq!(json["results"][0]["losses"], serde_json::json!(of_chosen));
    assert_eq!(json["results"].as_array().unwrap().len(), 1, "of the chosen prediction");

    open(&mut window, &path);
    wait(&mut window, "the scenes of the file", |app| app.parts.model.settings.loss.file_scenes().is_some());
    let session = folder.path().join("a.svbrdf-session.json");
    apply(&mut window, WindowCommand::DismissMessages);
    save(&mut window, SaveKind::Session, &session);
    let session = Some(Session::read(&session).unwrap());
    let mut other = super::window(ViewerOptions { session, ..ViewerOptions::default() });
    wait(&mut other, "the loss", is_over(9));
    assert_eq!(other.state().losses().unwrap(), losses(&Request::Listed(saved)));
}

#[needs(adapter)]
fn a_scene_file_is_opened_with_the_window_and_dropped_with_materials() {
    let folder = tempfile::tempdir().unwrap();
    let path = capture(&folder);
    let scenes = scene_file::read_named(&path).unwrap();
    let options = ViewerOptions { scenes: Some(scenes.clone()), ..ViewerOptions::default() };
    let mut window = super::window(options);
    wait(&mut window, "the loss over the file", is_over(3));
    assert_eq!(window.state().losses().unwrap(), losses(&Request::Listed(scenes.scenes)));
    window.get_by_label("3 scenes of render.json");

    let mut window = built_in();
    let material = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/samples/worn_tiles.png");
    drop_files(&mut window, [material.clone(), path.clone(), material]);
    wait(&mut window, "materials and scenes", |app| app.names().len() == 2 && is_over(3)(app));
    assert_eq!(window.state().messages(), ["The loss is over the 3 scenes of render.json"]);

    // Two of them are refused, and those of before stay.
    let other = folder.path().join("other.json");
    std::fs::write(&other, CAPTURE).unwrap();
    apply(&mut window, WindowCommand::DismissMessages);
    drop_files(&mut window, [path, other]);
    wait(&mut window, "the refusal", |app| !app.messages().is_empty());
    let messages = window.state().messages();
    assert!(messages[0].contains("expected one scene file, found"), "{messages:?}");
    window.get_by_label("3 scenes of render.json");
}

#[needs(adapter)]
fn scenes_with_a_name_are_those_of_the_loss_until_they_are_removed() {
    let mut window = by_scenes();
    click(&mut window, "Named...");
    click(&mut window, "flash-9");
    let request = |window: &Window<'_>| window.state().parts.model.settings.loss.request();
    assert_eq!(request(&window), Request::Listed(flash_9().into()));
    window.get_by_label("9 scenes of flash-9");
    click(&mut window, "Remove scenes");
    assert!(matches!(request(&window), Request::Accuracy { .. }));
}
