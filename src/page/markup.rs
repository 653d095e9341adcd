//! Names and numbers as HTML: what a file or a user wrote is text, never markup.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use sha2::{Digest as _, Sha256};

use svbrdf_files::disk::atomic::SOFTWARE;

/// The head of every page, with its content security policy.
const FRAME: &str = include_str!("frame.html");

/// Most names of predictions in a line.
pub(super) const MOST_NAMES: usize = 4;

/// A page that needs no other file.
pub(super) struct Document<'a> {
    /// As HTML.
    pub title: &'a str,
    /// For search engines and previews of links, as HTML.
    pub description: &'a str,
    pub style: &'a str,
    /// Empty: none.
    pub script: &'a str,
    /// As HTML.
    pub body: &'a str,
}

impl Document<'_> {
    /// The document as HTML: its policy admits its own script and style, pictures inside the file, and nothing else.
    pub(super) fn html(&self) -> String {
        let script = match self.script {
            "" => String::new(),
            script => format!(r#"<script type="module">{script}</script>"#),
        };
        filled(
            FRAME,
            &[
                ("title", self.title),
                ("description", self.description),
                ("software", SOFTWARE),
                ("script-hash", &policy_source(self.script)),
                ("style-hash", &policy_source(self.style)),
                ("style", self.style),
                ("script", &script),
                ("body", self.body),
            ],
        )
    }

    /// Bytes of the document around its body.
    pub(super) fn bytes_without_body(style: &str, script: &str) -> usize {
        FRAME.len() + style.len() + script.len()
    }
}

/// The text with the characters that HTML reads as markup escaped: for elements and quoted attributes. What steers the direction of
/// text is written as `\u{...}`.
pub fn escaped(text: &str) -> String {
    let mut html = String::with_capacity(text.len());
    for c in svbrdf_core::text::printable(text).chars() {
        match c {
            '&' => html += "&amp;",
            '<' => html += "&lt;",
            '>' => html += "&gt;",
            '"' => html += "&quot;",
            '\'' => html += "&#39;",
            c => html.push(c),
        }
    }
    html
}

/// JSON inside a script element: no `<`, so that nothing in it ends the element or begins a comment.
pub(super) fn embedded(json: &str) -> String {
    json.replace('<', "\\u003c")
}

/// The source expression of a content security policy that admits an inline script or style of this text.
fn policy_source(text: &str) -> String {
    format!("sha256-{}", BASE64_STANDARD.encode(Sha256::digest(text)))
}

/// The template with each `{{key}}` replaced; what is put in is not searched for keys.
pub(super) fn filled(template: &str, values: &[(&str, &str)]) -> String {
    let mut parts = template.split("{{");
    let mut html = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let known = part.split_once("}}").and_then(|(key, rest)| {
            let (_, value) = values.iter().find(|(name, _)| *name == key)?;
            Some((*value, rest))
        });
        match known {
            Some((value, rest)) => html.extend([value, rest]),
            None => html.extend(["{{", part]),
        }
    }
    html
}

/// A number with a typographic minus and four significant digits.
pub(super) fn number(x: f64) -> String {
    let decimals = if x == 0.0 { 3 } else { (3.0 - x.abs().log10().floor()).clamp(0.0, 8.0) as usize };
    format!("{x:.decimals$}").replace('-', "\u{2212}")
}

/// A section; `html` is its content.
pub(super) fn section(title: &str, html: &str) -> String {
    let id = title.split(' ').next().unwrap_or_default().to_lowercase();
    format!(r#"<section aria-labelledby="{id}"><h2 id="{id}">{title}</h2>{html}</section>"#)
}

/// A table of HTML: headings, and rows whose first cells are their headings.
pub(super) fn table(
    headings: impl IntoIterator<Item = String>,
    rows: impl IntoIterator<Item = Vec<String>>,
) -> String {
    let headings: String =
        headings.into_iter().map(|text| format!(r#"<th scope="col">{text}</th>"#)).collect();
    let cell = |(column, html): (usize, String)| match column {
        0 => format!(r#"<th scope="row" class="name">{html}</th>"#),
        _ => format!("<td>{html}</td>"),
    };
    let row = |row: Vec<String>| {
        let cells: String = row.into_iter().enumerate().map(cell).collect();
        format!("<tr>{cells}</tr>\n")
    };
    let rows: String = rows.into_iter().map(row).collect();
    format!(
        r#"<div class="wide"><table><thead><tr>{headings}</tr></thead><tbody>{rows}</tbody></table></div>"#
    )
}

/// A position or direction, on one line, without a negative zero.
pub(super) fn place(p: [f64; 3]) -> String {
    let [x, y, z] = p.map(|c| format!("{:.2}", (100.0 * c).round() / 100.0 + 0.0));
    format!("({x},\u{a0}{y},\u{a0}{z})").replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hostile_names_are_text() {
        let name = "</script><img src=x onerror='alert(1)'>&\"\u{202e}";
        assert_eq!(
            escaped(name),
            "&lt;/script&gt;&lt;img src=x onerror=&#39;alert(1)&#39;&gt;&amp;&quot;\\u{202e}"
        );
        let json = serde_json::to_string(name).unwrap();
        assert!(json.contains('<') && !embedded(&json).contains('<'));
        assert_eq!(serde_json::from_str::<String>(&embedded(&json)).unwrap(), name);
    }

    #[test]
    fn a_text_is_admitted_by_its_digest() {
        // The first test vector of FIPS 180-2.
        let known = "sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=";
        assert_eq!(policy_source("abc"), known);
    }

    #[test]
    fn values_are_not_searched_for_keys() {
        assert_eq!(filled("{{a}}-{{b}}-{{c}}", &[("a", "{{b}}"), ("b", "2")]), "{{b}}-2-{{c}}");
    }

    #[test]
    fn numbers_have_four_digits() {
        assert_eq!(
            [0.0, 0.123_456, -12.345_6, 1234.5].map(number),
            ["0.000", "0.1235", "\u{2212}12.35", "1234"]
        );
        assert_eq!(place([-0.004, 0.5, -1.25]), "(0.00,\u{a0}0.50,\u{a0}\u{2212}1.25)");
    }
}
