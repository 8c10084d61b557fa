// Trajectories as MCAP in the format's own reader, against the tables of the same trials.
// `node tests/peer/trajectory_test.mjs GRASPBENCH`

import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, readdirSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {basename, join} from 'node:path';

const SKIPPED = 77;
const TOLERANCE = 1e-6;
const graspbench = process.argv[2];
let mcap, fzstd, protobuf, descriptor;
try {
  mcap = await import('@mcap/core');
  fzstd = await import('fzstd');
  protobuf = (await import('protobufjs')).default;
  descriptor = (await import('protobufjs/ext/descriptor.js')).default;
} catch (missing) {
  console.log(`skipped: ${missing.message}`);
  process.exit(SKIPPED);
}

const folder = mkdtempSync(join(tmpdir(), 'trajectory-'));
process.on('exit', () => rmSync(folder, {recursive: true, force: true}));
const run = (...args) => execFileSync(graspbench, args, {stdio: 'ignore'});
run('run', '--hand', 'tum,shadow', '--object', 'golf_ball', '--trials', '1', '--out', join(folder, 's'));
for (const form of ['mcap', 'csv']) {
  run('replay', join(folder, 's'), '--all', '--trajectory', form, '--out', join(folder, form));
}

const readTable = file => {
  const [head, ...lines] = readFileSync(file, 'utf8').trimEnd().split('\n').map(line => line.split(','));
  return lines.map(cells => Object.fromEntries(head.map((name, i) => [name, cells[i]])));
};

async function readMcap(file) {
  const bytes = readFileSync(file);
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
  };
  const reader = await mcap.McapIndexedReader.Initialize(
      {readable, decompressHandlers: {zstd: packed => fzstd.decompress(packed)}});
  const types = new Map();
  for (const schema of reader.schemasById.values()) {
    const set = descriptor.FileDescriptorSet.decode(schema.data);
    types.set(schema.id, protobuf.Root.fromDescriptor(set).lookupType(schema.name));
  }
  const messages = {};
  for await (const message of reader.readMessages()) {  // by its index, in the order of time
    const channel = reader.channelsById.get(message.channelId);
    const content = types.get(channel.schemaId).decode(message.data);
    (messages[channel.topic] ??= []).push({time: Number(message.logTime) * 1e-9, content});
  }
  const about = {};
  for await (const metadata of reader.readMetadata()) about[metadata.name] = metadata.metadata;
  assert.equal(Number(reader.statistics.messageCount),
      Object.values(messages).reduce((sum, list) => sum + list.length, 0));
  return {messages, about};
}

const near = (a, b, what) => assert.ok(Math.abs(a - b) < TOLERANCE, `${what}: ${a} and ${b}`);
let numTrials = 0, numPoses = 0;
for (const file of readdirSync(join(folder, 'mcap')).filter(name => name.endsWith('.mcap'))) {
  const {messages, about} = await readMcap(join(folder, 'mcap', file));
  const name = basename(file, '.mcap');
  const rows = readTable(join(folder, 'csv', name + '.csv'));
  const events = readTable(join(folder, 'csv', name + '.events.csv'));
  assert.equal(about.trial.get('record_sha256').length, 64);
  assert.equal(messages['/tf'].length, rows.length);
  rows.forEach((row, i) => {
    near(messages['/tf'][i].time, row.time_s, 'time');
    for (const frame of messages['/tf'][i].content.transforms) {
      const of = frame.child_frame_id;
      if (of !== 'hand' && of !== 'object') continue;
      ++numPoses;
      for (const axis of 'xyz') near(frame.translation[axis], row[`${of}_${axis}_m`], `${of} ${axis}`);
      const q = 'xyzw'.split('').map(part => [frame.rotation[part], Number(row[`${of}_q${part}`])]);
      near(Math.abs(q.reduce((sum, [a, b]) => sum + a * b, 0)), 1, `${of} turned`);
    }
    for (const joint of messages['/joints'][i].content.joints) {
      near(joint.position, row[`${joint.name}_rad`], joint.name);
    }
    near(messages['/contacts'][i].content.grip_force, row.grip_force_n, 'grip');
    assert.equal(messages['/contact_forces'][i].content.entities[0].arrows.length,
        messages['/contacts'][i].content.contacts.length);
  });
  assert.equal(messages['/events'].length, events.length);
  events.forEach((event, i) => {
    near(messages['/events'][i].time, event.time_s, 'event');
    assert.equal(messages['/events'][i].content.kind, event.kind);
  });
  ++numTrials;
}
assert.equal(numTrials, 2);
assert.ok(numPoses > 600);
console.log(`${numTrials} trials: the same numbers`);
