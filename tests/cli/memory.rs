//! Memory of lists, headers and documents: counted before it is taken, and refused.

use std::fs;

use super::{assert_has, fail, folder, succeed, text};

#[test]
fn a_list_of_too_many_methods_and_materials_is_refused_and_a_long_one_of_few_is_not() {
    let folder = folder();
    let list = |rows: String| {
        fs::write(
            folder.path().join("pairs.csv"),
            "ground_truth,prediction,method,material\n".to_owned() + &rows,
        )
    };
    list((0..2000).map(|i| format!("gt{i}.png,p{i}.png,method{i},material{i}\n")).collect()).unwrap();
    let error = fail(folder.path(), "rank --pairs pairs.csv --max-memory 64MiB", 1);
    assert_has(&error, &["2000 methods over 2000 materials", "--max-memory"]);
    let rows: String = (0..20_000).map(|i| format!("gt.png,none{i}.png,first,m\n")).collect();
    list(format!("gt.png,a.png,first,m\ngt.png,b.png,second,m\n{rows}")).unwrap();
    let ranked = succeed(folder.path(), "rank --pairs pairs.csv --max-memory 64MiB --target-error 30%");
    assert_has(&ranked, &["second"]);
}

/// Within a limit of the system, beyond which the program would abort.
#[cfg(target_os = "linux")]
#[test]
fn the_header_of_an_hdr_ends() {
    let folder = folder();
    let path = folder.path().join("x.hdr");
    fs::write(&path, "#?RADIANCE\n").unwrap();
    fs::File::options().write(true).open(&path).unwrap().set_len(6 << 30).unwrap();
    let output = super::limited(folder.path(), "-v 3000000", "info x.hdr");
    let stderr = text(&output.stderr);
    assert!(output.status.code() == Some(1) && stderr.contains("header"), "{:?} {stderr}", output.status);
}

/// A material of two pictures.
const MTL: &str = "newmtl a\nmap_Kd gray.png\nmap_Pr gray.png\n";

#[test]
fn documents_of_many_materials_are_counted() {
    let folder = folder();
    let of = |name: &str| folder.path().join(name);
    let gltf = |count: usize| {
        let materials = vec!["{}"; count].join(",");
        format!(r#"{{"asset":{{"version":"2.0"}},"materials":[{materials}]}}"#)
    };
    image::GrayImage::from_pixel(8, 8, image::Luma([90])).save(of("gray.png")).unwrap();
    fs::write(of("many.gltf"), gltf(1_000_000)).unwrap();
    fs::write(of("few.gltf"), gltf(1000)).unwrap();
    fs::write(of("many.mtl"), MTL.to_owned() + &"a\n".repeat(2_000_000)).unwrap();
    fs::write(of("few.mtl"), MTL.to_owned() + &"a\n".repeat(2000)).unwrap();
    for kind in ["gltf", "mtl"] {
        let error = fail(folder.path(), &format!("info many.{kind} --max-memory 256MiB"), 1);
        assert_has(&error, &[&format!("many.{kind} takes"), "--max-memory"]);
        succeed(folder.path(), &format!("info few.{kind} --max-memory 256MiB"));
    }
}
