//! Memory and time of files: counted before they are taken, and refused.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use image::{GrayImage, Luma, Rgb, RgbImage};

use super::{assert_has, fail, folder, succeed};

/// A file of this many bytes that takes no disk.
fn write_sparse(path: &Path, start: &str, bytes: u64) {
    fs::write(path, start).unwrap();
    fs::File::options().write(true).open(path).unwrap().set_len(bytes).unwrap();
}

#[test]
fn memory_is_asked_for_before_it_is_taken() {
    let folder = folder();
    let at = folder.path();
    let write = |name: &str, text: String| fs::write(at.join(name), text).unwrap();
    RgbImage::from_pixel(16384, 1024, Rgb([128, 128, 255])).save(at.join("large.png")).unwrap();
    GrayImage::from_pixel(8, 8, Luma([90])).save(at.join("gray.png")).unwrap();
    write("large.json", " ".repeat(20 << 20));
    for (name, count) in [("many", 1_000_000), ("few", 1000)] {
        let materials = vec!["{}"; count].join(",");
        write(
            &format!("{name}.gltf"),
            format!(r#"{{"asset":{{"version":"2.0"}},"materials":[{materials}]}}"#),
        );
        let statements = "a\n".repeat(2 * count);
        write(&format!("{name}.mtl"), format!("newmtl a\nmap_Kd gray.png\nmap_Pr gray.png\n{statements}"));
    }
    let titles = "ground_truth,prediction,method,material\n";
    let rows = (0..2000).map(|i| format!("gt{i}.png,p{i}.png,method{i},material{i}\n"));
    write("many.csv", titles.to_owned() + &rows.collect::<String>());
    let rows = (0..20_000).map(|i| format!("gt.png,none{i}.png,first,m\n"));
    let of_two = "gt.png,a.png,first,m\ngt.png,b.png,second,m\n";
    write("long.csv", [titles, of_two].concat() + &rows.collect::<String>());
    for (args, limit, what) in [
        ("convert large.png out.exr", 16, "large.png"),
        ("render large.png -o out.png", 40, "large.png"),
        ("loss gt.png a.png --scenes large.json", 16, "large.json"),
        ("info many.gltf", 256, "many.gltf takes"),
        ("info many.mtl", 256, "many.mtl takes"),
        ("rank --pairs many.csv", 64, "2000 methods over 2000 materials"),
    ] {
        assert_has(&fail(at, &format!("{args} --max-memory {limit}MiB"), 1), &[what, "MiB", "--max-memory"]);
    }
    for (args, limit) in [
        ("convert gt.png out.exr", 16),
        ("info few.gltf", 256),
        ("info few.mtl", 256),
        ("rank --pairs long.csv --target-error 30%", 64),
    ] {
        succeed(at, &format!("{args} --max-memory {limit}MiB"));
    }
}

/// Limits of the system, beyond which decoders and the program would abort.
#[cfg(target_os = "linux")]
#[test]
fn what_the_system_does_not_give_is_an_error() {
    let folder = folder();
    let at = folder.path();
    RgbImage::from_pixel(16384, 4096, Rgb([128, 128, 255])).save(at.join("large.png")).unwrap();
    write_sparse(&at.join("x.hdr"), "#?RADIANCE\n", 6 << 30);
    let refusal = |kilobytes: u32, args: &str| {
        let output = super::limited(at, &format!("-v {kilobytes}"), args);
        let said = super::text(&output.stderr).to_owned();
        assert_eq!(output.status.code(), Some(1), "{kilobytes} {args}: {said}");
        said
    };
    // The picture takes 192 MiB.
    let said = [200_000, 250_000, 300_000].map(|limit| refusal(limit, "info large.png --max-memory 64GiB"));
    let refused =
        |said: &String| said.contains("large.png: ") && said.contains("which the system does not give");
    assert!(said.iter().any(refused), "{said:?}");
    assert_has(&refusal(3_000_000, "info x.hdr"), &["header"]);
}

#[test]
fn readers_take_time_in_proportion_to_their_text() {
    let folder = folder();
    let at = folder.path();
    let attributes: String = (0..100_000).map(|i| format!(" a{i}=\"1\"")).collect();
    fs::write(at.join("m.mtlx"), format!("<materialx{attributes}></materialx>")).unwrap();
    let rows: String = (0..80_000).map(|i| format!("gt.png,none{i}.png\n")).collect();
    fs::write(at.join("pairs.csv"), format!("ground_truth,prediction\n{rows}")).unwrap();
    let started = Instant::now();
    assert_has(&fail(at, "info m.mtlx", 1), &["at most 1000 attributes"]);
    assert!(started.elapsed() < Duration::from_secs(2), "{:?}", started.elapsed());
    let started = Instant::now();
    let cases = svbrdf_evaluate::dataset::cases_of_table(&at.join("pairs.csv")).unwrap();
    let candidates = &cases[0].candidates;
    assert_eq!((cases.len(), candidates.len(), candidates[79_999].sample), (1, 80_000, 79_999));
    assert!(started.elapsed() < Duration::from_secs(2), "{:?}", started.elapsed());
}
