//! The table of a data set with pictures.

use svbrdf_viewer::dataset::matrix::Matrix;
use svbrdf_viewer::dataset::pictures::MatrixCell;
use svbrdf_viewer::dataset::pictures::{self, CellPictures};
use svbrdf_viewer::dataset::summary;
use svbrdf_viewer::jobs::answers::Answered;

use super::*;

#[needs(adapter)]
fn the_light_is_dragged_in_any_cell_and_a_row_is_the_panes_until_escape() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = built_in();
    drop_files(&mut window, folders(folder.path()));
    wait(&mut window, "the table", |app| app.parts.model.dataset.table.has_pictures);
    edit(&mut window, |model| model.dataset.table.cell = Some(64.0));
    wait(&mut window, "the first material", |app| app.names()[0] == "a");
    wait_for_losses(&mut window);
    tab(&mut window, "Methods");
    wait(&mut window, "the summary", |app| summary::drawn(app.shown()).is_some());
    see(&mut window, "theirs has 3 of 6 materials");
    // Escape leaves the search, and shows all again.
    press_with(&mut window, Modifiers::COMMAND, egui::Key::F);
    window.event(egui::Event::Text("e".to_owned()));
    window.run_steps(3);
    assert!(has(&window, "1 of 6 materials"));
    press(&mut window, egui::Key::Escape);
    assert!(!has(&window, "1 of 6 materials") && window.model().dataset.list.search.is_empty());
    wait_in(&mut window, "the cells", |window| {
        let pictures = pictures_of(window);
        let of = |case, column| MatrixCell { case, column };
        pictures
            .as_deref()
            .is_some_and(|pictures| pictures.part(of(0, 1)).is_some() && pictures.part(of(2, 2)).is_none())
    });
    let before = pictures_of(&window).unwrap().atlas.picture.clone();
    let rect = window.get_by_label("Cell b, ours").rect();
    drag_primary(&mut window, rect, vec2(0.5, 0.5), vec2(0.75, 0.25));
    let light = window.scene().light;
    assert!((light[0] - 0.5).abs() < 0.05 && (light[1] - 0.5).abs() < 0.05, "{light:?}");
    wait_in(&mut window, "other pictures", |window| {
        pictures_of(window).is_some_and(|pictures| pictures.atlas.picture != before)
    });
    assert_eq!(window.names()[0], "a", "a drag opens nothing");
    // A click chooses the cell, of which the side panel tells; Enter makes its row the panes, and Escape goes back.
    click(&mut window, "Cell e, theirs");
    wait(&mut window, "the material", |app| app.names()[0] == "e");
    let chosen = |window: &Window<'_>| window.model().chosen_prediction().unwrap().name().to_owned();
    assert!(window.model().dataset.table.has_pictures && chosen(&window) == "theirs");
    for opens in [egui::Key::Enter, egui::Key::S] {
        press(&mut window, opens);
        assert!(!window.model().dataset.table.has_pictures && has(&window, "Pane 2  theirs"));
        press(&mut window, egui::Key::Escape);
        assert!(window.model().dataset.table.has_pictures && !has(&window, "Pane 2  theirs"));
    }
    double_click(&mut window, "Cell f, ours");
    wait(&mut window, "the row", |app| app.names()[0] == "f");
    assert!(has(&window, "Pane 1  ours") && chosen(&window) == "ours");
    edit(&mut window, opening::open_built_in);
    wait(&mut window, "the built-in materials", |app| app.names()[0] == "worn tiles");
    assert!(!has(&window, "Tab Methods"), "another comparison closes it");
}

fn double_click(window: &mut Window<'_>, label: &str) {
    let at = window.get_by_label(label).rect().center();
    hover(window, at);
    for pressed in [true, false, true, false] {
        window.event(primary(at, pressed));
        window.step();
    }
    window.run_steps(3);
}

/// The latest pictures of the table.
fn pictures_of(window: &Window<'_>) -> Option<Arc<Answered<CellPictures>>> {
    pictures::latest(window.shown())
}

/// The range of the latest cells.
fn range(window: &Window<'_>) -> Option<f64> {
    pictures_of(window)?.range
}

#[needs(adapter)]
fn the_table_sorts_by_its_heads_and_has_one_range() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = on_table(&dataset(folders(folder.path()), None));
    // A click on the name of a method sorts by its losses; again, the other way round.
    let listed = |window: &Window<'_>| Matrix::ask(window.shown()).unwrap().rows;
    let by_name = listed(&window);
    // The heads are the table of methods, and stay where they are as the rows are scrolled.
    wait(&mut window, "the summary", |app| summary::drawn(app.shown()).is_some());
    let head = |window: &Window<'_>| window.get_by_label_contains("Sort by ours").rect();
    assert!(has(&window, "rank 1") && has(&window, "unranked"));
    let row = |window: &Window<'_>| window.get_by_label("Material c").rect();
    let before = (head(&window), row(&window));
    hover(&mut window, before.1.center());
    window.event(wheel(vec2(0.0, -40.0), egui::MouseWheelUnit::Point, Modifiers::NONE));
    rest(&mut window, 12);
    assert!(head(&window) == before.0 && row(&window).top() < before.1.top() - 20.0);
    for is_reversed in [false, true] {
        window.get_by_label_contains("Sort by ours").click();
        window.run_steps(4);
        let list = window.model().dataset.list.clone();
        assert_eq!((list.order, list.is_reversed), (ListOrder::Loss(0), is_reversed));
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
fn a_column_that_is_dragged_has_its_number_in_another_place_also_in_sessions() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = on_table(&dataset(folders(folder.path()), None));
    wait(&mut window, "the summary", |app| summary::drawn(app.shown()).is_some());
    let places = |window: &Window<'_>| {
        ["ours", "theirs"].map(|of| {
            let head = window.get_by_label_contains(&format!("Sort by {of}")).rect();
            let cell = window.get_by_label(&format!("Cell a, {of}")).rect();
            (head, cell.left())
        })
    };
    let [ours, theirs] = places(&window);
    let to = (theirs.0.center() - ours.0.min) / ours.0.size();
    drag_primary(&mut window, ours.0, vec2(0.5, 0.5), to);
    assert_eq!(places(&window), [theirs, ours]);
    assert_eq!(window.model().dataset.list.order, ListOrder::Name, "a drag sorts nothing");
    let list = window.model().session().dataset.unwrap().list;
    assert_eq!(list["methods"], json!(["theirs", "ours"]));
    click(&mut window, "Cell a, theirs");
    assert_eq!(window.model().chosen_prediction().map(|one| one.slot), Some(2));
}

#[needs(adapter)]
fn the_list_keeps_the_width_that_it_is_given() {
    let folder = tempfile::tempdir().unwrap();
    let dataset = dataset(folders(folder.path()), None);
    let mut window = on_dataset(&dataset);
    let left = |window: &Window<'_>| pane(window, "GROUND TRUTH  a").left();
    let before = left(&window);
    assert_eq!(window.model().settings.list_width, None);
    stillness::drag_edge(&mut window, before - 1.0, 80.0);
    let after = left(&window);
    assert!((after - before - 80.0).abs() < 20.0, "{before} to {after}");
    // In the next window.
    let settings = window.model().settings.clone();
    let mut window = on_table(&dataset);
    edit(&mut window, |model| (model.settings = settings, model.dataset.show_table(false)).0);
    window.run_steps(4);
    assert!((left(&window) - after).abs() < 2.0, "{after}, then {}", left(&window));
}

/// The head of a method.
fn head_of(window: &Window<'_>, method: &str) -> String {
    window.get_by_label_contains(&format!("Sort by {method}")).accesskit_node().label().unwrap_or_default()
}

#[needs(adapter)]
fn methods_with_one_mean_have_one_rank() {
    let folder = tempfile::tempdir().unwrap();
    let all = folders(folder.path());
    // A copy of a method, and one that is worse on every material that it has.
    let [twin, worse] = ["twin", "worse"].map(|name| folder.path().join(name));
    [&twin, &worse].into_iter().for_each(|folder| std::fs::create_dir(folder).unwrap());
    for name in ["a", "b", "c", "d", "e", "f"].map(|name| format!("{name}.png")) {
        std::fs::copy(all[1].join(&name), twin.join(&name)).unwrap();
        write(&worse.join(&name), if name == "e.png" { 24 } else { 16 }, 60);
    }
    let methods = vec![(None, worse), (None, all[1].clone()), (None, twin)];
    let source = Source::folders(all[0].clone(), methods);
    let request = Request::Accuracy { target: 0.02, seed: 0 };
    let mut window = on_table(&OpenDataset::new(source, DatasetReading::default(), request, None).unwrap());
    wait(&mut window, "the summary", |app| {
        summary::drawn(app.shown()).is_some_and(|report| report.results.len() == 6)
    });
    for (method, rank) in [("ours", 1), ("twin", 1), ("worse", 3)] {
        let head = head_of(&window, method);
        assert!(head.contains(&format!("rank {rank}")), "{head}");
    }
}

/// What is written while the table is displayed is marked in its row, and read again with its losses.
#[needs(adapter)]
fn a_row_whose_files_are_newer_is_marked_and_read_again() {
    let folder = tempfile::tempdir().unwrap();
    let all = folders(folder.path());
    let mut window = on_table(&dataset(all.clone(), None));
    edit(&mut window, |model| model.dataset.table.cell = Some(64.0));
    wait_in(&mut window, "the cells", |window| {
        pictures_of(window).is_some_and(|pictures| pictures.part(MatrixCell { case: 4, column: 1 }).is_some())
    });
    let before = loss(&window, 4, 0).unwrap();
    assert_eq!(window.names()[0], "a", "another material is in the window");
    std::thread::sleep(std::time::Duration::from_millis(1100));
    std::fs::copy(all[0].join("e.png"), all[1].join("e.png")).unwrap();
    wait(&mut window, "the mark", |app| app.parts.model.dataset.newer.contains(&4));
    assert_eq!((loss(&window, 4, 0), window.model().dataset.newer.len()), (Some(before), 1));
    window.key_press_modifiers(Modifiers::COMMAND, egui::Key::R);
    wait(&mut window, "its loss", |app| loss(app, 4, 0).is_some_and(|now| now.loss == 0.0));
    assert!(window.model().dataset.newer.is_empty());
}

/// A name of a method stays beside its numbers, and the reason of a failed cell is told whole.
#[needs(adapter)]
fn names_stay_as_numbers_scroll_and_a_failed_cell_tells_why() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = on_table(&dataset(folders(folder.path()), None));
    tab(&mut window, "Methods");
    wait(&mut window, "the summary", |app| summary::drawn(app.shown()).is_some());
    window.run_steps(3);
    let left = |window: &Window<'_>, label: &str| window.get_by_label(label).rect().left();
    let before = ["method", "median"].map(|label| left(&window, label));
    let over = window.get_by_label("mean loss").rect().center();
    hover(&mut window, over);
    window.event(wheel(vec2(-120.0, 0.0), egui::MouseWheelUnit::Point, Modifiers::NONE));
    rest(&mut window, 12);
    assert_eq!(left(&window, "method"), before[0]);
    assert!(left(&window, "median") < before[1] - 50.0, "{} was {}", left(&window, "median"), before[1]);
    let failed = window.get_by_label("Cell c, theirs").rect().center();
    hover(&mut window, failed);
    rest(&mut window, 60);
    assert!(window.query_all_by_label_contains("theirs/c.png").next().is_some());
}
