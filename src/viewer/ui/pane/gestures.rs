//! Gestures of the mouse in a pane. The press decides the gesture, which then does one thing.
//!
//! They are read before the panes are shaded: what a drag changes is in the frame that read it.

use eframe::egui::{self, PointerButton, Pos2, Response, Vec2};

use svbrdf_core::model::scene::Kind;
use svbrdf_core::picture::quantity::Quantity;

use crate::model::command::{Command, DisplayCommand, InspectionCommand, SceneCommand};
use crate::model::inspection::Region;
use crate::model::view::endpoint::{self, Endpoint};
use crate::model::view::state::{Layout, Projection, ViewState};
use crate::ui::pane::handles::{self, REACH};
use crate::ui::pane::placed::Placed;

/// Radians of orbit per point that the pointer moves.
const ORBIT_SPEED: f64 = 0.008;
/// Factor of a height or a distance per notch of the wheel or 50 points of a drag.
const SCALE_STEP: f64 = 1.1;
/// Factor of the magnification per notch of the wheel.
const ZOOM_STEP: f32 = 1.15;

/// What the current drag does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gesture {
    Light,
    View,
    OrbitView,
    OrbitLight,
    LightDistance,
    Pan,
    Wipe,
    /// Pins the texel that was pressed, and nothing more.
    Pin,
    /// Draws a rectangle from this point of the plane.
    Rectangle([f32; 2]),
}

/// A pane under the mouse.
#[derive(Clone, Copy, Debug)]
pub struct PaneTarget<'a> {
    pub placed: Placed,
    pub state: &'a ViewState,
    pub highlight_follows: bool,
    /// Whether a left-drag draws a rectangle.
    pub is_armed: bool,
}

impl PaneTarget<'_> {
    /// Which gesture a press at `pos` begins.
    fn begin(&self, ctx: &egui::Context, button: PointerButton, pos: Pos2) -> Gesture {
        let (modifiers, space) = ctx.input(|i| (i.modifiers, i.key_down(egui::Key::Space)));
        let chord = modifiers.command && modifiers.shift;
        match button {
            PointerButton::Primary if space => Gesture::Pan,
            PointerButton::Primary if chord => Gesture::OrbitLight,
            PointerButton::Primary if modifiers.alt => Gesture::Pin,
            PointerButton::Primary => {
                let on_map = self.state.display.quantity != Quantity::Rendering;
                match self.placed.point(pos).filter(|_| self.is_armed || on_map && modifiers.shift) {
                    Some(point) => Gesture::Rectangle(point),
                    None => self.grabbed(pos),
                }
            }
            PointerButton::Secondary if chord => Gesture::LightDistance,
            PointerButton::Secondary if self.state.display.projection == Projection::Perspective => {
                Gesture::OrbitView
            }
            PointerButton::Secondary => Gesture::View,
            _ => Gesture::Pan,
        }
    }

    /// What a left press grabs: the wipe line first, then the sun, then the eye; elsewhere it moves the light. Maps have no
    /// light: there it pans.
    fn grabbed(&self, pos: Pos2) -> Gesture {
        if self.over_wipe(pos) {
            Gesture::Wipe
        } else if self.state.display.quantity != Quantity::Rendering {
            Gesture::Pan
        } else if self.over(Endpoint::Light, pos) {
            Gesture::Light
        } else if self.state.display.projection == Projection::Flat && self.over(Endpoint::View, pos) {
            Gesture::View
        } else {
            Gesture::Light
        }
    }

    fn over(&self, endpoint: Endpoint, pos: Pos2) -> bool {
        let at = endpoint::over_plane(&self.state.scene, endpoint);
        let seen = handles::pos_from_plane(&self.placed.camera, self.placed.rect, at);
        seen.is_some_and(|(at, _)| at.distance(pos) <= REACH)
    }

    fn over_wipe(&self, pos: Pos2) -> bool {
        let rect = self.placed.rect;
        let line = rect.left() + self.state.display.wipe * rect.width();
        self.state.display.layout == Layout::Wipe && (pos.x - line).abs() <= REACH * 0.6
    }

    /// The pointer's shape over this pane.
    fn cursor(&self, pos: Pos2) -> egui::CursorIcon {
        match self.grabbed(pos) {
            _ if self.is_armed => egui::CursorIcon::Crosshair,
            Gesture::Wipe => egui::CursorIcon::ResizeHorizontal,
            Gesture::View => egui::CursorIcon::Grab,
            Gesture::Pan => egui::CursorIcon::Default,
            _ if self.over(Endpoint::Light, pos) => egui::CursorIcon::Grab,
            _ => egui::CursorIcon::Crosshair,
        }
    }

    /// What `gesture` does as the pointer stands at `pos` after moving by `delta`.
    fn carry_on(&self, gesture: Gesture, pos: Pos2, delta: Vec2) -> Option<Command> {
        let rect = self.placed.rect;
        let plane = || self.placed.point(pos).map(|p| p.map(f64::from));
        let over_plane = |endpoint| plane().map(|p| SceneCommand::MoveOverPlane(endpoint, p).into());
        let (right, up) = (f64::from(delta.x) * ORBIT_SPEED, -f64::from(delta.y) * ORBIT_SPEED);
        match gesture {
            Gesture::Light if self.highlight_follows && self.state.scene.kind == Kind::Near => {
                plane().map(|p| SceneCommand::PutHighlight(p).into())
            }
            Gesture::Light => over_plane(Endpoint::Light),
            Gesture::View => over_plane(Endpoint::View),
            // The hand turns the material: the view goes the other way around it.
            Gesture::OrbitView => Some(orbit(Endpoint::View, -right, -up)),
            Gesture::OrbitLight => Some(orbit(Endpoint::Light, right, up)),
            Gesture::LightDistance => {
                let factor = SCALE_STEP.powf(-f64::from(delta.y) / 25.0);
                Some(SceneCommand::ScaleDistance(Endpoint::Light, factor).into())
            }
            Gesture::Pin => None,
            Gesture::Rectangle(from) => {
                let region = Region::between(self.placed.grid, from, self.placed.point(pos)?)?;
                Some(InspectionCommand::SetRegion(Some(region)).into())
            }
            Gesture::Pan => {
                let by = delta / (rect.size() * 0.5);
                Some(DisplayCommand::Pan([by.x, -by.y]).into())
            }
            Gesture::Wipe => Some(DisplayCommand::SetWipe((pos.x - rect.left()) / rect.width()).into()),
        }
    }

    /// What the wheel does over this pane.
    fn wheel(&self, ctx: &egui::Context, pos: Pos2) -> Vec<Command> {
        let at = handles::ndc_from_pos(self.placed.rect, pos);
        ctx.input(|input| {
            let notches = input.events.iter().filter_map(|event| match event {
                egui::Event::MouseWheel { unit, delta, modifiers, .. } => {
                    // Shift turns the wheel into a sideways one on some systems: either axis counts.
                    let delta = delta.x + delta.y;
                    let notches = if *unit == egui::MouseWheelUnit::Point { delta / 50.0 } else { delta };
                    Some((notches, *modifiers))
                }
                _ => None,
            });
            notches
                .filter(|(notches, modifiers)| *notches != 0.0 && !modifiers.command)
                .map(|(notches, modifiers)| {
                    let factor = SCALE_STEP.powf(f64::from(notches));
                    if modifiers.shift {
                        SceneCommand::ScaleHeight(Endpoint::Light, factor).into()
                    } else if modifiers.alt {
                        SceneCommand::ScaleHeight(Endpoint::View, factor).into()
                    } else {
                        DisplayCommand::Zoom { factor: ZOOM_STEP.powf(notches), at }.into()
                    }
                })
                .collect()
        })
    }
}

fn orbit(endpoint: Endpoint, sideways: f64, upwards: f64) -> Command {
    SceneCommand::Orbit { endpoint, sideways, upwards }.into()
}

/// The commands of the mouse over one pane; `current` is the gesture that is going on in any pane.
pub fn commands(
    ctx: &egui::Context,
    response: &Response,
    target: &PaneTarget<'_>,
    current: &mut Option<Gesture>,
) -> Vec<Command> {
    let mut commands = Vec::new();
    for button in [PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle] {
        let dragged = response.drag_started_by(button);
        let pos =
            if dragged { ctx.input(|i| i.pointer.press_origin()) } else { clicked(ctx, response, button) };
        let Some(pos) = pos else { continue };
        let gesture = target.begin(ctx, button, pos);
        if dragged {
            *current = Some(gesture);
        } else {
            commands.extend(target.carry_on(gesture, pos, Vec2::ZERO));
        }
        if gesture == Gesture::Pin
            && let Some(texel) = target.placed.texel(pos)
        {
            commands.push(InspectionCommand::TogglePin(texel).into());
        }
    }
    if response.dragged()
        && let (Some(gesture), Some(pos)) = (*current, response.interact_pointer_pos())
    {
        let origin = ctx.input(|i| i.pointer.press_origin()).filter(|_| response.drag_started());
        // A frame may have movements from before the press, too.
        let delta = origin.map_or(response.drag_delta(), |origin| pos - origin);
        commands.extend(target.carry_on(gesture, pos, delta));
    }
    if response.drag_stopped() {
        *current = None;
    }
    if let Some(pos) = response.hover_pos() {
        ctx.set_cursor_icon(target.cursor(pos));
        commands.extend(target.wheel(ctx, pos));
    }
    commands
}

/// Where a button was pressed and released within one frame, which on slow adapters takes as long as a click.
fn clicked(ctx: &egui::Context, response: &Response, button: PointerButton) -> Option<Pos2> {
    let quick = ctx.input(|i| i.pointer.button_pressed(button) && i.pointer.button_released(button));
    response.hover_pos().filter(|_| quick)
}
