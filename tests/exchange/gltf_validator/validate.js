// node validate.js FILE.glb: says nothing and exits with 0 where the file is valid glTF 2.0 without a warning.
const fs = require("fs");
const validator = require("gltf-validator");

validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2]))).then((report) => {
  const { numErrors, numWarnings, messages } = report.issues;
  if (numErrors + numWarnings === 0) return;
  console.error(JSON.stringify(messages.slice(0, 20), null, 1));
  process.exit(1);
});
