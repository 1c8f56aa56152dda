// Pictures that load while they are seen, a few at once, so that picking a texture need not wait behind them.

const AT_ONCE = 4;
/** What is scrolled past faster than this is not asked for, ms. */
const REST_MS = 80;

export class Thumbnails {
  #waiting = new Map();
  #loading = new Set();

  /** Gives an image its picture as soon as it is its turn; `address` promises where that is. */
  load(image, address) {
    this.#waiting.set(image, { address, timer: setTimeout(() => this.#ready(image), REST_MS) });
  }

  /** The image is not seen any more. */
  drop(image) {
    clearTimeout(this.#waiting.get(image)?.timer);
    this.#waiting.delete(image);
    if (!this.#loading.delete(image)) return;
    // Ends the request.
    image.removeAttribute("src");
    this.#next();
  }

  #ready(image) {
    this.#waiting.get(image).timer = null;
    this.#next();
  }

  #next() {
    for (const [image, { address, timer }] of this.#waiting) {
      if (this.#loading.size >= AT_ONCE) return;
      if (timer !== null) continue;
      this.#waiting.delete(image);
      this.#loading.add(image);
      const end = (state) => () => {
        if (!this.#loading.delete(image)) return;
        if (image.src.startsWith("blob:")) URL.revokeObjectURL(image.src);
        image.dataset.state = state;
        this.#next();
      };
      image.addEventListener("load", end("loaded"), { once: true });
      image.addEventListener("error", end("missing"), { once: true });
      address().then((found) => {
        if (this.#loading.has(image)) image.src = found;
        else if (found.startsWith("blob:")) URL.revokeObjectURL(found);
      }, end("missing"));
    }
  }
}
