// The preview as a plain tiled picture, for browsers without WebGL 2.

export class Plain {
  #context;
  #picture = null;
  #width_mm = 1;

  constructor(canvas) {
    this.#context = canvas.getContext("2d", { alpha: false });
  }

  setPicture(picture, _normals, width_mm) {
    this.#picture = picture;
    this.#width_mm = width_mm;
  }

  draw(view) {
    const context = this.#context;
    const { width, height } = context.canvas;
    if (!this.#picture) return;
    const pixels = width / view.width_px;
    const [left, top] = view.toPx([0, 0]).map((px) => px * pixels);
    const scale = (this.#width_mm * view.px_mm * pixels) / this.#picture.width;
    const pattern = context.createPattern(this.#picture, "repeat");
    pattern.setTransform(new DOMMatrix([scale, 0, 0, scale, left, top]));
    context.fillStyle = pattern;
    context.fillRect(0, 0, width, height);
  }
}
