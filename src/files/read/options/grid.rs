//! Grids of tiles: the division of a packed image.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use svbrdf_core::error::Error;

/// Columns and rows of equal tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct TileGrid {
    pub columns: usize,
    pub rows: usize,
}

impl TileGrid {
    /// Most columns, and most rows.
    pub const MOST: usize = 64;

    /// The (width, height) of a tile of an image of `size`; `None` where the image does not divide so.
    pub(crate) fn tile(self, size: [usize; 2]) -> Option<[usize; 2]> {
        let Self { columns, rows } = self;
        let [w, h] = size;
        let fits = columns > 0 && rows > 0 && w >= columns && h >= rows && w % columns == 0 && h % rows == 0;
        fits.then(|| [w / columns, h / rows])
    }

    /// (column, row) of the top left corner of tile `number`, counted row by row, of tiles of the given size.
    pub(crate) fn corner(self, number: usize, tile: [usize; 2]) -> [usize; 2] {
        [number % self.columns * tile[0], number / self.columns * tile[1]]
    }

    pub(crate) fn count(self) -> usize {
        self.columns * self.rows
    }
}

impl fmt::Display for TileGrid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} x {}", self.columns, self.rows)
    }
}

impl From<TileGrid> for String {
    /// As on the command line.
    fn from(TileGrid { columns, rows }: TileGrid) -> Self {
        format!("{columns}x{rows}")
    }
}

impl TryFrom<String> for TileGrid {
    type Error = Error;

    fn try_from(text: String) -> Result<Self, Error> {
        text.parse()
    }
}

impl FromStr for TileGrid {
    type Err = Error;

    /// `4x1` has 4 columns and one row.
    fn from_str(text: &str) -> Result<Self, Error> {
        let side = |text: &str| text.trim().parse().ok().filter(|n| (1..=Self::MOST).contains(n));
        let sides = text.split_once('x').and_then(|(w, h)| Some((side(w)?, side(h)?)));
        sides
            .map(|(columns, rows)| Self { columns, rows })
            .ok_or_else(|| Error::unknown_name("grid of tiles", text, "COLUMNSxROWS, such as 4x1 or 2x2"))
    }
}
