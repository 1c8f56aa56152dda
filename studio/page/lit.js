// The preview, tiled without end: under a lamp, by its normal map, in WebGL 2, or plain.

const VERTEX = `#version 300 es
void main() {
  // One triangle over everything.
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
}`;

const FRAGMENT = `#version 300 es
precision highp float;
uniform sampler2D picture, normals;
uniform vec2 size_px, centre_mm;
uniform float mm_px, tile_mm, reach_mm;
uniform vec3 lamp_mm;
// Where the surface gives way under the hand, and how deep, mm.
uniform vec3 dent_mm;
const float DENT_MM = 9.0, EYE_MM = 40.0;
out vec4 colour;
void main() {
  vec2 at_mm = centre_mm + (gl_FragCoord.xy - 0.5 * size_px) * mm_px;
  // A hollow: z = −d·exp(−r²/R²). What is deeper looks smaller, and less light reaches it.
  vec2 from_dent = at_mm - dent_mm.xy;
  float hollow = dent_mm.z * exp(-dot(from_dent, from_dent) / (DENT_MM * DENT_MM));
  vec2 slope = 2.0 * hollow / (DENT_MM * DENT_MM) * from_dent;
  vec2 seen_mm = dent_mm.xy + from_dent * (1.0 + hollow / EYE_MM);
  // Row 0 of a picture is its top, and normals have green up.
  vec2 at = vec2(seen_mm.x, -seen_mm.y) / tile_mm;
  vec3 base = pow(texture(picture, at).rgb, vec3(2.2)) / (1.0 + 0.15 * hollow);
  vec3 normal = normalize(texture(normals, at).xyz * 2.0 - 1.0);
  normal = normalize(normal - vec3(slope * normal.z, 0.0));
  vec3 way = lamp_mm - vec3(at_mm, 0.0);
  float falloff = 1.0 / (1.0 + dot(way.xy, way.xy) / (reach_mm * reach_mm));
  vec3 to_lamp = normalize(way);
  float diffuse = max(dot(normal, to_lamp), 0.0);
  vec3 between = normalize(to_lamp + vec3(0.0, 0.0, 1.0));
  float shine = pow(max(dot(normal, between), 0.0), 32.0);
  // Dark cloth does not gleam like dark ice would.
  float gleam = 0.01 + 0.15 * dot(base, vec3(0.2126, 0.7152, 0.0722));
  vec3 light = base * (0.3 + 1.05 * diffuse * falloff) + gleam * shine * falloff;
  colour = vec4(pow(min(light, vec3(1.0)), vec3(1.0 / 2.2)), 1.0);
}`;

const UNIFORMS = ["picture", "normals", "size_px", "centre_mm", "mm_px", "tile_mm", "reach_mm", "lamp_mm",
  "dent_mm"];

export class Lit {
  #gl;
  #at = {};
  #textures = [];
  #width_mm = 1;

  /** `null` where the browser has no WebGL 2. */
  static on(canvas) {
    const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, depth: false });
    if (!gl) return null;
    const program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    return gl.getProgramParameter(program, gl.LINK_STATUS) ? new Lit(gl, program) : null;
  }

  constructor(gl, program) {
    this.#gl = gl;
    gl.useProgram(program);
    for (const name of UNIFORMS) this.#at[name] = gl.getUniformLocation(program, name);
    gl.uniform1i(this.#at.picture, 0);
    gl.uniform1i(this.#at.normals, 1);
  }

  setPicture(picture, normals, width_mm) {
    const gl = this.#gl;
    this.#textures.forEach((texture) => gl.deleteTexture(texture));
    this.#textures = [picture, normals].map((image, unit) => {
      const texture = gl.createTexture();
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, image);
      gl.generateMipmap(gl.TEXTURE_2D);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
      return texture;
    });
    this.#width_mm = width_mm;
  }

  /** `lamp_px`: where the lamp hangs over the stage; `dent_mm`: a hollow's place and depth. */
  draw(view, lamp_px, dent_mm) {
    const gl = this.#gl;
    const { width, height } = gl.canvas;
    const [shown_mm, pixel_mm] = [Math.min(view.width_px, view.height_px) / view.px_mm, view.width_px / width / view.px_mm];
    gl.viewport(0, 0, width, height);
    gl.uniform2f(this.#at.size_px, width, height);
    gl.uniform2f(this.#at.centre_mm, ...view.centre_mm);
    gl.uniform1f(this.#at.mm_px, pixel_mm);
    gl.uniform1f(this.#at.tile_mm, this.#width_mm);
    // The lamp looks the same at every zoom.
    gl.uniform1f(this.#at.reach_mm, 0.75 * shown_mm);
    gl.uniform3f(this.#at.lamp_mm, ...view.toMm(lamp_px), 0.4 * shown_mm);
    gl.uniform3f(this.#at.dent_mm, ...dent_mm);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}

/** The preview as a plain tiled picture, for browsers without WebGL 2. */
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
