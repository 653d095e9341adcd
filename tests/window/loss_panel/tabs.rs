//! Tabs of the side panel beside the losses.

use svbrdf_viewer::jobs::displayed::Displayed;
use svbrdf_viewer::ui::content;

use super::*;

#[needs(adapter)]
#[test]
fn the_loss_is_to_1_percent_with_the_few_scenes_of_the_papers_beside_it() {
    let mut window = built_in();
    wait(&mut window, "the loss", |app| app.losses().is_some());
    let loss = window.state().losses().unwrap()[0].estimate;
    assert!(loss.relative_error95() <= 0.01, "{loss:?}");
    let few = expected(&Sampling::default());
    see(&mut window, "6 + 3 scenes: ");
    for (key, loss) in [egui::Key::Num1, egui::Key::Num2].into_iter().zip(&few) {
        press(&mut window, key);
        let [low, high] = loss.estimate.interval95.unwrap();
        let line = format!("6 + 3 scenes: {:.2} [{low:.3}, {high:.3}]", loss.estimate.mean);
        window.get_by_label(&line);
    }
}

#[needs(adapter)]
#[test]
fn what_has_no_room_beside_the_interval_stands_below_it() {
    let folder = tempfile::tempdir().unwrap();
    let paths = ["gt.png", "ours.png"].map(|name| folder.path().join(name));
    for (path, by) in paths.iter().zip([0, 3]) {
        let of_map = |map: u32| [[128, 128, 255], [90, 110, 130], [120 + by; 3], [40; 3]][map as usize];
        crate::materials::write_packed(path, 16, |map, _, _| of_map(map));
    }
    let mut window = on_files(paths);
    wait(&mut window, "the loss", |app| app.losses().is_some());
    see(&mut window, "6 + 3 scenes: 0.");
    let few = window.get_by_label_contains("6 + 3 scenes: ");
    let text = few.accesskit_node().label().or(few.accesskit_node().value()).unwrap_or_default();
    // More digits than fit, as of a small loss.
    assert!(text.len() > 34, "{text}");
    let right = window.ctx.content_rect().right();
    assert!(few.rect().right() <= right, "{} of {right}", few.rect());
}

#[needs(adapter)]
#[test]
fn of_many_predictions_every_one_is_reached_by_keys_and_by_a_filter() {
    let folder = tempfile::tempdir().unwrap();
    let picture = crate::pictures::packed("NDRS", 4, |_, value| value);
    let names = (0..14).map(|i| format!("a_long_name_of_an_experiment_seed_{i:03}.png"));
    let paths = ["gt.png".to_owned()].into_iter().chain(names).map(|name| folder.path().join(name));
    let mut window = on_files(paths.inspect(|path| picture.save(path).unwrap()));
    wait(&mut window, "all of them", |app| app.names().len() == 15);
    wait(&mut window, "the loss", |app| app.losses().is_some());
    for expected in [13, 12] {
        press_with(&mut window, Modifiers::COMMAND, egui::Key::ArrowUp);
        assert_eq!(window.state().parts.model.view.display.prediction, expected);
    }
    assert!(has(&window, "4  \u{2026}003"), "names end with what differs");
    let parts = &window.state().parts;
    let scenery = content::scenery(&window.ctx, Displayed::of(&parts.model, &parts.jobs), &parts.model.view);
    let titles: Vec<_> = scenery.contents().into_iter().map(|one| scenery.name_of(one, 9)).collect();
    assert_eq!(titles[0], "GROUND TRUTH  gt");
    assert!((1..15).all(|i| titles[i] == format!("{i}  \u{2026}{:03}", i - 1)), "so do titles: {titles:?}");
    window.get_by_role(Role::TextInput).click();
    window.run_steps(3);
    window.get_by_role(Role::TextInput).type_text("seed_007");
    window.run_steps(4);
    assert!(!has(&window, "4  \u{2026}003"));
    window.get_by_label_contains("8  \u{2026}007").click();
    window.run_steps(3);
    assert_eq!(window.state().parts.model.view.display.prediction, 7);
}
