//! Whether the order survives: the fold has what `svbrdf rank --robust` prints, of what is in the window now.

use svbrdf_core::loss::Comparison;
use svbrdf_evaluate::report::Report as _;
use svbrdf_evaluate::robust::RobustReport;
use svbrdf_viewer::loss::losses::PredictionOrder;

use super::*;

const TITLE: &str = "Does the order survive?";

/// The answer, of the convention of now.
fn report(app: &App) -> Option<RobustReport> {
    let known = app.jobs().answers.known(&PredictionOrder::of(app.model()));
    known.map(|report| report.answer.clone())
}

#[needs(adapter)]
fn the_fold_of_predictions_has_the_answer_of_the_command_line_in_the_convention_of_now() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = on_files([("gt", 0), ("near", 8), ("far", 60)].map(|(name, more)| {
        let path = folder.path().join(format!("{name}.png"));
        write_packed(&path, 8, |tile, x, y| {
            [[128, 128, 255], [100 + x as u8; 3], [100 + more; 3], [20 + y as u8; 3]][tile as usize]
        });
        path
    }));
    let mut loss = window.model().settings.loss.clone();
    loss.target_percent = 10.0;
    edit(&mut window, |model| model.settings.loss = loss);
    assert!(report(window.state()).is_none(), "not asked yet");
    for convention in ["printed", "svbrdf-estimation-2022"] {
        let chosen = ChosenConvention::read(convention).unwrap();
        edit(&mut window, |model| model.use_convention(chosen));
        if convention == "printed" {
            // The rows of losses that arrive move what is below them, under the pointer.
            wait(&mut window, "the losses", |app| app.losses().is_some());
            click(&mut window, TITLE);
        }
        wait(&mut window, "the answer", |app| report(app).is_some());
        let found = report(window.state()).unwrap();
        let all = window.model().materials.all.iter();
        let materials: Vec<_> =
            all.map(|one| one.read.material().clone().renamed(one.name().to_owned())).collect();
        let predictions: Vec<_> = materials[1..].iter().collect();
        let of = Comparison::new(&materials[0], &predictions, convention.parse().unwrap()).unwrap();
        let expected =
            RobustReport::new(&of, &Request::Accuracy { target: 0.1, seed: 0 }, &Progress::default())
                .unwrap();
        assert_eq!(found.text(), expected.text());
        see(&mut window, &found.sentence);
        assert!(found.text().contains(&format!("convention {convention}")), "{}", found.text());
    }
    // Folded, nothing is asked.
    click(&mut window, TITLE);
    edit(&mut window, |model| model.use_convention(ChosenConvention::read("guided-2020").unwrap()));
    rest(&mut window, 5);
    assert!(!window.jobs().answers.is_running::<PredictionOrder>());
}
