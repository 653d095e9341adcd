// What lies over the panes: titles, readouts, the handles of light and view, the line of the wipe.

/** @param {string} name @param {HTMLElement} parent */
function child(name, parent) {
  const element = document.createElement("div");
  element.className = name;
  parent.append(element);
  return element;
}

/** A number in four digits. @param {number} x */
function digits(x) {
  if (!Number.isFinite(x)) return "not finite";
  const size = Math.abs(x);
  if (size === 0) return "0";
  return size >= 1e5 || size > 0 && size < 1e-4 ? x.toExponential(2) : x.toFixed(size >= 100 ? 1 : size >= 10 ? 2 : size >= 1 ? 3 : 4);
}

class Overlay {
  /** @param {Figure} figure @param {HTMLElement} root */
  constructor(figure, root) {
    this.figure = figure;
    this.root = root;
    /** @type {Seen | null} */
    this.seen = null;
    figure.watchers.push(() => this.update());
  }

  update() {
    const { figure, root } = this;
    const boxes = figure.boxes();
    while (root.children.length > boxes.length) root.lastChild?.remove();
    boxes.forEach((box, i) => {
      const pane = /** @type {HTMLElement} */ (root.children[i] ?? child("pane", root));
      if (!pane.firstChild) ["line", "handle view", "handle light", "title", "readout"].forEach((name) => child(name, pane));
      Object.assign(pane.style, { left: `${box.x}px`, top: `${box.y}px`, width: `${box.width}px`, height: `${box.height}px` });
      const [line, view, light, title, readout] = /** @type {HTMLElement[]} */ ([...pane.children]);
      line.hidden = box.pane.wipe === null;
      line.style.left = `${100 * (box.pane.wipe ?? 0)}%`;
      this.handle(light, "light", box);
      this.handle(view, "view", box);
      title.textContent = this.title(box.pane);
      readout.textContent = this.seen ? this.readout(box.pane, this.seen) : "";
    });
  }

  /** @param {HTMLElement} handle @param {Endpoint} which @param {{width: number, height: number}} box */
  handle(handle, which, { width, height }) {
    const { state } = this.figure;
    const hidden = state.quantity !== "rendering" || which === "view" && state.projection === "perspective";
    const [x, y] = overPlane(state.scene, which);
    const at = hidden ? null : ndcFromPoint(this.figure.camera(width, height), [x, y, 0]);
    handle.hidden = at === null;
    if (at) Object.assign(handle.style, { left: `${50 * (at[0] + 1)}%`, top: `${50 * (1 - at[1])}%` });
  }

  /** @param {Pane} pane */
  title(pane) {
    const { state, data: { convention, drawn } } = this.figure;
    return `${this.content(pane)}${state.quantity === "rendering" && drawn !== convention ? `, drawn as ${drawn}` : ""}`;
  }

  /** @param {Pane} pane */
  content(pane) {
    const { material, difference, wipe } = pane;
    const { materials, state, data } = this.figure;
    const name = materials[material].name;
    if (wipe !== null) return `${materials[0].name} | ${name}${difference ? `, ${this.figure.kind().name}` : ""}`;
    if (difference) return `${name}, ${this.figure.kind().name}`;
    const stops = this.figure.offset(pane);
    const brighter = stops === 0 ? "" : `, ${stops > 0 ? "+" : "\u2212"}${Math.abs(stops)} EV`;
    if (material === 0 && materials.length > 1 && data.groundTruth) return `${name} (ground truth)`;
    return `${name}${brighter}${state.quantity === "rendering" ? "" : `, ${state.quantity}`}`;
  }

  /** @param {Pane} pane @param {Seen} seen */
  readout({ material, difference }, seen) {
    const value = this.figure.value(material, seen);
    const numbers = (this.figure.state.quantity === "roughness" ? value.slice(0, 1) : value).map(digits).join("  ");
    const off = difference ? `\n${this.figure.kind().unit} = ${digits(this.figure.difference(material, seen))}` : "";
    return `(${seen.texel.join(", ")})  ${numbers}${off}`;
  }

  /** The texel whose numbers are shown. @param {Seen | null} seen */
  hover(seen) {
    if (JSON.stringify(seen) === JSON.stringify(this.seen)) return;
    this.seen = seen;
    requestAnimationFrame(() => this.update());
  }
}
