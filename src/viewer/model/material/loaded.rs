//! Loaded material: a material in the window, with its unique name and whether its files still hold it.

use std::ops::RangeInclusive;
use std::sync::Arc;

use svbrdf_core::material::{Grid, Material};
use svbrdf_evaluate::report::distinct_names;
use svbrdf_files::source::Place;

use crate::message::SizeMismatch;
use crate::model::material::read::{MaterialId, ReadMaterial};

/// What marks a file that was written since it was read.
pub const NEWER: &str = "newer on disk: Ctrl+R";

/// A material in the window.
#[derive(Clone, Debug)]
pub struct LoadedMaterial {
    pub read: Arc<ReadMaterial>,
    /// Its number: 0 of the ground truth, n of the nth prediction or method. It stays whichever others are there.
    pub slot: usize,
    /// Whether its files were written since it was read.
    pub is_newer: bool,
    /// Why it is stale: its files could not be read again.
    pub problem: Option<String>,
    /// Its name, unique in the window.
    name: String,
}

impl LoadedMaterial {
    pub fn new(read: Arc<ReadMaterial>) -> Self {
        let name = drawable(read.material().name());
        Self { read, slot: 0, is_newer: false, problem: None, name }
    }

    /// The same material in another slot.
    #[must_use]
    pub fn at(self, slot: usize) -> Self {
        Self { slot, ..self }
    }

    /// Shows a material made of it and others in its place, with this name.
    pub fn replace(&mut self, read: Arc<ReadMaterial>, name: String) {
        (self.read, self.name) = (read, name);
    }

    /// Its number in titles and tables.
    pub fn number(&self) -> String {
        if self.slot == 0 { "GT".to_owned() } else { self.slot.to_string() }
    }

    /// What identifies its maps: every reading of every version of its files has another one.
    pub fn id(&self) -> MaterialId {
        self.read.id
    }

    pub fn material(&self) -> &Material<f32> {
        self.read.material()
    }

    pub fn grid(&self) -> Grid {
        self.material().grid()
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether its files hold something else by now: it and every result of it are stale.
    pub fn is_stale(&self) -> bool {
        self.problem.is_some()
    }

    /// Its name, marked where it is stale.
    pub fn label(&self) -> String {
        match (self.is_stale(), self.is_newer) {
            (true, _) => format!("{}  (stale)", self.name),
            (false, true) => format!("{}  ({NEWER})", self.name),
            (false, false) => self.name.clone(),
        }
    }
}

/// The text with every character written as `\u{...}` for which the fonts of the window have no picture: a name of boxes tells
/// nothing, and letters from right to left would come in the wrong order.
pub fn drawable(text: &str) -> String {
    let has_picture = |c: &char| DRAWN.iter().any(|range| range.contains(c));
    text.chars()
        .map(|c| if has_picture(&c) { c.to_string() } else { c.escape_unicode().to_string() })
        .collect()
}

/// The characters that the window draws, of names.
pub const DRAWN: [RangeInclusive<char>; 9] = [
    ' '..='~',
    '\u{a1}'..='\u{ac}',
    '\u{ae}'..='\u{17f}',
    '\u{391}'..='\u{3a1}',
    '\u{3a3}'..='\u{3ce}',
    '\u{400}'..='\u{45f}',
    '\u{2013}'..='\u{2015}',
    '\u{2018}'..='\u{201a}',
    '\u{2026}'..='\u{2026}',
];

/// Gives every material a unique name.
pub fn rename(materials: &mut [LoadedMaterial]) {
    let named: Vec<_> = materials.iter().map(|one| (one.material().name(), one.read.path())).collect();
    let names = distinct_names(&named);
    materials.iter_mut().zip(names).for_each(|(material, name)| material.name = drawable(&name));
}

/// The two sizes, where `prediction` has another size than the ground truth.
pub fn mismatch(ground_truth: &LoadedMaterial, prediction: &ReadMaterial) -> Option<SizeMismatch> {
    let [gt, material] = [ground_truth.material(), prediction.material()];
    let ([w, h], [gt_w, gt_h]) = (material.size(), gt.size());
    let text = || {
        format!("{} is {w} x {h} and the ground truth {} is {gt_w} x {gt_h}", named(prediction), gt.name())
    };
    ([w, h] != [gt_w, gt_h]).then(|| SizeMismatch { text: text(), source: prediction.reopened() })
}

/// The name of a material that is not in the window, and where it is: several may have one name.
fn named(read: &ReadMaterial) -> String {
    match &read.source.place {
        Place::Path(path) => format!("{} ({})", read.material().name(), path.display()),
        Place::BuiltIn(_) => read.material().name().to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_files::source::MaterialSource;

    #[test]
    fn names_that_steer_the_text_after_them_or_fill_the_window_are_shown_and_do_neither() {
        let read = svbrdf_files::samples::load::<f32>().unwrap().ground_truth;
        let material = |name: String| {
            let mut read = read.clone();
            read.material = read.material.renamed(name);
            LoadedMaterial::new(Arc::new(ReadMaterial::new(MaterialSource::built_in(0), read, None)))
        };
        let hostile = ["a\u{202e}gnp.b".to_owned(), "\u{1b}[2J".to_owned(), "long ".repeat(100_000)];
        let mut all: Vec<_> = hostile.into_iter().map(material).collect();
        let check = |all: &[LoadedMaterial]| {
            assert_eq!([all[0].name(), all[1].name()], ["a\\u{202e}gnp.b", "\\u{1b}[2J"]);
            assert!(all[2].name().chars().count() < 2100);
        };
        check(&all);
        rename(&mut all);
        check(&all);
    }
}
