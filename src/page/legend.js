// The legend of differences: the colours of their range.

/** @param {Figure} figure @param {(id: string) => HTMLElement} element */
function addLegend(figure, element) {
  const [root, ticks] = [element("legend"), element("ticks")];
  const bar = /** @type {HTMLCanvasElement} */ (element("bar"));
  let painted = "";
  figure.watchers.push(() => {
    root.hidden = figure.panes().every((pane) => !pane.difference);
    const { signed, range, unit: formula } = figure.kind();
    const { quantity } = figure.state;
    const context = bar.getContext("2d");
    if (root.hidden || painted === quantity || !context) return;
    painted = quantity;
    const low = signed ? -range : 0;
    const texts = [low, (low + range) / 2, range].map(digits);
    ticks.replaceChildren(...texts.map((text) => Object.assign(document.createElement("span"), { textContent: text })));
    element("formula").textContent = formula;
    const colours = figure.data.colours[signed ? "diverging" : "heat"];
    const { width, height } = bar;
    colours.forEach((colour, i) => {
      context.fillStyle = colour;
      context.fillRect(Math.floor(i * width / colours.length), 0, Math.ceil(width / colours.length), height);
    });
  });
}
