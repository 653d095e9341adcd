//! Title above a pane.

use eframe::egui::{self, FontId, Rect, Sense, vec2};

use svbrdf_gpu::DisplayMode;

use crate::model::dataset::Missing;
use crate::model::material::loaded::drawable;
use crate::model::view::Layout;
use crate::model::{Model, display};
use crate::pane::Displayed;
use crate::pane::placed::TITLE;
use crate::pane::scenery::{PaneContent, PhotographUse};
use crate::widgets::names::{FEWEST, fitted};
use crate::widgets::numbers::means;
use crate::widgets::paint::inset;
use crate::widgets::theme;

/// Width of the button that shows the prediction itself again, in points.
const BACK: f32 = 96.0;
/// Least width of a title with the loss, in points.
const LEAST: f32 = 150.0;
/// Width of the colour of a prediction, in points.
const SWATCH: f32 = 14.0;

/// The title of a pane. A click on the title of a prediction chooses the prediction.
pub fn title_bar(
    ui: &mut egui::Ui,
    shown: &Displayed<'_>,
    number: usize,
    content: PaneContent,
    rect: Rect,
    next: &mut Model,
) {
    let is_material = content.photograph != PhotographUse::Displayed;
    let is_blind = shown.model.blind.is_some();
    let prediction = content.index.checked_sub(1).filter(|_| is_material && !is_blind);
    let chosen = prediction.is_some() && content.index == shown.chosen() && content.index != 0;
    let text = text(shown, content, usize::MAX, true);
    let response = ui.interact(rect, ui.scope_id().with(("title", number)), Sense::click());
    let replaced = chosen && shown.view().display.is_replaced();
    let loss = prediction.filter(|_| !replaced).and_then(|index| loss_of(shown, index, rect));
    response.widget_info(|| egui::WidgetInfo {
        current_text_value: loss.clone(),
        ..egui::WidgetInfo::labeled(egui::Role::Button, true, format!("Title {text}"))
    });
    let has_button = replaced && !shown.is_picture;
    let back =
        inset(Rect::from_min_max(rect.right_top() - vec2(BACK, 0.0), rect.right_bottom()), vec2(2.0, 2.0));
    let painter = ui.painter_at(rect);
    let colour = if prediction.is_none() && !is_blind {
        theme::ground_truth(ui.visuals())
    } else {
        ui.visuals().text_color()
    };
    let slot = prediction.map(|_| shown.materials()[content.index].slot);
    let left = if slot.is_some() { 8.0 + SWATCH } else { 8.0 };
    if let Some(slot) = slot {
        painter.rect_filled(swatch(rect), 0.0, theme::series(slot, ui.visuals().dark_mode));
    }
    let weak = ui.visuals().weak_text_color();
    let loss = loss.map(|loss| painter.layout_no_wrap(loss, FontId::monospace(12.0), weak));
    let button = if has_button { BACK } else { 0.0 };
    let room_of = |loss: f32| (rect.width() - left - 8.0 - button.max(loss)).max(0.0);
    let font = FontId::proportional(13.5);
    let width = room_of(loss.as_ref().map_or(0.0, |loss| loss.size().x + 8.0));
    let with_loss = short_in(ui, shown, content, &font, width);
    // Where a name does not fit beside it, the loss goes, which the panel has.
    let (width, loss) = if with_loss.is_some() { (width, loss) } else { (room_of(0.0), None) };
    let short = with_loss.or_else(|| short_in(ui, shown, content, &font, width));
    let short = short.unwrap_or_else(|| self::text(shown, content, FEWEST, false));
    if let Some(loss) = loss {
        let at = rect.right_center() - vec2(8.0 + loss.size().x, 0.5 * loss.size().y);
        painter.galley(at, loss, weak);
    }
    let galley = egui::WidgetText::from(egui::RichText::new(&short).font(font.clone()).color(colour))
        .into_galley(ui, Some(egui::TextWrapMode::Truncate), width, font);
    let elided = galley.elided || short != text;
    let at = rect.left_center() + vec2(left, -galley.size().y * 0.5);
    painter.galley(at, galley, colour);
    if chosen && shown.view().display.layout == Layout::SideBySide && shown.materials().len() > 2 {
        let line = Rect::from_min_max(rect.left_bottom() - vec2(0.0, 2.0), rect.right_bottom());
        painter.rect_filled(line, 0.0, theme::accent(ui.visuals()));
    }
    if has_button && back_button(ui, shown, back).clicked() {
        return next.view.isolate(None);
    }
    let response = if elided { response.on_hover_text(text) } else { response };
    if let Some(index) = prediction.filter(|_| response.clicked()) {
        display::choose(next, index);
    }
}

/// The button that shows the prediction itself again.
fn back_button(ui: &mut egui::Ui, shown: &Displayed<'_>, place: Rect) -> egui::Response {
    let is_corrected = shown.view().display.corrected.is_some();
    let label = if is_corrected { "Show original" } else { "Show all maps" };
    let button = ui.put(place, egui::Button::new(egui::RichText::new(label).small()));
    button.on_hover_text("Show the prediction itself again (Esc)")
}

/// Where the colour of a prediction is in its title.
fn swatch(title: Rect) -> Rect {
    Rect::from_center_size(title.left_center() + vec2(12.0, 0.0), vec2(8.0, 8.0))
}

/// The pane of a prediction that is not there, with the reason.
pub fn empty_pane(ui: &mut egui::Ui, shown: &Displayed<'_>, missing: &Missing, cell: Rect) {
    let (title, picture) = cell.split_top_bottom_at_y(cell.top() + TITLE);
    let (colour, problem) = (theme::series(missing.slot, ui.visuals().dark_mode), drawable(&missing.problem));
    ui.painter().rect_filled(picture, 0.0, theme::surround(shown.model.settings.dark));
    ui.painter().rect_filled(swatch(title), 0.0, colour);
    let room = inset(title, vec2(8.0, 0.0)).with_min_x(title.left() + 8.0 + SWATCH);
    ui.scope_builder(egui::UiBuilder::new().max_rect(room), |ui| {
        let name = format!("{}  {}", missing.slot, drawable(&missing.name));
        ui.add(egui::Label::new(egui::RichText::new(name).size(13.5)).truncate());
    });
    let room = inset(picture, vec2(12.0, 12.0));
    ui.scope_builder(egui::UiBuilder::new().max_rect(room), |ui| ui.label(problem));
}

/// The names and the quantity in this width: names lose what they have in common, and then their middles; where that is not enough,
/// the quantity goes, which the legend has.
fn short_in(
    ui: &egui::Ui,
    shown: &Displayed<'_>,
    content: PaneContent,
    font: &FontId,
    width: f32,
) -> Option<String> {
    let with = |has_quantity: bool| fitted(ui, font, width, |most| text(shown, content, most, has_quantity));
    with(true).or_else(|| with(false))
}

/// The loss of a prediction, where there may be room for it.
fn loss_of(shown: &Displayed<'_>, prediction: usize, title: Rect) -> Option<String> {
    let model = shown.model;
    // The panel has the loss of a single prediction.
    let is_repeated = model.dataset.open.is_none() && model.materials.all.len() == 2 && model.side_panel();
    shown.losses.get(prediction)?.as_ref().filter(|_| title.width() >= LEAST && !is_repeated)?;
    let place = shown.losses[..prediction].iter().flatten().count();
    Some(format!("loss {}", means(&shown.losses.iter().flatten().collect::<Vec<_>>()).get(place)?))
}

/// The names, of at most `most` characters each, and the quantity of differences where there is room for it.
fn text(shown: &Displayed<'_>, content: PaneContent, most: usize, has_quantity: bool) -> String {
    let [name, reference] = shown.names_of(content, most);
    let names = match content.mode {
        DisplayMode::Value => name,
        DisplayMode::Wipe(_) => format!("{reference}   |   {name}"),
    };
    if content.difference && has_quantity {
        format!("{names}: {}", shown.view().difference_name())
    } else {
        names
    }
}
