//! Limits of files: the paths that they may name and the memory that they may take.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use image::{Rgb, RgbImage};
use serde_json::json;

use super::{assert_has, fail, folder, run_in, succeed, text};

/// The documents that name a picture, in the folder `in` below `at`, each with its command.
fn documents(at: &Path, picture: &str) -> Vec<(&'static str, &'static str)> {
    let of = |name: &str| at.join("in").join(name);
    fs::create_dir_all(at.join("in")).unwrap();
    let gltf = json!({
        "asset": {"version": "2.0"}, "images": [{"uri": picture}], "textures": [{"source": 0}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    });
    fs::write(of("m.gltf"), gltf.to_string()).unwrap();
    fs::write(of("m.mtl"), format!("newmtl m\nmap_Kd {picture}\nmap_Pr {picture}\n")).unwrap();
    let mtlx = format!(
        r#"<?xml version="1.0"?><materialx version="1.38"><tiledimage name="i" type="color3"><input name="file" type="filename"
        value="{picture}"/></tiledimage><standard_surface name="s" type="surfaceshader"><input name="base_color" type="color3"
        nodename="i"/></standard_surface></materialx>"#
    );
    fs::write(of("m.mtlx"), mtlx).unwrap();
    let session = json!({
        "svbrdf-session": 1, "convention": "printed", "materials": [{"path": picture}],
        "scene": {"kind": "near", "view": [0, 0, 2], "light": [0, 0, 1]},
    });
    fs::write(of("s.svbrdf-session.json"), session.to_string()).unwrap();
    fs::copy(at.join("gt.png"), of("p.png")).unwrap();
    fs::write(of("p.svbrdf.json"), json!({"maps": {"roughness": picture}}).to_string()).unwrap();
    let scene = json!({"kind": "near", "view": [0, 0, 2], "light": [0, 0, 1]});
    let capture = json!({"photographs": [{"file": picture, "scene": scene}]});
    fs::write(of("capture.json"), capture.to_string()).unwrap();
    vec![
        ("capture.json", "photo in gt.png"),
        ("m.gltf", "info in/m.gltf"),
        ("m.mtl", "info in/m.mtl"),
        ("m.mtlx", "info in/m.mtlx"),
        ("s.svbrdf-session.json", "render in/s.svbrdf-session.json -o out.png"),
        ("p.svbrdf.json", "info in/p.png"),
    ]
}

/// A folder with a picture that is any map or, packed, a material.
fn pictures() -> tempfile::TempDir {
    let folder = folder();
    RgbImage::from_pixel(8, 8, Rgb([100; 3])).save(folder.path().join("map.png")).unwrap();
    folder
}

#[test]
fn absolute_paths_in_files_are_refused_unless_they_are_allowed() {
    let folder = pictures();
    let at = folder.path();
    for absolute in [at.join("map.png").to_str().unwrap(), "//host/share/map.png", "C:/map.png"] {
        for (name, command) in documents(at, absolute) {
            let error = fail(at, command, 1);
            assert_has(&error, &["absolute path", "--allow-outside", name]);
        }
    }
    for (name, command) in documents(at, &at.join("map.png").display().to_string()) {
        if !name.contains("session") {
            succeed(at, &format!("{command} --allow-outside"));
        }
    }
    documents(at, &at.join("gt.png").display().to_string());
    succeed(at, "render in/s.svbrdf-session.json -o out.png --allow-outside");
}

#[test]
fn relative_paths_may_leave_the_folder_and_a_note_says_so() {
    let folder = pictures();
    let at = folder.path();
    for (name, command) in documents(at, "../map.png") {
        // Theirs are notes on stderr.
        if name.contains("session") || name == "capture.json" {
            continue;
        }
        let output = succeed(at, command);
        assert_has(&output, &["map.png"]);
        // The map of a sidecar file is always noted, with its path.
        let is_noted = output.contains("lies outside of the folder") || name.starts_with('p');
        assert!(is_noted, "{name}: {output}");
    }
    documents(at, "../gt.png");
    let output = run_in(at, "render in/s.svbrdf-session.json -o out.png");
    let said = text(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert_has(said, &["gt.png lies outside of the folder of the session"]);
}

#[test]
fn a_buffer_outside_is_named_in_a_note() {
    let folder = pictures();
    let at = folder.path();
    documents(at, "map.png");
    let bytes = fs::read(at.join("map.png")).unwrap();
    fs::write(at.join("map.bin"), &bytes).unwrap();
    let gltf = json!({
        "asset": {"version": "2.0"}, "textures": [{"source": 0}],
        "buffers": [{"uri": "../map.bin", "byteLength": bytes.len()}],
        "bufferViews": [{"buffer": 0, "byteLength": bytes.len()}],
        "images": [{"bufferView": 0, "mimeType": "image/png"}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    });
    fs::write(at.join("in/m.gltf"), gltf.to_string()).unwrap();
    assert_has(&succeed(at, "info in/m.gltf"), &["map.bin lies outside of the folder"]);
}

#[cfg(unix)]
#[test]
fn devices_and_pipes_in_files_are_refused_at_once() {
    let folder = pictures();
    let at = folder.path();
    fs::create_dir(at.join("in")).unwrap();
    std::os::unix::fs::symlink("/dev/zero", at.join("in/zero")).unwrap();
    assert!(std::process::Command::new("mkfifo").arg(at.join("in/fifo")).status().unwrap().success());
    let started = Instant::now();
    for name in ["zero", "fifo"] {
        for (document, command) in documents(at, name) {
            let error = fail(at, command, 1);
            assert!(error.contains("expected a regular file"), "{document}: {error}");
        }
    }
    // A sidecar file is loaded without being named.
    fs::remove_file(at.join("in/p.svbrdf.json")).unwrap();
    fs::rename(at.join("in/fifo"), at.join("in/p.svbrdf.json")).unwrap();
    fail(at, "info in/p.png", 1);
    fail(at, "info /dev/zero", 1);
    fail(at, "loss gt.png a.png --scenes /dev/zero", 1);
    assert!(started.elapsed() < Duration::from_secs(20), "{:?}", started.elapsed());
}

#[cfg(unix)]
#[test]
fn a_pipe_that_a_user_names_is_read_and_said_to_be_one() {
    let folder = folder();
    let at = folder.path().to_owned();
    let pipe = at.join("pipe.png");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let writer = std::thread::spawn({
        let (at, pipe) = (at.clone(), pipe.clone());
        move || fs::write(pipe, fs::read(at.join("gt.png")).unwrap())
    });
    let output = run_in(&at, "info pipe.png");
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("pipe.png is a pipe"), "{}", text(&output.stderr));
    writer.join().unwrap().unwrap();
    // One without an end.
    let endless = std::thread::spawn(move || {
        let mut pipe = fs::OpenOptions::new().write(true).open(pipe).unwrap();
        let zeros = vec![0; 1 << 20];
        while std::io::Write::write_all(&mut pipe, &zeros).is_ok() {}
    });
    assert_has(&fail(&at, "info pipe.png --max-memory 16MiB", 1), &["16 MiB"]);
    endless.join().unwrap();
}

#[test]
fn memory_is_asked_for_before_it_is_taken() {
    let folder = folder();
    let at = folder.path();
    RgbImage::from_pixel(16384, 1024, Rgb([128, 128, 255])).save(at.join("large.png")).unwrap();
    fs::write(at.join("large.json"), vec![b' '; 20 << 20]).unwrap();
    for args in [
        "convert large.png out.exr --max-memory 16MiB",
        "render large.png -o out.png --max-memory 40MiB",
        "loss gt.png a.png --scenes large.json --max-memory 16MiB",
    ] {
        let error = fail(at, args, 1);
        assert_has(&error, &["MiB of memory", "--max-memory"]);
    }
    succeed(at, "convert gt.png out.exr --max-memory 16MiB");
    for wrong in ["12", "1MiB", "x"] {
        fail(at, &format!("info gt.png --max-memory {wrong}"), 64);
    }
}

/// `--max-memory` above what the system gives: decoders would abort.
#[cfg(target_os = "linux")]
#[test]
fn what_the_system_does_not_give_is_an_error() {
    let folder = folder();
    let at = folder.path();
    RgbImage::from_pixel(16384, 4096, Rgb([128, 128, 255])).save(at.join("large.png")).unwrap();
    // Kilobytes of address space; the picture takes 192 MiB.
    let said = [200_000, 250_000, 300_000].map(|limit| {
        let output = super::limited(at, &format!("-v {limit}"), "info large.png --max-memory 64GiB");
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{limit}: {said}");
        said.to_owned()
    });
    let refused =
        |said: &str| said.contains("large.png: ") && said.contains("which the system does not give");
    assert!(said.iter().any(|said| refused(said)), "{said:?}");
}

#[test]
fn readers_take_time_in_proportion_to_their_text() {
    let folder = pictures();
    let at = folder.path();
    let attributes: String = (0..100_000).map(|i| format!(" a{i}=\"1\"")).collect();
    fs::write(at.join("m.mtlx"), format!("<materialx{attributes}></materialx>")).unwrap();
    let rows: String = (0..80_000).map(|i| format!("gt.png,none{i}.png\n")).collect();
    fs::write(at.join("pairs.csv"), format!("ground_truth,prediction\n{rows}")).unwrap();
    let started = Instant::now();
    let error = fail(at, "info m.mtlx", 1);
    assert!(error.contains("at most 1000 attributes"), "{error}");
    assert!(started.elapsed() < Duration::from_secs(2), "{:?}", started.elapsed());
    let started = Instant::now();
    let cases = svbrdf_evaluate::dataset::cases_of_table(&at.join("pairs.csv")).unwrap();
    assert_eq!(
        (cases.len(), cases[0].candidates.len(), cases[0].candidates[79_999].sample),
        (1, 80_000, 79_999)
    );
    assert!(started.elapsed() < Duration::from_secs(2), "{:?}", started.elapsed());
}
