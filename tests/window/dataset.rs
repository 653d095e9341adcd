//! A data set in the window.

mod files;
mod table;

use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Endpoint;
use svbrdf_evaluate::dataset::{DatasetReading, Evaluation, KnownLoss, Source};
use svbrdf_viewer::OpenDataset;
use svbrdf_viewer::dataset::losses as known;
use svbrdf_viewer::model::dataset::list::{ListFilter, ListOrder, ListView};
use svbrdf_viewer::widgets::numbers::significant;

use super::observed::Observed;
use super::*;

/// A note that a spreadsheet would run.
const FORMULA: &str = "=cmd|' /C calc'!A0";

/// Writes a material whose error is so many times the least.
fn write(path: &Path, side: u32, error: u32) {
    write_packed(path, side, |tile, x, y| {
        let shade = |value: u32| (value + error).min(255) as u8;
        [[128, 128, 255], [shade(60 + 4 * x); 3], [shade(90 + 3 * y); 3], [20; 3]][tile as usize]
    });
}

/// Materials a to f, all of which `ours` has; `theirs` lacks b, has a damaged c, and d in another size. The material e is larger.
fn folders(folder: &Path) -> [PathBuf; 3] {
    let [gt, ours, theirs] = ["gt", "ours", "theirs"].map(|name| folder.join(name));
    [&gt, &ours, &theirs].into_iter().for_each(|folder| std::fs::create_dir(folder).unwrap());
    for (name, times) in ["a", "b", "c", "d", "e", "f"].into_iter().zip(1..) {
        let side = if name == "e" { 24 } else { 16 };
        let [truth, our, their] = [&gt, &ours, &theirs].map(|folder| folder.join(format!("{name}.png")));
        write(&truth, side, 0);
        write(&our, side, 5 * times);
        match name {
            "b" => {}
            "c" => std::fs::write(their, "no picture").unwrap(),
            "d" => write(&their, 8, 9 * times),
            _ => write(&their, side, 9 * times),
        }
    }
    [gt, ours, theirs]
}

fn dataset([gt, ours, theirs]: [PathBuf; 3], results: Option<PathBuf>) -> OpenDataset {
    let source = Source::folders(gt, vec![(None, ours), (None, theirs)]);
    OpenDataset::new(source, DatasetReading::default(), Request::Accuracy { target: 0.02, seed: 0 }, results)
        .unwrap()
}

/// The window on a data set, once its losses are there: the panes, and the table beside them.
fn on_dataset<'a>(dataset: &OpenDataset) -> Window<'a> {
    let mut window = on_table(dataset);
    edit(&mut window, |model| model.dataset.show_table(false));
    window
}

/// The window on the table of a data set, once its losses are there.
fn on_table<'a>(dataset: &OpenDataset) -> Window<'a> {
    let dataset = Some(Box::new(dataset.clone()));
    let mut window = window(ViewerOptions { dataset, ..ViewerOptions::default() });
    assert!(window.model().dataset.table.has_pictures);
    wait_for_losses(&mut window);
    window
}

fn wait_for_losses(window: &mut Window<'_>) {
    wait(window, "all losses", |app| known::ask(app.shown()).count() == 6);
}

fn loss(window: &impl Observed, case: usize, method: usize) -> Option<KnownLoss> {
    known::ask(window.shown()).row(case)?.by_method[method]
}

#[needs(adapter)]
fn the_losses_in_the_list_are_those_of_rank_to_the_last_bit_and_what_fails_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let dataset = dataset(folders(folder.path()), Some(folder.path().join("results")));
    let window = on_dataset(&dataset);
    let progress = Progress::default();
    let ranked = Evaluation::new(&dataset.settings, &dataset.reading, None, &progress).unwrap();
    for case in &dataset.cases {
        let result = ranked.material(case).unwrap();
        for (method, prediction) in result.predictions.iter().enumerate() {
            assert_eq!(loss(&window, case.index, method), prediction.known, "{} {method}", case.material);
        }
    }
    let known: Vec<usize> = (0..6).filter(|case| loss(&window, *case, 1).is_some()).collect();
    assert_eq!(known, [0, 4, 5], "theirs lacks b, c and d");
    // Another window finds all of them in the results folder.
    let other = on_dataset(&dataset);
    let found =
        Evaluation::new(&dataset.settings, &dataset.reading, dataset.results.as_deref(), &progress).unwrap();
    assert!(found.known(&dataset.cases[0]).is_some());
    assert_eq!(loss(&other, 0, 0), loss(&window, 0, 0));
    // A planted fault: other scenes, another loss.
    let mut planted = dataset.clone();
    planted.settings.seed = 1;
    let planted = on_dataset(&planted);
    assert_ne!(loss(&planted, 0, 0), loss(&window, 0, 0));
}

#[needs(adapter)]
fn what_the_hand_has_set_stays_over_flips_and_nothing_of_two_materials_is_seen_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = on_dataset(&dataset(folders(folder.path()), None));
    assert_eq!(window.names(), ["a", "ours", "theirs"]);
    // The exposure that the hand has not set is that of each material.
    let exposure = window.view().exposure_ev;
    edit(&mut window, |model| model.dataset.show(4, Vec::new()));
    wait(&mut window, "another material", |app| app.names()[0] == "e");
    window.run_steps(2);
    assert_ne!(window.view().exposure_ev, exposure);
    edit(&mut window, |model| model.dataset.show(0, Vec::new()));
    wait(&mut window, "the first material", |app| app.names()[0] == "a");
    edit(&mut window, |model| endpoint::move_over_plane(&mut model.view.scene, Endpoint::Light, [0.4, -0.2]));
    edit(&mut window, |model| display::choose(model, 1));
    edit(&mut window, |model| display::step_exposure(model, 0.5));
    edit(&mut window, |model| display::magnify(model, 37.0));
    let before = window.view().clone();
    let mut seen = Vec::new();
    for name in ["b", "c", "d", "e", "f"] {
        window.key_press(egui::Key::PageDown);
        wait(&mut window, name, |app| {
            // In every frame, all materials are of one case: their files have one name.
            let files = app.model().materials.all.iter().map(|one| one.read.path().file_name().unwrap());
            let files: std::collections::BTreeSet<_> = files.collect();
            assert_eq!(files.len(), 1, "{files:?}");
            app.names()[0] == name
        });
        let view = window.view();
        assert_eq!((view.scene, view.exposure_ev), (before.scene, before.exposure_ev), "{name}");
        seen.push((window.names().len(), view.display.prediction, view.display.framing.unwrap()));
    }
    // Chosen is `theirs` wherever it is.
    assert_eq!(seen.iter().map(|(count, ..)| *count).collect::<Vec<_>>(), [2, 2, 2, 3, 3]);
    assert_eq!(seen[3..].iter().map(|(_, chosen, _)| *chosen).collect::<Vec<_>>(), [1, 1]);
    // The material of 24 texels shows the same part as those of 16.
    let (small, large) = (seen[2].2, seen[3].2);
    assert_eq!(small, before.display.framing.unwrap());
    assert!((large.pixels_per_texel * 24.0 - small.pixels_per_texel * 16.0).abs() < 1e-3);
    assert!((large.centre[0] / 24.0 - small.centre[0] / 16.0).abs() < 1e-6);
    window.key_press(egui::Key::PageUp);
    wait(&mut window, "the one before", |app| app.names()[0] == "e");
    assert!(window.model().dataset.missing.is_empty());
    (0..3).for_each(|_| press(&mut window, egui::Key::PageUp));
    wait(&mut window, "b", |app| app.names()[0] == "b");
    // The empty pane has the reason, and the number and the place of its method.
    assert!(has(&window, "no prediction named b") && has(&window, "2  theirs"));
}

/// A method has one number, one colour and one place on every material, and a pair has one loss in the window.
#[needs(adapter)]
fn a_method_has_one_number_and_place_and_a_pair_one_loss() {
    let folder = tempfile::tempdir().unwrap();
    let [gt, ours, theirs] = folders(folder.path());
    // In the order theirs, ours: the first one fails.
    let source = Source::folders(gt, vec![(None, theirs), (None, ours)]);
    let open = OpenDataset::new(
        source,
        DatasetReading::default(),
        Request::Accuracy { target: 0.02, seed: 7 },
        None,
    )
    .unwrap();
    let mut window = on_dataset(&open);
    window.run_steps(4);
    let place = pane(&window, "2  ours");
    for name in ["b", "c", "a"] {
        let case = ["a", "b", "c"].iter().position(|one| *one == name).unwrap();
        edit(&mut window, |model| model.dataset.show(case, Vec::new()));
        wait_in(&mut window, name, |window| {
            // In every frame, the loss in a title is that of the material below it, or there is none.
            let case = window.model().dataset.shown.unwrap();
            let title = window.get_by_label("Title 2  ours").accesskit_node().value();
            let known = loss(window, case, 1).map(|known| known.estimate());
            let expected = known.map(|one| format!("loss {}", significant(&one)[0]));
            assert_eq!(title, expected, "{case}");
            case == ["a", "b", "c"].iter().position(|one| *one == name).unwrap()
        });
        assert_eq!(pane(&window, "2  ours"), place, "{name}");
        press(&mut window, egui::Key::Num2);
        assert_eq!(window.model().chosen_prediction().unwrap().slot, 2, "{name}");
        assert!(has(&window, "1  theirs"), "{name}");
    }
}

#[needs(adapter)]
fn the_list_is_sorted_filtered_and_marked_and_a_session_keeps_it() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = on_dataset(&dataset(folders(folder.path()), Some(folder.path().join("results"))));
    let list = ListView { order: ListOrder::Loss(0), ..ListView::default() };
    edit(&mut window, |model| model.dataset.list = list);
    let title = |window: &Window<'_>| svbrdf_viewer::dataset::title(window.shown());
    let largest = (0..6)
        .max_by(|a, b| loss(&window, *a, 0).unwrap().loss.total_cmp(&loss(&window, *b, 0).unwrap().loss));
    let case = largest.unwrap();
    edit(&mut window, |model| model.dataset.show(case, Vec::new()));
    wait(&mut window, "the worst", |app| app.parts.model.dataset.shown == Some(case));
    let name = ["a", "b", "c", "d", "e", "f"][case];
    assert_eq!(title(&window).unwrap(), format!("{name} (1 of 6)"));
    window.key_press(egui::Key::K);
    window.run_steps(2);
    edit(&mut window, |model| model.dataset.change_mark(|mark| mark.note = FORMULA.to_owned()));
    let marked = ListView { filter: ListFilter::Marked, ..ListView::default() };
    edit(&mut window, |model| model.dataset.list = marked);
    assert_eq!(title(&window).unwrap(), format!("{name} (1 of 1)"));
    let failed = ListView { filter: ListFilter::Failed, ..ListView::default() };
    edit(&mut window, |model| model.dataset.list = failed);
    assert!(has(&window, "3 of 6 materials"));

    edit(&mut window, |model| model.dataset.list = ListView::default());
    let path = folder.path().join("list.csv");
    edit(&mut window, |model| {
        model.effects.push(Effect::Save(SaveRequest { kind: SaveKind::Materials, path: path.clone() }))
    });
    wait(&mut window, "the list", |app| app.messages().iter().any(|text| text.ends_with("list.csv")));
    edit(&mut window, |model| model.messages.dismiss_all());
    let list = std::fs::read_to_string(path).unwrap();
    let known = loss(&window, case, 0).unwrap().loss;
    assert!(list.contains(&format!("\n{name},true,'{FORMULA},{known},")), "{list}");
    assert_eq!(list.lines().count(), 7, "{list}");

    let list = ListView { order: ListOrder::Disagreement, filter: ListFilter::Marked, ..ListView::default() };
    edit(&mut window, |model| model.dataset.list = list.clone());
    let path = folder.path().join("all.svbrdf-session.json");
    edit(&mut window, |model| {
        model.effects.push(Effect::Save(SaveRequest { kind: SaveKind::Session, path: path.clone() }))
    });
    wait(&mut window, "the session", |app| app.messages().iter().any(|text| text.starts_with("Saved")));
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains("\"gt\"") && !text.contains(folder.path().to_str().unwrap()), "{text}");
    let mut other = on_session(&path);
    wait_for_losses(&mut other);
    wait(&mut other, "the marked one", |app| app.parts.model.dataset.shown == Some(case));
    let mark = other.model().dataset.mark(name).cloned().unwrap();
    assert!(mark.is_marked && mark.note == FORMULA);
    assert_eq!(other.model().dataset.list, list);
    assert_eq!(loss(&other, case, 0), loss(&window, case, 0));
}

#[needs(adapter)]
fn a_session_names_no_folder_that_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let of = |name: &str| folder.path().join(name);
    let window = on_dataset(&dataset(folders(folder.path()), Some(of("results"))));
    let path = of("stranger.svbrdf-session.json");
    let mut session: serde_json::Value =
        serde_json::from_str(&window.model().session().text(&path).unwrap()).unwrap();
    assert_eq!(session["dataset"]["results"], serde_json::Value::Null);
    session["dataset"]["results"] = json!("victim");
    std::fs::write(&path, session.to_string()).unwrap();
    std::fs::create_dir(of("victim")).unwrap();
    let old = std::fs::File::create(of("victim/.svbrdf-a1B2c3")).unwrap();
    old.set_modified(std::time::SystemTime::UNIX_EPOCH).unwrap();
    wait_for_losses(&mut on_session(&path));
    let files: Vec<_> =
        std::fs::read_dir(of("victim")).unwrap().map(|one| one.unwrap().file_name()).collect();
    assert_eq!(files, [".svbrdf-a1B2c3"]);
    // A person names one.
    let (session, results) = (Session::read(&path).ok(), Some(of("results")));
    let mut named = self::window(ViewerOptions { session, results: results.clone(), ..Default::default() });
    wait_for_losses(&mut named);
    assert_eq!(named.model().dataset.open.as_ref().unwrap().results, results);
}
