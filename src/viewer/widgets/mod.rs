//! Widgets and formats that several parts of the window share.

pub mod names;
pub mod numbers;
pub mod paint;
pub mod theme;

use std::ops::Range;

use eframe::egui::text::{LayoutJob, TextFormat};
use eframe::egui::{self, DragValue, Response, RichText};

use svbrdf_evaluate::report::{Cell, Table};

use crate::jobs::answers::Answer;
use crate::message::Message;
use crate::model::Model;
use crate::model::material::loaded::drawable;

/// A number to drag or type; a double-click resets it to `default`. A field that nobody edits writes nothing.
///
/// `name` is its accessible name.
pub fn number<T: egui::emath::Numeric>(
    ui: &mut egui::Ui,
    name: &str,
    value: &mut T,
    default: T,
    shape: impl FnOnce(DragValue<'_>) -> DragValue<'_>,
) -> Response {
    let before = *value;
    // As a field is left, egui writes its text once more, which has fewer digits than the number.
    let is_edited = is_edited(ui, ui.next_auto_id());
    let response = ui.add(shape(field(value, is_edited)));
    response.widget_info(|| {
        let mut info = egui::WidgetInfo::labeled(egui::Role::SpinButton, true, name);
        info.value = Some(before.to_f64());
        info
    });
    if response.double_clicked() {
        *value = default;
        ui.memory_mut(|m| m.surrender_focus(response.id));
    }
    response
}

/// Whether a field can be edited in this frame: by keys, by a drag or by assistive software.
fn is_edited(ui: &egui::Ui, id: egui::Id) -> bool {
    use egui::accesskit::Action;
    let asked = |action| ui.input(|input| input.has_accesskit_action_request(id, action));
    let has_focus = ui.is_enabled()
        && ui.memory_mut(|memory| {
            // Here Tab takes the focus away.
            memory.interested_in_focus(id, ui.layer_id());
            memory.has_focus(id)
        });
    has_focus
        || ui.ctx().is_being_dragged(id)
        || [Action::Increment, Action::Decrement, Action::SetValue].into_iter().any(asked)
}

/// A field of `value`, which it writes only where `is_edited`.
fn field<T: egui::emath::Numeric>(value: &mut T, is_edited: bool) -> DragValue<'_> {
    let field = DragValue::from_get_set(move |new| {
        if let Some(new) = new.filter(|_| is_edited) {
            *value = T::from_f64(new);
        }
        value.to_f64()
    });
    let field = field.clamp_existing_to_range(false);
    if T::INTEGRAL { field.max_decimals(0).range(T::MIN..=T::MAX).speed(0.25) } else { field }
}

/// Puts a text on the clipboard, and reports it; `what` names it.
pub fn copy(ctx: &egui::Context, model: &mut Model, text: String, what: &str) {
    ctx.copy_text(text);
    model.report([Message::Done(format!("Copied {what}"))]);
}

/// Gives a drop-down its accessible name.
pub fn named(combo: &Response, name: &str) {
    combo.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ComboBox, true, name));
}

/// How far work is, as wide as there is room.
pub fn progress(ui: &mut egui::Ui, fraction: f32, text: String) -> Response {
    ui.add(egui::ProgressBar::new(fraction).text(text).corner_radius(3.0))
}

/// A line of constant height: how far work is, or what was found, with more of it under the pointer.
pub fn state_line(
    ui: &mut egui::Ui,
    found: Option<String>,
    hover: &str,
    (fraction, doing): (f32, impl FnOnce() -> String),
) {
    let height = ui.spacing().interact_size.y;
    let Some(text) = found else {
        progress(ui, fraction, doing());
        return;
    };
    of_height(ui, height, |ui| {
        ui.add(egui::Label::new(RichText::new(text).small().weak()).truncate()).on_hover_text(hover);
    });
}

/// Contents of a height that is kept without them.
pub fn of_height(ui: &mut egui::Ui, height: f32, contents: impl FnOnce(&mut egui::Ui)) {
    ui.allocate_ui(egui::vec2(ui.available_width(), height), |ui| {
        ui.set_min_height(height);
        contents(ui);
    });
}

/// An answer where it is drawn: how far it is, why there is none, or what it `shows`.
pub fn answered<A>(ui: &mut egui::Ui, answer: Answer<A>, shows: impl FnOnce(&mut egui::Ui, &A)) {
    match answer {
        Answer::Partial(_, fraction, elapsed) | Answer::Running(fraction, elapsed) => {
            progress(ui, fraction, format!("{} s", elapsed.as_secs()));
        }
        Answer::Ready(found) => shows(ui, &found),
        Answer::Failed(problem) => {
            ui.label(RichText::new(drawable(&problem)).small().color(theme::problem(ui.visuals())));
        }
        Answer::Stopped(_) => {}
    }
}

/// A button that copies a table.
pub fn copy_table(ui: &mut egui::Ui, text: impl FnOnce() -> String) {
    if ui.small_button("Copy").on_hover_text("The table as text, with its settings").clicked() {
        ui.copy_text(text());
    }
}

/// A panel without a background: the window is cleared in its colour, and filling it again takes time on slow adapters.
pub fn bare(panel: egui::Panel, ui: &egui::Ui) -> egui::Panel {
    panel.frame(egui::Frame::side_top_panel(ui.style()).fill(egui::Color32::TRANSPARENT))
}

/// A text in this number of rows, which it does not exceed and which are kept without it; `hover` is shown on it.
pub fn rows(ui: &mut egui::Ui, text: Option<String>, format: TextFormat, rows: usize, hover: &str) {
    // Rows are rounded to pixels.
    let empty = LayoutJob::single_section("\n".repeat(rows - 1), format.clone());
    let height = ui.painter().layout_job(empty).size().y;
    of_height(ui, height, |ui| {
        if let Some(text) = text {
            let mut job = LayoutJob::single_section(text, format);
            job.wrap.max_rows = rows;
            ui.label(job).on_hover_text(hover);
        }
    });
}

/// Draws contents into the room that `ui` has; they do not widen it, whatever they need.
pub fn fixed<R>(ui: &mut egui::Ui, contents: impl FnOnce(&mut egui::Ui) -> R) -> R {
    let rect = ui.available_rect_before_wrap();
    ui.allocate_rect(rect, egui::Sense::hover());
    let mut child = ui.new_child(egui::UiBuilder::new().max_rect(rect));
    child.shrink_clip_rect(rect.expand(ui.spacing().item_spacing.x));
    contents(&mut child)
}

/// Height of a row of a report, in points, whatever letters it has.
const ROW: f32 = 18.0;

/// The table of a report: the names of its rows stay, and the other columns scroll sideways where there is no room for them.
pub fn report_table(ui: &mut egui::Ui, table: &Table) {
    ui.horizontal_top(|ui| {
        ui.vertical(|ui| {
            ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Truncate);
            columns(ui, table, 0..1, 0.4 * ui.available_width());
        });
        let scroll = egui::ScrollArea::horizontal().id_salt("table");
        scroll.show(ui, |ui| columns(ui, table, 1..table.columns.len(), f32::INFINITY));
    });
}

fn columns(ui: &mut egui::Ui, table: &Table, range: Range<usize>, most: f32) {
    let grid = egui::Grid::new(("table", range.start)).striped(true).spacing([8.0, 0.0]);
    grid.min_row_height(ROW).max_col_width(most).show(ui, |ui| {
        for (column, title) in table.columns.iter().enumerate().take(range.end).skip(range.start) {
            let below = table.rows.iter().find_map(|row| row.get(column));
            aligned(ui, below, RichText::new(drawable(title)).small().strong());
        }
        ui.end_row();
        for row in &table.rows {
            row.get(range.clone()).unwrap_or_default().iter().for_each(|cell| value(ui, cell));
            ui.end_row();
        }
    });
}

fn value(ui: &mut egui::Ui, cell: &Cell) {
    let text = RichText::new(drawable(&cell.text())).small();
    let is_words = matches!(cell, Cell::Text(_));
    aligned(ui, Some(cell), if is_words { text } else { text.monospace().size(11.0) });
}

/// Words to the left, numbers, and what stands above them, to the right.
fn aligned(ui: &mut egui::Ui, cell: Option<&Cell>, text: RichText) {
    match cell {
        None | Some(Cell::Text(_)) => ui.label(text),
        Some(_) => {
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| ui.label(text)).inner
        }
    };
}
