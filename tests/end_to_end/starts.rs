//! Starts of the window on settings that other programs, crashes and hands have left.

use svbrdf_needs::needs;

use super::*;

/// As while it is updated.
#[needs(f32_adapter, desktop)]
fn after_a_loss_a_driver_that_is_gone_is_waited_for() {
    let desktop = Desktop::start();
    let (drivers, system) = (desktop.folder.path().join("drivers"), Path::new("/usr/share/vulkan/icd.d"));
    let names = std::fs::read_dir(system).unwrap().map(|entry| drivers.join(entry.unwrap().file_name()));
    let mut command = desktop.svbrdf();
    command.env("WGPU_BACKEND", "vulkan").env("VK_DRIVER_FILES", std::env::join_paths(names).unwrap());
    let now = std::time::SystemTime::UNIX_EPOCH.elapsed().unwrap().as_secs();
    command.env("SVBRDF_RESTARTED", format!("1:{now}:planted"));
    let back = std::thread::spawn(move || {
        std::thread::sleep(Duration::from_secs(5));
        std::os::unix::fs::symlink(system, drivers).unwrap();
    });
    let mut program = desktop.run(command, &[]);
    back.join().unwrap();
    assert!(program.0.try_wait().unwrap().is_none(), "the window is that of the program that was started");
}

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
