//! Where files are written: links, devices and pipes stay what they are.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::{FileTypeExt, symlink};
use std::process::Command;

use super::{folder, succeed, svbrdf};

#[test]
fn a_link_stays_and_its_target_is_written() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    fs::create_dir(of("kept")).unwrap();
    for (args, link) in [
        ("convert gt.png link.exr", "link.exr"),
        ("convert gt.png link.png", "link.png"),
        ("render gt.png -o picture.png", "picture.png"),
    ] {
        fs::write(of("kept").join(link), "old").unwrap();
        symlink(of("kept").join(link), of(link)).unwrap();
        succeed(folder.path(), args);
        assert!(of(link).is_symlink(), "{args}");
        let written = fs::read(of("kept").join(link)).unwrap();
        assert!(written.len() > 100 && of("kept").join(link).is_file(), "{args}");
    }
    assert_eq!(fs::read_dir(of("kept")).unwrap().count(), 3, "a temporary file is left");
}

#[test]
fn a_pipe_is_written_to() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    for (pipe, args) in [("pipe.exr", "convert gt.png"), ("pipe.png", "convert gt.png")] {
        assert!(Command::new("mkfifo").arg(of(pipe)).status().unwrap().success());
        let mut child = svbrdf().args(args.split(' ')).arg(pipe).current_dir(folder.path()).spawn().unwrap();
        let through = fs::read(of(pipe)).unwrap();
        assert!(child.wait().unwrap().success());
        assert!(fs::metadata(of(pipe)).unwrap().file_type().is_fifo());
        let plain = format!("plain.{}", &pipe[5..]);
        succeed(folder.path(), &format!("{args} {plain}"));
        assert!(through == fs::read(of(&plain)).unwrap(), "{pipe}: {} bytes", through.len());
    }
}

#[test]
fn a_device_stays() {
    let folder = folder();
    // A link, so that a program that replaces what it is given replaces this one.
    symlink("/dev/null", folder.path().join("null.exr")).unwrap();
    succeed(folder.path(), "convert gt.png null.exr");
    succeed(folder.path(), "render gt.png -o null.exr");
    assert!(folder.path().join("null.exr").is_symlink());
    assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
}
