//! Saving a report.

use svbrdf_core::loss::Ask;

use super::*;

/// The text between two others.
fn between<'a>(text: &'a str, start: &str, end: &str) -> &'a str {
    let from = text.find(start).unwrap_or_else(|| panic!("no {start}")) + start.len();
    &text[from..from + text[from..].find(end).unwrap()]
}

#[needs(adapter)]
fn a_report_begins_as_the_window_and_has_its_losses_and_session() {
    let mut window = by_scenes();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a report.html");
    edit(&mut window, |model| model.view.display.layout = Layout::Wipe);
    edit(&mut window, |model| model.view.set_exposure(1.5));
    let mut scene = window.scene();
    scene.light = [0.1, -0.7, 1.3];
    edit(&mut window, |model| model.view.scene = scene);
    edit(&mut window, |model| model.view.display.difference = true);
    edit(&mut window, |model| set_range(model, Some(0.75)));
    wait(&mut window, "the losses", |app| app.losses().is_some());
    let losses: Vec<f64> = window.losses().unwrap().iter().map(|loss| loss.estimate.mean).collect();
    save(&mut window, SaveKind::Report, &path);
    let html = std::fs::read_to_string(&path).unwrap();
    let data: serde_json::Value = serde_json::from_str(between(&html, r#"id="data">"#, "</script>")).unwrap();
    let start = &data["start"];
    assert_eq!(start["scene"], serde_json::to_value(scene).unwrap());
    assert_eq!([&start["layout"], &start["difference"]], [&"wipe".into(), &serde_json::Value::from(true)]);
    assert_eq!([start["exposure"].as_f64(), start["ranges"]["log"].as_f64()], [Some(1.5), Some(0.75)]);
    for loss in losses {
        assert!(html.contains(&format!("<td>{loss:.4}</td>")), "{loss}");
    }
    let command = "svbrdf report &#39;a report.svbrdf-session.json&#39; -o &#39;a report.html&#39;";
    assert!(html.contains(command));
    // The session within it is the session of the window.
    let text = between(&html, "<summary>a report.svbrdf-session.json</summary><pre><code>", "</code>");
    let session = folder.path().join("a report.svbrdf-session.json");
    std::fs::write(&session, text.replace("&quot;", "\"")).unwrap();
    assert_eq!(Session::read(&session).unwrap(), window.model().session());
}

#[needs(adapter)]
fn a_report_that_is_cancelled_leaves_no_file_and_the_dialog_open() {
    let mut window = built_in();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("report.html");
    let mut settings = window.model().settings.loss.clone();
    (settings.ask, settings.target_percent) = (Ask::Accuracy, 0.05);
    edit(&mut window, |model| model.settings.loss = settings);
    click(&mut window, "Save");
    click(&mut window, "Report");
    edit(&mut window, |model| model.effects.push(Effect::Save(SaveRequest { kind: SaveKind::Report, path })));
    wait(&mut window, "some progress", |app| {
        app.parts.jobs.saving.as_ref().is_some_and(|job| job.fraction() > 0.0)
    });
    click(&mut window, "Cancel saving");
    wait(&mut window, "the end", |app| app.parts.jobs.saving.is_none());
    window.get_by_label("Save file");
    assert!(window.messages().is_empty(), "{:?}", window.messages());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
