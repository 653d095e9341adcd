//! Tables of reports as HTML: the columns that the command line prints, with fewer digits.

use std::borrow::Borrow;

use svbrdf_evaluate::report::{Column, Shown};

use super::markup::{escaped, number, percent};

/// A table.
pub(super) struct Table {
    /// As HTML; an empty one is above a column of pictures.
    headings: Vec<String>,
    /// The cells of each row with their tags, the first of which is the heading of the row.
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table of `headings` as text.
    pub(super) fn new<'a>(
        headings: impl IntoIterator<Item = &'a str>,
        rows: impl IntoIterator<Item = Vec<String>>,
    ) -> Self {
        Self { headings: headings.into_iter().map(escaped).collect(), rows: rows.into_iter().collect() }
    }

    /// The `rows` of a report in `columns`, but those of standard errors: the page has intervals and bars. `class` is that of the headings
    /// of rows. Where the table `sorts`, cells have the numbers that they are sorted by.
    pub(super) fn of<R>(
        columns: &[Column<'_, R, Shown>],
        rows: impl IntoIterator<Item = impl Borrow<R>>,
        class: &str,
        sorts: bool,
    ) -> Self {
        let columns = || columns.iter().filter(|(name, _)| *name != "+- std. error");
        let cells = |row| {
            let mut all = columns().map(|(_, value)| value(Borrow::borrow(&row)));
            let first = all.next().map(|name| row_heading(class, &escaped(&name.to_string())));
            first.into_iter().chain(all.map(|shown| cell(&shown, sorts))).collect()
        };
        let rows: Vec<Vec<String>> = rows.into_iter().map(cells).collect();
        Self { headings: columns().map(|(name, _)| heading(name)).collect(), rows }
    }

    /// Puts a column of HTML before that at `place`.
    pub(super) fn insert(&mut self, place: usize, name: &str, cells: impl IntoIterator<Item = String>) {
        self.headings.insert(place, heading(name));
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

/// The name of a column: `- best` is `− best`, and the first letter is a capital.
fn heading(name: &str) -> String {
    let name = name.strip_prefix("- ").map_or(name.to_owned(), |name| format!("\u{2212}\u{a0}{name}"));
    let mut rest = name.chars();
    let first = rest.next().map(|first| first.to_uppercase().to_string());
    escaped(&(first.unwrap_or_default() + rest.as_str()))
}

/// The heading of a row; `html` is its content.
pub(super) fn row_heading(class: &str, html: &str) -> String {
    let class = if class.is_empty() { String::new() } else { format!(r#" class="{class}""#) };
    format!(r#"<th scope="row"{class}>{html}</th>"#)
}

/// The cell of a value, which may be sorted by its number.
pub(super) fn cell(shown: &Shown, sorts: bool) -> String {
    let (key, text) = match shown {
        Shown::Text(text) => return format!("<td>{}</td>", escaped(text)),
        Shown::Count(count) => (count.to_string(), count.to_string()),
        Shown::Number(value) if value.is_finite() => (value.to_string(), number(*value)),
        Shown::Number(value) => (String::new(), value.to_string()),
        Shown::Share(share) => (share.to_string(), percent(*share)),
        Shown::Interval([low, high]) => (low.to_string(), format!("{} to {}", number(*low), number(*high))),
        Shown::Missing("-") => (String::new(), "&ndash;".to_owned()),
        Shown::Missing(text) => (String::new(), escaped(text)),
    };
    if sorts { format!(r#"<td data-sort="{key}">{text}</td>"#) } else { format!("<td>{text}</td>") }
}
