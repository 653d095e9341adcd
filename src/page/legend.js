// The legend of differences: colours, their range, a histogram and the statistics of each prediction.

/** Milliseconds without a change after which the histogram is computed. */
const PAUSE = 120;
const BINS = 64;

/** @param {string} heading @param {string[]} texts @param {string} element */
function tableRow(heading, texts, element) {
  const row = document.createElement("tr");
  const cell = (/** @type {string} */ name, /** @type {string} */ text) => Object.assign(document.createElement(name), { textContent: text });
  const first = Object.assign(cell("th", heading), { className: "name", scope: element === "td" ? "row" : "col" });
  row.append(first, ...texts.map((text) => cell(element, text)));
  return row;
}

class Legend {
  /** @param {Figure} figure @param {(id: string) => HTMLElement} element */
  constructor(figure, element) {
    this.figure = figure;
    this.root = element("legend");
    this.bar = /** @type {HTMLCanvasElement} */ (element("bar"));
    this.ticks = element("ticks");
    this.statistics = element("statistics");
    this.range = /** @type {HTMLInputElement} */ (element("range"));
    this.timer = 0;
    this.key = "";
    figure.watchers.push(() => this.update());
    this.range.addEventListener("change", () => {
      const range = Number(this.range.value);
      if (range > 0 && Number.isFinite(range)) this.setRange(range);
      else this.range.value = String(this.kindRange());
    });
    element("auto").addEventListener("click", () => this.setRange(this.automatic()));
  }

  kindRange() {
    return this.figure.state.ranges[this.figure.kind().key];
  }

  /** @param {number} range */
  setRange(range) {
    this.figure.state.ranges[this.figure.kind().key] = range;
    this.figure.changed();
  }

  /** The predictions whose differences are shown. */
  predictions() {
    return this.figure.panes().filter((pane) => pane.difference).map((pane) => pane.material);
  }

  /** The 99th percentile of the absolute differences of the prediction where it is largest. */
  automatic() {
    const percentile = this.predictions().map((material) => {
      const sorted = this.figure.sortedDifferences(material).map(Math.abs).sort();
      return sorted[Math.min(Math.floor(0.99 * sorted.length), sorted.length - 1)];
    });
    return Math.max(...percentile) || this.figure.kind().range;
  }

  update() {
    const { figure } = this;
    this.root.hidden = this.predictions().length === 0;
    if (this.root.hidden) return;
    const { signed, unit: formula } = figure.kind();
    const range = this.kindRange();
    if (document.activeElement !== this.range) this.range.value = String(Number(range.toPrecision(4)));
    const low = signed ? -range : 0;
    const ticks = [low, (low + range) / 2, range].map(digits);
    if (this.ticks.textContent !== ticks.join("")) {
      this.ticks.replaceChildren(...ticks.map((text) => Object.assign(document.createElement("span"), { textContent: text })));
    }
    const key = JSON.stringify([figure.how(), figure.kind().key, this.predictions(), range]);
    if (key === this.key) return;
    this.key = key;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.measure(low, range, formula, signed), PAUSE);
  }

  /** @param {number} low @param {number} range @param {string} formula @param {boolean} signed */
  measure(low, range, formula, signed) {
    const { figure } = this;
    const all = this.predictions().map((material) => ({ name: figure.materials[material].name, sorted: figure.sortedDifferences(material) }));
    const counts = new Array(BINS).fill(0);
    for (const { sorted } of all) {
      for (const x of sorted) counts[clamp(Math.floor(BINS * (x - low) / (range - low)), 0, BINS - 1)]++;
    }
    this.paint(counts, figure.data.colours[signed ? "diverging" : "heat"]);
    const rows = all.map(({ name, sorted }) => {
      const mean = sorted.reduce((sum, x) => sum + x, 0) / sorted.length;
      const at = (/** @type {number} */ share) => sorted[Math.floor(share * (sorted.length - 1))];
      return tableRow(name, [mean, at(0.5), at(0.95), at(1)].map(digits), "td");
    });
    this.statistics.replaceChildren(tableRow(formula, ["mean", "median", "95%", "largest"], "th"), ...rows);
  }

  /** @param {number[]} counts @param {string[]} colours */
  paint(counts, colours) {
    const context = this.bar.getContext("2d");
    if (!context) return;
    const { width, height } = this.bar;
    const strip = 12;
    context.fillStyle = "#24262a";
    context.fillRect(0, 0, width, height);
    const most = Math.max(...counts, 1);
    context.fillStyle = "#c9ced6";
    counts.forEach((count, i) => {
      const h = Math.sqrt(count / most) * (height - strip - 1);
      context.fillRect(i * width / BINS, height - strip - h, width / BINS - 0.5, h);
    });
    colours.forEach((colour, i) => {
      context.fillStyle = colour;
      context.fillRect(Math.floor(i * width / colours.length), height - strip, Math.ceil(width / colours.length), strip);
    });
  }
}
