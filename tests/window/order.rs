//! Whether the order survives: the fold has what `svbrdf rank --robust` prints, of what is in the window now.

use svbrdf_core::progress::Progress;
use svbrdf_evaluate::report::{Report as _, RobustReport};
use svbrdf_evaluate::robust::RobustInput;
use svbrdf_files::convention::ChosenConvention;
use svbrdf_viewer::model::command::{LossCommand, SceneCommand};

use super::materials::write_packed;
use super::*;

const TITLE: &str = "Does the order survive?";

/// Materials `gt`, `near` and `far` of this number in their folders.
fn write(folder: &Path, number: u8) -> [PathBuf; 3] {
    [("gt", 0), ("near", 8), ("far", 60)].map(|(name, more)| {
        let folder = folder.join(name);
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join(format!("m{number}.png"));
        write_packed(&path, 8, |tile, x, y| {
            [[128, 128, 255], [100 + x as u8; 3], [100 + 10 * number + more; 3], [20 + y as u8; 3]]
                [tile as usize]
        });
        path
    })
}

/// The losses of the questions to ±10%.
fn coarse(window: &mut Window<'_>) {
    let mut loss = window.state().parts.model.settings.loss.clone();
    loss.target_percent = 10.0;
    apply(window, LossCommand::SetSettings(loss));
}

fn report(app: &App) -> Option<Arc<RobustReport>> {
    app.parts.jobs.order.state().ok().flatten().map(|answer| answer.clone().unwrap())
}

#[needs(adapter)]
fn the_fold_of_predictions_has_the_answer_of_the_command_line_in_the_convention_of_now() {
    let folder = tempfile::tempdir().unwrap();
    let paths = write(folder.path(), 0);
    let mut window = on_files(paths);
    coarse(&mut window);
    assert!(report(window.state()).is_none(), "not asked yet");
    for convention in ["printed", "svbrdf-estimation-2022"] {
        let chosen = ChosenConvention::read(convention).unwrap();
        apply(&mut window, SceneCommand::SetConvention(chosen));
        if convention == "printed" {
            click(&mut window, TITLE);
        }
        wait(&mut window, "the answer", |app| report(app).is_some());
        let found = report(window.state()).unwrap();
        let materials: Vec<_> =
            window.state().parts.model.materials.all.iter().map(|one| one.read.clone()).collect();
        let names: Vec<String> = window.state().names();
        let materials: Vec<_> = materials
            .iter()
            .zip(&names)
            .map(|(read, name)| read.material().clone().renamed(name.clone()))
            .collect();
        let input = RobustInput {
            ground_truth: &materials[0],
            predictions: materials[1..].iter().collect(),
            convention: convention.parse().unwrap(),
            target_error: 0.1,
            seed: 0,
        };
        let expected = RobustReport::new(&input, &Progress::default()).unwrap();
        assert_eq!(found.text(), expected.text());
        see(&mut window, found.sentence());
        assert!(found.text().contains(&format!("convention {convention}")), "{}", found.text());
    }
    // Folded, nothing is asked.
    click(&mut window, TITLE);
    apply(&mut window, SceneCommand::SetConvention(ChosenConvention::read("guided-2020").unwrap()));
    rest(&mut window, 5);
    assert!(window.state().parts.jobs.order.state().is_ok(), "no job");
}
