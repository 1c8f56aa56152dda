// Making a texture again that the server no longer has: the same requests in the same order give the same bytes.

/** What textures a step needs, and how the server takes it. */
const MAKERS = {
  prompt: ({ prompt, seed }) => [[], (server, _, signal) => server.compile({ prompt, seed }, signal)],
  steps: ({ base, steps }) => [[base], (server, [from], signal) =>
    (Object.keys(steps).length ? server.edit(from, { steps }, signal) : Promise.resolve(from))],
  words: ({ of, words }) => [[of], (server, [from], signal) => server.edit(from, { words }, signal)],
  encode: ({ from }) => [[from], (server, [of], signal) => server.encode(of, signal)],
  blend: ({ a, b, t }) => [[a, b], (server, [from, to], signal) => server.blend(from, to, t, signal)],
  compose: ({ tap, slide, friction }) => [[tap, slide, friction], (server, [taps, slides, rubs], signal) =>
    server.compose({ tap: taps, slide: slides, friction: rubs }, signal)],
};

/** What makes a texture again, as of the loader; `null` where a file would have to be opened. */
export function madeAgain(server, session, texture) {
  const ways = new Map(session.entries.map((entry) => [entry.texture.id, entry.how]));
  const find = (wanted) => {
    const how = ways.get(wanted.id) ?? (wanted.compiled && { kind: "prompt", prompt: wanted.compiled.prompt, seed: wanted.seed });
    const maker = how && MAKERS[how.kind];
    if (!maker) return null;
    const [needed, make] = maker(how);
    const before = needed.map((other) => (other.id === wanted.id ? null : find(other)));
    if (before.includes(null)) return null;
    return async (signal) => {
      const made = [];
      for (const step of before) made.push(await step(signal));
      return make(server, made, signal);
    };
  };
  return find(texture);
}
