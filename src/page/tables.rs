//! Tables of reports as HTML: those that the command line prints, with fewer digits.

use svbrdf_evaluate::report::{self, Cell};

use super::markup::{escaped, number, percent};

/// A table.
pub(super) struct HtmlTable {
    /// As HTML; an empty one is above a column of pictures.
    headings: Vec<String>,
    /// The cells of each row with their tags, the first of which is the heading of the row.
    rows: Vec<Vec<String>>,
}

impl HtmlTable {
    /// A table of `headings` as text.
    pub(super) fn new<'a>(
        headings: impl IntoIterator<Item = &'a str>,
        rows: impl IntoIterator<Item = Vec<String>>,
    ) -> Self {
        Self { headings: headings.into_iter().map(escaped).collect(), rows: rows.into_iter().collect() }
    }

    /// A table of a report for people without its standard errors: the page has intervals and bars. `class` is that of the headings of
    /// rows. Where the table `sorts`, cells have the numbers that they are sorted by.
    pub(super) fn of(table: report::Table, class: &str, sorts: bool) -> Self {
        let has = |column: usize| table.columns[column] != "+- std. error";
        let html = |(column, value): (usize, &Cell)| match column {
            0 => row_heading(class, &escaped(&value.text())),
            _ => cell(value, sorts),
        };
        let row =
            |row: &Vec<Cell>| row.iter().enumerate().filter(|(column, _)| has(*column)).map(html).collect();
        let rows = table.rows.iter().map(row).collect();
        let headings = table.columns.iter().enumerate().filter(|(column, _)| has(*column));
        Self { headings: headings.map(|(_, name)| escaped(name)).collect(), rows }
    }

    /// The same table with headings as the page writes titles: `- best` is `− best`, and the first letter is a capital.
    pub(super) fn titled(mut self) -> Self {
        self.headings.iter_mut().for_each(|name| *name = title(name));
        self
    }

    /// Puts a column of HTML before that at `place`.
    pub(super) fn insert(&mut self, place: usize, name: &str, cells: impl IntoIterator<Item = String>) {
        self.headings.insert(place, title(name));
        for (row, cell) in self.rows.iter_mut().zip(cells) {
            row.insert(place, format!("<td>{cell}</td>"));
        }
    }

    pub(super) fn html(&self) -> String {
        let heading = |text: &String| match text.as_str() {
            "" => "<td></td>".to_owned(),
            text => format!(r#"<th scope="col">{text}</th>"#),
        };
        let headings: String = self.headings.iter().map(heading).collect();
        let rows: String = self.rows.iter().map(|row| format!("<tr>{}</tr>", row.concat())).collect();
        format!(
            r#"<div class="wide"><table><thead><tr>{headings}</tr></thead><tbody>{rows}</tbody></table></div>"#
        )
    }
}

fn title(name: &str) -> String {
    let name = name.strip_prefix("- ").map_or(name.to_owned(), |name| format!("\u{2212}\u{a0}{name}"));
    let mut rest = name.chars();
    let first = rest.next().map(|first| first.to_uppercase().to_string());
    first.unwrap_or_default() + rest.as_str()
}

/// The heading of a row; `html` is its content.
pub(super) fn row_heading(class: &str, html: &str) -> String {
    let class = if class.is_empty() { String::new() } else { format!(r#" class="{class}""#) };
    format!(r#"<th scope="row"{class}>{html}</th>"#)
}

/// The cell of a value, which may be sorted by its number.
pub(super) fn cell(value: &Cell, sorts: bool) -> String {
    let (key, text) = match value {
        Cell::Text(_) | Cell::Truth(_) => return format!("<td>{}</td>", escaped(&value.text())),
        Cell::Number(value) if value.is_finite() => (value.to_string(), number(*value)),
        Cell::Share(share) => (share.to_string(), percent(*share)),
        Cell::Interval(_, [low, high]) => (low.to_string(), format!("{} to {}", number(*low), number(*high))),
        Cell::Integer(count) => (count.to_string(), count.to_string()),
        Cell::Missing("-") => (String::new(), "&ndash;".to_owned()),
        other => (String::new(), escaped(&other.text())),
    };
    if sorts { format!(r#"<td data-sort="{key}">{text}</td>"#) } else { format!("<td>{text}</td>") }
}
