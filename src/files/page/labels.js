// The labels of the figure in the language of the page.

/** @type {Map<string, string>} By the English text. */
let labels = new Map();

/** The text in the language of the page; in English where the table lacks it. @param {string} text */
const label = (text) => labels.get(text) ?? text;

/** The attributes that people read. */
const READ = ["title", "aria-label"];

/** Translates the texts and names in an element. @param {Element} root @param {Record<string, string>} table */
function translate(root, table) {
  labels = new Map(Object.entries(table));
  if (labels.size === 0) return;
  const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const node = /** @type {Text} */ (walker.currentNode);
    const text = node.data.trim();
    if (labels.has(text)) node.data = node.data.replace(text, () => label(text));
  }
  for (const element of [root, ...root.querySelectorAll("*")]) {
    for (const name of READ) {
      const text = element.getAttribute(name);
      if (text !== null) element.setAttribute(name, label(text));
    }
  }
}
