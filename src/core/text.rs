//! Numbers as people read them.

use std::ffi::OsStr;

/// A time in two digits or three, as people read it.
pub fn time(seconds: f64) -> String {
    match seconds {
        s if s >= 0.9995 => digits(s, "s"),
        s if s >= 0.9995e-3 => digits(s * 1e3, "ms"),
        s => digits(s * 1e6, "us"),
    }
}

/// A share in percent, in two digits.
pub fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    let decimals = if percent > 0.0 { (1.0 - percent.log10().floor()).clamp(0.0, 9.0) as usize } else { 0 };
    let text = format!("{percent:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    format!("{text}%")
}

/// The problem of a JSON text that does not have the expected form, in words for users.
pub fn of_json(problem: &impl std::fmt::Display) -> String {
    const WORDS: [(&str, &str); 7] = [
        ("expected f64", "expected a number"),
        ("EOF while parsing ", "the text ends within "),
        ("unknown variant ", "unknown value "),
        ("unknown field ", "unknown key "),
        ("missing field ", "no key "),
        ("invalid type: ", "found "),
        ("invalid value: ", "found "),
    ];
    WORDS.iter().fold(problem.to_string(), |text, (code, words)| text.replace(code, words))
}

/// Most characters of a line that has no end of its own, such as a name from a file.
const LONGEST: usize = 2000;

/// The text with every character written as `\u{...}` that steers a terminal, breaks lines other than as `\n`, hides text, or
/// changes the direction of the text after it. For texts of several lines, whose parts from files are each a [`line()`].
pub fn printable(text: &str) -> String {
    escaped(text, |c| c != '\n' && steers(c))
}

/// Whether a character is no visible part of a line.
fn steers(c: char) -> bool {
    let is_direction =
        matches!(c, '\u{200e}' | '\u{200f}' | '\u{61c}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let is_break = matches!(c, '\u{2028}' | '\u{2029}');
    // Invisible copies of ASCII.
    let is_tag = matches!(c, '\u{e0000}'..='\u{e007f}');
    c.is_control() || is_direction || is_break || is_tag
}

fn escaped(text: &str, is_escaped: impl Fn(char) -> bool) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        if is_escaped(c) { escaped.extend(c.escape_unicode()) } else { escaped.push(c) }
    }
    escaped
}

/// An argument of a command as shells read it: in quotes where it has other characters than those of plain names. What steers a
/// terminal, or is no UTF-8, stands there as the numbers of its bytes, which bash, zsh and ksh read in `$'...'`.
pub fn quoted(argument: impl AsRef<OsStr>) -> String {
    let argument = argument.as_ref();
    let is_plain = |c: char| c.is_alphanumeric() || "-_./=:,%+@".contains(c);
    match argument.to_str() {
        Some(text) if !text.is_empty() && text.chars().all(is_plain) => return text.to_owned(),
        Some(text) if !text.contains(steers) => return format!("'{}'", text.replace('\'', r"'\''")),
        _ => {}
    }
    let octal = |bytes: &[u8]| bytes.iter().map(|byte| format!("\\{byte:03o}")).collect::<String>();
    let quoted = |c: char| match c {
        '\'' | '\\' => format!("\\{c}"),
        c if steers(c) => octal(c.to_string().as_bytes()),
        c => c.to_string(),
    };
    let chunks = argument.as_encoded_bytes().utf8_chunks();
    let text = chunks.map(|one| one.valid().chars().map(quoted).collect::<String>() + &octal(one.invalid()));
    format!("$'{}'", text.collect::<String>())
}

/// The text in one line of a readable length, in which nothing steers what follows: for every name from a file. Names of
/// materials are lines from the start.
pub fn line(text: &str) -> String {
    escaped(&shortened(text), steers)
}

/// The text without its middle where it is too long to be read.
pub fn shortened(text: &str) -> String {
    let count = text.chars().count();
    if count <= LONGEST {
        return text.to_owned();
    }
    let half = LONGEST / 2;
    let (start, end) = (text.chars().take(half), text.chars().skip(count - half));
    let left_out = format!(" ... {} characters ... ", count - 2 * half);
    start.chain(left_out.chars()).chain(end).collect()
}

fn digits(value: f64, unit: &str) -> String {
    let text = if value < 9.95 { format!("{value:.1}") } else { format!("{value:.0}") };
    format!("{} {unit}", text.trim_end_matches(".0"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_steers_a_terminal_is_escaped_and_what_is_long_is_shortened() {
        assert_eq!(printable("a\u{1b}[31m\u{202e}b\r\nc\u{9b}"), "a\\u{1b}[31m\\u{202e}b\\u{d}\nc\\u{9b}");
        assert_eq!(printable("Größe 木 \u{1f600}"), "Größe 木 \u{1f600}");
        let long = shortened(&"é".repeat(1_000_000));
        assert!(long.chars().count() < 2100 && long.contains("... 998000 characters ..."), "{long}");
        assert_eq!(shortened("short"), "short");
        assert_eq!(line("two\nlines \u{202e}x"), "two\\u{a}lines \\u{202e}x");
        assert_eq!(printable("a\u{2028}b\u{e0041}\n"), "a\\u{2028}b\\u{e0041}\n");
        assert_eq!(line("a\u{2029}b\u{e007f}\u{85}"), "a\\u{2029}b\\u{e007f}\\u{85}");
    }

    #[test]
    fn problems_of_json_are_in_words_for_users() {
        assert_eq!(of_json(&"missing field `x` at line 1"), "no key `x` at line 1");
        assert_eq!(of_json(&"invalid type: map, expected f64"), "found map, expected a number");
        assert_eq!(of_json(&"EOF while parsing a list"), "the text ends within a list");
    }

    #[test]
    fn times_and_shares_have_a_few_digits() {
        assert_eq!([2.345, 0.012_34, 0.000_999_9, 1.2e-5].map(time), ["2.3 s", "12 ms", "1 ms", "12 us"]);
        assert_eq!(
            [0.1, 0.003, 0.012_34, 0.000_056, 1.5, 0.0].map(percent),
            ["10%", "0.3%", "1.2%", "0.0056%", "150%", "0%"]
        );
    }

    #[test]
    fn an_argument_is_quoted_for_a_shell_and_steers_no_terminal() {
        for (argument, text) in [
            ("gt/wood_1.png", "gt/wood_1.png"),
            ("", "''"),
            ("two words", "'two words'"),
            ("it's", r"'it'\''s'"),
            (r"a\b", r"'a\b'"),
            ("a\u{202e}b", r"$'a\342\200\256b'"),
            ("it's\n\\\u{1b}7", r"$'it\'s\012\\\0337'"),
        ] {
            assert_eq!(quoted(argument), text);
        }
        #[cfg(unix)]
        {
            let bytes: &OsStr = std::os::unix::ffi::OsStrExt::from_bytes(b"a\xff'");
            assert_eq!(quoted(bytes), r"$'a\377\''");
        }
    }
}
