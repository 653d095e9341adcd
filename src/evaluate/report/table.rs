//! Tables: typed cells for CSV and data frames, and aligned columns for people.

use std::borrow::Borrow;
use std::fmt;

use svbrdf_core::error::Error;
use svbrdf_core::text::line;

/// A value of a [`Table`].
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// An unknown value.
    Empty,
    Text(String),
    Integer(u64),
    Number(f64),
    /// A number of 32 bits, which has fewer digits.
    Single(f32),
    Truth(bool),
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => Ok(()),
            Self::Text(text) => text.fmt(f),
            Self::Integer(number) => number.fmt(f),
            Self::Number(number) => number.fmt(f),
            Self::Single(number) => number.fmt(f),
            Self::Truth(truth) => truth.fmt(f),
        }
    }
}

impl Cell {
    /// Its text in a table. Spreadsheets take text that begins with `= + - @` as a formula: it begins with `'` instead.
    fn in_table(&self) -> String {
        match self {
            Self::Text(text) if text.starts_with(['=', '+', '-', '@', '\t', '\r']) => {
                format!("'{}", line(text))
            }
            Self::Text(text) => line(text),
            number => number.to_string(),
        }
    }
}

macro_rules! cells_of {
    ($($from:ty, $value:ident => $cell:expr;)+) => {
        $(impl From<$from> for Cell {
            fn from($value: $from) -> Self {
                $cell
            }
        })+
    };
}

cells_of! {
    &str, text => Self::Text(text.to_owned());
    String, text => Self::Text(text);
    usize, number => Self::Integer(number as u64);
    u64, number => Self::Integer(number);
    f64, number => Self::Number(number);
    bool, truth => Self::Truth(truth);
}

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

impl Cell {
    /// The lower end of an interval.
    pub fn low(interval: Option<[f64; 2]>) -> Self {
        interval.map(|[low, _]| low).into()
    }

    /// The upper end of an interval.
    pub fn high(interval: Option<[f64; 2]>) -> Self {
        interval.map(|[_, high]| high).into()
    }
}

/// A value of a table for people: text has six decimals, a page fewer digits.
#[derive(Clone, Debug, PartialEq)]
pub enum Shown {
    Text(String),
    Count(usize),
    Number(f64),
    /// A part of a whole, from 0 to 1.
    Share(f64),
    Interval([f64; 2]),
    /// No value, and what stands in its place.
    Missing(&'static str),
}

impl Shown {
    /// An interval, or what stands in its place.
    pub fn interval(interval: Option<[f64; 2]>, missing: &'static str) -> Self {
        interval.filter(|[low, _]| !low.is_nan()).map_or(Self::Missing(missing), Self::Interval)
    }

    /// A number, or what stands in its place.
    pub fn number(number: Option<f64>, missing: &'static str) -> Self {
        number.filter(|number| !number.is_nan()).map_or(Self::Missing(missing), Self::Number)
    }
}

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text(text) => text.fmt(f),
            Self::Count(count) => count.fmt(f),
            Self::Number(number) => write!(f, "{number:.6}"),
            Self::Share(share) => write!(f, "{:.1}%", 100.0 * share),
            Self::Interval([low, high]) => write!(f, "{low:.6} to {high:.6}"),
            Self::Missing(text) => text.fmt(f),
        }
    }
}

/// A column of a table: its name, and its value in a row.
pub type Column<'a, R, V = Cell> = (&'a str, fn(&R) -> V);

/// Rows of values under the names of their columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    pub columns: Vec<String>,
    /// Each has a cell for every column.
    pub rows: Vec<Vec<Cell>>,
}

impl Table {
    /// The table of `rows` under `columns`.
    pub fn new<C: Into<String>>(
        columns: impl IntoIterator<Item = C>,
        rows: impl IntoIterator<Item = Vec<Cell>>,
    ) -> Self {
        Self { columns: columns.into_iter().map(Into::into).collect(), rows: rows.into_iter().collect() }
    }

    /// The table of `rows`, each of which has a value in every one of `columns`.
    pub fn of<R>(columns: &[Column<'_, R>], rows: impl IntoIterator<Item = impl Borrow<R>>) -> Self {
        let cells = |row| columns.iter().map(|(_, value)| value(Borrow::borrow(&row))).collect();
        Self::new(columns.iter().map(|(name, _)| *name), rows.into_iter().map(cells))
    }

    /// The columns of this table, then those of another one of as many rows.
    #[must_use]
    pub fn beside(mut self, other: Self) -> Self {
        self.columns.extend(other.columns);
        self.rows.iter_mut().zip(other.rows).for_each(|(row, cells)| row.extend(cells));
        self
    }

    /// Adds a column with a cell for each row.
    pub fn push(&mut self, column: String, cells: impl IntoIterator<Item = Cell>) {
        self.columns.push(column);
        for (row, cell) in self.rows.iter_mut().zip(cells) {
            row.push(cell);
        }
    }

    /// The table as CSV (RFC 4180) with a heading; an unknown value is an empty cell.
    ///
    /// # Errors
    /// [`Error::Internal`], which a table in memory does not give.
    pub fn csv(&self) -> Result<String, Error> {
        let internal = |problem: csv::Error| Error::Internal(problem.to_string());
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(&self.columns).map_err(internal)?;
        for row in &self.rows {
            writer.write_record(row.iter().map(Cell::in_table)).map_err(internal)?;
        }
        let bytes = writer.into_inner().map_err(|problem| Error::Internal(problem.to_string()))?;
        String::from_utf8(bytes).map_err(|problem| Error::Internal(problem.to_string()))
    }
}

/// The [`aligned`] texts of `rows` in `columns`, below the names of the columns.
pub fn aligned_columns<R, V: fmt::Display>(
    columns: &[Column<'_, R, V>],
    rows: impl IntoIterator<Item = impl Borrow<R>>,
) -> String {
    let titles = columns.iter().map(|(name, _)| (*name).to_owned()).collect();
    let texts = |row| columns.iter().map(|(_, value)| value(Borrow::borrow(&row)).to_string()).collect();
    aligned(&std::iter::once(titles).chain(rows.into_iter().map(texts)).collect::<Vec<_>>())
}

/// Lines of aligned columns, the first to the left, the others to the right. Every cell is a [`line`].
pub fn aligned(rows: &[Vec<String>]) -> String {
    let rows: Vec<Vec<String>> = rows.iter().map(|row| row.iter().map(|cell| line(cell)).collect()).collect();
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |c| {
        rows.iter().filter_map(|row| row.get(c)).map(|cell: &String| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let cell = |(c, cell): (usize, &String)| match c {
        0 => format!("{cell:<w$}", w = widths[0]),
        _ => format!("  {cell:>w$}", w = widths[c]),
    };
    let row =
        |row: &Vec<String>| row.iter().enumerate().map(cell).collect::<String>().trim_end().to_owned() + "\n";
    rows.iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_has_a_heading_quotes_names_and_leaves_unknown_values_empty() {
        let row = vec!["a, b".into(), 0.1.into(), Option::<f64>::None.into(), 3_usize.into(), true.into()];
        let table = Table::new(["name", "loss", "error", "scenes", "reached"], [row]);
        assert_eq!(table.csv().unwrap(), "name,loss,error,scenes,reached\n\"a, b\",0.1,,3,true\n");
    }

    #[test]
    fn text_is_no_formula_and_steers_no_terminal() {
        let row = vec!["=cmd()".into(), "@a".into(), "a-b".into(), (-0.5).into(), "\u{1b}[2J".into()];
        let table = Table::new(["a", "b", "c", "d", "e"], [row]);
        assert_eq!(table.csv().unwrap(), "a,b,c,d,e\n'=cmd(),'@a,a-b,-0.5,\\u{1b}[2J\n");
    }

    #[test]
    fn columns_are_as_wide_as_their_widest_cell_and_lines_have_no_blanks_at_their_end() {
        let rows = [["name", "1.5"], ["é", "10.25"], ["x", ""]].map(|row| row.map(str::to_owned).to_vec());
        assert_eq!(aligned(&rows), "name    1.5\né     10.25\nx\n");
    }
}
