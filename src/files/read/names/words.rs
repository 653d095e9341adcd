//! Words of a name, split at separators and capital letters.

use std::path::Path;

/// The words of a name, in lower case: it is split where no letter or digit is, and before a capital letter that
/// follows a small one.
pub(crate) fn words(name: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word = String::new();
    let mut after_small = false;
    for c in name.chars() {
        let border = !c.is_alphanumeric() || (after_small && c.is_uppercase());
        if border && !word.is_empty() {
            words.push(std::mem::take(&mut word));
        }
        if c.is_alphanumeric() {
            word.extend(c.to_lowercase());
        }
        after_small = c.is_lowercase();
    }
    if !word.is_empty() {
        words.push(word);
    }
    words
}

/// Whether the name of a file is that of a set and nothing more, as `brick.png` beside `brick_n.png`.
pub(crate) fn is_named_as(name: &str, stem: &[String]) -> bool {
    let own = Path::new(name).file_stem().unwrap_or_default().to_string_lossy();
    !stem.is_empty() && words(&own) == stem
}

/// Whether the name of a file begins with that of a set.
pub(crate) fn is_named_within(name: &str, stem: &[String]) -> bool {
    let own = Path::new(name).file_stem().unwrap_or_default().to_string_lossy();
    words(&own).starts_with(stem)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_fall_apart_into_lower_case_words() {
        assert_eq!(words("Wall02_NormalGL-2K .x"), ["wall02", "normal", "gl", "2k", "x"]);
        assert_eq!(words("__"), [""; 0]);
    }
}
