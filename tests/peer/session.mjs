// The trials of a session as graspbench recorded them, and their scenes for MuJoCo.

import {execFileSync} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';

/** Has graspbench write records and scenes; returns the records with the folder of each scene. */
export function exportSession(graspbench, folder, trial = 'all') {
  const run = args => execFileSync(graspbench, args, {stdio: ['ignore', 'pipe', 'inherit'],
                                                      maxBuffer: 1 << 24});
  run(['export', folder]);
  run(['export', folder, '--mjcf', trial]);
  return readRecords(folder).filter(record => trial === 'all' || record.trial_id.startsWith(trial));
}

export function readRecords(folder) {
  return readFileSync(join(folder, 'export', 'records.jsonl'), 'utf8').trim().split('\n').map(line => {
    const record = JSON.parse(line);
    return {...record, scene: join(folder, 'export', 'mjcf', record.trial_id)};
  });
}

/** The same draw in sessions of different settings. */
export const nameOf = record => `${record.hand} ${record.object} ${record.grasp} #${record.trial}`;
