//! Answers in pictures: every grid is found, and what is not a rendering of the materials is refused.

use svbrdf_core::image::Image;
use svbrdf_core::model::grammar::words::{Rows, Sites};
use svbrdf_core::model::grammar::{Description, RendererTerms};
use svbrdf_core::model::named_conventions as named;
use svbrdf_evaluate::conform::{Answer, VerdictKind, identify, probe_materials, verdict};

use super::Stored;

fn convention(name: &str) -> Description {
    named::all().iter().find(|one| one.name == name).unwrap().clone()
}

/// The materials as a renderer of these terms draws them.
fn pictures(terms: &RendererTerms, stored: Stored) -> Vec<Image<f32>> {
    let of = |material: &svbrdf_evaluate::conform::ProbeMaterial| {
        material.points(&terms.grid).iter().map(|point| terms.radiance(point, true)).collect::<Vec<_>>()
    };
    let exact: Vec<[f64; 3]> = probe_materials().iter().flat_map(of).collect();
    let picture = |texels: &[[f64; 3]]| Image {
        width: 8,
        height: 8,
        pixels: texels.iter().map(|rgb| rgb.map(|x| x as f32)).collect(),
    };
    stored.of(&exact, 1).chunks(64).map(picture).collect()
}

/// Whether a renderer on each grid is found, with what `asked` differs by.
fn assert_grid_is_found(asked: &Description, sampling: Sites, orientation: Rows, stored: Stored) {
    let mut terms = asked.terms;
    (terms.grid.sampling, terms.grid.orientation) = (sampling, orientation);
    let answer = Answer::of_pictures(&pictures(&terms, stored), None).unwrap();
    let found = verdict(&identify(&answer), asked);
    let context = format!("{} {sampling:?} {orientation:?} {stored:?}: {found:?}", asked.name);
    assert_ne!(found.kind, VerdictKind::Unknown, "{context}");
    assert_eq!(
        (found.terms.grid.sampling, found.terms.grid.orientation),
        (sampling, orientation),
        "{context}"
    );
    let differing: Vec<&str> = found.differences.iter().map(|one| one.term.key.as_str()).collect();
    let mut expected = Vec::new();
    if sampling != asked.terms.grid.sampling {
        expected.push("sampling");
    }
    if orientation != asked.terms.grid.orientation {
        expected.push("orientation");
    }
    assert_eq!(differing, expected, "{context}");
}

#[test]
fn corners_and_centres_and_the_order_of_rows_are_found() {
    let asked = convention("svbrdf-estimation-2022");
    for orientation in Rows::ALL {
        for sampling in Sites::ALL {
            assert_grid_is_found(&asked, sampling, orientation, Stored::Single);
        }
    }
}

#[test]
fn half_floats_tell_the_grid_too() {
    let asked = convention("multi-image-2019");
    assert_grid_is_found(&asked, Sites::Corner, Rows::Up, Stored::Half);
    assert_grid_is_found(&asked, Sites::Centre, Rows::Down, Stored::Half);
}

#[test]
fn rows_in_another_order_are_no_conformance() {
    let asked = convention("svbrdf-estimation-2022");
    let mut all = pictures(&asked.terms, Stored::Single);
    // One picture alone: no grid explains it.
    all[1].pixels.reverse();
    let found = verdict(&identify(&Answer::of_pictures(&all, None).unwrap()), &asked);
    assert_eq!(found.kind, VerdictKind::Unknown);
}

#[test]
fn pictures_of_another_size_are_refused() {
    let mut all = pictures(&convention("printed").terms, Stored::Single);
    all[2] = Image { width: 16, height: 4, pixels: all[2].pixels.clone() };
    let problem = Answer::of_pictures(&all, None).unwrap_err();
    assert_eq!(problem, "picture 2: expected 8 x 8 texels, found 16 x 4");
}
