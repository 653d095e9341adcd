//! Blind comparison of two materials of the window.

use std::hash::{BuildHasher as _, RandomState};

use svbrdf_evaluate::blind::BlindTest;

use crate::model::Model;
use crate::model::material::loaded::LoadedMaterial;

/// Two materials that are compared blind, and what was answered.
#[derive(Clone, Debug)]
pub struct Blind {
    /// A and B.
    pair: [LoadedMaterial; 2],
    pub test: BlindTest,
}

impl Blind {
    /// The materials of the panes: A, X and B, which have no other names until the test is over; then A and B with their names.
    pub fn materials(&self) -> Vec<LoadedMaterial> {
        let [a, b] = &self.pair;
        let named = |one: &LoadedMaterial, name: String| {
            let mut one = one.clone();
            one.replace(one.read.clone(), name);
            one
        };
        let letter = |(one, letter): (_, &str)| named(one, letter.to_owned());
        match self.test.trial() {
            Some((_, x_is_b)) => [(a, "A"), (if x_is_b { b } else { a }, "X"), (b, "B")].map(letter).into(),
            None => [("A", a), ("B", b)].map(|(is, one)| named(one, format!("{is}: {}", one.name()))).into(),
        }
    }
}

/// Compares the chosen prediction with the material at index `other` blind.
pub fn start(model: &mut Model, other: usize) {
    let chosen = model.chosen_prediction().cloned();
    let (Some(chosen), Some(other)) = (chosen, model.materials.all.get(other).cloned()) else { return };
    let test = BlindTest::new(RandomState::new().hash_one(0));
    let pair = if test.is_swapped { [other, chosen] } else { [chosen, other] };
    model.dataset.show_table(false);
    model.blind = Some(Blind { pair, test });
}

/// Ends the test, which shows its result; where there is none, or it was shown, the window is as before.
pub fn end(model: &mut Model) {
    match &mut model.blind {
        Some(blind) if blind.test.trial().is_some_and(|(trial, _)| trial > 1) => blind.test.end(),
        _ => model.blind = None,
    }
}
