// A conversation of the protocol's own client with `asdf-vk mcp`; scripts/test-mcp runs it.
//   node mcp_client.mjs FOLDER_OF_PROGRAMS    in a folder with node_modules
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const require = createRequire(join(process.cwd(), "package.json"));
const load = (name) => import(pathToFileURL(require.resolve(`@modelcontextprotocol/sdk/client/${name}.js`)));
const { Client } = await load("index");
const { StdioClientTransport } = await load("stdio");

const programs = process.argv[2];
const folder = mkdtempSync(join(tmpdir(), "asdf-vk-mcp-"));
for (const shape of ["ligament-96", "animal"])
  execFileSync(join(programs, "asdf-vk-generate"), [shape, "-o", join(folder, `${shape}.ply`)], { stdio: "ignore" });

const transport = new StdioClientTransport({
  command: join(programs, "asdf-vk"),
  args: ["mcp", "--root", folder, "--backend", "cpu"],
});
const client = new Client({ name: "test", version: "1" }, { capabilities: {} });
let version = "";
const send = transport.send.bind(transport);
const sent = [];
transport.send = (message, ...rest) => {
  sent.push(message);
  return send(message, ...rest);
};
await client.connect(transport);
version = sent[0].params.protocolVersion;
assert.equal(client.getServerVersion().name, "asdf-vk");
await client.ping();

const { tools } = await client.listTools();
assert.deepEqual(tools.map((tool) => tool.name), ["check_walls", "measure", "find_parts", "picture"]);
assert.ok(tools[0].inputSchema.properties.thinnerThan.description);

const call = (name, args, options) => client.callTool({ name, arguments: args }, undefined, options);
const part = "ligament-96.ply";
const thin = await call("check_walls", { mesh: part, thinnerThan: 0.8 });
assert.match(thin.content[0].text, /^FAIL: 1 wall thinner than 0.8[^]*\nto do: wall of 0.6/);
if (version >= "2025-06-18") assert.equal(thin.structuredContent.thickness.verdict, "failed");
else assert.equal(JSON.parse(thin.content[1].text).thickness.verdict, "failed");
assert.match((await call("check_walls", { mesh: part, thinnerThan: 0.5 })).content[0].text, /^PASS/);

const picture = await call("picture", { mesh: part, thinnerThan: 0.8 });
assert.equal(picture.content[1].mimeType, "image/png");
assert.equal(Buffer.from(picture.content[1].data, "base64").toString("latin1", 1, 4), "PNG");

const steps = [];
const parts = await call("find_parts", { mesh: "animal.ply", output: "parts.npy" }, { onprogress: (step) => steps.push(step) });
assert.match(parts.content[0].text, /parts: 7/);
assert.ok(existsSync(join(folder, "parts.npy")));
assert.ok(readFileSync(join(folder, "parts.npy")).subarray(1, 6).equals(Buffer.from("NUMPY")));
assert.ok(steps.length > 0);

for (const [args, message] of [
  [{ mesh: "../secret.stl", thinnerThan: 1 }, /is outside of/],
  [{ mesh: "/etc/passwd", thinnerThan: 1 }, /is outside of/],
  [{ mesh: "missing.stl", thinnerThan: 1 }, /cannot be opened/],
  [{ mesh: part }, /needs a limit/],
  [{ mesh: part, thinnerthan: 1 }, /did you mean thinnerThan\?/],
]) {
  const refused = await call("check_walls", args);
  assert.equal(refused.isError, true);
  assert.match(refused.content[0].text, message);
}
await assert.rejects(call("chek_walls", {}), /did you mean check_walls/);

const abort = new AbortController();
const long = call("measure", { mesh: "animal.ply", measure: "sdf,gap", seeds: "all" }, { signal: abort.signal });
setTimeout(() => abort.abort("no longer needed"), 50);
await assert.rejects(long);
assert.equal((await call("measure", { mesh: part, measure: "thickness" })).isError, false);

await client.close();
rmSync(folder, { recursive: true });
console.log(`protocol ${version}: passed`);
