// Runs the compiler's module: loads it, says how far that is, then answers one request after another. A request is
// { target, body }, its reply { status, type, bytes }; { failed } is the last word.

const encoder = new TextEncoder();
const decoder = new TextDecoder();
let exports = null;

/** The bytes of the module, counted while they come. */
async function fetched(address) {
  const response = await fetch(address);
  if (!response.ok) throw new Error(`HTTP ${response.status}`);
  const parts = [];
  let bytes = 0;
  const reader = response.body.getReader();
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    parts.push(part.value);
    bytes += part.value.length;
    postMessage({ loaded: bytes });
  }
  return new Blob(parts).arrayBuffer();
}

function reply({ target, body = undefined }) {
  const path = encoder.encode(target);
  const at = exports.reserve(path.length + (body?.byteLength ?? 0));
  // The memory may have grown, and its buffer is another one then.
  const memory = (from, length) => new Uint8Array(exports.memory.buffer, from, length);
  memory(at, path.length).set(path);
  if (body) memory(at + path.length, body.byteLength).set(new Uint8Array(body));
  const status = exports.ask(path.length, body ? 1 : 0);
  const type = decoder.decode(memory(exports.reply_type(), exports.reply_type_length()));
  return { status, type, bytes: memory(exports.reply(), exports.reply_length()).slice().buffer };
}

addEventListener("message", async ({ data }) => {
  try {
    if (data.module) {
      const { instance } = await WebAssembly.instantiate(await fetched(data.module));
      exports = instance.exports;
      // Which makes it read its networks.
      return postMessage({ ready: JSON.parse(decoder.decode(reply({ target: "api/about.json" }).bytes)).version });
    }
    const answer = reply(data);
    postMessage(answer, { transfer: [answer.bytes] });
  } catch (error) {
    postMessage({ failed: String(error) });
  }
});
