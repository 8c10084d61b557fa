// Copies objects with the static coefficient of friction as the sliding one, too, and with a rigid surface:
// MuJoCo has one coefficient and no compressible surface. Engines are compared on what both can express.
//
//   node tests/peer/one_friction.mjs objects/catalogue OUT
//   graspbench run --object $(ls -d OUT/* | paste -sd,) --out DIR

import {cpSync, existsSync, readFileSync, readdirSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';

const [from, out] = process.argv.slice(2);
if (!out) {
  console.error('usage: node one_friction.mjs FOLDER OUT');
  process.exit(2);
}
for (const id of readdirSync(from).filter(name => existsSync(join(from, name, 'object.yaml')))) {
  cpSync(join(from, id), join(out, id), {recursive: true});
  const file = join(out, id, 'object.yaml'), text = readFileSync(file, 'utf8');
  const given = text.match(/^friction_static: *(\S+)/m);
  if (!given) throw new Error(`${file}: no friction_static; expected "friction_static: NUMBER"`);
  writeFileSync(file, text.replace(/^friction_dynamic:.*$/m, `friction_dynamic: ${given[1]}`)
                          .replace(/^compressible:.*\n(?: .*\n)*/m, ''));
}
