// Which part of the endless surface the stage shows. x to the right and y up, mm; pixels from the top left.

const FINEST_PX_MM = 24;
const COARSEST_PX_MM = 1.5;
/** A little larger than life, so that a mouse strokes at 20 to 200 mm/s. */
const USUAL_PX_MM = 5;
/** Longest scale bar, px. */
const LONGEST_BAR_PX = 140;

export class View {
  width_px = 1;
  height_px = 1;
  px_mm = USUAL_PX_MM;
  centre_mm = [0, 0];

  resize(width_px, height_px) {
    this.width_px = Math.max(width_px, 1);
    this.height_px = Math.max(height_px, 1);
  }

  reset() {
    this.px_mm = USUAL_PX_MM;
    this.centre_mm = [0, 0];
  }

  toMm(/** @type {number[]} */ [x_px, y_px]) {
    const [x_mm, y_mm] = this.centre_mm;
    return [x_mm + (x_px - this.width_px / 2) / this.px_mm, y_mm - (y_px - this.height_px / 2) / this.px_mm];
  }

  toPx(/** @type {number[]} */ [x_mm, y_mm]) {
    const [right_mm, up_mm] = [x_mm - this.centre_mm[0], y_mm - this.centre_mm[1]];
    return [this.width_px / 2 + right_mm * this.px_mm, this.height_px / 2 - up_mm * this.px_mm];
  }

  /** Zooms by a factor; what is at `at_px` stays there. */
  zoom(factor, at_px = [this.width_px / 2, this.height_px / 2]) {
    const before = this.toMm(at_px);
    this.px_mm = Math.min(Math.max(this.px_mm * factor, COARSEST_PX_MM), FINEST_PX_MM);
    const after = this.toMm(at_px);
    this.centre_mm = this.centre_mm.map((centre, axis) => centre + before[axis] - after[axis]);
  }

  /** The longest scale bar of 1, 2 or 5 times a power of ten, mm. */
  bar_mm() {
    const longest = LONGEST_BAR_PX / this.px_mm;
    const decade = 10 ** Math.floor(Math.log10(longest));
    return [5, 2, 1].map((n) => n * decade).find((mm) => mm <= longest) ?? decade;
  }
}
