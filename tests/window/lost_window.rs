//! A graphics device that is lost: the window of the system is opened again on another device.

use std::process::Stdio;
use std::time::{Duration, Instant};

use svbrdf_needs::needs;

use crate::desktop::{Desktop, Running, changed, colours};

/// The window in a program that loses its device: `losing.rs`.
fn start(desktop: &Desktop, when: &str) -> Running {
    let log = std::fs::File::create(desktop.folder.path().join("log")).unwrap();
    let mut command = desktop.program(env!("CARGO_BIN_EXE_losing"));
    command.arg(when).stdout(Stdio::null()).stderr(log);
    command.spawn().map(Running).unwrap()
}

fn log(desktop: &Desktop) -> String {
    std::fs::read_to_string(desktop.folder.path().join("log")).unwrap()
}

#[needs(f32_adapter, desktop)]
#[test]
fn the_window_comes_back_after_each_loss_and_the_light_stays_where_it_was_dragged() {
    let desktop = Desktop::start();
    let mut program = start(&desktop, "drag");
    desktop.wait("the built-in pair to be drawn", |p| colours(p) > 3000);
    let before = desktop.wait_until_still();
    for (x, y) in [(330, 180), (200, 420), (300, 300)] {
        desktop.xdotool("mousemove 260 260");
        desktop.xdotool("mousedown 1");
        desktop.xdotool(&format!("mousemove {} {}", (260 + x) / 2, (260 + y) / 2));
        desktop.xdotool(&format!("mousemove {x} {y}"));
        desktop.xdotool("mouseup 1");
        desktop.wait("the window on its new device", |p| colours(p) > 3000 && changed(p, &before) > 20_000);
        assert!(program.0.try_wait().unwrap().is_none(), "{}", log(&desktop));
    }
    let lost = desktop.wait_until_still();
    desktop.xdotool("search --sync --name svbrdf windowfocus");
    desktop.xdotool("key m");
    desktop.wait("the normal map to be shown", |p| changed(p, &lost) > 60_000);
    assert_eq!(log(&desktop), "");
}

#[needs(f32_adapter, desktop)]
#[test]
fn where_devices_are_lost_again_and_again_the_program_ends_and_tells_what_to_do() {
    let desktop = Desktop::start();
    let mut program = start(&desktop, "always");
    let start = Instant::now();
    let status = loop {
        if let Some(status) = program.0.try_wait().unwrap() {
            break status;
        }
        assert!(start.elapsed() < Duration::from_secs(60), "it tries for ever");
        std::thread::sleep(Duration::from_millis(200));
    };
    let log = log(&desktop);
    assert_eq!(status.code(), Some(1), "{log}");
    assert!(log.contains("lost again and again") && log.contains("WGPU_BACKEND"), "{log}");
}
