//! Places of the rows and columns of the table, and what all files that draw it share.

use eframe::egui::{self, Rect, vec2};

use crate::dataset::matrix::Matrix;
use crate::dataset::pictures::{MatrixCell, ReadCells};
use crate::widgets::paint::PanelTextures;

/// Size of a cell without a picture, least width of the names of materials, and their width beside pictures, in points.
pub const NUMBER: egui::Vec2 = vec2(58.0, 21.0);
pub const NAMES: f32 = 84.0;
pub const WIDE_NAMES: f32 = 132.0;
/// Height of a line of a head, and gap between cells, in points.
pub const LINE: f32 = 16.0;
pub const GAP: f32 = 4.0;

/// Where rows and columns are, in points.
#[derive(Clone, Copy, Debug)]
pub struct Places {
    /// What is in sight, and the corner of the whole table, which is scrolled.
    pub view: Rect,
    pub origin: egui::Pos2,
    pub cell: egui::Vec2,
    /// Height of the heads of the columns, and width of those of the rows. Both stay in sight.
    pub head: f32,
    pub names: f32,
    /// The first column: without pictures the ground truth has nothing to tell.
    pub first: usize,
}

impl Places {
    pub fn left(&self, column: usize) -> f32 {
        self.origin.x + self.names + (column - self.first) as f32 * (self.cell.x + GAP)
    }

    pub fn top(&self, row: usize) -> f32 {
        self.origin.y + self.head + row as f32 * (self.cell.y + GAP)
    }

    /// The part of the view without heads.
    pub fn body(&self) -> Rect {
        Rect::from_min_max(self.view.min + vec2(self.names, self.head), self.view.max)
    }
}

/// The table between frames.
#[derive(Debug, Default)]
pub struct DatasetUi {
    /// How far it is scrolled without and with pictures, in points.
    pub offsets: [egui::Vec2; 2],
    /// How far it is to be scrolled in the next frame.
    pub scrolled: Option<egui::Vec2>,
    /// The cell under the pointer in the last frame.
    pub hovered: Option<MatrixCell>,
    /// What was read of the rows with pictures of the last frame.
    pub rows: Vec<ReadCells>,
    /// The material that it has scrolled to, and whether with pictures.
    pub scrolled_to: Option<(usize, bool)>,
}

/// The table, in place of the panes where it has pictures, or beside them.
#[derive(Debug)]
pub struct MatrixTable<'a> {
    pub matrix: &'a Matrix<'a>,
    pub state: &'a mut DatasetUi,
    pub textures: &'a mut PanelTextures,
    pub has_pictures: bool,
}
