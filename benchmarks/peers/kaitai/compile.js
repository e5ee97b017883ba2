// Compiles a .ksy file to Python: node compile.js FILE.ksy FOLDER [--read-write]

"use strict";

const fs = require("fs");
const path = require("path");
const Module = require("module");

// The JavaScript build holds the whole compiler, writers included, but its interface has no
// parameter for `--read-write`. Both settings are turned where the configuration is made.
const SWITCHES = [
  ["RuntimeConfig__f_autoRead = autoRead;", "RuntimeConfig__f_autoRead = false;"],
  ["RuntimeConfig__f_readWrite = readWrite;", "RuntimeConfig__f_readWrite = true;"],
];

function fail(reason) {
  console.error(reason);
  process.exit(1);
}

function load(readWrite) {
  if (!readWrite) return require("kaitai-struct-compiler");
  const file = require.resolve("kaitai-struct-compiler");
  let text = fs.readFileSync(file, "utf8");
  for (const [from, to] of SWITCHES) {
    if (!text.includes(from)) fail("this build of the compiler makes readers only");
    text = text.replace(from, to);
  }
  const module = new Module(file);
  module.filename = file;
  module._compile(text, file);
  return module.exports;
}

const [source, folder, option] = process.argv.slice(2);
let compiler, yaml;
try {
  compiler = load(option === "--read-write");
  yaml = require("yaml");
} catch (error) {
  if (error.code !== "MODULE_NOT_FOUND") throw error;
  fail("kaitai-struct-compiler or yaml is not in node_modules");
}
compiler.compile("python", yaml.parse(fs.readFileSync(source, "utf8")), null, false).then(
  (files) => {
    for (const name of Object.keys(files)) {
      fs.writeFileSync(path.join(folder, name), files[name]);
    }
  },
  (error) => fail(String(error)),
);
