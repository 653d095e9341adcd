//! Table of a data set: its matrix, with pictures of all cells in the place of the panes, or with losses alone beside the panes.

use std::sync::Arc;

use eframe::egui::scroll_area::ScrollSource;
use eframe::egui::{
    self, Align2, Color32, FontId, PointerButton, Rect, Response, RichText, Sense, Stroke, TextureOptions,
    WidgetInfo, pos2, vec2,
};
use egui_material_icons::icons;

use svbrdf_core::material::Grid;
use svbrdf_core::model::scene::Endpoint;
use svbrdf_core::text::line;

use crate::dataset::matrix::{Matrix, texts};
use crate::dataset::pictures::{self, CellPictures, DrawCells, MatrixCell, ReadCells, ReadRow};
use crate::dataset::summary;
use crate::jobs::Shown;
use crate::jobs::answers::Answered;
use crate::model::dataset::DatasetState;
use crate::model::dataset::list::{ListFilter, ListOrder};
use crate::model::material::loaded::drawable;
use crate::model::{Model, display, endpoint};
use crate::widgets::names::{Names, fitted};
use crate::widgets::numbers::digits;
use crate::widgets::paint::{PanelTextures, colour_bar};
use crate::widgets::{named, theme};

/// The sign of a material that is marked, after its name.
const MARK: &str = " *";
/// Size of a cell without a picture, least width of the names of materials, and their width beside pictures, in points.
const NUMBER: egui::Vec2 = vec2(58.0, 21.0);
const NAMES: f32 = 84.0;
const WIDE_NAMES: f32 = 132.0;
/// Least and greatest side of a picture that is fitted to the window, in points.
const LEAST: f32 = 110.0;
const MOST: f32 = 184.0;
/// Height of a line of a head, and gap between cells, in points.
const LINE: f32 = 16.0;
const GAP: f32 = 4.0;
/// The change of the size of a cell by a step of the wheel, per point of its motion.
const WHEEL: f32 = 0.004;

/// The width of a table of losses for this many methods, in points.
pub fn width(methods: usize) -> f32 {
    NAMES + 26.0 + (NUMBER.x + GAP) * methods as f32
}

/// What was read and drawn of the rows in sight.
#[derive(Default)]
struct Drawn {
    rows: Vec<ReadCells>,
    pictures: Option<Arc<Answered<CellPictures>>>,
}

impl Drawn {
    /// Why there is no material in a cell.
    fn problem(&self, cell: MatrixCell) -> Option<&str> {
        let (_, row) = self.rows.iter().find(|(case, _)| *case == cell.case)?;
        row.get(cell.column)?.as_ref().err().map(String::as_str)
    }
}

/// Where rows and columns are, in points.
#[derive(Clone, Copy, Debug)]
struct Places {
    /// What is in sight, and the corner of the whole table, which is scrolled.
    view: Rect,
    origin: egui::Pos2,
    cell: egui::Vec2,
    /// Height of the heads of the columns, and width of those of the rows. Both stay in sight.
    head: f32,
    names: f32,
    /// The first column: without pictures the ground truth has nothing to tell.
    first: usize,
}

impl Places {
    fn left(&self, column: usize) -> f32 {
        self.origin.x + self.names + (column - self.first) as f32 * (self.cell.x + GAP)
    }

    fn top(&self, row: usize) -> f32 {
        self.origin.y + self.head + row as f32 * (self.cell.y + GAP)
    }

    /// The part of the view without heads.
    fn body(&self) -> Rect {
        Rect::from_min_max(self.view.min + vec2(self.names, self.head), self.view.max)
    }
}

/// The table between frames.
#[derive(Debug, Default)]
pub struct DatasetUi {
    /// How far it is scrolled without and with pictures, in points.
    pub(super) offsets: [egui::Vec2; 2],
    /// How far it is to be scrolled in the next frame.
    pub(super) scrolled: Option<egui::Vec2>,
    /// The cell under the pointer in the last frame.
    pub(super) hovered: Option<MatrixCell>,
    /// The material that it has scrolled to, and whether with pictures.
    pub(super) scrolled_to: Option<(usize, bool)>,
}

/// The table, in place of the panes where it has pictures, or beside them.
#[derive(Debug)]
pub struct MatrixTable<'a> {
    pub matrix: &'a Matrix<'a>,
    pub state: &'a mut DatasetUi,
    pub textures: &'a mut PanelTextures,
    pub has_pictures: bool,
}

impl MatrixTable<'_> {
    pub fn ui(&mut self, ui: &mut egui::Ui, next: &mut Model) {
        self.controls(ui, &mut next.dataset);
        egui::Panel::bottom("material card").resizable(false).frame(egui::Frame::NONE).show(ui, |ui| {
            self.card(ui, &mut next.dataset);
        });
        if self.matrix.rows.is_empty() {
            ui.weak(format!("No {} is like this.", self.matrix.open.noun()));
        } else {
            self.table(ui, next);
        }
    }

    fn controls(&self, ui: &mut egui::Ui, next: &mut DatasetState) {
        ui.horizontal_wrapped(|ui| {
            let pictures = ui.selectable_label(self.has_pictures, "Pictures");
            let hover = "All materials under the present light, in the place of the panes (S)";
            if pictures.on_hover_text(hover).clicked() {
                next.show_table(!self.has_pictures);
            }
            let filters = egui::ComboBox::from_id_salt("filter").selected_text(next.list.filter.name());
            let filters = filters.width(70.0).show_ui(ui, |ui| {
                let has_floors = self.matrix.open.settings.diagnose;
                for filter in
                    ListFilter::ALL.into_iter().filter(|one| has_floors || *one != ListFilter::NotResolvable)
                {
                    ui.selectable_value(&mut next.list.filter, filter, filter.name());
                }
            });
            named(&filters.response, "Materials that are listed");
            let search = egui::TextEdit::singleline(&mut next.list.search).hint_text("Search");
            let search = ui.add(search.desired_width((ui.available_width() - 12.0).clamp(60.0, 180.0)));
            if std::mem::take(&mut next.finds) {
                search.request_focus();
            }
            search.widget_info(|| WidgetInfo::labeled(egui::Role::TextInput, true, "Search materials"));
            let counts = RichText::new(self.matrix.counts()).small().weak();
            ui.add(egui::Label::new(counts).extend());
        });
    }

    /// What a person has noted on the material in the window, and what is to be known of the results folder.
    fn card(&self, ui: &mut egui::Ui, next: &mut DatasetState) {
        let (dataset, open) = (&self.matrix.shown.model.dataset, self.matrix.open);
        let name = open.name(dataset.wanted);
        let mark = dataset.mark(name).cloned().unwrap_or_default();
        ui.separator();
        for note in &self.matrix.losses.notes {
            let label = egui::Label::new(RichText::new(note).small().color(ui.visuals().warn_fg_color));
            ui.add(label.truncate()).on_hover_text(note);
        }
        ui.horizontal(|ui| {
            let star = ui.selectable_label(mark.is_marked, icons::ICON_STAR.codepoint);
            star.widget_info(|| {
                WidgetInfo::selected(egui::Role::Button, true, mark.is_marked, "Mark this material")
            });
            let hover = match open.is_of_predictions() {
                true => "Pin this prediction: it stays beside the others (K)",
                false => "Mark this material (K)",
            };
            if star.on_hover_text(hover).clicked() {
                next.toggle_mark();
            }
            let mut note = mark.note.clone();
            let hint = format!("Note on {}", drawable(name));
            let field = egui::TextEdit::singleline(&mut note).hint_text(hint).desired_width(f32::INFINITY);
            let field = ui.add(field);
            field.widget_info(|| WidgetInfo::labeled(egui::Role::TextInput, true, "Note on this material"));
            if note != mark.note {
                next.change_mark(|mark| mark.note = note);
            }
        });
    }

    fn table(&mut self, ui: &mut egui::Ui, next: &mut Model) {
        let (rows, methods) = (self.matrix.rows.len(), self.matrix.open.methods().len());
        let area = ui.available_rect_before_wrap();
        let fitting = (area.width() - WIDE_NAMES - 12.0) / (methods + 1) as f32 - GAP;
        let cell = self.matrix.shown.model.dataset.table.cell;
        let cell = cell.unwrap_or(fitting.clamp(LEAST, MOST));
        let places = match self.has_pictures {
            true => Places {
                view: area,
                origin: area.min,
                cell: vec2(cell, cell),
                head: 3.0 * LINE + 4.0,
                names: WIDE_NAMES,
                first: 0,
            },
            false => {
                let numbers = (NUMBER.x + GAP) * methods as f32 + 10.0;
                let names = (area.width() - numbers).max(NAMES);
                Places { view: area, origin: area.min, cell: NUMBER, head: 2.0 * LINE + 4.0, names, first: 1 }
            }
        };
        let size = vec2(places.left(methods + 1), places.top(rows)) - area.min.to_vec2();
        let is_over = ui.input(|i| i.pointer.hover_pos().is_some_and(|at| places.body().contains(at)));
        let zooms = self.has_pictures && is_over;
        let mut scroll = egui::ScrollArea::both().id_salt(self.has_pictures).auto_shrink([false, false]);
        if zooms {
            // Over the pictures the wheel sizes them.
            scroll = scroll.scroll_source(ScrollSource { mouse_wheel: false, ..ScrollSource::default() });
        }
        if let Some(offset) = self.state.scrolled.take().or_else(|| self.offset(&places)) {
            scroll = scroll.scroll_offset(offset);
        }
        let out = scroll.show_viewport(ui, |ui, viewport| {
            ui.set_min_size(size);
            let origin = ui.min_rect().min;
            let places = Places { view: viewport.translate(origin.to_vec2()), origin, ..places };
            self.contents(ui, &places, next);
            if zooms {
                self.wheel(ui, &places, next);
            }
        });
        self.state.offsets[usize::from(self.has_pictures)] = out.state.clamped_offset();
    }

    /// Where the table is scrolled to, so that the material in the window is in sight when it changes; `None` where it is.
    fn offset(&mut self, places: &Places) -> Option<egui::Vec2> {
        let wanted = self.matrix.shown.model.dataset.wanted;
        let now = Some((wanted, self.has_pictures));
        if std::mem::replace(&mut self.state.scrolled_to, now) == now {
            return None;
        }
        let offset = self.state.offsets[usize::from(self.has_pictures)];
        let top = self.matrix.row(wanted)? as f32 * (places.cell.y + GAP);
        let room = places.body().height() - places.cell.y;
        let is_in_sight = top >= offset.y && top <= offset.y + room;
        (!is_in_sight).then(|| vec2(offset.x, (top - 0.5 * room).max(0.0)))
    }

    fn contents(&mut self, ui: &mut egui::Ui, places: &Places, next: &mut Model) {
        let step = places.cell.y + GAP;
        let (first, rows) = (places.top(0), self.matrix.rows.len());
        let row = |y: f32| (((y - first) / step).floor().max(0.0) as usize).min(rows);
        let range = row(places.body().top())..(row(places.body().bottom()) + 1).min(rows);
        let cases = self.matrix.rows.get(range.clone()).unwrap_or_default();
        let dataset = &self.matrix.shown.model.dataset;
        dataset.in_sight.set(&[&[dataset.wanted], cases].concat());
        let drawn = if self.has_pictures { self.drawn(ui, places, cases) } else { Drawn::default() };
        for row in range {
            self.row(ui, places, row, &drawn, next);
        }
        self.heads(ui, places, next);
    }

    /// What is drawn of these rows, which are asked for from the first on.
    fn drawn(&self, ui: &egui::Ui, places: &Places, cases: &[usize]) -> Drawn {
        let Shown { model, jobs } = self.matrix.shown;
        let pixels = (places.cell.x * ui.pixels_per_point()).round() as usize;
        let read = |case: &usize| {
            let row = ReadRow::of(self.matrix.open, *case, pixels, model.dataset.version(*case));
            Some((*case, jobs.answers.get(&row).ready()?))
        };
        let rows: Vec<ReadCells> = cases.iter().filter_map(read).collect();
        let pictures = jobs.answers.drawn(&DrawCells::of(rows.clone(), &model.view));
        Drawn { rows, pictures: pictures.map(|(pictures, _)| pictures) }
    }

    /// The heads of the columns: the table of methods. A click sorts by the losses of one.
    fn heads(&self, ui: &egui::Ui, places: &Places, next: &mut Model) {
        let corner = Rect::from_min_size(places.view.min, vec2(places.names, places.head));
        self.corner(ui, corner, next);
        let report = summary::drawn(self.matrix.shown);
        let methods: Vec<&str> = self.matrix.open.methods().iter().map(String::as_str).collect();
        let names = Names::new(&methods);
        let fonts = (FontId::proportional(12.5), FontId::monospace(11.0));
        let heads = corner.with_min_x(corner.right()).with_max_x(places.view.right());
        for column in places.first..=methods.len() {
            let room = corner.with_min_x(places.left(column)).with_max_x(places.left(column) + places.cell.x);
            let seen = room.intersect(heads);
            let painter = ui.painter().with_clip_rect(seen.intersect(ui.clip_rect()));
            let paint = |number: usize, text: &str, font: &FontId, ink| {
                let at = room.min + vec2(0.0, (number as f32 + 0.5) * LINE);
                painter.text(at, Align2::LEFT_CENTER, text, font.clone(), ink);
            };
            let Some(method) = column.checked_sub(1) else {
                paint(0, "GROUND TRUTH", &fonts.0, theme::ground_truth(ui.visuals()));
                continue;
            };
            let is_chosen = self.matrix.chosen() == Some(column);
            let ink = if is_chosen { ui.visuals().strong_text_color() } else { ui.visuals().text_color() };
            let title = |most| format!("{column}  {}", drawable(&names.shortened(method, most)));
            let name = fitted(ui, &fonts.0, places.cell.x, title).unwrap_or_else(|| title(4));
            paint(0, &name, &fonts.0, ink);
            let arrow = arrow(next, ListOrder::Loss(method));
            let found = report.as_ref().and_then(|all| {
                let place = all.methods.iter().position(|one| one.method == methods[method])?;
                all.methods.get(place).filter(|one| one.mean.is_finite()).map(|one| (place + 1, one))
            });
            let mean = found.map_or_else(String::new, |(_, one)| digits(one.mean));
            let mut told = format!("{mean}{arrow}");
            let mut hover =
                format!("{}\nThe largest losses of this method first; again: the least", methods[method]);
            if let Some((place, one)) = found {
                let interval = one.interval95_materials.map(|ends| ends.map(digits));
                let over =
                    interval.map_or("few materials".to_owned(), |[low, high]| format!("[{low}, {high}]"));
                let rank = if one.compared { format!("rank {place}") } else { "unranked".to_owned() };
                let count = format!("{} of {} materials", one.materials, one.materials + one.failures);
                hover = format!("{hover}\nmean {mean}, 95% over materials: {over}; {rank}, {count}");
                told = if self.has_pictures { format!("{mean}  {rank}{arrow}") } else { told };
                paint(2, &over, &fonts.1, ui.visuals().weak_text_color());
            }
            paint(1, &told, &fonts.1, ui.visuals().text_color());
            let line = room.with_min_y(room.bottom() - 3.0).with_max_y(room.bottom() - 1.0);
            if !self.matrix.open.is_of_predictions() {
                painter.rect_filled(line, 0.0, theme::series(column, ui.visuals().dark_mode));
            }
            let response = ui.interact(seen, ui.scope_id().with(("head", method)), Sense::click());
            let name = format!("Sort by {}: {told}", methods[method]);
            response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, &name));
            if response.on_hover_text(hover).clicked() {
                next.dataset.list.sort_by(ListOrder::Loss(method));
            }
        }
    }

    /// What sorts by names, and by the disagreement of methods; below it the colours of differences.
    fn corner(&self, ui: &egui::Ui, corner: Rect, next: &mut Model) {
        let several = self.matrix.open.methods().len() > 1;
        let orders = [
            (ListOrder::Name, "Name", "By name; again: the other way round"),
            (
                ListOrder::Disagreement,
                "Disagreement",
                "The largest difference of two methods first; again: the least",
            ),
        ];
        for (number, (order, name, hover)) in orders.into_iter().take(1 + usize::from(several)).enumerate() {
            let top = corner.top() + number as f32 * LINE;
            let room = corner.with_min_y(top).with_max_y(top + LINE);
            let response = ui.interact(room, ui.scope_id().with(("head", name)), Sense::click());
            response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, format!("Sort by {name}")));
            let is_sorted = next.dataset.list.order == order;
            let ink =
                if is_sorted { ui.visuals().strong_text_color() } else { ui.visuals().weak_text_color() };
            let text = format!("{name}{}", arrow(next, order));
            ui.painter().text(room.left_center(), Align2::LEFT_CENTER, text, FontId::monospace(11.0), ink);
            if response.on_hover_text(hover).clicked() {
                next.dataset.list.sort_by(order);
            }
        }
        if self.has_pictures {
            self.legend(ui, corner.with_min_y(corner.bottom() - LINE));
        }
    }

    /// The colours of differences, which all cells share, between the numbers of both ends.
    fn legend(&self, ui: &egui::Ui, area: Rect) {
        let shown = self.matrix.shown;
        let (display, range) = (&shown.model.view.display, pictures::latest(shown).and_then(|one| one.range));
        let Some(range) = range.filter(|_| display.difference) else { return };
        let (kind, _) = display.differences.pointwise(display.quantity);
        let least = if kind.is_signed() { -1.0 } else { 0.0 };
        let (font, ink) = (FontId::monospace(10.0), ui.visuals().text_color());
        let middle = area.center().y;
        let text = |value: f64| digits(value).replace('-', "\u{2212}");
        let low = pos2(area.left(), middle);
        let low = ui.painter().text(low, Align2::LEFT_CENTER, text(least * range), font.clone(), ink);
        let high = pos2(area.right() - 2.0 * GAP, middle);
        let high = ui.painter().text(high, Align2::RIGHT_CENTER, text(range), font, ink);
        let bar =
            Rect::from_min_max(pos2(low.right() + 3.0, middle - 4.0), pos2(high.left() - 3.0, middle + 4.0));
        ui.painter().add(colour_bar(bar, [least as f32, 1.0], kind.is_signed()));
    }

    fn row(&mut self, ui: &mut egui::Ui, places: &Places, row: usize, drawn: &Drawn, next: &mut Model) {
        let Some((case, ahead)) = self.matrix.at(row) else { return };
        let (methods, name) = (self.matrix.open.methods().len(), drawable(self.matrix.open.name(case)));
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
        for column in places.first..=methods {
            let square = line.with_min_x(places.left(column)).with_max_x(places.left(column) + places.cell.x);
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
            let more = [drawable(&mark.note), cause].into_iter().filter(|text| !text.is_empty());
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
        painter.rect_filled(bar, 0.0, theme::series(self.matrix.slot(cell), ui.visuals().dark_mode));
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

    /// The wheel over the pictures changes their size about the pointer, with Shift the height of the light. Beyond the largest size the
    /// row under the pointer becomes the panes.
    fn wheel(&mut self, ui: &egui::Ui, places: &Places, next: &mut Model) {
        let (delta, modifiers, pointer) =
            ui.input(|i| (i.smooth_scroll_delta, i.modifiers, i.pointer.hover_pos()));
        let turned = delta.x + delta.y;
        let (factor, Some(pointer)) = ((turned * WHEEL).exp(), pointer) else { return };
        if turned != 0.0 && modifiers.shift_only() {
            endpoint::scale_height(&mut next.view.scene, Endpoint::Light, f64::from(factor));
        } else if turned != 0.0 && modifiers.is_none() {
            let from = pointer - places.origin - vec2(places.names, places.head);
            let row = (from.y / (places.cell.y + GAP)).max(0.0) as usize;
            let cell = next.dataset.set_cell(places.cell.x * factor);
            if cell == places.cell.x
                && factor > 1.0
                && let Some((case, ahead)) = self.matrix.at(row)
            {
                next.dataset.show(case, ahead);
                return next.dataset.show_table(false);
            }
            let grown = (cell + GAP) / (places.cell.x + GAP);
            let offset = places.view.min - places.origin + from * (grown - 1.0);
            self.state.scrolled = Some(offset.max(egui::Vec2::ZERO));
        }
    }
}

/// The direction of an order that the rows have, after its name.
fn arrow(model: &Model, order: ListOrder) -> &'static str {
    let list = &model.dataset.list;
    match (list.order == order, list.is_reversed) {
        (false, _) => "",
        (true, false) => " \u{2193}",
        (true, true) => " \u{2191}",
    }
}
