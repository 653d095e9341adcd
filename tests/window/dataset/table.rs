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
