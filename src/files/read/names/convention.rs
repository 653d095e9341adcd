//! Words by which libraries name the maps of a set.

use crate::read::options::Role;

/// Words for normals, the colour, roughness and metallic that go together, as their files have them.
const CONVENTIONS: [[&str; 4]; 7] = [
    ["nor_gl", "diff", "rough", "metal"],
    ["NormalGL", "Color", "Roughness", "Metalness"],
    ["Normal", "BaseColor", "Roughness", "Metallic"],
    ["Normal", "Albedo", "Roughness", "Metallic"],
    ["Normal", "AlbedoTransparency", "Smoothness", "MetallicSmoothness"],
    ["normal", "diffuse", "roughness", "metallic"],
    ["N", "BC", "R", "M"],
];

/// The word for the map `role` by the convention that most of `words`, those of the other files, follow.
pub(crate) fn word_beside(role: Role, words: &[String]) -> Option<&'static str> {
    let place = match role {
        Role::Normal => 0,
        Role::Base | Role::Diffuse => 1,
        Role::Roughness => 2,
        Role::Metallic => 3,
        _ => return None,
    };
    let is_there = |own: &&str| words.contains(&own.to_lowercase().replace('_', ""));
    let count = |convention: &&[&str; 4]| convention.iter().filter(|own| is_there(own)).count();
    // The first of those that most follow.
    let best = CONVENTIONS.iter().rev().max_by_key(count).filter(|best| count(best) > 0)?;
    Some(best[place])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_map_is_named_as_the_others_are() {
        let of = |role, words: &[&str]| {
            word_beside(role, &words.iter().map(|w| (*w).to_owned()).collect::<Vec<_>>())
        };
        assert_eq!(of(Role::Roughness, &["norgl", "diff"]), Some("rough"));
        assert_eq!(of(Role::Roughness, &["normal", "basecolor"]), Some("Roughness"));
        assert_eq!(of(Role::Base, &["n", "r"]), Some("BC"));
        assert_eq!(of(Role::Base, &["normalgl", "roughness"]), Some("Color"));
        assert_eq!(of(Role::Roughness, &["xyz"]), None);
        assert_eq!(of(Role::Specular, &["normal"]), None);
    }
}
