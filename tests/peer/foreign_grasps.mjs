// Grasps in the layout of DexGraspBench, made from the held trials of a session of the Shadow Hand: each
// trial several times, its root moved and turned at random, opened for the pregrasp, bent further for the
// squeeze. What they are worth is not known beforehand.

import {readFileSync, mkdirSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';

const PALM = [0, -0.02, 0.114];  // about which roots are turned, in the root's frame [m]
const WRIST = [0, 0, -0.034];    // the file's root in the hand's frame [m]
const DIGITS = {FF: 4, MF: 4, RF: 4, LF: 5, TH: 5};
export const JOINTS = Object.entries(DIGITS).flatMap(([digit, count]) =>
    Array.from({length: count}, (_, i) => `${digit}J${count - i}`));

/** SplitMix64's top bits as numbers in [0, 1): the same grasps everywhere. */
function makeRandom(seed) {
  let state = BigInt(seed);
  const mask = (1n << 64n) - 1n;
  return () => {
    state = (state + 0x9e3779b97f4a7c15n) & mask;
    let z = state;
    z = ((z ^ (z >> 30n)) * 0xbf58476d1ce4e5b9n) & mask;
    z = ((z ^ (z >> 27n)) * 0x94d049bb133111ebn) & mask;
    return Number((z ^ (z >> 31n)) >> 11n) / 2 ** 53;
  };
}

const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const column = (R, k) => R.map(row => row[k]);
const turnVector = (R, v) => R.map(row => dot(row, v));
export const compose = (a, b) => ({
  R: a.R.map(row => [0, 1, 2].map(k => dot(row, column(b.R, k)))),
  p: turnVector(a.R, b.p).map((x, i) => x + a.p[i]),
});
const IDENTITY = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
export const shift = p => ({R: IDENTITY, p});

export function rotation(axis, angle) {
  const n = Math.hypot(...axis), [x, y, z] = axis.map(a => a / n);
  const c = Math.cos(angle), s = Math.sin(angle), d = 1 - c;
  return [[c + x * x * d, x * y * d - z * s, x * z * d + y * s],
          [y * x * d + z * s, c + y * y * d, y * z * d - x * s],
          [z * x * d - y * s, z * y * d + x * s, c + z * z * d]];
}

/** w x y z. */
export function toQuaternion(R) {
  const trace = R[0][0] + R[1][1] + R[2][2];
  if (trace > -0.9) {
    const w = Math.sqrt(1 + trace) / 2;
    return [w, (R[2][1] - R[1][2]) / (4 * w), (R[0][2] - R[2][0]) / (4 * w), (R[1][0] - R[0][1]) / (4 * w)];
  }
  const i = [0, 1, 2].reduce((best, k) => R[k][k] > R[best][best] ? k : best, 0), j = (i + 1) % 3, k = (i + 2) % 3;
  const t = Math.sqrt(1 + R[i][i] - R[j][j] - R[k][k]) / 2, q = [(R[k][j] - R[j][k]) / (4 * t), 0, 0, 0];
  q[1 + i] = t;
  q[1 + j] = (R[j][i] + R[i][j]) / (4 * t);
  q[1 + k] = (R[k][i] + R[i][k]) / (4 * t);
  return q;
}

/** @param records  of a session of the Shadow Hand, with snapshots.
    @returns {object, X_WO, stages: [{R, p, joints}] by name} */
export function makeGrasps(records, count, seed, noise) {
  const random = makeRandom(seed);
  const uniform = (a, b) => a + (b - a) * random();
  const normal = () => Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random());
  const drawVector = size => [0, 1, 2].map(() => size * normal());
  const disturb = (X, turn, move) => [shift(PALM), {R: rotation(drawVector(1), turn), p: drawVector(move)},
                                      shift(PALM.map(x => -x))].reduce(compose, X);
  const poseOf = json => ({R: json.R, p: json.p_m});
  const held = records.filter(({hand, result}) => hand === 'shadow' && result.outcome === 'success');
  const grasps = [];
  for (let i = 0; i < count; ++i) {
    const record = held[i % held.length];
    const [open, closed] = ['pregrasp', 'closed'].map(name => record.result.snapshots.find(s => s.name === name));
    const grasp = disturb(compose(poseOf(closed.X_WH), shift(WRIST)), noise * Math.PI / 180 * normal(), 1e-3 * noise);
    const start = disturb(grasp, uniform(0, 3) * Math.PI / 180, 2e-3);
    const q = closed.q_rad.slice(0, JOINTS.length), bend = q.map((x, j) => x - open.q_rad[j]);
    const opening = uniform(0.2, 0.5), squeeze = uniform(0, 0.35);
    grasps.push({object: record.object, X_WO: poseOf(closed.X_WO), scene: record.scene, stages: {
      pregrasp: {...start, joints: q.map((x, j) => x - opening * bend[j])},
      grasp: {...grasp, joints: q},
      squeeze: {...grasp, joints: q.map((x, j) => x + squeeze * bend[j])}}});
  }
  return grasps;
}

/** A pickle of dictionaries, lists, texts and numbers (protocol 2). */
function pickle(value) {
  const parts = [Buffer.from([0x80, 2])];
  const put = item => {
    if (typeof item === 'number') {
      const bytes = Buffer.alloc(9);
      bytes.write('G', 'latin1');
      bytes.writeDoubleBE(item, 1);
      parts.push(bytes);
    } else if (typeof item === 'string') {
      const text = Buffer.from(item, 'utf8'), head = Buffer.alloc(5);
      head.write('X', 'latin1');
      head.writeUInt32LE(text.length, 1);
      parts.push(head, text);
    } else if (Array.isArray(item)) {
      parts.push(Buffer.from(']('));
      item.forEach(put);
      parts.push(Buffer.from('e'));
    } else {
      parts.push(Buffer.from('}('));
      for (const [key, child] of Object.entries(item)) { put(key); put(child); }
      parts.push(Buffer.from('u'));
    }
  };
  put(value);
  return Buffer.concat([...parts, Buffer.from('.')]);
}

/** Middle of the box of a catalogue's mesh, and metres of its unit. */
function readMesh(catalogue, object) {
  const unit = /^mesh_unit: mm/m.test(readFileSync(join(catalogue, object, 'object.yaml'), 'utf8')) ? 1e-3 : 1;
  const points = [...readFileSync(join(catalogue, object, 'mesh.obj'), 'utf8').matchAll(/^v (\S+) (\S+) (\S+)/gm)];
  const middle = [1, 2, 3].map(k => {
    const values = points.map(match => unit * Number(match[k]));
    return (Math.min(...values) + Math.max(...values)) / 2;
  });
  return {unit, middle};
}

/** One file an object; every grasp gets its file and its place there: source, index. */
export function writeGrasps(grasps, folder, catalogue) {
  mkdirSync(folder, {recursive: true});
  for (const object of new Set(grasps.map(grasp => grasp.object))) {
    const {unit, middle} = readMesh(catalogue, object);
    const mine = grasps.filter(grasp => grasp.object === object);
    const row = (X, more = []) => [...X.p, ...toQuaternion(X.R), ...more];
    const rows = name => mine.map(({stages}) => row(stages[name], stages[name].joints));
    mine.forEach((grasp, index) => Object.assign(grasp, {source: `${object}.npy`, index}));
    writeFileSync(join(folder, `${object}.npy`), pickle({
      pregrasp_qpos: rows('pregrasp'), grasp_qpos: rows('grasp'), squeeze_qpos: rows('squeeze'),
      obj_scale: mine.map(() => unit), obj_path: `assets/object/${object}`,
      obj_pose: mine.map(({X_WO}) => row(compose(X_WO, shift(middle.map(x => -x))))),
    }));
  }
}
