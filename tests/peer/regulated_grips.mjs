// Verdicts of regulated grips in MuJoCo, which is given the commands that the drives were given here:
// as many held as failed trials of a session.
//
//   node tests/peer/regulated_grips.mjs GRASPBENCH SESSION [--each N] [--out FILE]
//
// --each takes N of either kind (50). --out keeps every comparison as a line of JSON; trials that are
// in the file already are not run again.

import {appendFileSync, existsSync, readFileSync} from 'node:fs';
import {parseArgs} from 'node:util';
import {runTrial} from './judge.mjs';
import {loadMujoco} from './load.mjs';
import {Scene} from './scene.mjs';
import {chooseTrials, exportSession, nameOf} from './session.mjs';

const {positionals: [graspbench, folder], values: options} = parseArgs({
  allowPositionals: true,
  options: {each: {type: 'string', default: '50'}, out: {type: 'string'}},
});
if (!folder) {
  console.error('usage: node regulated_grips.mjs GRASPBENCH SESSION [--each N] [--out FILE]');
  process.exit(2);
}
const mujoco = await loadMujoco();
if (!mujoco) process.exit(0);

const isHeld = record => record.result.outcome === 'success';
const chosen = chooseTrials(graspbench, folder, Number(options.each), Number(options.each));
const records = exportSession(graspbench, folder, record => chosen.has(record.trial_id));
const known = new Map();
if (options.out && existsSync(options.out)) {
  for (const line of readFileSync(options.out, 'utf8').split('\n').filter(Boolean)) {
    const comparison = JSON.parse(line);
    known.set(comparison.trial_id, comparison);
  }
}

const comparisons = records.map((record, i) => {
  if (known.has(record.trial_id)) return known.get(record.trial_id);
  const scene = new Scene(mujoco, record.scene, 'as_written');
  try {
    const there = runTrial(scene);
    const comparison = {trial_id: record.trial_id, trial: nameOf(record), here: record.result.outcome, held: isHeld(record),
                        there: there.outcome, held_there: there.success};
    if (options.out) appendFileSync(options.out, JSON.stringify(comparison) + '\n');
    process.stderr.write(`\r${i + 1} of ${records.length}`);
    return comparison;
  } finally {
    scene.delete();
  }
});
process.stderr.write('\n');

const count = (held, there) => comparisons.filter(c => c.held === held && c.held_there === there).length;
console.log(`same verdict in ${count(true, true) + count(false, false)} of ${comparisons.length}: both held ${count(true, true)}, ` +
    `only here ${count(true, false)}, only in MuJoCo ${count(false, true)}, both lost ${count(false, false)}`);
for (const c of comparisons.filter(c => c.held !== c.held_there)) console.log(`${c.trial}: ${c.here}; MuJoCo: ${c.there}`);
