//! Files of scenes and of conventions: the losses are those of the file, whatever it is called.

use svbrdf_core::model::named_scenes::flash_9;
use svbrdf_files::scene_file;

use super::*;

const CAPTURE: &str = r#"{"im_size": 4, "camera_pos": [[-3, 3, 16], [0, 3, 16], [3, 1, 16]],
    "light_pos": [[-1, 3, 16], [0, 3, 16], [3, 2, 8]]}"#;

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
    open(&mut window, [path.clone()]);
    wait(&mut window, "the loss over the file", is_over(3));
    assert_eq!(window.losses().unwrap(), losses(&Request::Listed(scenes)));
    window.get_by_label("3 scenes of render.json");
    assert_eq!(window.names().len(), 3, "the materials stay");
    let listed = |app: &App| app.listed_scenes().is_some_and(|(scenes, _)| scenes.len() == 3);
    tab(&mut window, "Why");
    wait(&mut window, "the list of the file", listed);
    tab(&mut window, "Loss");
    click(&mut window, "Remove scenes");
    window.run_steps(26);
    assert!(window.query_by_label("3 scenes of render.json").is_none());
    assert!(window.model().settings.loss.file.is_none());
    edit(&mut window, history::undo);
    wait(&mut window, "the loss over the file", is_over(3));
    edit(&mut window, |model| model.settings.loss = model.settings.loss.with_file(None));
    wait(&mut window, "the loss to +-1%", |app| app.losses().is_some());

    // What is no scene file is an error, and changes nothing.
    let wrong = folder.path().join("wrong.json");
    std::fs::write(&wrong, "{}").unwrap();
    open(&mut window, [wrong]);
    wait(&mut window, "the error", |app| {
        app.messages().iter().any(|text| text.contains("not a usable scene file"))
    });
    assert!(window.model().settings.loss.file.is_none());
}

#[needs(adapter)]
fn the_saved_scenes_are_a_scene_file_worst_first_and_a_session_keeps_them() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = by_scenes();
    tab(&mut window, "Why");
    wait(&mut window, "the scenes", |app| app.listed_scenes().is_some());
    let ranked = window.listed_scenes().unwrap().0.to_vec();
    wait(&mut window, "the loss", is_over(9));
    let mean = ranked.iter().map(|ranked| ranked.losses[0]).sum::<f64>() / 9.0;
    let loss = window.losses().unwrap()[0].estimate.mean;
    assert!(ranked.len() == 9 && (mean / loss - 1.0).abs() < 1e-12, "{mean} and {loss}");
    let path = folder.path().join("scenes.json");
    save(&mut window, SaveKind::Scenes, &path);
    let saved = scene_file::read(&path).unwrap();
    assert_eq!(saved, ranked.iter().map(|ranked| ranked.scene).collect::<Vec<_>>());
    let json: serde_json::Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    let of_chosen: Vec<f64> = ranked.iter().map(|ranked| ranked.losses[0]).collect();
    assert_eq!(json["results"][0]["losses"], serde_json::json!(of_chosen));
    assert_eq!(json["results"].as_array().unwrap().len(), 1, "of the chosen prediction");

    open(&mut window, [path.clone()]);
    wait(&mut window, "the scenes of the file", |app| app.parts.model.settings.loss.file_scenes().is_some());
    let session = folder.path().join("a.svbrdf-session.json");
    edit(&mut window, |model| model.messages.dismiss_all());
    save(&mut window, SaveKind::Session, &session);
    let mut other = on_session(&session);
    wait(&mut other, "the loss", is_over(9));
    assert_eq!(other.losses().unwrap(), losses(&Request::Listed(saved)));
}

#[needs(adapter)]
fn a_scene_file_is_dropped_with_materials_and_two_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = capture(&folder);
    let mut window = built_in();
    let material = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/samples/worn_tiles.png");
    drop_files(&mut window, [material.clone(), path.clone(), material]);
    wait(&mut window, "materials and scenes", |app| app.names().len() == 2 && is_over(3)(app));
    assert_eq!(window.messages(), ["The loss is over the 3 scenes of render.json"]);

    // Two of them are refused, and those of before stay.
    let other = folder.path().join("other.json");
    std::fs::write(&other, CAPTURE).unwrap();
    edit(&mut window, |model| model.messages.dismiss_all());
    drop_files(&mut window, [path, other]);
    wait(&mut window, "the refusal", |app| !app.messages().is_empty());
    let messages = window.messages();
    assert!(messages[0].contains("expected one scene file, found"), "{messages:?}");
    window.get_by_label("3 scenes of render.json");
}

#[needs(adapter)]
fn scenes_with_a_name_are_those_of_the_loss_until_they_are_removed() {
    let mut window = by_scenes();
    click(&mut window, "Named...");
    click(&mut window, "flash-9");
    let request = |window: &Window<'_>| window.model().settings.loss.request();
    assert_eq!(request(&window), Request::Listed(flash_9().into()));
    window.get_by_label("9 scenes of flash-9");
    click(&mut window, "Remove scenes");
    assert!(matches!(request(&window), Request::Accuracy { .. }));
}

/// A convention by the name `mine`, of this brightness.
fn write_convention(path: &Path, factor: f64) {
    let text = format!(
        "name = \"mine\"\n[specular]\nF = \"schlick5\"\n[light]\nlz = \"none\"\nfactor = {factor:?}\n\
         [loss]\nnorm = \"log-l1\"\nepsilon = 0.01\n"
    );
    std::fs::write(path, text).unwrap();
}

fn chosen(path: &Path) -> ChosenConvention {
    ChosenConvention::read(path.to_str().unwrap()).unwrap()
}

/// The loss over the 6 + 3 scenes, of the convention of now.
fn assert_losses(window: &mut Window<'_>, expected: &ChosenConvention) {
    let wanted = losses_in(&Request::default(), expected.convention);
    wait(window, "the losses", |app| app.losses().is_some());
    assert_eq!(window.losses().unwrap(), wanted);
    assert_eq!(window.view().convention, *expected);
}

#[needs(adapter)]
fn the_losses_are_those_of_the_file_and_change_with_its_content() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    write_convention(&path, 2.0);
    let first = chosen(&path);
    let mut window = by_scenes();
    wait(&mut window, "the loss", |app| app.losses().is_some());
    open(&mut window, [path.clone()]);
    assert_eq!(window.names().len(), 3, "the materials stay");
    assert_losses(&mut window, &first);
    // Of the same name, and another one.
    write_convention(&path, 8.0);
    let second = chosen(&path);
    assert_eq!(first.convention.name, second.convention.name);
    open(&mut window, [path.clone()]);
    assert_losses(&mut window, &second);
    // The picker keeps it, and undo knows both.
    choose(&mut window, "Convention", "printed");
    assert_losses(&mut window, &ChosenConvention::default());
    choose(&mut window, "Convention", "mine.toml");
    assert_losses(&mut window, &second);
    rest(&mut window, 30);
    edit(&mut window, history::undo);
    assert_losses(&mut window, &ChosenConvention::default());
    // What is none is told, and changes nothing.
    std::fs::write(&path, "F = 5").unwrap();
    open(&mut window, [path.clone()]);
    see(&mut window, "not a convention");
    assert_losses(&mut window, &ChosenConvention::default());
}

#[needs(adapter)]
fn a_session_and_the_command_line_open_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    write_convention(&path, 3.0);
    let convention = Some(chosen(&path));
    let with = window(ViewerOptions { convention, ..ViewerOptions::default() });
    let session = with.model().session();
    let convention = chosen(&path).convention;
    // On a machine without the file.
    std::fs::remove_file(&path).unwrap();
    let mut window = window(ViewerOptions { session: Some(session.clone()), ..ViewerOptions::default() });
    assert_eq!(window.view().convention(), convention);
    choose(&mut window, "Convention", "printed");
    choose(&mut window, "Convention", "mine");
    assert_eq!(window.view().convention(), convention);
    assert_eq!(window.model().session(), session);
    // One that is none is told, and not taken for another.
    let mut session = session;
    session.convention = "name = \n".to_owned();
    let mut window = self::window(ViewerOptions { session: Some(session), ..ViewerOptions::default() });
    assert_eq!(window.view().convention().name, "printed");
    see(&mut window, "not a convention");
}
