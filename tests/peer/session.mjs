// The trials of a session as graspbench recorded them, and their scenes for MuJoCo.

import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';

const run = (graspbench, ...args) => execFileSync(graspbench, args, {stdio: ['ignore', 'pipe', 'inherit'], maxBuffer: 1 << 24});

/** Has graspbench write records and the scenes of those that `isWanted`; returns these records with
    the folder of each scene. */
export function exportSession(graspbench, folder, isWanted = () => true) {
  const records = readRecords(graspbench, folder).filter(isWanted);
  if (records.length === 0) throw new Error(`${folder}: no such trial`);
  run(graspbench, 'export', folder, '--mjcf', records.map(record => record.trial_id).join(','));
  return records;
}

/** Has graspbench write the records of a session and reads them. */
export function readRecords(graspbench, folder) {
  run(graspbench, 'export', folder, '--records');
  return readFileSync(join(folder, 'export', 'records.jsonl'), 'utf8').trim().split('\n').map(line => {
    const record = JSON.parse(line);
    return {...record, scene: join(folder, 'export', 'mjcf', record.trial_id)};
  });
}

/** So many held and failed trials of a session, those with the smallest ids, which are hashes. What
    is unreachable is left out: that verdict is of geometry. */
export function chooseTrials(graspbench, folder, numHeld, numFailed) {
  const records = readRecords(graspbench, folder), chosen = new Set();
  for (const [held, num] of [[true, numHeld], [false, numFailed]]) {
    const ids = records.filter(({result: {outcome}}) => (outcome === 'success') === held && outcome !== 'unreachable')
        .map(record => record.trial_id).sort();
    if (ids.length < num) throw new Error(`${folder}: ${ids.length} trials are ${held ? 'held' : 'failed'}, ${num} wanted`);
    for (const id of ids.slice(0, num)) chosen.add(id);
  }
  return chosen;
}

/** The same draw in sessions of different settings. */
export const nameOf = record => `${record.hand} ${record.object} ${record.grasp} #${record.trial}`;
