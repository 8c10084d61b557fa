// One thread of the referee: a record in, what MuJoCo makes of its trial out.

import {parentPort} from 'node:worker_threads';
import {runTrial} from './judge.mjs';
import {loadMujoco} from './load.mjs';
import {Scene, VARIANTS} from './scene.mjs';

const mujoco = await loadMujoco();

function referee(record, variant) {
  const scene = new Scene(mujoco, record.scene, variant);
  try {
    return runTrial(scene);
  } finally {
    scene.delete();
  }
}

parentPort.on('message', ({record, withVariants}) => {
  const there = referee(record, 'as_written');
  const variants = {};
  if (withVariants && there.success !== (record.result.outcome === 'success')) {
    for (const variant of VARIANTS.slice(1)) variants[variant] = referee(record, variant).outcome;
  }
  parentPort.postMessage({there, variants});
});
