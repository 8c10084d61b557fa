// A second opinion: carries out the trials of a session in MuJoCo, judges them by the README's rule
// of success and compares. Prints the tables of README.md.
//
//   node tests/peer/referee.mjs GRASPBENCH SESSION [--trial ID] [--held N --failed N] [--jobs N] [--variants]
//       [--half-step SESSION] [--out FILE]
//
// --held and --failed take so many trials of either verdict (chooseTrials). --variants repeats a trial on which both disagree in
// every variant of scene.mjs, to find what the verdict hangs on. --half-step names a session of the same plan at half the physics' step: it tells which verdicts
// of graspbench itself hang on the step. --out keeps every comparison as a line of JSON; trials that
// are in the file already are not run again.

import {appendFileSync, existsSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {parseArgs} from 'node:util';
import {Worker} from 'node:worker_threads';
import {loadMujoco} from './load.mjs';
import {chooseTrials, exportSession, nameOf, readRecords} from './session.mjs';

const {positionals: [graspbench, folder], values: options} = parseArgs({
  allowPositionals: true,
  options: {trial: {type: 'string', default: 'all'}, jobs: {type: 'string', default: '1'},
            held: {type: 'string'}, failed: {type: 'string'}, variants: {type: 'boolean', default: false}, 'half-step': {type: 'string'}, out: {type: 'string'}},
});
if (!folder) {
  console.error('usage: node referee.mjs GRASPBENCH SESSION [--trial ID] [--held N --failed N] [--jobs N] [--variants] [--half-step SESSION] [--out FILE]');
  process.exit(2);
}
const mujoco = await loadMujoco();
if (!mujoco) process.exit(0);

const halved = options['half-step'] ?
    new Map(readRecords(graspbench, options['half-step']).map(record => [nameOf(record), record.result.outcome])) : null;
const chosen = options.held || options.failed ?
    chooseTrials(graspbench, folder, Number(options.held ?? 0), Number(options.failed ?? 0)) : null;
const records = exportSession(graspbench, folder, record =>
    (chosen?.has(record.trial_id) ?? true) &&
    (options.trial === 'all' || record.trial_id.startsWith(options.trial)));
const kept = new Map();
if (options.out && existsSync(options.out)) {
  for (const line of readFileSync(options.out, 'utf8').split('\n').filter(Boolean)) {
    const comparison = JSON.parse(line);
    kept.set(comparison.trial_id, comparison);
  }
}
const SAME_RISE = 0.005;  // of the object in the hand until the lift, in one seat [m]
const NEAR_GRIP = 0.25;
const isSameSeat = ({here, there}) => Math.abs(here.closureRise - there.closureRise) <= SAME_RISE;
const agrees = comparison => comparison.here.success === comparison.there.success;
const isKnown = ({trial_id: id}) => kept.has(id) &&
    (!options.variants || agrees(kept.get(id)) || Object.keys(kept.get(id).variants).length > 0);
const unknown = records.filter(record => !isKnown(record));

/** What graspbench recorded, beside what MuJoCo finds. */
function compare(record, {there, variants}) {
  const here = record.result;
  return {
    trial: nameOf(record), trial_id: record.trial_id, hand: record.hand,
    here: {
      outcome: here.outcome, success: here.outcome === 'success', closedGrip: here.grip_force_n,
      holdGrip: here.stability.hold.normal_force_n, closureRise: here.closure_rise_m,
      steadyDepth: here.steady_penetration_m, creep: here.hold_creep_m,
      firstTouch: Object.fromEntries(here.contacts.filter(c => c.time_s !== null).map(c => [c.digit, c.time_s])),
      halfStep: halved?.get(nameOf(record)) ?? null,
    },
    there, variants,
  };
}

let next = 0, done = 0;
await Promise.all(Array.from({length: Number(options.jobs)}, () => new Promise((resolve, reject) => {
  const worker = new Worker(new URL('./worker.mjs', import.meta.url));
  let index = -1;
  const give = () => {
    index = next++;
    if (index < unknown.length) worker.postMessage({record: unknown[index], withVariants: options.variants});
    else worker.terminate().then(resolve);
  };
  worker.on('error', reject);
  worker.on('message', answer => {
    const comparison = compare(unknown[index], answer);
    kept.set(comparison.trial_id, comparison);
    if (options.out) appendFileSync(options.out, JSON.stringify(comparison) + '\n');
    process.stderr.write(`\r${++done} of ${unknown.length}`);
    give();
  });
  give();
})));
process.stderr.write('\n');
const comparisons = records.map(record => kept.get(record.trial_id));

function median(values) {
  const v = values.filter(x => x !== null && Number.isFinite(x)).sort((a, b) => a - b);
  if (v.length === 0) return NaN;
  const m = v.length >> 1;
  return v.length % 2 ? v[m] : 0.5 * (v[m - 1] + v[m]);
}

/** Wilson's interval at 95 %. */
function wilson(k, n) {
  const z = 1.959964, p = k / n, q = 1 + z * z / n;
  const middle = (p + z * z / (2 * n)) / q;
  const half = z * Math.sqrt(p * (1 - p) / n + z * z / (4 * n * n)) / q;
  return `${(100 * (middle - half)).toFixed(1)} to ${(100 * (middle + half)).toFixed(1)}`;
}

const scene0 = readFileSync(join(records[0].scene, 'scene.xml'), 'utf8');
const version = scene0.match(/name="physics_version" data="([^"]*)"/)[1];
console.log(`physics version ${version}, MuJoCo ${mujoco.mj_versionString()}, ${records.length} trials\n`);
console.log('| hand | same verdict | both succeed | only here | only MuJoCo | both fail | first touch, median ' +
    '\\|difference\\| | same seat: grip within 25 %, there over here, median (quartiles) | steady penetration here, there | creep here, there |');
console.log('| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |');
for (const hand of new Set(records.map(record => record.hand))) {
  const all = comparisons.filter(c => c.hand === hand), n = all.length;
  const count = (here, there) => all.filter(c => c.here.success === here && c.there.success === there).length;
  const both = all.filter(c => c.here.success && c.there.success);
  const same = count(true, true) + count(false, false);
  const touches = all.flatMap(c => Object.entries(c.here.firstTouch)
      .filter(([digit]) => digit in c.there.firstTouch)
      .map(([digit, time]) => Math.abs(c.there.firstTouch[digit] - time)));
  const seated = both.filter(isSameSeat);
  const grips = seated.map(c => c.there.holdGrip / c.here.holdGrip).sort((a, b) => a - b);
  const near = grips.filter(ratio => Math.abs(ratio - 1) <= NEAR_GRIP).length;
  const quartile = share => (grips[Math.floor(share * (grips.length - 1))] ?? NaN).toFixed(2);
  const mm = values => `${(1e3 * median(values)).toPrecision(2)} mm`;
  console.log(`| ${hand} | ${same} of ${n}, ${(100 * same / n).toFixed(1)} % (${wilson(same, n)}) | ${count(true, true)} | ` +
      `${count(true, false)} | ${count(false, true)} | ${count(false, false)} | ${(1e3 * median(touches)).toFixed(0)} ms | ` +
      `${near} of ${seated.length}, ${median(grips).toFixed(2)} (${quartile(0.25)} to ${quartile(0.75)}) | ` +
      `${mm(both.map(c => c.here.steadyDepth))}, ${mm(both.map(c => c.there.steadyDepth))} | ` +
      `${mm(both.map(c => c.here.creep))}, ${mm(both.map(c => c.there.creep))} |`);
}

console.log('\n| trial | here (half the step) | MuJoCo | grip here, there [N] | variants of MuJoCo that say as graspbench |');
console.log('| --- | --- | --- | --- | --- |');
for (const c of comparisons.filter(c => !agrees(c))) {
  const agree = Object.entries(c.variants)
      .filter(([, outcome]) => (outcome === 'success') === c.here.success).map(([variant]) => variant);
  console.log(`| ${c.trial} | ${c.here.outcome}${c.here.halfStep ? ` (${c.here.halfStep})` : ''} | ${c.there.outcome} | ` +
      `${c.here.closedGrip.toFixed(2)}, ${c.there.closedGrip.toFixed(2)} | ${agree.join(', ') || 'none'} |`);
}

console.log('\n| trial, held by both | rise here, there [mm] | grip while held here, there [N] |');
console.log('| --- | --- | --- |');
for (const {trial, here, there} of comparisons.filter(c => c.here.success && c.there.success)) {
  const isNear = Math.abs(there.holdGrip / here.holdGrip - 1) <= NEAR_GRIP;
  if (isNear && isSameSeat({here, there})) continue;
  console.log(`| ${trial} | ${(1e3 * here.closureRise).toFixed(1)}, ${(1e3 * there.closureRise).toFixed(1)} | ` +
      `${here.holdGrip.toFixed(2)}, ${there.holdGrip.toFixed(2)} |`);
}
