//! Texture sets of Minecraft: their pictures, constants and defaults.

use super::whole_sets::{BUMPS, grays, put};
use super::*;

/// A texture set of Minecraft of these pairs.
fn texture_set(folder: &Path, entries: &str) -> std::path::PathBuf {
    let path = folder.join("ore.texture_set.json");
    let text = format!(r#"{{"format_version": "1.16.100", "minecraft:texture_set": {{{entries}}}}}"#);
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn a_texture_set_names_its_maps_and_states_constants() {
    let folder = grays(&[("ore.png", 0.5)]);
    put(folder.path(), "glow.png", &picture(BUMPS, BUMPS, |_, _| [0.2, 0.9, 0.6]));
    let maps = r#""color": "ore", "metalness_emissive_roughness": "glow""#;
    let read = open(&texture_set(folder.path(), maps));
    let texel = read.material.texel(9);
    assert_eq!(read.material.name(), "ore");
    assert!((texel.roughness - 0.6).abs() < EIGHT_BITS, "{texel:?}");
    let base = 0.214;
    assert!((texel.diffuse[0] - 0.8 * base).abs() < 0.005, "{texel:?}");
    assert!((texel.specular[0] - (0.8 * 0.04 + 0.2 * base)).abs() < 0.005, "{texel:?}");
    let constants = r##""color": "#808080", "metalness_emissive_roughness": [51, 0, 153]"##;
    let read = open(&texture_set(folder.path(), constants));
    assert_eq!(read.material.size(), [1, 1]);
    let of_constants = read.material.texel(0);
    assert!((of_constants.roughness - 0.6).abs() < EIGHT_BITS, "{of_constants:?}");
    assert!((of_constants.diffuse[0] - 0.8 * base).abs() < 0.005, "{of_constants:?}");
    let plain = open(&texture_set(folder.path(), r#""color": "ore""#));
    assert_eq!((plain.material.texel(9).roughness, plain.material.texel(9).specular), (1.0, [0.04; 3]));
    assert_refused(&texture_set(folder.path(), r#""color": "none""#), &["none.png"]);
}
