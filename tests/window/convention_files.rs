//! Conventions in files: the losses are those of the file, whatever it is called.

use svbrdf_core::loss::Request;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_files::read::ReadOptions;
use svbrdf_viewer::model::command::{DisplayCommand, MaterialsCommand};

use super::materials::losses_in;
use super::*;

/// A convention by the name `mine`, of this brightness.
fn write(path: &Path, factor: f64) {
    let text = format!(
        "name = \"mine\"\n[specular]\nF = \"schlick5\"\n[light]\nlz = \"none\"\nfactor = {factor:?}\n\
         [loss]\nnorm = \"log-l1\"\nepsilon = 0.01\n"
    );
    std::fs::write(path, text).unwrap();
}

fn chosen(path: &Path) -> ChosenConvention {
    ChosenConvention::read(path.to_str().unwrap()).unwrap()
}

fn open(window: &mut Window<'_>, path: &Path) {
    let (paths, read) = (vec![path.to_owned()], ReadOptions::AUTO);
    apply(window, MaterialsCommand::Open { paths, replace: true, read });
}

/// The loss over the 6 + 3 scenes, of the convention of now.
fn assert_losses(window: &mut Window<'_>, expected: &ChosenConvention) {
    let wanted = losses_in(&Request::default(), expected.convention);
    wait(window, "the losses", |app| app.losses().is_some());
    assert_eq!(window.state().losses().unwrap(), wanted);
    assert_eq!(window.state().parts.model.view.convention, *expected);
}

#[needs(adapter)]
fn the_losses_are_those_of_the_file_and_change_with_its_content() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    write(&path, 2.0);
    let first = chosen(&path);
    let mut window = by_scenes();
    wait(&mut window, "the loss", |app| app.losses().is_some());
    open(&mut window, &path);
    assert_eq!(window.state().names().len(), 3, "the materials stay");
    assert_losses(&mut window, &first);
    // Of the same name, and another one.
    write(&path, 8.0);
    let second = chosen(&path);
    assert_eq!(first.convention.name, second.convention.name);
    open(&mut window, &path);
    assert_losses(&mut window, &second);
    // The picker keeps it, and undo knows both.
    choose(&mut window, "Convention", "printed");
    assert_losses(&mut window, &ChosenConvention::default());
    choose(&mut window, "Convention", "mine.toml");
    assert_losses(&mut window, &second);
    rest(&mut window, 30);
    apply(&mut window, DisplayCommand::Undo);
    assert_losses(&mut window, &ChosenConvention::default());
    // What is none is told, and changes nothing.
    std::fs::write(&path, "F = 5").unwrap();
    open(&mut window, &path);
    see(&mut window, "not a convention");
    assert_losses(&mut window, &ChosenConvention::default());
}

#[needs(adapter)]
fn a_session_and_the_command_line_open_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    write(&path, 3.0);
    let convention = Some(chosen(&path));
    let with = window(ViewerOptions { convention, ..ViewerOptions::default() });
    let session = with.state().parts.model.session();
    assert_eq!(session.convention, path.to_str().unwrap());
    let mut window = window(ViewerOptions { session: Some(session.clone()), ..ViewerOptions::default() });
    assert_eq!(window.state().parts.model.view.convention, chosen(&path));
    choose(&mut window, "Convention", "printed");
    choose(&mut window, "Convention", "mine.toml");
    assert_eq!(window.state().parts.model.view.convention, chosen(&path));
    // Gone since: told, and not taken for another.
    std::fs::remove_file(&path).unwrap();
    let mut window = self::window(ViewerOptions { session: Some(session), ..ViewerOptions::default() });
    assert_eq!(window.state().parts.model.view.convention().name, "printed");
    see(&mut window, "mine.toml");
}
