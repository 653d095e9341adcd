//! Starts of the window on settings and displays that other programs, crashes and hands have left.

use svbrdf_needs::needs;

use super::*;

/// The folder of the settings, with this file of them.
fn settings(desktop: &Desktop, text: &str) -> std::path::PathBuf {
    let folder = desktop.folder.path().join(".local/share/svbrdf");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("app.ron"), text).unwrap();
    folder
}

#[needs(f32_adapter, desktop)]
#[test]
fn a_window_opens_with_damaged_settings() {
    let window = |side: &str| {
        format!(
            "(normal_geometry:(outer_position_pixels:Some((x:0.0,y:0.0)),scale_factor:1.0,\
             inner_size_points:(x:{side},y:{side})),fullscreen:false,maximized:false)"
        )
    };
    let cases = [
        r#"{"settings": "(dark:true)", "egui": "(options:(zoom_factor:NaN))"}"#.to_owned(),
        format!(
            r#"{{"settings": "(dark:true)", "egui": "(options:(zoom_factor:0.0))", "window": "{}"}}"#,
            window("0.0")
        ),
        r#"{"settings": "(dark:true,ui_scale:4.0)", "egui": "(options:(zoom_factor:1e30))"}"#.to_owned(),
    ];
    for text in cases {
        let desktop = Desktop::start();
        settings(&desktop, &text);
        let mut program = desktop.open(&[]);
        assert!(program.0.try_wait().unwrap().is_none(), "{text}: the program still runs");
    }
}

#[needs(f32_adapter, desktop)]
#[test]
fn settings_that_are_a_pipe_are_moved_aside() {
    let desktop = Desktop::start();
    let folder = settings(&desktop, "");
    std::fs::remove_file(folder.join("app.ron")).unwrap();
    assert!(Command::new("mkfifo").arg(folder.join("app.ron")).status().unwrap().success());
    let mut program = desktop.open(&[]);
    assert!(folder.join("app.ron.damaged").exists());
    assert!(program.0.try_wait().unwrap().is_none(), "the program still runs");
}

#[needs(f32_adapter, desktop)]
#[test]
fn a_stale_wayland_display_beside_an_x11_one_is_passed_over() {
    let desktop = Desktop::start();
    // A socket that nobody listens at any more.
    drop(std::os::unix::net::UnixListener::bind(desktop.folder.path().join("wayland-7")).unwrap());
    let mut command = desktop.svbrdf();
    command.env("WAYLAND_DISPLAY", "wayland-7");
    let mut program = desktop.run(command, &[]);
    assert!(program.0.try_wait().unwrap().is_none(), "the program still runs");
}
