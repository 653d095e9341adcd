//! The size of each room in bytes and lines, and the budgets that it is held to (`tests/size.toml`).
//!
//! Bytes are counted, not lines, so that line widths do not matter. Every text file that git tracks counts, in one of three
//! columns: product, tests, or generated.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::{command, root};

/// A file belongs to the longest of these that its path begins with.
const ROOMS: [&str; 17] = [
    "",
    "assets",
    "docs",
    "packaging",
    "python",
    "python/package",
    "python/src",
    "python/tests",
    "shaders",
    "src",
    "src/core",
    "src/evaluate",
    "src/files",
    "src/gpu",
    "src/page",
    "src/viewer",
    "tests",
];

/// Files that a command of `cargo xtask bless` writes, and licences.
const GENERATED: [&str; 6] = [
    "Cargo.lock",
    "LICENSE-APACHE",
    "packaging/THIRD-PARTY",
    "shaders/page.json",
    "tests/fuzz/Cargo.lock",
    ".github/workflows/release.yml",
];

const BUDGETS: &str = "tests/size.toml";

const COLUMNS: [&str; 3] = ["product", "tests", "generated"];

/// Bytes and lines of product, tests and generated files.
type Sizes = [[usize; 2]; 3];

const HEAD: &str = "# The most bytes that a room may have (`cargo xtask size` prints bytes and lines). A change that needs more raises its
# number in a commit of its own that gives the reason; `cargo xtask size --lower` lowers the numbers to today's sizes.
";

pub fn run(arguments: &[String]) -> Result<(), String> {
    let sizes = measure()?;
    match arguments {
        [] => {
            print!("{}", table(&sizes));
            Ok(())
        }
        [option] if option == "--lower" => lower(&sizes),
        _ => Err(help()),
    }
}

pub fn help() -> String {
    "size prints bytes and lines of each room; size --lower lowers the budgets to them\n".into()
}

fn measure() -> Result<BTreeMap<&'static str, Sizes>, String> {
    let listed = command("git")
        .args(["ls-files", "-z"])
        .output()
        .map_err(|problem| format!("git ls-files: {problem}"))?;
    if !listed.status.success() {
        return Err(format!("git ls-files: {}", String::from_utf8_lossy(&listed.stderr)));
    }
    let mut sizes = BTreeMap::new();
    for path in String::from_utf8_lossy(&listed.stdout).split_terminator('\0').filter(|path| *path != BUDGETS)
    {
        let file = root().join(path);
        // Links, pictures, and files that are deleted but not yet committed are passed over.
        let Some(text) = std::fs::read_to_string(&file).ok().filter(|_| !file.is_symlink()) else { continue };
        let room: &mut Sizes = sizes.entry(room(path)).or_default();
        for (column, text) in columns(path, &text) {
            room[column][0] += text.len();
            room[column][1] += text.lines().count();
        }
    }
    Ok(sizes)
}

fn room(path: &str) -> &'static str {
    let holds = |room: &&&str| Path::new(path).starts_with(room);
    ROOMS.iter().filter(holds).max_by_key(|room| room.len()).unwrap_or(&"")
}

/// The parts of a file by column. The unit tests at the end of a file are tests.
fn columns<'a>(path: &str, text: &'a str) -> Vec<(usize, &'a str)> {
    if GENERATED.contains(&path) {
        return vec![(2, text)];
    }
    let tests = path.split('/').any(|part| part == "tests" || part == "tests.rs");
    let units = text.find("\n#[cfg(test)]\nmod tests {").filter(|_| !tests).map_or(text.len(), |end| end + 1);
    let (first, rest) = text.split_at(units);
    vec![(usize::from(tests), first), (1, rest)]
}

fn table(sizes: &BTreeMap<&str, Sizes>) -> String {
    let mut table = format!("{:<16}{:>24}{:>24}{:>24}\n", "bytes and lines", "product", "tests", "generated");
    let mut total = Sizes::default();
    for (room, columns) in sizes {
        row(&mut table, if room.is_empty() { "(root)" } else { room }, columns);
        let all = total.iter_mut().flatten().zip(columns.iter().flatten());
        all.for_each(|(total, size)| *total += size);
    }
    row(&mut table, "total", &total);
    table
}

fn row(table: &mut String, name: &str, columns: &Sizes) {
    let cells: String = columns.iter().map(|[bytes, lines]| format!("{bytes:>14}{lines:>10}")).collect();
    let _ = writeln!(table, "{name:<16}{cells}");
}

fn budgets_file() -> PathBuf {
    root().join(BUDGETS)
}

/// Budgets by column and room. A line of the file is `[column]` or `"room" = bytes`.
fn budgets(text: &str) -> Result<BTreeMap<(String, String), usize>, String> {
    let mut column = String::new();
    let mut budgets = BTreeMap::new();
    for line in text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#')) {
        let wrong = || format!("tests/size.toml: expected [column] or \"room\" = bytes, found {line}");
        if let Some(name) = line.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
            name.clone_into(&mut column);
            continue;
        }
        let (room, bytes) = line.split_once('=').ok_or_else(wrong)?;
        let bytes = bytes.trim().replace('_', "").parse().map_err(|_| wrong())?;
        budgets.insert((column.clone(), room.trim().trim_matches('"').to_owned()), bytes);
    }
    Ok(budgets)
}

/// Bytes by column and room, of those that have any.
fn bytes(sizes: &BTreeMap<&str, Sizes>) -> BTreeMap<(String, String), usize> {
    let of_room = |(room, columns): (&&str, &Sizes)| {
        let name = (*room).to_owned();
        COLUMNS
            .iter()
            .zip(*columns)
            .map(move |(column, [bytes, _])| (((*column).to_owned(), name.clone()), bytes))
            .collect::<Vec<_>>()
    };
    sizes.iter().flat_map(of_room).filter(|(_, bytes)| *bytes > 0).collect()
}

/// The rooms that are larger than their budgets.
fn over(
    sizes: &BTreeMap<(String, String), usize>,
    budgets: &BTreeMap<(String, String), usize>,
) -> Vec<String> {
    let excess = |(key, bytes): (&(String, String), &usize)| {
        let budget = budgets.get(key).copied().unwrap_or(0);
        (*bytes > budget).then(|| format!("{} of {:?}: {bytes} bytes, budget {budget}", key.0, key.1))
    };
    sizes.iter().filter_map(excess).collect()
}

/// Lowers the budgets to today's sizes; a room above its budget keeps it.
fn lower(sizes: &BTreeMap<&str, Sizes>) -> Result<(), String> {
    let now = bytes(sizes);
    let file = budgets_file();
    let text = std::fs::read_to_string(&file).map_err(|problem| format!("{}: {problem}", file.display()))?;
    let old = budgets(&text)?;
    let mut text = HEAD.to_owned();
    for column in COLUMNS {
        let _ = write!(text, "\n[{column}]\n");
        for (key, bytes) in now.iter().filter(|((name, _), _)| name == column) {
            let budget = old.get(key).map_or(*bytes, |old| *bytes.min(old));
            let _ = writeln!(text, "{:?} = {budget}", key.1);
        }
    }
    std::fs::write(&file, text).map_err(|problem| format!("{}: {problem}", file.display()))?;
    let over = over(&now, &old);
    if over.is_empty() {
        Ok(())
    } else {
        Err(format!("above the budgets of tests/size.toml:\n{}", over.join("\n")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_room_is_larger_than_its_budget() {
        let budgets = budgets(&std::fs::read_to_string(budgets_file()).unwrap()).unwrap();
        let over = over(&bytes(&measure().unwrap()), &budgets);
        assert!(
            over.is_empty(),
            "remove code, or raise the number in a commit that gives the reason: {over:#?}"
        );
    }

    #[test]
    fn one_byte_more_is_over_the_budget() {
        let sizes = BTreeMap::from([("src/core", [[100, 4], [30, 2], [0, 0]])]);
        let budgets = |product| {
            budgets(&format!("[product]\n\"src/core\" = {product}\n[tests]\n\"src/core\" = 30\n")).unwrap()
        };
        assert!(over(&bytes(&sizes), &budgets(100)).is_empty());
        assert_eq!(over(&bytes(&sizes), &budgets(99)).len(), 1);
    }

    #[test]
    fn unit_tests_and_generated_files_have_columns_of_their_own() {
        let text = "fn a() {}\n\n#[cfg(test)]\nmod tests {\n}\n";
        assert_eq!(
            columns("src/core/a.rs", text),
            [(0, "fn a() {}\n\n"), (1, "#[cfg(test)]\nmod tests {\n}\n")]
        );
        assert_eq!(columns("python/tests/a.py", "a\n"), [(1, "a\n"), (1, "")]);
        assert_eq!(columns("Cargo.lock", "a\n"), [(2, "a\n")]);
        assert_eq!((room("src/core/lib.rs"), room("src/lib.rs"), room("run")), ("src/core", "src", ""));
    }
}
