//! The materials of the command line: written, named, and brought to one size.

use super::*;

#[test]
fn convert_writes_what_loss_finds_to_be_the_same() {
    let folder = folder();
    for out in ["gt.exr", "gt16.png", "gt_folder", "gt.glb"] {
        let depth = if out == "gt.exr" { "float" } else { "16" };
        assert_eq!(succeed(folder.path(), &format!("convert gt.png {out} --depth {depth}")), "");
        let loss = loss_of(folder.path(), &format!("gt.png {out}"));
        assert!(loss < 1e-3, "{out}: {loss}");
    }
}

#[test]
fn predictions_of_another_size_are_brought_to_one_that_fits() {
    let folder = folder();
    // One texel wide and seven high each.
    RgbImage::from_fn(4, 7, |x, _| Rgb([[128, 128, 255], [200, 100, 50], [90; 3], [12; 3]][x as usize]))
        .save(folder.path().join("slim.png"))
        .unwrap();
    let slim = "slim.png slim.png --read order=ndrs,grid=4x1";
    for (materials, to, size) in [
        ("gt.png big.png", "gt", [8, 8]),
        ("gt.png big.png", "pred", [16, 16]),
        ("gt.png big.png", "12", [12, 12]),
        (slim, "20", [20, 140]),
    ] {
        let json = losses_as_json(folder.path(), &format!("{materials} --resize-to {to}"));
        assert_eq!(json["size"], json!(size), "{to}");
    }
    let [slim, wide] = [slim, "gt.png a.png"].map(|materials| format!("loss {materials} --resize-to 16384"));
    assert_refused(folder.path(), &[(&slim, 1, "16384 x 114688"), (&wide, 1, "10 GiB")]);
}
