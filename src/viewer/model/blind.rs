//! Blind comparison of two materials of the window.

use svbrdf_evaluate::blind::BlindTest;

use crate::model::material::loaded::LoadedMaterial;

/// Two materials that are compared blind, and what was answered.
#[derive(Clone, Debug)]
pub struct Blind {
    /// A and B.
    pair: [LoadedMaterial; 2],
    pub test: BlindTest,
}

impl Blind {
    /// Compares these blind, in the order that the test gives them.
    pub fn new([one, other]: [LoadedMaterial; 2], test: BlindTest) -> Self {
        Self { pair: if test.is_swapped { [other, one] } else { [one, other] }, test }
    }

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
