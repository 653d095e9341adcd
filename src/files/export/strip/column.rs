//! Columns of a figure: what each shows, and the lines of text above it.

use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::content::PictureContent;
use svbrdf_core::picture::quantity::Quantity;

/// Heights of text, in pixels.
pub(super) const NAME: u32 = 17;
pub(super) const SMALL: u32 = 13;
pub(super) const INK: [u8; 3] = [32; 3];
const WEAK: [u8; 3] = [96; 3];

/// A column: what it shows, and under which light and view.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    pub content: PictureContent,
    pub scene: Scene,
}

impl Column {
    /// What it shows, for metadata.
    pub(super) fn text(&self, epsilon: f64) -> String {
        match self.content.quantity {
            Quantity::Rendering => {
                format!("{}, {}", self.content.text(epsilon), endpoints(&self.scene).join(", "))
            }
            _ => self.content.text(epsilon),
        }
    }

    /// Its name, and what it is of: lines of text with their heights and inks.
    pub(super) fn header(&self) -> Vec<(String, u32, [u8; 3])> {
        let quantity = self.content.quantity;
        let name = match self.content.difference {
            Some(difference) => format!("{}, {}", quantity.name(), difference.kind.name()),
            None => quantity.name().to_owned(),
        };
        let mut lines = vec![(name, NAME, INK)];
        if quantity == Quantity::Rendering {
            let [light, view] = endpoints(&self.scene);
            lines.extend([(light, SMALL, WEAK), (view, SMALL, WEAK)]);
        }
        lines
    }
}

/// Light and view.
fn endpoints(scene: &Scene) -> [String; 2] {
    let kind = match scene.kind {
        Kind::Near => "",
        Kind::Distant => "distant ",
    };
    let point = |[x, y, z]: [f64; 3]| format!("{x:.3}, {y:.3}, {z:.3}");
    [format!("{kind}light {}", point(scene.light)), format!("view {}", point(scene.view))]
}
