//! Tabs of the side panel beside the losses.

use svbrdf_viewer::jobs::displayed::Displayed;
use svbrdf_viewer::ui::content;

use super::*;

#[needs(adapter)]
fn of_many_predictions_every_one_is_reached_by_keys_and_by_a_filter() {
    let folder = tempfile::tempdir().unwrap();
    let picture = crate::pictures::packed(|value| value);
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
    let scenery = content::scenery(&window.ctx, Displayed::of(&parts.model, &parts.jobs));
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
