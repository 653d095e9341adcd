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

/// The words of a name without those of sizes and formats.
pub(super) fn telling_words(name: &str) -> Vec<String> {
    words(name).into_iter().filter(|word| size_of(word).is_none() && !is_format(word)).collect()
}

/// The words of a file name that count, without its extension.
pub(super) fn words_of_file(name: &str) -> Vec<String> {
    telling_words(&Path::new(name).file_stem().unwrap_or_default().to_string_lossy())
}

/// The size in texels that the name of a file tells, by a word such as 2k, 1024 or 512px.
pub(crate) fn size(name: &str) -> Option<u32> {
    let stem = Path::new(name).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    words(&stem).iter().rev().find_map(|word| size_of(word))
}

fn size_of(word: &str) -> Option<u32> {
    let thousands = word.strip_suffix('k').and_then(|number| number.parse::<u32>().ok());
    let texels = word.strip_suffix("px").unwrap_or(word).parse::<u32>().ok();
    // 0000064 is the 64th material.
    let is_side =
        |n: &u32| word.ends_with("px") || (*n >= 64 && n.is_power_of_two() && !word.starts_with('0'));
    thousands.and_then(|number| number.checked_mul(1024)).or(texels.filter(is_side))
}

/// Words such as jpg, 16bit, LOD0, texture and the tile 1001.
fn is_format(word: &str) -> bool {
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let format =
        ["1001", "jpg", "jpeg", "jfif", "png", "exr", "tif", "tiff", "hdr", "texture"].contains(&word);
    format || word.strip_suffix("bit").is_some_and(digits) || word.strip_prefix("lod").is_some_and(digits)
}

/// Whether the name of a file is that of a set and nothing more, as `brick.png` beside `brick_n.png`.
pub(crate) fn is_named_as(name: &str, stem: &[String]) -> bool {
    !stem.is_empty() && words_of_file(name) == stem
}

/// Whether the name of a file begins with that of a set.
pub(crate) fn is_named_within(name: &str, stem: &[String]) -> bool {
    words_of_file(name).starts_with(stem)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_fall_apart_into_lower_case_words() {
        assert_eq!(words("Wall02_NormalGL-2K .x"), ["wall02", "normal", "gl", "2k", "x"]);
        assert_eq!(words("__"), [""; 0]);
    }

    #[test]
    fn sizes_and_formats_are_no_names() {
        assert_eq!(telling_words("rock-2K-JPG_16bit_LOD0_1001_512px_1024_4x"), ["rock", "4x"]);
        assert_eq!(
            ["a_2k.png", "a_1024", "a_64px", "a_1001", "a_3", "0064_a"].map(size),
            [Some(2048), Some(1024), Some(64), None, None, None]
        );
        assert!(is_named_as("brick_2k.png", &["brick".to_owned()]));
    }
}
