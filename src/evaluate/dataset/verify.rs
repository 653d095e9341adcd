//! A table that was written, against the one that is computed now.

use std::fmt;

/// Where a table differs from the one that is computed now.
#[derive(Clone, Debug, PartialEq)]
pub struct TableDifference {
    /// From 1.
    pub line: usize,
    pub written: String,
    pub computed: String,
    /// Whether it is a digest of files.
    pub is_of_files: bool,
    /// Of a number, how far both are from each other as a share; infinite for others.
    pub share: f64,
}

/// As a sentence.
impl fmt::Display for TableDifference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, written, computed, .. } = self;
        match self.is_of_files {
            true => write!(f, "line {line}: other files: {written} in the table, {computed} now"),
            false => write!(f, "line {line}: {written} in the table, {computed} computed"),
        }
    }
}

/// The differences of the text of a table from what is computed now, but for the version of the program, line by line: those of files first.
pub fn differences(written: &str, computed: &str) -> Vec<TableDifference> {
    let [written, computed] = [written, computed].map(|text| text.lines().collect::<Vec<_>>());
    let lines = written.len().max(computed.len());
    let of = |index: usize| {
        let [a, b] = [&written, &computed].map(|lines| lines.get(index).copied().unwrap_or("nothing"));
        let [a, b] = [without_pictures(a), without_pictures(b)];
        if a == b { Vec::new() } else { in_line(index + 1, &a, &b) }
    };
    let mut all: Vec<TableDifference> = (0..lines).flat_map(of).collect();
    all.sort_by_key(|one| (!one.is_of_files, one.line));
    all
}

/// Pictures of a page are rendered again, and compared by nothing.
fn without_pictures(line: &str) -> String {
    let mut parts = line.split("data:image");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| text + part.split_once('"').map_or("", |(_, rest)| rest))
}

/// What differs in a line: its numbers and words one by one, where both have as many.
fn in_line(line: usize, written: &str, computed: &str) -> Vec<TableDifference> {
    let [a, b] = [written, computed].map(words);
    let is_number = |word: &str| word.contains('.') && word.chars().all(|c| c.is_ascii_digit() || c == '.');
    // Behind it may stand a commit.
    let version = |word: &str| is_number(word.split('+').next().unwrap_or_default());
    let is_version = |index: usize| {
        let follows = |words: &[&str]| index > 0 && words[index - 1] == "svbrdf" && version(words[index]);
        follows(&a) && follows(&b)
    };
    let whole = |written: &str, computed: &str, share| TableDifference {
        line,
        written: written.trim().to_owned(),
        computed: computed.trim().to_owned(),
        is_of_files: computed.contains("sha256") || is_digest(computed),
        share,
    };
    if a.len() != b.len() {
        return vec![whole(written, computed, f64::INFINITY)];
    }
    let others = (0..a.len()).filter(|&index| a[index] != b[index] && !is_version(index));
    let one = |index: usize| {
        let name = if computed.contains("sha256") || is_digest(b[index]) { written } else { a[index] };
        let now = if name == written { computed } else { b[index] };
        whole(name, now, share(a[index], b[index]))
    };
    others.map(one).collect()
}

fn words(line: &str) -> Vec<&str> {
    line.split(|c: char| c.is_whitespace() || ",;:()[]{}&<>\"=|$".contains(c))
        .filter(|w| !w.is_empty())
        .collect()
}

/// Whether this is the digest of files.
fn is_digest(word: &str) -> bool {
    let word = word.trim_matches(|c: char| !c.is_alphanumeric());
    word.len() == 16
        && word.chars().all(|c| c.is_ascii_hexdigit())
        && !word.chars().all(|c| c.is_ascii_digit())
}

fn share(written: &str, computed: &str) -> f64 {
    match (written.parse::<f64>(), computed.parse::<f64>()) {
        (Ok(a), Ok(b)) => (a - b).abs() / a.abs().max(b.abs()),
        _ => f64::INFINITY,
    }
}

/// The command that repeats the ranking of a table, as a shell takes it: of LaTeX, JSON, CSV or a page.
pub fn command(written: &str) -> Option<String> {
    let json = || {
        let value: serde_json::Value = serde_json::from_str(written).ok()?;
        Some(value.pointer("/repetition/command")?.as_str()?.to_owned())
    };
    let after = |begin: &str, end: &str| {
        let (_, rest) = written.split_once(begin)?;
        let (_, rest) = rest.split_once(": ").filter(|_| end == "\n").unwrap_or(("", rest));
        Some(rest.split_once(end).map_or(rest, |(command, _)| command).to_owned())
    };
    let of_page = || {
        let html = after("Repeat with <code>", "</code>")?;
        let text = html.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"");
        Some(text.replace("&#39;", "'").replace("&#x27;", "'").replace("&amp;", "&"))
    };
    let of_csv = || {
        let mut rows = csv::Reader::from_reader(written.as_bytes());
        let column = rows.headers().ok()?.iter().position(|title| title == "repeat_with")?;
        Some(rows.records().next()?.ok()?.get(column)?.to_owned())
    };
    json().or_else(of_page).or_else(of_csv).or_else(|| after("repeat with svbrdf ", "\n"))
}

/// The words of a command as a shell reads them: blanks separate them, outside of single quotes.
pub fn shell_words(command: &str) -> Vec<String> {
    let (mut words, mut word, mut quoted, mut escaped) = (Vec::new(), String::new(), false, false);
    for c in command.chars() {
        match c {
            _ if escaped => {
                word.push(c);
                escaped = false;
            }
            '\'' => quoted = !quoted,
            '\\' if !quoted => escaped = true,
            ' ' if !quoted => words.extend((!word.is_empty()).then(|| std::mem::take(&mut word))),
            c => word.push(c),
        }
    }
    words.extend((!word.is_empty()).then_some(word));
    words
}

/// The words of a command without the readings and registrations that the table `written` says were decided by its materials, which decide
/// again.
pub fn without_decisions(words: Vec<String>, written: &str) -> Vec<String> {
    let (mut kept, mut words) = (Vec::new(), words.into_iter());
    while let Some(word) = words.next() {
        let value = if ["--read", "--register"].contains(&&*word) { words.next() } else { None };
        let left = value.as_ref().map(|value| open(value, written));
        kept.extend((left.as_deref() != Some("")).then_some(word));
        kept.extend(left.filter(|left| !left.is_empty()));
    }
    kept
}

/// What of `WHOSE:OPTION,...` or `METHOD:WAY` was not decided by materials; empty where that is nothing.
fn open(value: &str, written: &str) -> String {
    let Some((whose, options)) = value.split_once(':') else { return value.to_owned() };
    let name = if whose == "gt" { "ground truths" } else { whose };
    if written.contains(&format!("{name}: {options} of ground truths of ")) {
        return String::new();
    }
    let is_open = |option: &&str| !written.contains(&format!("{name}: {option} for all: "));
    let left: Vec<&str> = options.split(',').filter(is_open).collect();
    if left.is_empty() { String::new() } else { format!("{whose}:{}", left.join(",")) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Repetition;
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt as _, SeedableRng as _};

    const TABLE: &str = "\
% means over the 12 materials that all 2 compared methods have
% sha256 0123456789abcdef ground truth, m0
% sha256 fedcba9876543210 ours, m0
% repeat with svbrdf 0.2.0: svbrdf rank --dataset gt ours 'their s' --near 16 --distant 8
\\caption{Rendering loss over 12 materials: convention printed, epsilon 0.01, 16 near-field and 8 distant scenes each, seed 0.}
ours & \\textbf{0.0258} & [0.0211, 0.0301] & 0.0222 & 12 \\\\
theirs & 0.1098 & [0.0877, 0.1321] & 0.0940 & 12 \\\\
";

    #[test]
    fn each_of_a_thousand_altered_digits_files_and_options_is_named() {
        let mut generator = ChaCha8Rng::seed_from_u64(7);
        let places: Vec<usize> =
            TABLE.char_indices().filter(|(_, c)| c.is_ascii_hexdigit()).map(|(at, _)| at).collect();
        for _ in 0..1000 {
            let at = places[generator.random_range(0..places.len())];
            let old = TABLE[at..].chars().next().unwrap();
            let new = if old == '7' { '8' } else { '7' };
            let altered = format!("{}{new}{}", &TABLE[..at], &TABLE[at + 1..]);
            let found = differences(&altered, TABLE);
            let line = TABLE[..at].matches('\n').count() + 1;
            let is_version = TABLE[..at].ends_with("svbrdf 0.2.")
                || TABLE[..at].ends_with("svbrdf 0.")
                || TABLE[..at].ends_with("with svbrdf ");
            let lines: Vec<usize> = found.iter().map(|one| one.line).collect();
            assert_eq!(lines, if is_version { vec![] } else { vec![line] }, "{altered}");
            assert!(is_version || found[0].is_of_files == (line == 2 || line == 3), "{found:?}");
        }
        assert_eq!(differences(TABLE, TABLE), []);
    }

    #[test]
    fn the_commit_of_a_build_is_told_and_is_no_difference() {
        let built = |commit| Repetition::new("svbrdf rank --dataset gt ours".to_owned()).at(commit);
        let line = |commit| format!("% {}\n", built(commit));
        let [with, other] = ["0123456789abcdef", "fedcba9876543210"].map(|commit| line(Some(commit)));
        let without = line(None);
        assert!(
            with.starts_with("% repeat with svbrdf ") && with.contains("+0123456789ab: svbrdf rank"),
            "{with}"
        );
        assert_eq!(with.replace("+0123456789ab", ""), without);
        for table in [&other, &without] {
            assert_eq!([differences(&with, table), differences(table, &with)], [vec![], vec![]]);
            assert_eq!(command(&with), command(table));
        }
        assert_eq!(differences(&with, &without.replace(" gt ", " g ")).len(), 1, "a planted fault");
    }

    #[test]
    fn the_command_of_every_format_is_found() {
        let expected = "svbrdf rank --dataset gt ours 'their s' --near 16 --distant 8";
        let json = serde_json::json!({"repetition": {"software": "svbrdf 0.2.0", "command": expected}});
        let page = format!("<p>Repeat with <code>{}</code></p>", expected.replace('\'', "&#39;"));
        let csv = format!("material,repeat_with\nm0,{expected}\n");
        for text in [TABLE, &json.to_string(), &page, &csv] {
            assert_eq!(command(text).as_deref(), Some(expected), "{text}");
        }
        let decided = "ours: centre-crop of ground truths of 8 x 8\nours: albedo=srgb for all: 3\nground truths: albedo=linear for all: 3";
        let typed = "rank --read gt:albedo=linear --read ours:albedo=srgb,normal-y=up --register ours:centre-crop --register b:crop=1,2 --near 1";
        let left = without_decisions(shell_words(typed), decided);
        assert_eq!(left.join(" "), "rank --read ours:normal-y=up --register b:crop=1,2 --near 1");
        assert_eq!(without_decisions(shell_words(typed), "").join(" "), typed);
        assert_eq!(command("a picture"), None);
        assert_eq!(shell_words(expected)[5], "their s");
    }
}
