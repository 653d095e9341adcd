//! Rows of the table: the name of a material, and its cells with picture, loss or the reason for there being none.

use std::sync::Arc;

use eframe::egui::{
    self, Align2, Color32, FontId, PointerButton, Rect, Response, Sense, Stroke, TextureOptions, WidgetInfo,
    pos2, vec2,
};

use svbrdf_core::material::Grid;
use svbrdf_core::model::scene::Endpoint;
use svbrdf_core::text::line;

use crate::dataset::matrix::texts;
use crate::dataset::pictures::{CellPictures, MatrixCell, ReadCells};
use crate::dataset::places::{GAP, MatrixTable, NUMBER, Places};
use crate::jobs::answers::Answered;
use crate::model::material::loaded::{NEWER, drawable};
use crate::model::{Model, display, endpoint};
use crate::widgets::theme;

/// The sign of a material that is marked, after its name.
const MARK: &str = " *";

/// What was read and drawn of the rows in sight.
#[derive(Debug, Default)]
pub struct Drawn {
    pub rows: Vec<ReadCells>,
    pub pictures: Option<Arc<Answered<CellPictures>>>,
}

impl Drawn {
    /// Why there is no material in a cell.
    fn problem(&self, cell: MatrixCell) -> Option<&str> {
        let (_, row) = self.rows.iter().find(|(case, _)| *case == cell.case)?;
        row.cells.get(cell.column)?.as_ref().err().map(String::as_str)
    }
}

impl MatrixTable<'_> {
    pub fn row(&mut self, ui: &mut egui::Ui, places: &Places, row: usize, drawn: &Drawn, next: &mut Model) {
        let Some((case, ahead)) = self.matrix.at(row) else { return };
        let name = drawable(self.matrix.open.name(case));
        let top = places.top(row);
        let line = places.view.with_min_y(top).with_max_y(top + places.cell.y);
        let body = places.body();
        let head = line.with_max_x(body.left() - GAP).intersect(places.view.with_min_y(body.top()));
        let head = ui.interact(head, ui.scope_id().with(("row", case)), Sense::click());
        self.row_head(ui, places, line, case, &head);
        if head.hovered() {
            self.state.hovered = Some(MatrixCell { case, column: 0 });
        }
        if head.clicked() {
            next.dataset.show(case, ahead.clone());
        }
        if head.double_clicked() {
            next.dataset.show_table(false);
        }
        let texts = self.matrix.losses.row(case).map(texts).unwrap_or_default();
        for (place, &column) in self.matrix.columns.iter().enumerate().skip(places.first) {
            let square = line.with_min_x(places.left(place)).with_max_x(places.left(place) + places.cell.x);
            let seen = square.intersect(body);
            if !seen.is_positive() {
                continue;
            }
            let at = MatrixCell { case, column };
            let id = ui.scope_id().with(("cell", case, column));
            let response = ui.interact(seen, id, Sense::click_and_drag());
            let label = format!("Cell {name}, {}", self.matrix.column(column));
            response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, &label));
            let text = column.checked_sub(1).and_then(|method| texts.get(method)).map_or("", String::as_str);
            let painter = ui.painter().with_clip_rect(seen.intersect(ui.clip_rect()));
            let shown = match self.has_pictures {
                true => self.picture(ui, &painter, square, at, drawn),
                false => None,
            };
            self.loss(ui, &painter, square, at, text);
            if self.has_pictures && self.matrix.chosen() == Some(column) && next.dataset.wanted == case {
                let stroke = Stroke::new(2.0, theme::accent(ui.visuals()));
                painter.rect_stroke(square, 0.0, stroke, egui::StrokeKind::Inside);
            }
            if response.hovered() {
                self.state.hovered = Some(at);
            }
            // Whole, however small the cell is.
            let problem = drawn.problem(at).or_else(|| self.matrix.problem(at)).map(drawable);
            let response = problem.into_iter().fold(response, Response::on_hover_text);
            self.gesture(&response, shown, (at, &ahead), next);
        }
    }

    /// The name of a material with its mark; where there is room, what is noted on it and the cause of most of a loss.
    fn row_head(&self, ui: &egui::Ui, places: &Places, line: Rect, case: usize, response: &Response) {
        let (dataset, name) = (&self.matrix.shown.model.dataset, self.matrix.open.name(case));
        let is_shown = dataset.wanted == case;
        response.widget_info(|| {
            WidgetInfo::selected(egui::Role::Button, true, is_shown, format!("Material {name}"))
        });
        let visuals = ui.style().interact_selectable(response, is_shown);
        let painter = ui.painter().with_clip_rect(response.rect.intersect(ui.clip_rect()));
        if is_shown || response.hovered() {
            let line = response.rect.with_max_y(response.rect.bottom().min(line.top() + NUMBER.y));
            painter.rect_filled(line, 3.0, visuals.weak_bg_fill);
        }
        let mark = dataset.mark(name).cloned().unwrap_or_default();
        let text = format!("{}{}", drawable(name), if mark.is_marked { MARK } else { "" });
        let width = places.names - 2.0 * GAP;
        let at = line.min + vec2(3.0, 2.0);
        let font = FontId::proportional(12.5);
        if !self.has_pictures {
            painter.text(at, Align2::LEFT_TOP, text, font, visuals.text_color());
        } else {
            let galley = painter.layout(text, font, visuals.text_color(), width);
            let below = at + vec2(0.0, galley.size().y + 2.0);
            painter.galley(at, galley, visuals.text_color());
            let cause = self.matrix.losses.cause(case).unwrap_or_default();
            let newer = if dataset.newer.contains(&case) { NEWER } else { "" }.to_owned();
            let more = [newer, drawable(&mark.note), cause].into_iter().filter(|text| !text.is_empty());
            let (more, ink) = (more.collect::<Vec<_>>().join("\n"), visuals.text_color());
            painter.galley(below, painter.layout(more, FontId::proportional(11.0), ink, width), ink);
        }
        if self.matrix.losses.row(case).is_some() {
            response.clone().on_hover_ui(|ui| drop(ui.label(self.matrix.lines(case))));
        }
    }

    /// Draws the picture of a cell, or why there is none; where it is, and its size in texels.
    fn picture(
        &mut self,
        ui: &egui::Ui,
        painter: &egui::Painter,
        square: Rect,
        cell: MatrixCell,
        drawn: &Drawn,
    ) -> Option<(Rect, [usize; 2])> {
        if let Some(pictures) = &drawn.pictures
            && let Some(([least, most], size)) = pictures.part(cell)
        {
            let texture = self.textures.id(ui.ctx(), &pictures.atlas.picture, TextureOptions::LINEAR);
            let [width, height] = size.map(|side| side as f32);
            let fitted = vec2(width, height) * (square.width() / width.max(height).max(1.0));
            let at = Rect::from_center_size(square.center(), fitted);
            let part = Rect::from_min_max(pos2(least[0], least[1]), pos2(most[0], most[1]));
            painter.image(texture, at, part, Color32::WHITE);
            return Some((at, size));
        }
        painter.rect_filled(square, 2.0, ui.visuals().faint_bg_color);
        if let Some(problem) = drawn.problem(cell).or_else(|| self.matrix.problem(cell)) {
            let (colour, width) = (theme::problem(ui.visuals()), square.width() - 8.0);
            let galley = painter.layout(drawable(&line(problem)), FontId::proportional(11.0), colour, width);
            painter.galley(square.min + vec2(4.0, 4.0), galley, colour);
        }
        None
    }

    /// Prints the loss of a cell: into the lower left corner of its picture, or above its bar, from one zero to one largest loss.
    fn loss(&self, ui: &egui::Ui, painter: &egui::Painter, square: Rect, cell: MatrixCell, text: &str) {
        let known = self.matrix.loss(cell);
        let is_failed = cell.column > 0 && known.is_none() && self.matrix.losses.row(cell.case).is_some();
        let (text, font) = (if is_failed { "failed" } else { text }, FontId::monospace(11.0));
        if self.has_pictures {
            if text.is_empty() || is_failed {
                return;
            }
            let galley = painter.layout_no_wrap(text.to_owned(), font, Color32::WHITE);
            let at = Align2::LEFT_BOTTOM.anchor_size(square.left_bottom(), galley.size() + vec2(6.0, 2.0));
            painter.rect_filled(at, 0.0, Color32::from_black_alpha(170));
            painter.galley(at.min + vec2(3.0, 1.0), galley, Color32::WHITE);
            return;
        }
        let is_chosen = self.matrix.chosen() == Some(cell.column);
        let ink = match is_chosen {
            _ if is_failed => theme::problem(ui.visuals()),
            true => ui.visuals().strong_text_color(),
            false => ui.visuals().text_color(),
        };
        painter.text(square.left_top() + vec2(0.0, 2.0), Align2::LEFT_TOP, text, font, ink);
        let share = known.map_or(0.0, |known| known.loss / self.matrix.losses.largest.max(f64::MIN_POSITIVE));
        let bar = square.with_min_y(square.bottom() - 4.0);
        let bar = bar.with_max_x(bar.left() + bar.width() * share as f32);
        painter.rect_filled(
            bar,
            0.0,
            theme::series(self.matrix.open.slot(cell.case, cell.column), ui.visuals().dark_mode),
        );
    }

    /// A drag moves light or view in all cells, as in a pane; a click chooses the cell, and a second one opens its row.
    fn gesture(
        &self,
        response: &Response,
        shown: Option<(Rect, [usize; 2])>,
        (cell, ahead): (MatrixCell, &[usize]),
        next: &mut Model,
    ) {
        if response.clicked() {
            next.dataset.show(cell.case, ahead.to_vec());
            if cell.column > 0 && !self.matrix.open.is_of_predictions() {
                next.dataset.method = Some(self.matrix.column(cell.column).to_owned());
                display::choose_slot(next, cell.column);
            }
        }
        if response.double_clicked() {
            return next.dataset.show_table(false);
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
