//! Chosen difference of each quantity, and the range of its colours.

use serde::{Deserialize, Serialize};

use super::difference::Difference;
use super::quantity::Quantity;

/// The choices that differ from the defaults: the first difference of a quantity, with an automatic range.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Differences {
    chosen: Vec<(Quantity, Difference)>,
    ranges: Vec<((Quantity, Difference), f64)>,
    /// Whether the difference of renderings is the error map: the log difference, averaged over the scenes of the loss.
    #[serde(default)]
    error_map: bool,
    #[serde(default)]
    error_map_range: Option<f64>,
}

impl Differences {
    /// The chosen difference of `quantity`.
    pub fn kind(&self, quantity: Quantity) -> Difference {
        if self.is_error_map(quantity) {
            return Difference::Log;
        }
        let chosen = self.chosen.iter().find(|(of, _)| *of == quantity);
        chosen.map_or(Difference::all(quantity)[0], |(_, kind)| *kind)
    }

    /// The chosen difference of `quantity` where it compares texels one by one, else the default one, and its range.
    pub fn pointwise(&self, quantity: Quantity) -> (Difference, Option<f64>) {
        let (chosen, all) = (self.kind(quantity), Difference::pointwise(quantity));
        if all.contains(&chosen) { (chosen, self.range(quantity)) } else { (all[0], None) }
    }

    /// Chooses a difference of `quantity`, if it has that one.
    pub fn choose(&mut self, quantity: Quantity, kind: Difference) {
        if Difference::all(quantity).contains(&kind) {
            self.error_map &= quantity != Quantity::Rendering;
            self.chosen.retain(|(of, _)| *of != quantity);
            self.chosen.push((quantity, kind));
        }
    }

    /// Chooses the error map as the difference of renderings.
    pub fn choose_error_map(&mut self) {
        self.error_map = true;
    }

    /// Whether the difference of `quantity` is the error map.
    pub fn is_error_map(&self, quantity: Quantity) -> bool {
        self.error_map && quantity == Quantity::Rendering
    }

    /// The range set for the chosen difference of `quantity`; `None` where it is automatic.
    pub fn range(&self, quantity: Quantity) -> Option<f64> {
        if self.is_error_map(quantity) {
            return self.error_map_range;
        }
        let key = (quantity, self.kind(quantity));
        self.ranges.iter().find(|(of, _)| *of == key).map(|(_, range)| *range)
    }

    /// Leaves out choices that a quantity does not have and ranges that are no positive numbers, as files may hold them. Whether
    /// there were none.
    pub fn leave_out_unusable(&mut self) -> bool {
        let count = |all: &Self| (all.chosen.len(), all.ranges.len(), all.error_map_range.is_some());
        let before = count(self);
        let is_usable = |range: &f64| range.is_finite() && *range > 0.0;
        self.chosen.retain(|(quantity, kind)| Difference::all(*quantity).contains(kind));
        self.ranges.retain(|((quantity, kind), range)| {
            Difference::all(*quantity).contains(kind) && is_usable(range)
        });
        self.error_map_range = self.error_map_range.filter(is_usable);
        count(self) == before
    }

    /// Sets the range of the chosen difference of `quantity`; `None` makes it automatic.
    pub fn set_range(&mut self, quantity: Quantity, range: Option<f64>) {
        let range = range.filter(|r| r.is_finite() && *r > 0.0);
        if self.is_error_map(quantity) {
            self.error_map_range = range;
            return;
        }
        let key = (quantity, self.kind(quantity));
        self.ranges.retain(|(of, _)| *of != key);
        self.ranges.extend(range.map(|range| (key, range)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_difference_of_every_quantity_has_its_own_range() {
        let mut all = Differences::default();
        all.set_range(Quantity::Rendering, Some(0.5));
        assert_eq!(all.range(Quantity::Rendering), Some(0.5));
        assert_eq!(all.range(Quantity::Normal), None);
        all.choose(Quantity::Rendering, Difference::Absolute);
        assert_eq!(all.range(Quantity::Rendering), None);
        all.choose(Quantity::Rendering, Difference::Log);
        assert_eq!(all.range(Quantity::Rendering), Some(0.5));
        all.set_range(Quantity::Rendering, None);
        let chosen = vec![(Quantity::Rendering, Difference::Log)];
        assert_eq!(all, Differences { chosen, ..Differences::default() });
    }

    #[test]
    fn the_error_map_has_a_range_of_its_own_and_is_left_by_choosing_another_difference() {
        let mut all = Differences::default();
        all.set_range(Quantity::Rendering, Some(0.5));
        all.choose_error_map();
        assert!(all.is_error_map(Quantity::Rendering) && !all.is_error_map(Quantity::Normal));
        assert_eq!((all.kind(Quantity::Rendering), all.range(Quantity::Rendering)), (Difference::Log, None));
        all.set_range(Quantity::Rendering, Some(0.1));
        all.choose(Quantity::Normal, Difference::Angle);
        assert!(all.is_error_map(Quantity::Rendering));
        all.choose(Quantity::Rendering, Difference::Log);
        assert!(!all.is_error_map(Quantity::Rendering));
        assert_eq!(all.range(Quantity::Rendering), Some(0.5));
        all.choose_error_map();
        assert_eq!(all.range(Quantity::Rendering), Some(0.1));
    }
}
