// A studio of a check's own.
import { spawn } from "node:child_process";

/** Starts a studio with these arguments at a free port: { address, kill }. */
export async function begun(asperity, args) {
  const studio = spawn(asperity, ["studio", "--no-open", "--port", "0", ...args]);
  const address = await new Promise((done, failed) => {
    studio.stdout.on("data", (text) => done(String(text).trim()));
    studio.stderr.on("data", (text) => failed(new Error(String(text))));
  });
  return { address, kill: () => new Promise((done) => {
    studio.on("exit", done);
    studio.kill("SIGKILL");
  }) };
}
