//! Contact sheet: a row a material, a column a method, all under the light and view of the window.

use std::ops::Range;
use std::sync::Arc;

use eframe::egui::scroll_area::ScrollSource;
use eframe::egui::{
    self, Align2, FontId, PointerButton, Rect, Response, Sense, TextureOptions, WidgetInfo, pos2, vec2,
};

use svbrdf_core::material::Grid;
use svbrdf_core::model::scene::Endpoint;
use svbrdf_core::text::line;

use crate::dataset::list::MARK;
use crate::dataset::losses::DatasetLosses;
use crate::dataset::pictures::{self, DrawSheet, SheetPicture, SheetRow};
use crate::dataset::pictures::{ReadRow, Reduced, SheetCell};
use crate::dataset::rows::{Rows, chosen_method, texts};
use crate::dataset::summary;
use crate::jobs::Shown;
use crate::jobs::answers::Answered;
use crate::model::dataset::OpenDataset;
use crate::model::dataset::list::ListOrder;
use crate::model::material::loaded::drawable;
use crate::model::{Model, endpoint};
use crate::widgets::names::Names;
use crate::widgets::numbers::digits;
use crate::widgets::paint::{PanelTextures, colour_bar};
use crate::widgets::{names, theme};

/// Width of the names of materials, height of the names of methods, and gap between cells, in points.
const NAMES: f32 = 104.0;
/// Room before the names, in points.
const INDENT: f32 = 8.0;
const HEAD: f32 = 36.0;
const GAP: f32 = 4.0;
/// The change of the size of a cell by a step of the wheel, per point of its motion.
const WHEEL: f32 = 0.004;

/// What was read and drawn of the rows in sight.
struct Drawn {
    rows: Vec<SheetRow>,
    pictures: Option<Arc<Answered<SheetPicture>>>,
}

impl Drawn {
    /// Why there is no material in a cell.
    fn problem(&self, cell: SheetCell) -> Option<&str> {
        let (_, row) = self.rows.iter().find(|(case, _)| *case == cell.case)?;
        row.get(cell.column).and_then(|one: &Reduced| one.as_ref().err()).map(String::as_str)
    }
}

/// The sheet in the place of the panes.
#[derive(Debug)]
pub struct ContactSheet<'a> {
    pub shown: Shown<'a>,
    pub open: &'a Arc<OpenDataset>,
    pub rows: &'a Rows,
    pub losses: Arc<Answered<DatasetLosses>>,
    pub textures: &'a mut PanelTextures,
}

impl ContactSheet<'_> {
    pub fn ui(&mut self, ui: &mut egui::Ui, next: &mut Model) {
        let cell = self.shown.model.dataset.sheet.cell;
        let area = ui.available_rect_before_wrap();
        let over = area.with_min_x(area.left() + NAMES);
        let is_over = ui.input(|i| i.pointer.hover_pos().is_some_and(|at| over.contains(at)));
        if is_over {
            wheel(ui, next);
        }
        let columns = self.open.methods().len() + 1;
        let width = NAMES + columns as f32 * (cell + GAP);
        ui.add_space(2.0);
        let scroll = egui::ScrollArea::horizontal().id_salt("columns").auto_shrink([false, false]);
        scroll.show(ui, |ui| {
            ui.set_min_width(width.max(area.width()));
            self.head(ui, cell, next);
            ui.spacing_mut().item_spacing.y = GAP;
            let rows = egui::ScrollArea::vertical().id_salt("rows").auto_shrink([false, false]);
            // Over the pictures the wheel sizes them.
            let rows = rows.scroll_source(ScrollSource { mouse_wheel: !is_over, ..ScrollSource::SCROLL_BAR });
            rows.show_rows(ui, cell, self.rows.cases.len(), |ui, range| {
                let drawn = self.drawn((cell * ui.pixels_per_point()).round() as usize, range.clone());
                for row in range {
                    self.row(ui, (row, cell), &drawn, next);
                }
            });
        });
    }

    /// What is drawn of these rows, which are asked for from the first on.
    fn drawn(&mut self, pixels: usize, rows: Range<usize>) -> Drawn {
        let Shown { model, jobs } = self.shown;
        let cases = self.rows.cases.get(rows).unwrap_or_default();
        model.dataset.in_sight.set(&[&[model.dataset.wanted], cases].concat());
        let read = |case: &usize| {
            let row = ReadRow::of(self.open, *case, pixels, model.dataset.version(*case));
            Some((*case, jobs.answers.get(&row).ready()?))
        };
        let rows: Vec<SheetRow> = cases.iter().filter_map(read).collect();
        let pictures = jobs.answers.drawn(&DrawSheet::of(rows.clone(), &model.view));
        let pictures = pictures.map(|(pictures, _)| pictures);
        Drawn { rows, pictures }
    }

    /// The names of the columns with the means of the methods; a click sorts by the losses of one.
    fn head(&self, ui: &mut egui::Ui, cell: f32, next: &mut Model) {
        let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), HEAD), Sense::hover());
        self.legend(ui, rect.with_max_x(rect.left() + NAMES).with_max_y(rect.top() + 0.5 * HEAD));
        let report = summary::drawn(self.shown);
        let methods: Vec<&str> = self.open.methods().iter().map(String::as_str).collect();
        let all = Names::new(&methods);
        let font = FontId::proportional(12.0);
        let chosen = chosen_method(self.shown);
        for column in 0..=methods.len() {
            let left = rect.left() + NAMES + column as f32 * (cell + GAP);
            let text = match column.checked_sub(1) {
                None => Some("GROUND TRUTH".to_owned()),
                Some(method) => {
                    let text = |most| drawable(&all.shortened(method, most));
                    names::fitted(ui, &font, cell, text)
                }
            };
            let is_chosen = column > 0 && methods.get(column - 1).copied() == chosen;
            let dark = ui.visuals().dark_mode;
            let colour =
                if column == 0 { theme::ground_truth(ui.visuals()) } else { theme::series(column, dark) };
            let room = Rect::from_min_size(pos2(left, rect.top()), vec2(cell, HEAD));
            let painter = ui.painter().with_clip_rect(room.intersect(ui.clip_rect()));
            let line = |share: f32| pos2(left, rect.top() + share * HEAD);
            painter.text(line(0.28), Align2::LEFT_CENTER, text.unwrap_or_default(), font.clone(), colour);
            let Some(method) = column.checked_sub(1) else { continue };
            let order = ListOrder::Loss(method);
            let arrow = match (next.dataset.list.order == order, next.dataset.list.is_reversed) {
                (false, _) => "",
                (true, false) => " \u{2193}",
                (true, true) => " \u{2191}",
            };
            let summary =
                report.as_ref().and_then(|all| all.methods.iter().find(|one| one.method == methods[method]));
            let mean = summary
                .filter(|one| one.mean.is_finite())
                .map_or_else(String::new, |one| format!("mean {}", digits(one.mean)));
            let ink = if is_chosen { ui.visuals().text_color() } else { ui.visuals().weak_text_color() };
            let mean = format!("{mean}{arrow}");
            painter.text(line(0.74), Align2::LEFT_CENTER, &mean, FontId::monospace(11.0), ink);
            let response = ui.interact(room, ui.scope_id().with(("head", method)), Sense::click());
            let name = format!("Sort by {}: {mean}", methods[method]);
            response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, &name));
            if response.on_hover_text("The largest losses of this method first; again: the least").clicked() {
                next.dataset.list.sort_by(order);
            }
        }
    }

    /// The colours of differences, which all cells share, between the numbers of both ends.
    fn legend(&self, ui: &egui::Ui, area: Rect) {
        let (display, range) =
            (&self.shown.model.view.display, pictures::latest(self.shown).and_then(|one| one.range));
        let Some(range) = range.filter(|_| display.difference) else { return };
        let (kind, _) = display.differences.pointwise(display.quantity);
        let least = if kind.is_signed() { -1.0 } else { 0.0 };
        let (font, ink) = (FontId::monospace(10.0), ui.visuals().text_color());
        let middle = area.center().y;
        let text = |value: f64| digits(value).replace('-', "\u{2212}");
        let at = pos2(area.left() + INDENT, middle);
        let low = ui.painter().text(at, Align2::LEFT_CENTER, text(least * range), font.clone(), ink);
        let at = pos2(area.right() - GAP, middle);
        let high = ui.painter().text(at, Align2::RIGHT_CENTER, text(range), font, ink);
        let bar =
            Rect::from_min_max(pos2(low.right() + 3.0, middle - 4.0), pos2(high.left() - 3.0, middle + 4.0));
        ui.painter().add(colour_bar(bar, [least as f32, 1.0], kind.is_signed()));
    }

    fn row(&mut self, ui: &mut egui::Ui, (row, cell): (usize, f32), drawn: &Drawn, next: &mut Model) {
        let Some((case, ahead)) = self.rows.at(row) else { return };
        let columns = self.open.methods().len() + 1;
        let (rect, _) =
            ui.allocate_exact_size(vec2(NAMES + columns as f32 * (cell + GAP), cell), Sense::hover());
        let names = Rect::from_min_size(rect.min + vec2(INDENT, 0.0), vec2(NAMES - INDENT - 6.0, cell));
        let name = drawable(self.open.name(case));
        let mark = self.shown.model.dataset.mark(self.open.name(case)).filter(|mark| mark.is_marked);
        let text = format!("{name}{}", mark.map_or("", |_| MARK));
        let colour = ui.visuals().text_color();
        let galley = ui.painter().layout(text, FontId::proportional(12.0), colour, names.width());
        let painter = ui.painter().with_clip_rect(names.intersect(ui.clip_rect()));
        painter.galley(names.min, galley, colour);
        let texts = self.losses.row(case).map(texts).unwrap_or_default();
        for column in 0..columns {
            let left = rect.left() + NAMES + column as f32 * (cell + GAP);
            let square = Rect::from_min_size(pos2(left, rect.top()), vec2(cell, cell));
            if !ui.is_rect_visible(square) {
                continue;
            }
            let at = SheetCell { case, column };
            let id = ui.scope_id().with(("cell", case, column));
            let response = ui.interact(square, id, Sense::click_and_drag());
            let shown = self.paint(ui, square, at, drawn);
            self.paint_loss(ui, square, at, &texts);
            response.widget_info(|| {
                WidgetInfo::labeled(egui::Role::Button, true, format!("Cell {name}, {}", self.column(column)))
            });
            self.gesture(&response, shown, (case, &ahead), next);
        }
    }

    fn column(&self, column: usize) -> &str {
        column
            .checked_sub(1)
            .and_then(|method| self.open.methods().get(method))
            .map_or("ground truth", String::as_str)
    }

    /// Draws a cell; where its picture is, and its size in texels.
    fn paint(
        &mut self,
        ui: &egui::Ui,
        square: Rect,
        cell: SheetCell,
        drawn: &Drawn,
    ) -> Option<(Rect, [usize; 2])> {
        if let Some(sheet) = &drawn.pictures
            && let Some(([least, most], size)) = sheet.part(cell)
        {
            let texture = self.textures.id(ui.ctx(), &sheet.atlas.picture, TextureOptions::LINEAR);
            let [width, height] = size.map(|side| side as f32);
            let fitted = vec2(width, height) * (square.width() / width.max(height).max(1.0));
            let at = Rect::from_center_size(square.center(), fitted);
            let part = Rect::from_min_max(pos2(least[0], least[1]), pos2(most[0], most[1]));
            ui.painter().image(texture, at, part, egui::Color32::WHITE);
            return Some((at, size));
        }
        ui.painter().rect_filled(square, 2.0, ui.visuals().faint_bg_color);
        if let Some(problem) = drawn.problem(cell) {
            let (colour, width) = (theme::problem(ui.visuals()), square.width() - 8.0);
            let text = drawable(&line(problem));
            let galley = ui.painter().layout(text, FontId::proportional(11.0), colour, width);
            let painter = ui.painter().with_clip_rect(square.intersect(ui.clip_rect()));
            painter.galley(square.min + vec2(4.0, 4.0), galley, colour);
        }
        None
    }

    /// Prints the loss of a cell into its lower left corner.
    fn paint_loss(&self, ui: &egui::Ui, square: Rect, cell: SheetCell, texts: &[String]) {
        let text = cell.column.checked_sub(1).and_then(|method| texts.get(method));
        let Some(text) = text.filter(|text| !text.is_empty()) else { return };
        let painter = ui.painter().with_clip_rect(square.intersect(ui.clip_rect()));
        let galley = painter.layout_no_wrap(text.clone(), FontId::monospace(11.0), egui::Color32::WHITE);
        let at = Align2::LEFT_BOTTOM.anchor_size(square.left_bottom(), galley.size() + vec2(6.0, 2.0));
        painter.rect_filled(at, 0.0, egui::Color32::from_black_alpha(170));
        painter.galley(at.min + vec2(3.0, 1.0), galley, egui::Color32::WHITE);
    }

    /// A drag moves light or view in all cells, as in a pane; a click opens the material.
    fn gesture(
        &self,
        response: &Response,
        shown: Option<(Rect, [usize; 2])>,
        (case, ahead): (usize, &[usize]),
        next: &mut Model,
    ) {
        if response.clicked() {
            return next.dataset.show_from_sheet(case, ahead.to_vec());
        }
        let (Some((at, [width, height])), Some(pointer)) = (shown, response.interact_pointer_pos()) else {
            return;
        };
        let share = [(pointer.x - at.left()) / at.width(), (pointer.y - at.top()) / at.height()];
        let place = [share[0] * width as f32, share[1] * height as f32];
        let point = Grid { width, height }.point(place).map(f64::from);
        let scene = &mut next.view.scene;
        if response.dragged_by(PointerButton::Primary) && next.settings.highlight_follows {
            endpoint::put_highlight(scene, point);
        } else if response.dragged_by(PointerButton::Primary) {
            endpoint::move_over_plane(scene, Endpoint::Light, point);
        } else if response.dragged_by(PointerButton::Secondary) {
            endpoint::move_over_plane(scene, Endpoint::View, point);
        }
    }
}

/// The wheel over the pictures changes their size, with Shift the height of the light.
fn wheel(ui: &egui::Ui, next: &mut Model) {
    let (delta, modifiers) = ui.input(|i| (i.smooth_scroll_delta, i.modifiers));
    let turned = delta.x + delta.y;
    let factor = (turned * WHEEL).exp();
    if turned != 0.0 && modifiers.shift_only() {
        endpoint::scale_height(&mut next.view.scene, Endpoint::Light, f64::from(factor));
    } else if turned != 0.0 && modifiers.is_none() {
        next.dataset.set_cell(next.dataset.sheet.cell * factor);
    }
}
