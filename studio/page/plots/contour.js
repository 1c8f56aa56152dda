// Lines of equal value over a lattice (marching squares), in units of the lattice.

/** Segments [x0, y0, x1, y1] where `values`, in rows of `columns`, pass `level`. */
export function contour(values, columns, level) {
  const segments = [];
  const rows = values.length / columns;
  for (let y = 0; y + 1 < rows; y++) {
    for (let x = 0; x + 1 < columns; x++) {
      const at = y * columns + x;
      const corners = [values[at], values[at + 1], values[at + columns + 1], values[at + columns]];
      if (!corners.every(Number.isFinite)) continue;
      const crossings = [];
      for (let side = 0; side < 4; side++) {
        const [a, b] = [corners[side], corners[(side + 1) % 4]];
        if (a < level === b < level) continue;
        const t = (level - a) / (b - a);
        crossings.push(
          [
            [x + t, y],
            [x + 1, y + t],
            [x + 1 - t, y + 1],
            [x, y + 1 - t],
          ][side],
        );
      }
      if (crossings.length === 4) {
        // A saddle: the middle says which corners belong together.
        const middle = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
        if (middle < level !== corners[0] < level) crossings.push(crossings.shift());
      }
      for (let n = 0; n + 1 < crossings.length; n += 2) segments.push([...crossings[n], ...crossings[n + 1]]);
    }
  }
  return segments;
}
