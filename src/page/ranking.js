// Tables whose rows a click on a heading sorts.

/** What a row is sorted by: a number, or a text. @param {HTMLTableRowElement} row @param {number} column */
function sortKey(row, column) {
  const cell = row.cells[column];
  const value = cell.dataset.sort;
  if (value === undefined) return cell.textContent ?? "";
  // Cells without a number come last, in either direction.
  return value === "" ? NaN : Number(value);
}

/** @param {string | number} a @param {string | number} b @param {number} sign */
function compareKeys(a, b, sign) {
  if (typeof a === "number" && typeof b === "number") {
    if (Number.isNaN(a) || Number.isNaN(b)) return Number(Number.isNaN(a)) - Number(Number.isNaN(b));
    return sign * (a - b);
  }
  return sign * String(a).localeCompare(String(b), undefined, { numeric: true });
}

/** @param {HTMLTableElement} table */
function makeSortable(table) {
  const body = table.tBodies[0];
  // A column of pictures has nothing to sort by.
  const hasTexts = (/** @type {number} */ column) => [...body.rows].some((row) => row.cells[column].textContent !== "");
  const headings = [...(table.tHead?.rows[0].cells ?? [])].filter((cell) => cell.matches("th") && hasTexts(cell.cellIndex));
  for (const heading of headings) {
    const button = Object.assign(document.createElement("button"), { type: "button" });
    button.append(...heading.childNodes);
    heading.append(button);
    heading.setAttribute("aria-sort", "none");
    button.addEventListener("click", () => {
      const sign = heading.getAttribute("aria-sort") === "ascending" ? -1 : 1;
      for (const other of headings) other.setAttribute("aria-sort", "none");
      heading.setAttribute("aria-sort", sign > 0 ? "ascending" : "descending");
      const rows = [...body.rows].map((row) => ({ row, key: sortKey(row, heading.cellIndex) }));
      rows.sort((a, b) => compareKeys(a.key, b.key, sign));
      body.append(...rows.map(({ row }) => row));
    });
  }
}

document.querySelectorAll("table").forEach(makeSortable);
