//! Tiles of a packed image: their order, and the grid that divides it.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use svbrdf_core::error::Error;

use super::role::Role;

const MOST: usize = 6;

/// The order of the tiles of a packed image, row by row, a letter each: N normal, D diffuse, R roughness, S specular,
/// B base colour, M metallic, I a photo.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Order {
    /// Lower-case letters; zeros behind them.
    letters: [u8; MOST],
}

impl Order {
    /// Deschaintre and most who follow.
    pub const NDRS: Self = Self::of(b"ndrs");
    /// MaterialGAN.
    pub const DNRS: Self = Self::of(b"dnrs");
    /// MaterialGAN without specular.
    pub const DNR: Self = Self::of(b"dnr");
    /// MatFusion.
    pub const DSRN: Self = Self::of(b"dsrn");
    /// The 2 x 2 picture of svbrdf-diff-renderer.
    pub const NDSR: Self = Self::of(b"ndsr");
    /// The strip of svbrdf-evaluation (Gauthier 2025), which has no normals.
    pub const IBRM: Self = Self::of(b"ibrm");

    /// Orders of the tiles of a row or a column, the most common first.
    pub(crate) const ROWS: [Self; 11] = [
        Self::NDRS,
        Self::of(b"ndsr"),
        Self::of(b"nbrm"),
        Self::DNRS,
        Self::of(b"dnsr"),
        // IDArb: albedo, normal, metallic, roughness.
        Self::of(b"bnmr"),
        Self::of(b"bnrm"),
        Self::DSRN,
        Self::of(b"brmn"),
        Self::DNR,
        // Base colour, normal, height, roughness, metallic.
        Self::of(b"bnirm"),
    ];
    pub(crate) const SQUARES: [Self; 2] = [Self::NDSR, Self::DSRN];

    /// A picture that is all diffuse.
    pub const D: Self = Self::of(b"d");

    /// The orders that are known to be in use; any other can be specified as well.
    pub const ALL: [Self; 7] =
        [Self::NDRS, Self::DNRS, Self::DNR, Self::DSRN, Self::NDSR, Self::IBRM, Self::D];

    const fn of(word: &[u8]) -> Self {
        let mut letters = [0; MOST];
        let mut i = 0;
        while i < word.len() {
            letters[i] = word[i];
            i += 1;
        }
        Self { letters }
    }

    pub(crate) fn len(self) -> usize {
        self.roles().count()
    }

    pub(crate) fn roles(self) -> impl Iterator<Item = Role> {
        self.letters.into_iter().map_while(role)
    }
}

fn role(letter: u8) -> Option<Role> {
    Some(match letter {
        b'n' => Role::Normal,
        b'd' => Role::Diffuse,
        b'r' => Role::Roughness,
        b's' => Role::Specular,
        b'b' => Role::Base,
        b'm' => Role::Metallic,
        b'i' => Role::Ignored,
        _ => return None,
    })
}

impl FromStr for Order {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let word = text.to_ascii_lowercase();
        let once = |&letter: &u8| {
            let times = word.bytes().filter(|b| *b == letter).count();
            role(letter).is_some() && (letter == b'i' || times == 1)
        };
        let has = |letter| word.as_bytes().contains(&letter);
        let usable = word.len() <= MOST && word.as_bytes().iter().all(once) && (has(b'r') || word == "d");
        if usable && (has(b'd') || has(b'b')) {
            return Ok(Self::of(word.as_bytes()));
        }
        Err(Error::unknown_name(
            "order of tiles",
            text,
            format!(
                "{}, or other letters, each map once: n normal, d diffuse, r roughness, s specular, b base colour, \
                 m metallic, i photo",
                Self::ALL.map(|order| order.to_string()).join(", ")
            ),
        ))
    }
}

impl fmt::Display for Order {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word: String = self.letters.iter().take_while(|&&b| b != 0).map(|&b| char::from(b)).collect();
        f.pad(&word)
    }
}

impl From<Order> for String {
    fn from(order: Order) -> Self {
        order.to_string()
    }
}

impl TryFrom<String> for Order {
    type Error = Error;

    fn try_from(text: String) -> Result<Self, Error> {
        text.parse()
    }
}

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
