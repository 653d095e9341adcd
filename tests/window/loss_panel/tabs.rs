//! Tabs of the side panel beside the losses.

use std::path::PathBuf;

use super::*;

#[needs(adapter)]
#[test]
fn the_loss_is_to_1_percent_with_the_few_scenes_of_the_papers_beside_it() {
    let mut window = built_in();
    wait(&mut window, "the loss", |app| app.losses().is_some());
    let loss = window.state().losses().unwrap()[0].estimate;
    assert!(loss.relative_error95() <= 0.01, "{loss:?}");
    let few = expected(&Sampling::default()).losses;
    for _ in 0..3000 {
        window.step();
        if window.query_all_by_label_contains("6 + 3 scenes: ").count() == 1 {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    for (key, loss) in [egui::Key::Num1, egui::Key::Num2].into_iter().zip(&few) {
        press(&mut window, key);
        let [low, high] = loss.estimate.interval95.unwrap();
        let line = format!("6 + 3 scenes: {:.2} [{low:.3}, {high:.3}]", loss.estimate.mean);
        window.get_by_label(&line);
    }
}

#[needs(adapter)]
#[test]
fn the_why_tab_has_the_loss_of_this_scene_as_the_core_gives_it() {
    let mut window = built_in();
    tab(&mut window, "Why");
    let scene = window.state().parts.model.view.scene;
    let samples = samples::load::<f32>().unwrap();
    let predictions: Vec<&Material<f32>> = samples.predictions.iter().map(|r| &r.material).collect();
    let comparison = Comparison::new(&samples.ground_truth.material, &predictions, PRINTED).unwrap();
    let outcome = comparison.run(&Request::Listed(vec![scene]), &Progress::default()).unwrap();
    for loss in &outcome.losses {
        let text = format!("{:.4}", loss.estimate.mean);
        for _ in 0..3000 {
            window.step();
            if window.query_all_by_label(&text).next().is_some() {
                break;
            }
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
        assert!(window.query_all_by_label(&text).next().is_some(), "no {text}");
    }
}

#[needs(adapter)]
#[test]
fn of_many_predictions_every_one_is_reached_by_keys_and_by_a_filter() {
    let folder = tempfile::tempdir().unwrap();
    let picture = crate::pictures::packed("NDRS", 4, |_, value| value);
    let save = |name: String| -> PathBuf {
        let path = folder.path().join(name);
        picture.save(&path).unwrap();
        path
    };
    let options = ViewerOptions {
        ground_truth: Some(save("gt.png".to_owned()).into()),
        predictions: (0..14)
            .map(|i| save(format!("a_long_name_of_an_experiment_seed_{i:03}.png")).into())
            .collect(),
        ..ViewerOptions::default()
    };
    let mut window = window(options);
    wait(&mut window, "all of them", |app| app.names().len() == 15);
    wait(&mut window, "the loss", |app| app.losses().is_some());
    for expected in [13, 12] {
        window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::ArrowUp);
        window.run_steps(3);
        assert_eq!(window.state().parts.model.view.display.prediction, expected);
    }
    assert!(window.query_by_label_contains("4  \u{2026}003").is_some(), "names end with what differs");
    window.get_by_role(egui::accesskit::Role::TextInput).click();
    window.run_steps(3);
    window.get_by_role(egui::accesskit::Role::TextInput).type_text("seed_007");
    window.run_steps(4);
    assert!(window.query_by_label_contains("4  \u{2026}003").is_none());
    window.get_by_label_contains("8  \u{2026}007").click();
    window.run_steps(3);
    assert_eq!(window.state().parts.model.view.display.prediction, 7);
}
