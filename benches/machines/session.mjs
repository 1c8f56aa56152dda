// Runs the session's WebAssembly module: node session.mjs MODULE
import { readFileSync, writeSync } from "node:fs";

const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), {
  machine: {
    write: (text, len) => writeSync(1, new Uint8Array(instance.exports.memory.buffer, text, len)),
  },
});
instance.exports.session();
