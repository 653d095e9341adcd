//! Sets by the name that a user gives, and the messages where they lack a map.

use super::whole_sets::gray;
use super::*;

#[test]
fn a_prefix_that_is_the_name_of_a_set_means_this_set() {
    let folder = tempdir().unwrap();
    let names =
        |stem: &str| ["normal", "diffuse", "roughness", "specular"].map(|map| format!("{stem}_{map}.png"));
    folder_of(names("w").each_ref().map(String::as_str), folder.path(), |_, v| v);
    folder_of(names("w_old").each_ref().map(String::as_str), folder.path(), |_, _| 0.5);
    let read = open(&folder.path().join("w"));
    assert_eq!(read.material.name(), "w");
    assert_same(&read, EIGHT_BITS);
    assert_refused(folder.path(), &["several: w, w_old"]);
    // Of an incomplete set the message tells what it lacks, not that others have the same maps.
    for name in ["w_roughness.png", "w_old_roughness.png"] {
        std::fs::remove_file(folder.path().join(name)).unwrap();
    }
    assert_refused(&folder.path().join("w"), &["one picture for the roughness map"]);
}

#[test]
fn a_metallic_set_without_its_colour_lacks_the_base_colour() {
    let folder = tempdir().unwrap();
    for name in ["metallic.png", "roughness.png"] {
        gray(folder.path(), name, 0.5);
    }
    assert_refused(folder.path(), &["one picture for the base colour map"]);
}
