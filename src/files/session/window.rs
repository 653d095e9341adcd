//! Window part of a session: what the panes show and how, and the settings of the loss.

use std::str::FromStr;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::changes::Change;
use svbrdf_core::error::Error;
use svbrdf_core::loss::LossSettings;
use svbrdf_core::material::Map as MaterialMap;
use svbrdf_core::picture::differences::Differences;
use svbrdf_core::picture::quantity::Quantity;

/// What a window adds to a session; `None` where nothing was saved.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Map<String, Value>", into = "Map<String, Value>")]
pub struct SessionWindow {
    pub display: Option<SessionDisplay>,
    pub loss: Option<LossSettings>,
    pub inspection: Option<SessionInspection>,
}

/// Inspected texels of a material, as (column, row)s.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct SessionInspection {
    pub pins: Vec<[usize; 2]>,
    /// The first and the last texel of the rectangle.
    pub rectangle: Option<[[usize; 2]; 2]>,
}

const DISPLAY: &str = "view";
const LOSS: &str = "loss";
const INSPECTION: &str = "texels";

/// How the panes are arranged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Layout {
    /// The ground truth and every prediction, each in its own pane.
    #[default]
    SideBySide,
    /// Ground truth left and chosen prediction right of a line, in one pane.
    Wipe,
    /// The chosen prediction alone.
    Single,
}

impl Layout {
    pub const ALL: [Self; 3] = [Self::SideBySide, Self::Wipe, Self::Single];

    pub fn name(self) -> &'static str {
        match self {
            Self::SideBySide => "side by side",
            Self::Wipe => "wipe",
            Self::Single => "single",
        }
    }

    /// The name on the command line and in reports.
    pub fn key(self) -> &'static str {
        match self {
            Self::SideBySide => "side-by-side",
            Self::Wipe => "wipe",
            Self::Single => "single",
        }
    }
}

impl FromStr for Layout {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        Self::ALL
            .into_iter()
            .find(|layout| layout.key() == text)
            .ok_or_else(|| Error::unknown_name("layout", text, Self::ALL.map(Self::key).join(", ")))
    }
}

/// How the material is projected into a pane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Projection {
    /// As a flat texture, texel by texel.
    #[default]
    Flat,
    /// As a plane, viewed from the view position.
    Perspective,
}

impl Projection {
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Flat => Self::Perspective,
            Self::Perspective => Self::Flat,
        }
    }
}

/// Magnified part of a material, the same in panes of every size.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Framing {
    /// Physical pixels per texel; in perspective those of a texel in the middle of the material that faces the view.
    pub pixels_per_texel: f32,
    /// The point in the middle of the pane, in texels from the left and from the upper edge of the material.
    pub centre: [f32; 2],
}

/// Whether the exposure follows the ground truth: the brightest 1% of its rendering just clip.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum AutoExposure {
    /// It was set by hand.
    Off,
    /// It follows when materials are opened and a scene is chosen, and stays while light and view are moved.
    #[default]
    Once,
    /// It follows light, view and convention.
    Follow,
}

impl AutoExposure {
    /// That of sessions which do not say it: their exposure was set.
    fn of_older_sessions() -> Self {
        Self::Off
    }
}

/// What the panes show of the materials, and how. Every field has a default.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SessionDisplay {
    pub quantity: Quantity,
    /// Whether panes of predictions show their difference from the ground truth, in place of the value.
    pub difference: bool,
    /// The chosen difference and the range of each quantity.
    pub differences: Differences,
    pub layout: Layout,
    pub projection: Projection,
    #[serde(default = "AutoExposure::of_older_sessions")]
    pub auto_exposure: AutoExposure,
    pub show_clipping: bool,
    /// Whether roughness is shown in false colours.
    pub false_colour: bool,
    /// Position of the wipe line: 0 at the left edge of the pane, 1 at the right.
    pub wipe: f32,
    /// The magnified part of the material; where `None`, the material fits its pane.
    pub framing: Option<Framing>,
    /// The chosen prediction: its index among the predictions.
    pub prediction: usize,
    /// The map that is shown as the only wrong one, or the only right one, of the chosen prediction.
    pub isolated: Option<MaterialMap>,
    /// Whether [`SessionDisplay::isolated`] is the only right one, and not the only wrong one.
    pub only_right: bool,
    /// The change with which the chosen prediction is shown: one that a diagnosis found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corrected: Option<Change>,
}

impl SessionDisplay {
    /// Whether another material is shown in the place of the chosen prediction.
    pub fn is_replaced(&self) -> bool {
        self.isolated.is_some() || self.corrected.is_some()
    }
}

impl Default for SessionDisplay {
    fn default() -> Self {
        Self {
            quantity: Quantity::Rendering,
            difference: false,
            differences: Differences::default(),
            layout: Layout::SideBySide,
            projection: Projection::Flat,
            auto_exposure: AutoExposure::Once,
            show_clipping: false,
            false_colour: false,
            wipe: 0.5,
            framing: None,
            prediction: 0,
            isolated: None,
            only_right: false,
            corrected: None,
        }
    }
}

impl SessionWindow {
    /// Whether nothing was saved.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

impl From<SessionWindow> for Map<String, Value> {
    fn from(window: SessionWindow) -> Self {
        let display = window.display.map(|display| (DISPLAY, serde_json::to_value(display)));
        let loss = window.loss.map(|loss| (LOSS, serde_json::to_value(loss)));
        // Numbers, names and lists have a value.
        let inspection = window.inspection.map(|inspection| (INSPECTION, serde_json::to_value(inspection)));
        let parts = [display, loss, inspection].into_iter().flatten();
        parts.map(|(key, value)| (key.to_owned(), value.unwrap_or_default())).collect()
    }
}

impl TryFrom<Map<String, Value>> for SessionWindow {
    type Error = String;

    /// The text names the field that cannot be read or used.
    fn try_from(mut parts: Map<String, Value>) -> Result<Self, String> {
        let (display, loss) = (part(&mut parts, DISPLAY)?, part::<LossSettings>(&mut parts, LOSS)?);
        if let Some(loss) = &loss {
            loss.check().map_err(|problem| format!("window.{LOSS}.{problem}"))?;
        }
        Ok(Self { display, loss, inspection: part(&mut parts, INSPECTION)? })
    }
}

/// The part under this key; `None` where there is none.
fn part<T: DeserializeOwned>(parts: &mut Map<String, Value>, key: &str) -> Result<Option<T>, String> {
    let Some(value) = parts.remove(key) else { return Ok(None) };
    let of_field = |(field, value): (&String, &Value)| {
        let alone = Map::from_iter([(field.clone(), value.clone())]);
        let problem = serde_json::from_value::<T>(Value::Object(alone)).err()?;
        Some(format!("window.{key}.{field}: {problem}"))
    };
    let problem = value.as_object().and_then(|fields| fields.iter().find_map(of_field));
    serde_json::from_value(value)
        .map(Some)
        .map_err(|error| problem.unwrap_or(format!("window.{key}: {error}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<SessionWindow, String> {
        serde_json::from_str(text).map_err(|error| error.to_string())
    }

    #[test]
    fn a_mistyped_field_is_named() {
        for (text, field) in [
            (r#"{"loss": {"seed": 3, "ask": "Acuracy"}}"#, "window.loss.ask"),
            (r#"{"view": {"wipe": "large"}, "loss": {}}"#, "window.view.wipe"),
            (r#"{"view": 7}"#, "window.view"),
            (r#"{"texels": {"pins": [[1, -2]]}}"#, "window.texels.pins"),
        ] {
            let problem = read(text).unwrap_err();
            assert!(problem.contains(field), "{problem}");
        }
    }

    #[test]
    fn what_is_absent_has_its_default_and_what_is_written_is_read() {
        assert_eq!(read("{}"), Ok(SessionWindow::default()));
        let window =
            read(r#"{"view": {"wipe": 0.25}, "loss": {"seed": 7}, "of a newer version": 1}"#).unwrap();
        let loss = LossSettings { seed: 7, ..LossSettings::default() };
        // A session that does not say how it was exposed has an exposure that was set.
        let expected =
            SessionDisplay { wipe: 0.25, auto_exposure: AutoExposure::Off, ..SessionDisplay::default() };
        assert_eq!((window.display.clone(), window.loss.clone()), (Some(expected), Some(loss)));
        let rectangle = Some([[3, 4], [5, 6]]);
        let inspection = Some(SessionInspection { pins: vec![[1, 2]], rectangle });
        let window = SessionWindow { inspection, ..window };
        assert_eq!(read(&serde_json::to_string(&window).unwrap()), Ok(window));
    }
}
