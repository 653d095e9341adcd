//! Starts of the window on settings that other programs, crashes and hands have left.

use svbrdf_needs::needs;

use super::*;

#[needs(f32_adapter, desktop)]
fn a_window_opens_with_damaged_settings() {
    for text in [
        r#"{"settings": {"ui_scale": 1e30, "window": [0.0, 1e30]}}"#,
        r#"{"settings": {"ui_scale": 4.0, "window": [1e9, 1e9]}}"#,
        r#"{"settings": "(dark:true)"}"#,
    ] {
        let desktop = Desktop::start();
        let folder = desktop.folder.path().join(".local/share/svbrdf");
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("settings.json"), text).unwrap();
        let mut program = desktop.open(&[]);
        assert!(program.0.try_wait().unwrap().is_none(), "{text}: the program still runs");
        assert_eq!(folder.join("settings.json.damaged").exists(), text.contains("dark"), "{text}");
    }
}
