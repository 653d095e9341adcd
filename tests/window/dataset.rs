//! A data set in the window.

use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Endpoint;
use svbrdf_evaluate::dataset::{DatasetReading, Evaluation, KnownLoss, Source};
use svbrdf_viewer::OpenDataset;
use svbrdf_viewer::jobs::dataset::sheet::DrawSheet;
use svbrdf_viewer::jobs::dataset::summary::Summarize;
use svbrdf_viewer::model::dataset::list::{Filter, ListView, Order};
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

/// The window on a data set, once its losses are there.
fn on_dataset<'a>(dataset: &OpenDataset) -> Window<'a> {
    let mut window =
        window(ViewerOptions { dataset: Some(Box::new(dataset.clone())), ..ViewerOptions::default() });
    wait_for_losses(&mut window);
    window
}

fn wait_for_losses(window: &mut Window<'_>) {
    wait(window, "all losses", |app| app.jobs().dataset.losses.count() == 6);
}

fn loss(window: &impl Observed, case: usize, method: usize) -> Option<KnownLoss> {
    window.jobs().dataset.losses.row(case)?.by_method[method]
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
    let list = ListView { order: Order::Loss(0), ..ListView::default() };
    edit(&mut window, |model| model.dataset.list = list);
    let title = |window: &Window<'_>| window.state().parts.ui.dataset.title(window.state().parts.displayed());
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
    let marked = ListView { filter: Filter::Marked, ..ListView::default() };
    edit(&mut window, |model| model.dataset.list = marked);
    assert_eq!(title(&window).unwrap(), format!("{name} (1 of 1)"));
    let failed = ListView { filter: Filter::Failed, ..ListView::default() };
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

    let list = ListView { order: Order::Disagreement, filter: Filter::Marked, ..ListView::default() };
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

#[needs(adapter)]
fn the_light_is_dragged_in_any_cell_of_the_sheet_and_a_click_opens_what_escape_returns_from() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = built_in();
    drop_files(&mut window, folders(folder.path()));
    wait(&mut window, "the first material", |app| app.names()[0] == "a");
    wait_for_losses(&mut window);
    tab(&mut window, "Methods");
    wait(&mut window, "the summary", |app| app.jobs().answers.latest(|_: &Summarize| true).is_some());
    see(&mut window, "theirs has 3 of 6 materials");
    // Escape leaves the search, and shows all again.
    press_with(&mut window, Modifiers::COMMAND, egui::Key::F);
    window.event(egui::Event::Text("e".to_owned()));
    window.run_steps(3);
    assert!(has(&window, "1 of 6 materials"));
    press(&mut window, egui::Key::Escape);
    assert!(!has(&window, "1 of 6 materials") && window.model().dataset.list.search.is_empty());
    window.key_press(egui::Key::S);
    window.run_steps(3);
    wait_in(&mut window, "the cells", |window| {
        let sheet = DrawSheet::latest(&window.jobs().answers);
        let of = |case, column| svbrdf_viewer::jobs::dataset::cells::Cell { case, column };
        sheet.as_deref().is_some_and(|sheet| sheet.part(of(0, 1)).is_some() && sheet.part(of(2, 2)).is_none())
    });
    let before = DrawSheet::latest(&window.jobs().answers).unwrap().atlas.picture.clone();
    let rect = window.get_by_label("Cell b, ours").rect();
    drag_primary(&mut window, rect, vec2(0.5, 0.5), vec2(0.75, 0.25));
    let light = window.scene().light;
    assert!((light[0] - 0.5).abs() < 0.05 && (light[1] - 0.5).abs() < 0.05, "{light:?}");
    wait_in(&mut window, "other pictures", |window| {
        let sheet = DrawSheet::latest(&window.jobs().answers);
        sheet.is_some_and(|sheet| sheet.atlas.picture != before)
    });
    assert_eq!(window.names()[0], "a", "a drag opens nothing");
    click(&mut window, "Cell e, theirs");
    wait(&mut window, "the material", |app| app.names()[0] == "e");
    assert!(!window.model().dataset.sheet.is_open);
    press(&mut window, egui::Key::Escape);
    assert!(window.model().dataset.sheet.is_open);
    edit(&mut window, opening::open_built_in);
    wait(&mut window, "the built-in materials", |app| app.names()[0] == "worn tiles");
    assert!(!has(&window, "Tab Methods"), "another comparison closes it");
}

/// The range of the latest cells.
fn range(window: &Window<'_>) -> Option<f64> {
    DrawSheet::latest(&window.jobs().answers)?.range
}

#[needs(adapter)]
fn the_sheet_has_losses_sorts_by_its_heads_and_has_one_range() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = on_dataset(&dataset(folders(folder.path()), None));
    press(&mut window, egui::Key::S);
    // A click on the name of a method sorts by its losses; again, the other way round.
    let listed = |window: &Window<'_>| window.state().parts.ui.dataset.listed().to_vec();
    let by_name = listed(&window);
    for is_reversed in [false, true] {
        window.get_by_label_contains("Sort by ours").click();
        window.run_steps(4);
        let list = window.model().dataset.list.clone();
        assert_eq!((list.order, list.is_reversed), (Order::Loss(0), is_reversed));
    }
    assert_eq!(listed(&window).iter().rev().copied().collect::<Vec<_>>(), {
        edit(&mut window, |model| model.dataset.list.is_reversed = false);
        window.run_steps(2);
        listed(&window)
    });
    edit(&mut window, |model| model.dataset.list = ListView::default());
    window.run_steps(2);
    assert_eq!(listed(&window), by_name);
    // Differences of all cells have one range: that of the cell where it is largest.
    edit(&mut window, |model| model.view.display.difference = true);
    wait_in(&mut window, "the range", |window| range(window).is_some());
    let of_open = window.difference_range();
    let of_all = range(&window).unwrap();
    assert!(of_all > 1.5 * of_open, "{of_all} of all, {of_open} of the open one");
    edit(&mut window, |model| model.view.display.difference = false);
    wait_in(&mut window, "the values", |window| range(window).is_none());
}

#[needs(adapter)]
fn a_file_that_was_replaced_is_read_again_with_its_losses_and_one_that_is_gone_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let all = folders(folder.path());
    let mut window = on_dataset(&dataset(all.clone(), None));
    let before = loss(&window, 0, 0).unwrap();
    std::fs::copy(all[2].join("a.png"), all[1].join("a.png")).unwrap();
    std::fs::remove_file(all[2].join("a.png")).unwrap();
    window.key_press_modifiers(Modifiers::COMMAND, egui::Key::R);
    wait(&mut window, "the losses again", |app| {
        loss(app, 0, 0).is_some_and(|now| now != before) && app.names().len() == 2
    });
    assert_eq!(loss(&window, 0, 1), None);
    assert!(has(&window, "2  theirs"));
    // A file that is newer than what is displayed is marked; one that is watched is read again with its losses.
    std::thread::sleep(std::time::Duration::from_millis(1100));
    std::fs::copy(all[2].join("f.png"), all[1].join("a.png")).unwrap();
    see(&mut window, "(newer on disk: Ctrl+R)");
    window.key_press_modifiers(Modifiers::COMMAND, egui::Key::R);
    wait_in(&mut window, "the newer file", |window| !has(window, "newer on disk"));
    let now = loss(&window, 0, 0);
    wait(&mut window, "its loss", |app| loss(app, 0, 0).is_some() && loss(app, 0, 0) == now || now.is_none());
    edit(&mut window, |model| model.settings.watch = true);
    rest(&mut window, 20);
    let before = loss(&window, 0, 0).unwrap();
    std::fs::copy(all[0].join("a.png"), all[1].join("a.png")).unwrap();
    wait(&mut window, "the loss of what was written", |app| {
        loss(app, 0, 0).is_some_and(|now| now != before && now.loss == 0.0)
    });
}

#[needs(adapter)]
fn many_predictions_of_one_material_are_a_list_with_panes_for_the_chosen_and_the_pinned_ones() {
    let folder = tempfile::tempdir().unwrap();
    let files = (0..26).map(|number| match number {
        0 => ("gt".to_owned(), 0),
        _ => (format!("p{:02}", number - 1), 2 + number),
    });
    let mut window = on_files(files.map(|(name, error)| {
        let path = folder.path().join(format!("{name}.png"));
        write(&path, 16, error);
        path
    }));
    wait(&mut window, "the first prediction", |app| app.names() == ["gt", "p00"]);
    wait(&mut window, "all losses", |app| app.jobs().dataset.losses.count() == 25);
    see(&mut window, "25 predictions");
    // Assistive software is told what is open.
    assert_eq!(window.root().accesskit_node().label().as_deref(), Some("p00 (1 of 25) - svbrdf"));
    // The losses are those of one comparison each, over the same scenes.
    let materials = |window: &Window<'_>| window.materials().cloned().collect::<Vec<_>>();
    let pair = materials(&window);
    let by_seed = |seed| {
        let comparison = Comparison::new(&pair[0], &[&pair[1]], Convention::default()).unwrap();
        let request = Request::Accuracy { target: 0.01, seed };
        comparison.run(&request, &Progress::default()).unwrap().losses[0].estimate.mean
    };
    assert_eq!(loss(&window, 0, 0).unwrap().loss, by_seed(0));
    assert_ne!(loss(&window, 0, 0).unwrap().loss, by_seed(1));
    let losses: Vec<f64> = (0..25).map(|case| loss(&window, case, 0).unwrap().loss).collect();
    assert!(losses.is_sorted(), "{losses:?}");
    // A pinned one stays, beside those that are flipped through; the ground truth is read once.
    let id = |window: &Window<'_>| window.model().materials.all[0].id();
    let first = id(&window);
    edit(&mut window, |model| endpoint::move_over_plane(&mut model.view.scene, Endpoint::Light, [0.4, -0.2]));
    let scene = window.scene();
    window.key_press(egui::Key::K);
    for name in ["p01", "p02"] {
        window.key_press(egui::Key::PageDown);
        wait(&mut window, "the next prediction", |app| app.names() == ["gt", name, "p00"]);
    }
    window.key_press(egui::Key::K);
    window.key_press(egui::Key::PageDown);
    wait(&mut window, "two pinned ones", |app| app.names() == ["gt", "p03", "p00", "p02"]);
    window.key_press(egui::Key::PageUp);
    wait(&mut window, "a pinned one once", |app| app.names() == ["gt", "p02", "p00"]);
    assert_eq!((id(&window), window.scene()), (first, scene));
    // Worst first.
    let list = ListView { order: Order::Loss(0), ..ListView::default() };
    edit(&mut window, |model| model.dataset.list = list);
    let listed = window.state().parts.ui.dataset.listed();
    assert_eq!(listed[..3], [24, 23, 22]);
    let session = folder.path().join("many.svbrdf-session.json");
    save(&mut window, SaveKind::Session, &session);
    let mut later = on_session(&session);
    wait(&mut later, "the session", |app| app.names() == ["gt", "p02", "p00"]);
    // The ground truth that all have changes: all losses are of the new one.
    let before = loss(&window, 5, 0);
    std::fs::copy(folder.path().join("p10.png"), folder.path().join("gt.png")).unwrap();
    window.key_press_modifiers(Modifiers::COMMAND, egui::Key::R);
    wait(&mut window, "losses of another ground truth", |app| {
        loss(app, 5, 0) != before && app.jobs().dataset.losses.count() == 25
    });
    assert!(loss(&window, 10, 0).unwrap().loss == 0.0);
}

/// Panes without a material say why there is none.
#[needs(adapter)]
fn a_ground_truth_that_cannot_be_read_is_told_in_the_panes() {
    let folder = tempfile::tempdir().unwrap();
    let folders = folders(folder.path());
    std::fs::write(folders[0].join("b.png"), "no picture").unwrap();
    let dataset = Some(Box::new(dataset(folders, None)));
    let mut window = window(ViewerOptions { dataset, ..ViewerOptions::default() });
    press(&mut window, egui::Key::PageDown);
    wait(&mut window, "the problem", |app| !app.parts.model.dataset.missing.is_empty());
    window.run_steps(3);
    let problem = window.model().dataset.missing[0].problem.clone();
    assert!(problem.contains("b.png") && window.names().is_empty(), "{problem}");
    window.get_by_label(&problem);
    assert!(!has(&window, "Open a material with Ctrl+O, or drop files or folders here."));
    press(&mut window, egui::Key::PageDown);
    wait(&mut window, "the next material", |app| app.names().first().is_some_and(|name| name == "c"));
    assert!(!has(&window, &problem));
}

/// Predictions that are the centre of their ground truths are seen on that part, with the loss of `svbrdf rank`.
#[needs(adapter)]
fn predictions_of_a_registered_method_are_seen_on_their_part_of_the_ground_truth() {
    let folder = tempfile::tempdir().unwrap();
    let [gt, whole, crop] = ["gt", "whole", "crop"].map(|name| folder.path().join(name));
    [&gt, &whole, &crop].into_iter().for_each(|folder| std::fs::create_dir(folder).unwrap());
    let noise = |x: u32, y: u32| (x.wrapping_mul(73) ^ y.wrapping_mul(151)).wrapping_mul(2_654_435_761) >> 25;
    for name in ["a", "b", "c"] {
        let written = |folder: &Path, side, from: u32| {
            write_packed(&folder.join(format!("{name}.png")), side, |tile, x, y| {
                let shade = (40 + noise(x + from, y + from)) as u8;
                [[shade, 255 - shade, 200], [shade; 3], [shade; 3], [20; 3]][tile as usize]
            });
        };
        written(&gt, 48, 0);
        written(&whole, 48, 0);
        written(&crop, 32, 8);
    }
    let mut window = built_in();
    drop_files(&mut window, [gt, whole, crop]);
    wait(&mut window, "the data set", |app| app.names() == ["a", "whole", "crop"]);
    wait(&mut window, "all losses", |app| app.jobs().dataset.losses.count() == 3);
    assert!(window.materials().all(|one| one.size() == [32, 32]));
    let materials: Vec<_> = window.materials().cloned().collect();
    let same =
        |a: &Material<f32>, b: &Material<f32>| (0..32 * 32).all(|texel| a.texel(texel) == b.texel(texel));
    assert!(same(&materials[0], &materials[1]) && same(&materials[0], &materials[2]));
    assert_eq!(loss(&window, 0, 1).unwrap().loss, 0.0);
    tab(&mut window, "Files");
    assert!(has(&window, "crop: registration "));
}
