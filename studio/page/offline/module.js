// The compiler's module behind its worker: started by the first request, and again after it has failed.

import { Events } from "../events.js";
import { texts } from "../texts.js";

export class ModuleFailure extends Error {}

/** Emits "load" with bytes while the module loads, and with null once it is ready or has failed; "fail" when what it made is lost. */
export class Module extends Events {
  #address;
  #version;
  #worker = null;
  /** Those who wait for a reply, in the order of their requests. */
  #waiting = [];
  #started;

  /** `address` is that of the module, `version` that of the page. */
  constructor(address, version) {
    super();
    this.#address = address;
    this.#version = version;
  }

  /** The Response to a request of the page; `body` is an ArrayBuffer for a POST. */
  async ask(target, body) {
    await this.#start();
    return new Promise((resolve, reject) => {
      this.#waiting.push({ resolve, reject });
      this.#worker.postMessage({ target, body });
    });
  }

  #start() {
    if (this.#worker) return this.#started;
    this.#worker = new Worker(new URL("offline/worker.js", document.baseURI));
    this.#started = new Promise((resolve, reject) => this.#waiting.push({ resolve, reject }));
    this.#worker.addEventListener("message", ({ data }) => this.#hear(data));
    this.#worker.addEventListener("error", ({ message }) => this.#fail(message));
    this.#worker.postMessage({ module: this.#address });
    return this.#started;
  }

  #hear({ loaded, ready, failed, status, type, bytes }) {
    if (loaded) return this.emit("load", loaded);
    if (failed) return this.#fail(failed);
    if (!ready) return this.#waiting.shift().resolve(new Response(bytes, { status, headers: { "Content-Type": type } }));
    if (ready !== this.#version) return this.#fail(texts.offline.version(ready, this.#version));
    this.emit("load", null);
    this.#waiting.shift().resolve();
  }

  #fail(why) {
    this.emit("load", null);
    this.#worker.terminate();
    this.#worker = null;
    for (const { reject } of this.#waiting.splice(0)) reject(new ModuleFailure(why));
    this.emit("fail");
  }
}
