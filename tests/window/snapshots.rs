//! The window as text: the role, name and value of everything that assistive software is told, where it is. What a person reads is in
//! these files, which `SVBRDF_BLESS=1` renews.

use std::fmt::Write as _;

use eframe::egui::accesskit::Toggled;

use super::*;

/// The tree below a node, a line each, indented.
fn tree<'tree>(node: &egui_kittest::Node<'tree>, depth: usize, text: &mut String) {
    let told = node.accesskit_node();
    let (label, value) = (told.label().unwrap_or_default(), told.value().unwrap_or_default());
    let is_told = !(label.is_empty() && value.is_empty() && told.numeric_value().is_none());
    if is_told {
        let on = if told.toggled() == Some(Toggled::True) { " *" } else { "" };
        let words = [label, value].map(|text| masked(&text)).join(" = ");
        let words = words.trim_end_matches([' ', '=']).trim_start_matches(" = ");
        let _ = writeln!(text, "{}{:?} {words}{on}", "  ".repeat(depth), told.role());
    }
    // The lines of a text are its own, and the edges of a dialog are no words.
    let is_shown = |role| !matches!(role, Role::TextRun | Role::Splitter);
    for child in node.children().filter(|child| is_shown(child.accesskit_node().role())) {
        tree(&child, depth + usize::from(is_told), text);
    }
}

/// Without what differs by machine: the folder, numbers with a point or an exponent, and seconds.
fn masked(text: &str) -> String {
    let words: Vec<&str> =
        text.split_inclusive(|c: char| c.is_whitespace() || "[](),±:".contains(c)).collect();
    let is_end = |c: char| c.is_whitespace() || "[](),±:%".contains(c);
    let mask = |index: usize| {
        let (word, next) =
            (words[index], words.get(index + 1).map_or("", |next| next.trim_end_matches(is_end)));
        let bare = word.trim_end_matches(is_end);
        let digits = bare.trim_start_matches(['-', '+', '\u{2212}', '\u{d7}']);
        let is_masked = digits.contains(['.', 'e']) || ["ms", "s"].contains(&next);
        let is_number = digits.starts_with(|c: char| c.is_ascii_digit()) && is_masked;
        if is_number { format!("#{}", &word[bare.len()..]) } else { word.to_owned() }
    };
    let text: String = (0..words.len()).map(mask).collect();
    let here = std::env::current_dir().unwrap().display().to_string();
    text.replace("# ms", "# s").replace(&here, "FOLDER")
}

/// Compares the window with `snapshots/NAME.txt`, which has what differs from the first one; where a dialog is open, the dialog.
fn assert_snapshot(window: &Window<'_>, name: &str) {
    let mut text = String::new();
    let root = window.root();
    let dialog = root.children().find(|child| child.accesskit_node().role() == Role::Window);
    tree(&dialog.unwrap_or(root), 0, &mut text);
    let path = |name: &str| Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("snapshots/{name}.txt"));
    if name != "loss" {
        let first = std::fs::read_to_string(path("loss")).unwrap_or_default();
        let is_new = |line: &&str| !first.lines().any(|of_first| of_first == *line);
        text = text.lines().filter(is_new).map(|line| format!("{line}\n")).collect();
    }
    let path = path(name);
    if std::env::var_os("SVBRDF_BLESS").is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, &text).unwrap();
    }
    let expected = std::fs::read_to_string(&path).unwrap_or_default();
    let differs = text.lines().zip(expected.lines()).position(|(a, b)| a != b);
    let at = differs.unwrap_or(text.lines().count().min(expected.lines().count()));
    let line = |text: &str| text.lines().nth(at).unwrap_or("nothing").to_owned();
    assert!(
        text == expected,
        "{name}, line {}: {:?}, expected {:?}; SVBRDF_BLESS=1 renews the file",
        at + 1,
        line(&text),
        line(&expected)
    );
}

/// The built-in pair in a window of this size, once its loss is there.
fn settled<'a>(size: Vec2) -> Window<'a> {
    let mut window = built_in();
    window.set_size(size);
    wait(&mut window, "the loss", |app| app.losses().is_some());
    window.run_steps(30);
    window
}

#[needs(adapter)]
fn the_window_has_the_words_and_the_order_of_the_snapshots() {
    let mut window = settled(vec2(1360.0, 860.0));
    assert_snapshot(&window, "loss");
    window.state_mut().parts.model.settings.tab = Tab::Files;
    window.run_steps(12);
    assert_snapshot(&window, "files");
    window.state_mut().parts.model.settings.tab = Tab::Why;
    wait(&mut window, "the diagnosis", |app| app.diagnosis().is_some());
    wait(&mut window, "the attribution", |app| app.attribution().is_some());
    wait(&mut window, "the scenes", |app| {
        app.listed_scenes().is_some_and(|(_, thumbnails)| !thumbnails.is_empty())
    });
    see(&mut window, "roughness of wrong roughness: 60.1% of the loss");
    window.run_steps(12);
    assert_snapshot(&window, "why");
    window.state_mut().parts.model.settings.tab = Tab::Loss;
    edit(&mut window, |model| model.view.display.difference = true);
    statistics(&mut window);
    let at = pane(&window, GROUND_TRUTH).center();
    hover(&mut window, at);
    press(&mut window, egui::Key::I);
    press(&mut window, egui::Key::Q);
    let rect = pane(&window, GROUND_TRUTH);
    drag_primary(&mut window, rect, vec2(0.3, 0.3), vec2(0.6, 0.5));
    hover(&mut window, egui::pos2(1.0, 1.0));
    rest(&mut window, 20);
    assert_snapshot(&window, "difference");
}

#[needs(adapter)]
fn dialogs_menu_and_small_windows_have_the_words_of_the_snapshots() {
    let mut window = settled(vec2(900.0, 600.0));
    press(&mut window, egui::Key::B);
    window.run_steps(20);
    for (name, open) in [("open", actions::OPEN), ("save", actions::SAVE)] {
        edit(&mut window, open);
        window.run_steps(8);
        assert_snapshot(&window, name);
        press(&mut window, egui::Key::Escape);
    }
    click(&mut window, "Menu");
    assert_snapshot(&window, "menu");
    let name = window.state().parts.gpu.as_ref().unwrap().gpu.report.name.clone();
    click(&mut window, "Graphics adapter");
    see(&mut window, &name);
    click(&mut window, &name);
    assert_eq!(window.model().settings.adapter, Some(name), "of the next start");
}
