//! Gestures of the mouse in a pane. The press decides the gesture, which then does one thing.
//!
//! They are read before the panes are shaded: what a drag changes is in the frame that read it.

use eframe::egui::{self, PointerButton, Pos2, Response, Vec2};

use svbrdf_core::model::scene::Kind;
use svbrdf_core::picture::quantity::Quantity;

use crate::model::endpoint::{self, Endpoint};
use crate::model::inspection::Region;
use crate::model::view::{Layout, Projection};
use crate::model::{Model, display};
use crate::pane::handles::{self, REACH};
use crate::pane::placed::Placed;

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

/// Which gesture a press at `pos` of a pane begins.
fn begin(ctx: &egui::Context, model: &Model, placed: &Placed, button: PointerButton, pos: Pos2) -> Gesture {
    let (modifiers, space) = ctx.input(|i| (i.modifiers, i.key_down(egui::Key::Space)));
    let chord = modifiers.command && modifiers.shift;
    let display = &model.view.display;
    match button {
        PointerButton::Primary if space => Gesture::Pan,
        PointerButton::Primary if chord => Gesture::OrbitLight,
        PointerButton::Primary if modifiers.alt => Gesture::Pin,
        PointerButton::Primary => {
            let on_map = display.quantity != Quantity::Rendering;
            let draws = model.inspection.is_armed || on_map && modifiers.shift;
            match placed.point(pos).filter(|_| draws) {
                Some(point) => Gesture::Rectangle(point),
                None => grabbed(model, placed, pos),
            }
        }
        PointerButton::Secondary if chord => Gesture::LightDistance,
        PointerButton::Secondary if display.projection == Projection::Perspective => Gesture::OrbitView,
        PointerButton::Secondary => Gesture::View,
        _ => Gesture::Pan,
    }
}

/// What a left press grabs: the wipe line first, then the sun, then the eye; elsewhere it moves the light. Maps have no light: there it
/// pans.
fn grabbed(model: &Model, placed: &Placed, pos: Pos2) -> Gesture {
    let display = &model.view.display;
    let line = placed.rect.left() + display.wipe * placed.rect.width();
    if display.layout == Layout::Wipe && (pos.x - line).abs() <= REACH * 0.6 {
        Gesture::Wipe
    } else if display.quantity != Quantity::Rendering {
        Gesture::Pan
    } else if over(model, placed, Endpoint::Light, pos) {
        Gesture::Light
    } else if display.projection == Projection::Flat && over(model, placed, Endpoint::View, pos) {
        Gesture::View
    } else {
        Gesture::Light
    }
}

fn over(model: &Model, placed: &Placed, endpoint: Endpoint, pos: Pos2) -> bool {
    let at = endpoint::over_plane(&model.view.scene, endpoint);
    let seen = handles::pos_from_plane(&placed.camera, placed.rect, at);
    seen.is_some_and(|(at, _)| at.distance(pos) <= REACH)
}

/// The pointer's shape over a pane.
fn cursor(model: &Model, placed: &Placed, pos: Pos2) -> egui::CursorIcon {
    match grabbed(model, placed, pos) {
        _ if model.inspection.is_armed => egui::CursorIcon::Crosshair,
        Gesture::Wipe => egui::CursorIcon::ResizeHorizontal,
        Gesture::View => egui::CursorIcon::Grab,
        Gesture::Pan => egui::CursorIcon::Default,
        _ if over(model, placed, Endpoint::Light, pos) => egui::CursorIcon::Grab,
        _ => egui::CursorIcon::Crosshair,
    }
}

/// Does what `gesture` does as the pointer stands at `pos` after moving by `delta`.
fn carry_on(model: &mut Model, placed: &Placed, gesture: Gesture, pos: Pos2, delta: Vec2) {
    let rect = placed.rect;
    let plane = placed.point(pos).map(|p| p.map(f64::from));
    let (right, up) = (f64::from(delta.x) * ORBIT_SPEED, -f64::from(delta.y) * ORBIT_SPEED);
    let scene = &mut model.view.scene;
    match (gesture, plane) {
        (Gesture::Light, Some(point)) if model.settings.highlight_follows && scene.kind == Kind::Near => {
            endpoint::put_highlight(scene, point);
        }
        (Gesture::Light, Some(point)) => endpoint::move_over_plane(scene, Endpoint::Light, point),
        (Gesture::View, Some(point)) => endpoint::move_over_plane(scene, Endpoint::View, point),
        // The hand turns the material: the view goes the other way around it.
        (Gesture::OrbitView, _) => endpoint::orbit(scene, Endpoint::View, -right, -up),
        (Gesture::OrbitLight, _) => endpoint::orbit(scene, Endpoint::Light, right, up),
        (Gesture::LightDistance, _) => {
            let factor = SCALE_STEP.powf(-f64::from(delta.y) / 25.0);
            endpoint::scale_distance(scene, Endpoint::Light, factor);
        }
        (Gesture::Rectangle(from), _) => {
            let to = placed.point(pos);
            if let Some(region) = to.and_then(|to| Region::between(placed.grid, from, to)) {
                (model.inspection.region, model.inspection.is_armed) = (Some(region), false);
            }
        }
        (Gesture::Pan, _) => {
            let by = delta / (rect.size() * 0.5);
            display::pan(model, [by.x, -by.y]);
        }
        (Gesture::Wipe, _) => {
            model.view.display.wipe = ((pos.x - rect.left()) / rect.width()).clamp(0.0, 1.0);
        }
        (Gesture::Light | Gesture::View | Gesture::Pin, _) => {}
    }
}

/// Does what the wheel does over a pane.
fn wheel(ctx: &egui::Context, model: &mut Model, rect: egui::Rect, pos: Pos2) {
    let at = handles::ndc_from_pos(rect, pos);
    for event in ctx.input(|input| input.events.clone()) {
        let egui::Event::MouseWheel { unit, delta, modifiers, .. } = event else { continue };
        // Shift turns the wheel into a sideways one on some systems: either axis counts.
        let delta = delta.x + delta.y;
        let notches = if unit == egui::MouseWheelUnit::Point { delta / 50.0 } else { delta };
        if notches == 0.0 || modifiers.command {
            continue;
        }
        let (scene, factor) = (&mut model.view.scene, SCALE_STEP.powf(f64::from(notches)));
        if modifiers.shift {
            endpoint::scale_height(scene, Endpoint::Light, factor);
        } else if modifiers.alt {
            endpoint::scale_height(scene, Endpoint::View, factor);
        } else {
            display::zoom(model, ZOOM_STEP.powf(notches), at);
        }
    }
}

/// Carries out the gestures of the mouse over one pane; `current` is the one that is going on in any pane.
pub fn act(
    ctx: &egui::Context,
    response: &Response,
    placed: &Placed,
    current: &mut Option<Gesture>,
    model: &mut Model,
) {
    for button in [PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle] {
        let dragged = response.drag_started_by(button);
        let pos =
            if dragged { ctx.input(|i| i.pointer.press_origin()) } else { clicked(ctx, response, button) };
        let Some(pos) = pos else { continue };
        let gesture = begin(ctx, model, placed, button, pos);
        if dragged {
            *current = Some(gesture);
        } else {
            carry_on(model, placed, gesture, pos, Vec2::ZERO);
        }
        if gesture == Gesture::Pin
            && let Some(texel) = placed.texel(pos)
        {
            model.inspection.toggle_pin(texel);
        }
    }
    if response.dragged()
        && let (Some(gesture), Some(pos)) = (*current, response.interact_pointer_pos())
    {
        let origin = ctx.input(|i| i.pointer.press_origin()).filter(|_| response.drag_started());
        // A frame may have movements from before the press, too.
        let delta = origin.map_or(response.drag_delta(), |origin| pos - origin);
        model.settings.has_dragged = true;
        carry_on(model, placed, gesture, pos, delta);
    }
    if response.drag_stopped() {
        *current = None;
    }
    if let Some(pos) = response.hover_pos() {
        ctx.set_cursor_icon(cursor(model, placed, pos));
        wheel(ctx, model, placed.rect, pos);
    }
}

/// Where a button was pressed and released within one frame, which on slow adapters takes as long as a click.
fn clicked(ctx: &egui::Context, response: &Response, button: PointerButton) -> Option<Pos2> {
    let quick = ctx.input(|i| i.pointer.button_pressed(button) && i.pointer.button_released(button));
    response.hover_pos().filter(|_| quick)
}
