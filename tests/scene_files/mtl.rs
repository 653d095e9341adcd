//! Wavefront .mtl.

use super::*;

/// Writes roughness and metallic as gray pictures beside those of [`textures`], and the .mtl.
pub fn wall(text: &str) -> (TempDir, std::path::PathBuf) {
    let folder = textures();
    let put = |name: &str, image| save(folder.path(), name, &image, ImageFormat::Png);
    put("old rough.png", picture(SIDE, SIDE, |x, y| [texel(2, x, y)[0]; 3]));
    put("metal.png", picture(SIDE, SIDE, |_, _| [0.0; 3]));
    put("s.png", picture(SIDE, SIDE, |_, _| [srgb(0.04); 3]));
    put("height.png", picture(SIDE, SIDE, |x, _| [x as f64 / SIDE as f64; 3]));
    let path = folder.path().join("a.mtl");
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

pub const PBR: &str = "# made by a test
newmtl wall
Ka 1 1 1
Kd 1 1 1
Pr 1
Pm 0
map_Kd base colour.png
map_Pr -clamp on old rough.png
norm -bm 1.0 n.png
map_d -clamp on alpha.png
";

#[test]
fn mtl_with_roughness_and_metallic_opens() {
    let (_folder, path) = wall(PBR);
    let read = open(&path);
    assert_is_of_textures(&read, 1.0);
    assert_eq!(read.files.len(), 4);
    assert!(says(&read, "workflow: metallic"), "{:#?}", read.assumptions);
    assert!(says(&read, "map_d -clamp on alpha.png is not used"), "{:?}", read.notes);
    assert!(says(&read, "Statements of the .mtl that are not used: ka 1 1 1, pr 1."), "{:?}", read.notes);
}

#[test]
fn other_ways_to_say_it_in_mtl_are_the_same_material() {
    for (what, text) in [
        (
            "a picture of metallic, normals as bump",
            "map_Pm metal.png\nmap_Bump -bm 1 n.png\nmap_Pr old rough.png",
        ),
        ("specular", "bump n.png\nmap_Ks s.png\nmap_Pr old rough.png"),
        ("neither", "norm n.png\nmap_Pr old rough.png"),
        ("one channel", "norm n.png\nmap_Pr -imfchan g orm.png"),
        ("nvdiffrec", "bsdf pbr\nmap_Ks orm.png\nbump n.png"),
        ("nvdiffrec by the name", "map_Ks orm.png\nbump n.png"),
        ("ORM by its statement", "map_ORM orm.png\nbump n.png\nPr 0.3"),
        ("paths of another machine", "norm C:\\art\\n.png\nmap_Pr .\\old rough.png"),
    ] {
        let (_folder, path) =
            wall(&format!("newmtl other\nKd 1 1 1\nnewmtl wall\nmap_Kd base colour.png\n{text}\n"));
        let options = ReadOptions { exemplar: Some(1), ..ReadOptions::AUTO };
        let read = read::<f64>(&path, &options, &Progress::default()).unwrap();
        assert_is_of_textures(&read, 1.0);
        assert!(says(&read, "holds 2 materials: 0 other, 1 wall. This is number 1 from 0"), "{what}");
        let names = read.materials().map(|(names, index)| (names.join(" "), index));
        assert_eq!(names, Some(("other wall".to_owned(), 1)), "{what}");
        let third = ReadOptions { exemplar: Some(2), ..ReadOptions::AUTO };
        let refused = super::read::<f64>(&path, &third, &Progress::default()).unwrap_err().to_string();
        assert!(refused.contains("an exemplar from 0 to 1"), "{refused}");
    }
}

#[test]
fn factors_of_mtl_multiply_and_are_doubted() {
    let (_folder, path) = wall(
        "newmtl wall\nmap_Kd base colour.png\nKd 0.5 0.5 0.5\nmap_Pr old rough.png\nPr 0.5\nnorm n.png\n",
    );
    let read = open(&path);
    let got = read.material.texel(77);
    assert!((got.diffuse[0] - 0.5 * BASE[0]).abs() < BOUND, "{got:?}");
    assert!(
        (got.roughness - texel(2, 77 % SIDE, 77 / SIDE)[0]).abs() < BOUND,
        "a picture of roughness stands alone"
    );
    let doubts: Vec<_> = read.unsure().map(|a| a.chosen.as_str()).collect();
    assert_eq!(doubts, ["diffuse times [0.5, 0.5, 0.5]"]);
    assert!(says(&read, "not used: pr 0.5"), "{:?}", read.notes);
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, format!("# Blender 4.2.0 MTL File: 'a.blend'\n{text}")).unwrap();
    assert_is_of_textures(&open(&path), 1.0);
    assert!(says(&open(&path), "kd [0.5, 0.5, 0.5] is not used: Blender"), "{:?}", open(&path).notes);
    let (_folder, path) =
        wall("newmtl wall\nmap_Kd base colour.png\nKd 0 0 0\nmap_Pr old rough.png\nnorm n.png\n");
    let read = open(&path);
    assert_is_of_textures(&read, 1.0);
    assert!(says(&read, "kd 0 is not used"), "{:?}", read.notes);
}

#[test]
fn the_name_of_a_normal_map_tells_its_y_in_mtl() {
    let (folder, path) = wall("newmtl wall\nmap_Kd base colour.png\nmap_Pr old rough.png\nnorm n_dx.png\n");
    let turned = |x, y| {
        let [r, g, b] = stored(0, x, y, |v| v);
        [r, 1.0 - g, b]
    };
    save(folder.path(), "n_dx.png", &picture(SIDE, SIDE, turned), ImageFormat::Png);
    let read = open(&path);
    assert_is_of_textures(&read, 1.0);
    assert_eq!(certainty(&read, What::NormalY), Some(Certainty::Sure));
}

#[test]
fn an_exponent_stands_for_roughness_and_heights_for_nothing_in_mtl() {
    let (_folder, path) =
        wall("newmtl wall\nmap_Kd base colour.png\nNs 30\nKs 0.5 0.5 0.5\nbump height.png\n");
    let read = open(&path);
    let got = read.material.texel(3);
    assert!((got.roughness - (2.0_f64 / 32.0).powf(0.25)).abs() < 1e-6, "{got:?}");
    assert_eq!((got.specular, got.normal.to_array()), ([0.04; 3], [0.0, 0.0, 1.0]));
    assert_eq!(certainty(&read, What::Missing), Some(Certainty::Unsure));
    for part in ["Ns 30", "height.png is not used: it holds heights", "not used: ks 0.5 0.5 0.5"] {
        assert!(says(&read, part), "{part}: {:#?} {:?}", read.assumptions, read.notes);
    }
}

#[test]
fn a_bump_map_of_colours_is_called_neither_normals_nor_heights() {
    let (_folder, path) = wall("newmtl wall\nmap_Kd base colour.png\nPr 0.5\nbump base colour.png\n");
    let read = open(&path);
    let note = "base colour.png is not used: its pixels do not look like normals";
    assert!(says(&read, note), "{:?}", read.notes);
}

#[test]
fn an_mtl_without_what_is_needed_is_refused() {
    for (text, expected) in [
        ("Kd 1 1 1\n", "expected a material (newmtl NAME), found none"),
        ("newmtl plain\nKd 1 1 1\n", "expected one picture for the roughness map"),
        ("newmtl wall\nmap_Kd none.png\nPr 0.5\n", "none.png"),
        (
            "newmtl wall\nmap_Pr old rough.png\nKd red\n",
            "wall: expected one or three numbers after kd, found `red`",
        ),
        ("newmtl wall\nmap_Kd base colour.png\n", "expected one picture for the roughness map"),
        ("newmtl wall\nmap_Kd\nPr 0.5\n", "cannot read"),
        ("newmtl wall\nmap_Pr old rough.png\nKd nan\n", "finite numbers"),
    ] {
        let (folder, path) = wall(text);
        let message = read::<f64>(&path, &ReadOptions::AUTO, &Progress::default()).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
        assert!(message.contains(&folder.path().display().to_string()), "{message}");
    }
}

#[test]
fn a_picture_of_roughness_metallic_and_occlusion_has_a_statement_of_its_own() {
    let (folder, path) = wall("newmtl wall\nmap_Kd base colour.png\nmap_RMA rma.png\nnorm n.png\n");
    let rma = picture(SIDE, SIDE, |x, y| [texel(2, x, y)[0], 0.0, 0.9]);
    save(folder.path(), "rma.png", &rma, ImageFormat::Png);
    assert_is_of_textures(&open(&path), 1.0);
}
