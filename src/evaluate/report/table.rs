//! Tables: typed cells for CSV and data frames, and aligned columns for people.

use std::borrow::Borrow;
use std::fmt;

use super::heading::position;
use svbrdf_core::text::line;
use svbrdf_files::Error;

/// A value of a [`Table`].
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// No value, and what people read in its place.
    Missing(&'static str),
    Text(String),
    Integer(u64),
    Number(f64),
    /// A number of 32 bits, which has fewer digits.
    Single(f32),
    Truth(bool),
    /// A part of a whole, which people read in percent.
    Share(f64),
    /// A number, of which people read this many digits behind the point.
    Digits(usize, f64),
    /// An exposure in stops.
    Stops(f64),
    /// Its ends, of which people read this many digits behind the point.
    Interval(usize, [f64; 2]),
    /// A position or direction.
    Point([f64; 3]),
}

/// The cell for programs: every digit.
impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing(_) => Ok(()),
            Self::Text(text) => text.fmt(f),
            Self::Integer(number) => number.fmt(f),
            Self::Number(number) | Self::Share(number) | Self::Digits(_, number) | Self::Stops(number) => {
                number.fmt(f)
            }
            Self::Single(number) => number.fmt(f),
            Self::Truth(truth) => truth.fmt(f),
            Self::Interval(..) | Self::Point(_) => f.write_str(&self.text()),
        }
    }
}

impl Cell {
    /// The cell for people.
    pub fn text(&self) -> String {
        match self {
            Self::Missing(text) => (*text).to_owned(),
            Self::Number(number) => format!("{number:.6}"),
            Self::Share(share) => format!("{:.1}%", 100.0 * share),
            Self::Digits(digits, number) => format!("{number:.digits$}"),
            Self::Stops(stops) => format!("{stops:+.2}"),
            Self::Interval(digits, [low, high]) => format!("{low:.digits$} to {high:.digits$}"),
            Self::Point(point) => position(*point),
            cell => cell.to_string(),
        }
    }

    /// A value, or what people read in its place.
    pub fn or(value: Option<impl Into<Self>>, missing: &'static str) -> Self {
        value.map_or(Self::Missing(missing), Into::into)
    }

    /// The cells of `count` columns: the ends of an interval, or the coordinates of a point.
    fn parts(self, count: usize) -> Vec<Self> {
        match self {
            Self::Missing(_) => vec![self; count],
            Self::Interval(_, ends) => ends.map(Self::Number).into(),
            Self::Point(point) => point.map(Self::Number).into(),
            cell => vec![cell],
        }
    }

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
    [f64; 2], ends => Self::Interval(6, ends);
    [f64; 3], point => Self::Point(point);
}

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        Self::or(value, "")
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

/// A column of a report, declared once: its name for programs (CSV and data frames), its title for people (text, window and pages), and
/// its value in a row. An interval or a point has names for its parts, separated by blanks. Where a name or title is empty, the column is
/// for the others alone; a blank is a title without words.
pub type Field<R> = (&'static str, &'static str, fn(&R) -> Cell);

/// Who reads a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reader {
    Program,
    Person,
}

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

    /// The table of `rows`, each of which has a value in every one of `fields`, for a `reader`.
    pub fn fields<R>(
        fields: &[Field<R>],
        rows: impl IntoIterator<Item = impl Borrow<R>>,
        reader: Reader,
    ) -> Self {
        let names = |(name, title, _): &Field<R>| match reader {
            Reader::Program => name.split_whitespace().collect::<Vec<_>>(),
            Reader::Person => [*title].into_iter().filter(|title| !title.is_empty()).map(str::trim).collect(),
        };
        let columns: Vec<_> = fields.iter().map(|field| (names(field), field.2)).collect();
        let columns = || columns.iter().filter(|(names, _)| !names.is_empty());
        let cells = |row: &R| {
            let parts = columns().map(|(names, value)| match reader {
                Reader::Program => value(row).parts(names.len()),
                Reader::Person => vec![value(row)],
            });
            parts.flatten().collect()
        };
        let rows = rows.into_iter().map(|row| cells(row.borrow()));
        Self::new(columns().flat_map(|(names, _)| names.iter().copied()), rows)
    }

    /// Lines of aligned columns for people, below the names of the columns.
    pub fn text(&self) -> String {
        let rows = self.rows.iter().map(|row| row.iter().map(Cell::text).collect());
        aligned(&std::iter::once(self.columns.clone()).chain(rows).collect::<Vec<_>>())
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
        let heading = |name: &String| Cell::Text(name.clone()).in_table();
        writer.write_record(self.columns.iter().map(heading)).map_err(internal)?;
        for row in &self.rows {
            writer.write_record(row.iter().map(Cell::in_table)).map_err(internal)?;
        }
        let bytes = writer.into_inner().map_err(|problem| Error::Internal(problem.to_string()))?;
        String::from_utf8(bytes).map_err(|problem| Error::Internal(problem.to_string()))
    }
}

/// Lines of aligned columns, the first to the left, the others to the right. Every cell is a [`line`].
fn aligned(rows: &[Vec<String>]) -> String {
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
    fn a_field_has_names_for_programs_and_a_title_for_people() {
        let fields: [Field<Option<[f64; 2]>>; 3] = [
            ("known", "", |ends| ends.map(|_| f64::NAN).into()),
            ("low high", "95%", |ends| Cell::or(*ends, "unknown")),
            ("", "share", |ends| ends.map_or(Cell::Missing("-"), |[low, _]| Cell::Share(low))),
        ];
        let table = |reader| Table::fields(&fields, [Some([0.25, 1e-9]), None], reader);
        assert_eq!(table(Reader::Program).csv().unwrap(), "known,low,high\nNaN,0.25,0.000000001\n,,\n");
        let text = "95%                   share\n0.250000 to 0.000000  25.0%\nunknown                   -\n";
        assert_eq!(table(Reader::Person).text(), text);
    }

    #[test]
    fn csv_has_a_heading_quotes_names_and_leaves_unknown_values_empty() {
        let row = vec!["a, b".into(), 0.1.into(), Option::<f64>::None.into(), 3_usize.into(), true.into()];
        let table = Table::new(["name", "loss", "error", "scenes", "reached"], [row]);
        assert_eq!(table.csv().unwrap(), "name,loss,error,scenes,reached\n\"a, b\",0.1,,3,true\n");
    }

    #[test]
    fn text_is_no_formula_and_steers_no_terminal() {
        let row = vec!["=cmd()".into(), "@a".into(), "a-b".into(), (-0.5).into(), "\u{1b}[2J".into()];
        let table = Table::new(["=a", "b", "c", "d", "e"], [row]);
        assert_eq!(table.csv().unwrap(), "'=a,b,c,d,e\n'=cmd(),'@a,a-b,-0.5,\\u{1b}[2J\n");
    }

    #[test]
    fn columns_are_as_wide_as_their_widest_cell_and_lines_have_no_blanks_at_their_end() {
        let rows = [["name", "1.5"], ["é", "10.25"], ["x", ""]].map(|row| row.map(str::to_owned).to_vec());
        assert_eq!(aligned(&rows), "name    1.5\né     10.25\nx\n");
    }
}
