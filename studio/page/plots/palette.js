// The page's colours and font as canvases need them: resolved, whatever notation the page uses.

/** Which property of the probe (`plots.css`) holds which colour. */
const HOLDERS = {
  ink: "color",
  paper: "backgroundColor",
  grid: "borderTopColor",
  accent: "borderRightColor",
  accent_2: "borderBottomColor",
  muted: "borderLeftColor",
};

export class Palette {
  constructor(container, changed) {
    this.probe = container.ownerDocument.createElement("span");
    this.probe.className = "plot-probe";
    container.append(this.probe);
    this.read();
    this.read_again = () => {
      if (this.read()) changed();
    };
    // A theme is an attribute of the document or the system's wish.
    this.attributes = new MutationObserver(this.read_again);
    this.attributes.observe(container.ownerDocument.documentElement, { attributes: true });
    this.queries = ["(prefers-color-scheme: dark)", "(forced-colors: active)", "(prefers-contrast: more)"].map(
      (query) => matchMedia(query),
    );
    for (const query of this.queries) query.addEventListener("change", this.read_again);
  }

  /** Returns whether something changed. */
  read() {
    const style = getComputedStyle(this.probe);
    const found = Object.entries(HOLDERS).map(([name, property]) => [name, style[property]]);
    const version = JSON.stringify([...found, style.fontFamily]);
    if (version === this.version) return false;
    Object.assign(this, Object.fromEntries(found), { version, font: style.fontFamily });
    return true;
  }

  destroy() {
    this.attributes.disconnect();
    for (const query of this.queries) query.removeEventListener("change", this.read_again);
    this.probe.remove();
  }
}
