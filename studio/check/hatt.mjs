// A material in the form of the Penn Haptic Texture Toolkit, made up: four corners and a centre, models of order 2.

const VERTICES = [[0, 0], [200, 0], [200, 4], [0, 4], [80, 1.5]];
const TRIANGLES = [[1, 2, 5], [2, 3, 5], [3, 4, 5], [4, 1, 5]];

const list = (name, values) => `<${name}>\n${values.map((value) => `<value>${value}</value>\n`).join("")}</${name}>\n`;

function model([speed, force], n) {
  // Line spectral frequencies, and the polynomial that they stand for.
  const lsf = [0.7 + 0.1 * n, 1.6 + 0.1 * n];
  const [first, second] = lsf.map(Math.cos);
  return `<model>\n<modNum>${n + 1}</modNum>${list("ARcoeff", [1, -(first + second), 1 - first + second])}${list("ARlsf", lsf)}`
    + `${list("MAcoeff", [1])}${list("MAlsf", [])}<var>${speed && force ? 0.01 : 0}</var>\n<gain>1</gain>\n`
    + `<speedMod>${speed}</speedMod>\n<forceMod>${force}</forceMod>\n</model>\n`;
}

export function hattXml(name) {
  return `<?xml version="1.0" encoding="utf-8"?>\n<modelSet texture="0">\n<material>${name}</material>\n`
    + "<AccelUnits>m/s^2</AccelUnits>\n<SpeedUnits>mm/s</SpeedUnits>\n<ForceUnits>N</ForceUnits>\n<SampleRate>1000</SampleRate>\n"
    + `<mu>0.4</mu>\n<numMod>${VERTICES.length}</numMod>\n<numTri>${TRIANGLES.length}</numTri>\n<maxSpeed>200</maxSpeed>\n<maxForce>4</maxForce>\n`
    + list("speedList", VERTICES.map(([speed]) => speed)) + list("forceList", VERTICES.map(([, force]) => force))
    + TRIANGLES.map((triangle) => list("tri", triangle)).join("") + "<numARCoeff>2</numARCoeff>\n<numMACoeff>0</numMACoeff>\n"
    + VERTICES.map(model).join("") + "</modelSet>\n";
}
