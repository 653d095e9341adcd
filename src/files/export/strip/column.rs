//! Columns of a figure: what each shows, and the lines of text above it.

use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::content::PictureContent;
use svbrdf_core::picture::quantity::Quantity;

/// A column: what it shows, and under which light and view.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    pub content: PictureContent,
    pub scene: Scene,
}

impl Column {
    /// What it shows, for metadata.
    pub(super) fn text(&self, epsilon: f64) -> String {
        match self.scene() {
            Some(scene) => format!("{}, {}", self.content.text(epsilon), scene_text(scene)),
            None => self.content.text(epsilon),
        }
    }

    pub(super) fn name(&self) -> String {
        content_name(&self.content)
    }

    /// The scene of a rendering.
    pub(super) fn scene(&self) -> Option<&Scene> {
        (self.content.quantity == Quantity::Rendering).then_some(&self.scene)
    }
}

pub(super) fn content_name(content: &PictureContent) -> String {
    let quantity = content.quantity.name();
    match content.difference {
        Some(difference) if content.quantity == Quantity::Rendering => difference.kind.name().to_owned(),
        Some(difference) => format!("{quantity}, {}", difference.kind.name()),
        None => quantity.to_owned(),
    }
}

pub(super) fn scene_text(scene: &Scene) -> String {
    let kind = match scene.kind {
        Kind::Near => "light",
        Kind::Distant => "distant light",
    };
    let number = |x: f64| (1000.0 * x).round() / 1000.0 + 0.0;
    let point = |p: [f64; 3]| p.map(|x| number(x).to_string()).join(", ");
    format!("{kind} {}; view {}", point(scene.light), point(scene.view))
}

pub(super) fn stops(ev: f32) -> String {
    format!("exposure {}{ev} EV", if ev > 0.0 { "+" } else { "" })
}
