//! The contact sheet of a data set.

use svbrdf_viewer::dataset::pictures::SheetCell;
use svbrdf_viewer::dataset::pictures::{self, SheetPicture};
use svbrdf_viewer::dataset::rows::Rows;
use svbrdf_viewer::dataset::summary;
use svbrdf_viewer::jobs::answers::Answered;

use super::*;

#[needs(adapter)]
fn the_light_is_dragged_in_any_cell_of_the_sheet_and_a_click_opens_what_escape_returns_from() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = built_in();
    drop_files(&mut window, folders(folder.path()));
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
    window.key_press(egui::Key::S);
    window.run_steps(3);
    wait_in(&mut window, "the cells", |window| {
        let sheet = sheet(window);
        let of = |case, column| SheetCell { case, column };
        sheet.as_deref().is_some_and(|sheet| sheet.part(of(0, 1)).is_some() && sheet.part(of(2, 2)).is_none())
    });
    let before = sheet(&window).unwrap().atlas.picture.clone();
    let rect = window.get_by_label("Cell b, ours").rect();
    drag_primary(&mut window, rect, vec2(0.5, 0.5), vec2(0.75, 0.25));
    let light = window.scene().light;
    assert!((light[0] - 0.5).abs() < 0.05 && (light[1] - 0.5).abs() < 0.05, "{light:?}");
    wait_in(&mut window, "other pictures", |window| {
        sheet(window).is_some_and(|sheet| sheet.atlas.picture != before)
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

/// The latest pictures of the sheet.
fn sheet(window: &Window<'_>) -> Option<Arc<Answered<SheetPicture>>> {
    pictures::latest(window.shown())
}

/// The range of the latest cells.
fn range(window: &Window<'_>) -> Option<f64> {
    sheet(window)?.range
}

#[needs(adapter)]
fn the_sheet_has_losses_sorts_by_its_heads_and_has_one_range() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = on_dataset(&dataset(folders(folder.path()), None));
    press(&mut window, egui::Key::S);
    // A click on the name of a method sorts by its losses; again, the other way round.
    let listed = |window: &Window<'_>| Rows::ask(window.shown()).cases;
    let by_name = listed(&window);
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
