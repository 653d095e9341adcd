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
