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
    /** @type {[number, number] | null} */
    this.texel = null;
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
      readout.textContent = this.texel ? this.readout(box.pane, this.texel) : "";
    });
  }

  /** @param {HTMLElement} handle @param {Endpoint} which @param {{width: number, height: number}} box */
  handle(handle, which, { width, height }) {
    const { state } = this.figure;
    const [x, y] = overPlane(state.scene, which);
    const { origin, half } = this.figure.camera(width, height);
    handle.hidden = state.quantity !== "rendering";
    Object.assign(handle.style, { left: `${50 * ((x - origin[0]) / half[0] + 1)}%`, top: `${50 * (1 - (y - origin[1]) / half[1])}%` });
  }

  /** @param {Pane} pane */
  title(pane) {
    const { state, data: { convention, drawn } } = this.figure;
    return `${this.content(pane)}${state.quantity === "rendering" && drawn !== convention ? `, drawn as ${drawn}` : ""}`;
  }

  /** @param {Pane} pane */
  content({ material, difference, wipe }) {
    const { materials, state } = this.figure;
    const name = materials[material].name;
    if (wipe !== null) return `${materials[0].name} | ${name}${difference ? `, ${this.figure.kind().name}` : ""}`;
    if (difference) return `${name}, ${this.figure.kind().name}`;
    if (material === 0 && materials.length > 1) return `${name} (ground truth)`;
    return `${name}${state.quantity === "rendering" ? "" : `, ${state.quantity}`}`;
  }

  /** @param {Pane} pane @param {[number, number]} texel */
  readout({ material, difference }, texel) {
    const value = this.figure.value(material, texel);
    const numbers = (this.figure.state.quantity === "roughness" ? value.slice(0, 1) : value).map(digits).join("  ");
    const off = difference ? `\n${this.figure.kind().unit} = ${digits(this.figure.difference(material, texel))}` : "";
    return `(${texel.join(", ")})  ${numbers}${off}`;
  }

  /** The texel whose numbers are shown. @param {[number, number] | null} texel */
  hover(texel) {
    if (String(texel) === String(this.texel)) return;
    this.texel = texel;
    requestAnimationFrame(() => this.update());
  }
}
