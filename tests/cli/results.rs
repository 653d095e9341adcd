//! The results folder of a data set, where other processes write at the same time. `tests/transcripts/results.md` has the rest.

use std::fs;
use std::process::Stdio;
use std::thread::sleep;
use std::time::Duration;

use super::*;

const RANK: &str = "--target-error 20% --format json --read albedo=srgb";

#[test]
fn processes_at_once_write_the_same_bytes() {
    let folder = data_set(&[("ours", 8), ("theirs", 40)], 3);
    let rank = format!("rank --dataset gt ours theirs {RANK}");
    let whole = succeed(folder.path(), &rank);
    let one = || assert_eq!(succeed(folder.path(), &format!("{rank} --results kept")), whole);
    std::thread::scope(|scope| (0..3).for_each(|_| drop(scope.spawn(one))));
    assert_eq!(files(&folder.path().join("kept")).len(), 6);
    one();
}

#[test]
fn a_file_that_changes_while_it_is_read_has_no_result_of_another() {
    let folder = tempfile::tempdir().unwrap();
    let of = |name: &str| folder.path().join(name);
    for (name, roughness) in [("gt", 60), ("ours", 80), ("new", 140)] {
        fs::create_dir(of(name)).unwrap();
        write_material(&of(name).join("m.png"), 256, roughness);
    }
    let args = format!("rank --dataset gt ours {RANK}");
    let kept = format!("{args} --results kept");
    let contents = [fs::read(of("ours/m.png")).unwrap(), fs::read(of("new/m.png")).unwrap()];
    let place = |bytes: &Vec<u8>| {
        fs::write(of("next"), bytes).unwrap();
        fs::rename(of("next"), of("ours/m.png")).unwrap();
    };
    let expected = contents.each_ref().map(|bytes| {
        place(bytes);
        succeed(folder.path(), &args)
    });
    for delay in [5, 10, 20, 40, 80, 160] {
        place(&contents[0]);
        let mut command = svbrdf();
        command.args(kept.split(' ')).current_dir(folder.path()).stdout(Stdio::null()).stderr(Stdio::null());
        let mut child = command.spawn().unwrap();
        sleep(Duration::from_millis(delay));
        place(&contents[1]);
        assert!(child.wait().unwrap().success());
        for (bytes, expected) in contents.iter().zip(&expected) {
            place(bytes);
            assert_eq!(succeed(folder.path(), &kept), *expected, "{delay}");
        }
        fs::remove_dir_all(of("kept")).unwrap();
    }
}

/// Every file of a material, and what a reading looked at beside it.
#[test]
fn every_file_of_a_material_counts_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let of = |name: &str| folder.path().join(name);
    for (name, roughness) in [("gt", 60), ("other", 140)] {
        write_material(&of(&format!("{name}.png")), 8, roughness);
        fs::create_dir(of(name)).unwrap();
        for out in ["a.exr", "b.glb", "d"] {
            succeed(folder.path(), &format!("convert {name}.png {name}/{out} --read albedo=srgb"));
        }
        let maps = files(&of(name).join("d"));
        let roughness = maps.iter().find(|map| map.contains("roughness")).unwrap();
        for map in &maps {
            fs::copy(of(name).join("d").join(map), of(name).join(format!("p_{map}"))).unwrap();
        }
        let picture = format!(r#""images": [{{"uri": "p_{roughness}"}}], "textures": [{{"source": 0}}]"#);
        let surface = r#"{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}"#;
        let gltf = format!(r#"{{"asset": {{"version": "2.0"}}, {picture}, "materials": [{surface}]}}"#);
        fs::write(of(name).join("e.gltf"), gltf).unwrap();
        fs::write(of(name).join("f.mtl"), format!("newmtl f\nmap_Kd p_{roughness}\nPr 0.5\n")).unwrap();
    }
    let rows = ["a.exr", "b.glb", "d", "e.gltf", "f.mtl", "p_"].map(|form| format!("gt/{form},gt.png\n"));
    fs::write(of("pairs.csv"), format!("ground_truth,prediction\n{}", rows.concat())).unwrap();
    // The first letters of the pairs that are new in the folder.
    let run = || {
        let before = if of("kept").exists() { files(&of("kept")) } else { Vec::new() };
        succeed(folder.path(), &format!("rank --pairs pairs.csv {RANK} --results kept"));
        let new = files(&of("kept")).into_iter().filter(|name| !before.contains(name));
        new.map(|name| name.split('_').next().unwrap().to_owned()).collect::<String>()
    };
    assert_eq!([run(), run()], ["abdefp", ""]);
    let mut noticed = Vec::new();
    for below in ["", "d"] {
        for name in files(&of("gt").join(below)) {
            let [to, from] = ["gt", "other"].map(|side| of(side).join(below).join(&name));
            if to.is_file() && fs::read(&to).unwrap() != fs::read(&from).unwrap() {
                fs::copy(from, to).unwrap();
                noticed.push(run());
            }
        }
    }
    assert_eq!(noticed, ["a", "b", "efp", "d"]);
    // Another material of the folder tells how the colours of a set without normals are stored.
    for (at, roughness) in [("neighbours/one", 120), ("neighbours/other", 120), ("pred/one", 160)] {
        fs::create_dir_all(of(at)).unwrap();
        for (map, value) in [("diffuse", 102), ("specular", 31), ("roughness", roughness)] {
            RgbImage::from_pixel(8, 8, Rgb([value; 3])).save(of(at).join(map).with_extension("png")).unwrap();
        }
    }
    let args = "rank --dataset neighbours pred --target-error 20% --format json --results of_neighbours";
    let before = succeed(folder.path(), args);
    RgbImage::from_pixel(8, 8, Rgb([10; 3])).save(of("neighbours/other/specular.png")).unwrap();
    let after = succeed(folder.path(), args);
    assert!(after != before && after == succeed(folder.path(), &args.replace("of_neighbours", "empty")));
}
