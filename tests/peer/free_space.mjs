// Grasps of others in MuJoCo with the values of the profile dexgraspbench-fc, against the verdicts of
// `graspbench grasps judge`.
//
//     graspbench run --hand shadow --trials 3 --out results/shadow
//     node tests/peer/free_space.mjs build/release/graspbench results/shadow OUT --grasps 100
//
// The same: stages, updates, drives (kp 5, 3 N m, 0.05 N m s/rad, 0.01 N m, armature), every joint with
// its own, friction 0.6 and 0.02 m, 4 ms, mass, pushes, looks, limits. As DexGraspBench has it and
// graspbench in its own way: the weld that moves the root, soft contacts whose stiffness grows with depth
// and mass and whose friction creeps; capsules and convex parts.

import {execFileSync} from 'node:child_process';
import {readFileSync, mkdirSync} from 'node:fs';
import {join, resolve} from 'node:path';
import {JOINTS, makeGrasps, rotation, toQuaternion, writeGrasps} from './foreign_grasps.mjs';
import {loadMujoco} from './load.mjs';
import {exportSession} from './session.mjs';

const STEP = 0.004, UPDATES = 10, INNER = 10, LOOKS = 10, STEPS_A_LOOK = 50;  // of DexGraspBench
const MASS = 0.1, PUSH = 10 * MASS, MOST_DEPTH = 0.01, MOST_SHIFT = 0.05, MOST_TURN = 15 * Math.PI / 180;

/** The scene of a trial as DexGraspBench would have it. */
export function editScene(xml, step = STEP) {
  const joints = JOINTS.map(name => `<position name="${name}" joint="${name}" kp="5" forcerange="-3 3"/>`).join('');
  const object = xml.slice(xml.indexOf('<body name="object"'));
  const mass = Number(object.match(/<inertial mass="([^"]*)"/)[1]);
  const edited = object.replace(/(<inertial mass=")[^"]*("[^>]*fullinertia=")([^"]*)"/, (_, a, b, inertia) =>
      `${a}${MASS}${b}${inertia.split(' ').map(x => x * MASS / mass).join(' ')}"`);
  return xml.replace(object, edited)
      .replace(/<option [^>]*>/, `<option timestep="${step}" gravity="0 0 0" integrator="implicitfast" solver="Newton" ` +
               'cone="elliptic" impratio="10" noslip_iterations="2">')
      .replace(/<geom name="table"[^>]*>/, '')
      .replace(/<geom name="[^"]*"[^>]*>/g, geom => geom.replace(/ (condim|friction|priority)="[^"]*"/g, '')
               .replace(/\/?>$/, ' condim="4" friction="0.6 0.02 0.0001"' +
                        (geom.includes('"object/') ? ' solref="0.02 1" solimp="0.9 0.95 0.001"' :
                                                     ' solref="0.005 1" solimp="0.5 0.99 0.0001"') + '/>'))
      .replace(/<joint name="arm\/x"[^>]*>/, '<freejoint name="root"/>')
      .replace(/<joint name="(arm\/[^"]*|WRJ[12])"[^>]*>/g, '')
      .replace(/<body name="carried"[\s\S]*?<\/body>/, '')
      .replace(/<joint name="([FMRLT][FH]J\d)"/g, '<joint name="$1" damping="0.05" armature="0.0002" frictionloss="0.01"')
      .replace(/<(actuator|tendon|equality|keyframe|sensor)>[\s\S]*?<\/\1>/g, '')
      .replace('</worldbody>', '<body name="target" mocap="true"/></worldbody>' +
               '<equality><weld body1="target" body2="hand/forearm" relpose="0 0 0 1 0 0 0" ' +
               'solref="0.02 1" solimp="0.9 0.95 0.001 0.5 2"/></equality>' +
               `<actuator>${joints}</actuator>`);
}

/** Axis and angle of the way from a to b, in a's frame. */
function findTurn(a, b) {
  const R = [0, 1, 2].map(i => [0, 1, 2].map(j => [0, 1, 2].reduce((sum, k) => sum + a[k][i] * b[k][j], 0)));
  const [w, ...v] = toQuaternion(R), n = Math.hypot(...v);
  const angle = 2 * Math.atan2(n, w);
  return {axis: n > 1e-12 ? v : [1, 0, 0], angle: angle > Math.PI ? angle - 2 * Math.PI : angle};
}
const times = (A, B) => A.map(row => [0, 1, 2].map(k => row.reduce((sum, x, i) => sum + x * B[i][k], 0)));

class FreeSpace {
  constructor(mujoco, xml, step = STEP) {
    this.mujoco = mujoco;
    this.inner = Math.round(INNER * STEP / step);
    this.stepsALook = Math.round(STEPS_A_LOOK * STEP / step);
    this.model = mujoco.MjModel.from_xml_string(editScene(xml, step));
    this.data = new mujoco.MjData(this.model);
    const find = (type, name) => mujoco.mj_name2id(this.model, type.value, name);
    this.joints = JOINTS.map(name => this.model.jnt_qposadr[find(mujoco.mjtObj.mjOBJ_JOINT, name)]);
    this.root = this.model.jnt_qposadr[find(mujoco.mjtObj.mjOBJ_JOINT, 'root')];
    this.object = this.model.jnt_qposadr[find(mujoco.mjtObj.mjOBJ_JOINT, 'object')];
    this.body = find(mujoco.mjtObj.mjOBJ_BODY, 'object');
  }
  delete() { this.data.delete(); this.model.delete(); }

  aim(R, p, joints) {
    this.data.mocap_pos.set(p);
    this.data.mocap_quat.set(toQuaternion(R));
    this.data.ctrl.set(joints);
  }
  go(a, b) {
    const {axis, angle} = findTurn(a.R, b.R);
    for (let k = 1; k <= UPDATES; ++k) {
      const s = k / UPDATES;
      this.aim(times(a.R, rotation(axis, s * angle)), a.p.map((x, i) => x + s * (b.p[i] - x)),
               a.joints.map((x, i) => x + s * (b.joints[i] - x)));
      for (let n = 0; n < this.inner; ++n) this.mujoco.mj_step(this.model, this.data);
    }
  }
  begin({X_WO, stages: {pregrasp}}) {
    this.mujoco.mj_resetData(this.model, this.data);
    const {qpos} = this.data;
    qpos.set([...pregrasp.p, ...toQuaternion(pregrasp.R)], this.root);
    qpos.set([...X_WO.p, ...toQuaternion(X_WO.R)], this.object);
    this.joints.forEach((address, i) => { qpos[address] = pregrasp.joints[i]; });
    this.aim(pregrasp.R, pregrasp.p, pregrasp.joints);
    this.mujoco.mj_forward(this.model, this.data);
  }
  deepest() {
    const all = this.data.contact;
    let deepest = 0;
    for (let i = 0; i < this.data.ncon; ++i) {
      const contact = all.get(i);
      const bodies = [contact.geom1, contact.geom2].map(geom => this.model.geom_bodyid[geom]);
      if (bodies.includes(this.body)) deepest = Math.max(deepest, -contact.dist);
      contact.delete();
    }
    all.delete();
    return deepest;
  }
  moved(X_WO) {
    const {qpos} = this.data, p = qpos.slice(this.object, this.object + 3), q = qpos.slice(this.object + 3, this.object + 7);
    const w = Math.abs(toQuaternion(X_WO.R).reduce((sum, x, i) => sum + x * q[i], 0));
    return {shift: Math.hypot(...X_WO.p.map((x, i) => x - p[i])), turn: 2 * Math.acos(Math.min(1, w))};
  }
  /** @returns {passed, stage, shift, turn} */
  judge(grasp) {
    this.begin(grasp);
    if (this.deepest() > MOST_DEPTH) return {passed: false, stage: 'start', shift: 0, turn: 0};
    const {pregrasp, grasp: closed, squeeze} = grasp.stages;
    let worst = {shift: 0, turn: 0};
    for (let push = 0; push < 6; ++push) {
      this.begin(grasp);
      this.go(pregrasp, closed);
      this.go(closed, squeeze);
      this.data.xfrc_applied[6 * this.body + (push >> 1)] = push % 2 === 0 ? -PUSH : PUSH;
      for (let look = 0; look < LOOKS; ++look) {
        for (let n = 0; n < this.stepsALook; ++n) this.mujoco.mj_step(this.model, this.data);
        const moved = this.moved(grasp.X_WO);
        worst = {shift: Math.max(worst.shift, moved.shift), turn: Math.max(worst.turn, moved.turn)};
        if (moved.shift < MOST_SHIFT && moved.turn < MOST_TURN) continue;
        return {passed: false, stage: `push ${push % 2 ? '+' : '-'}${'xyz'[push >> 1]}`, ...worst};
      }
    }
    return {passed: true, stage: '', ...worst};
  }
}

async function main() {
  const [graspbench, session, out, ...options] = process.argv.slice(2);
  const option = (name, fallback) => Number(options.includes(name) ? options[options.indexOf(name) + 1] : fallback);
  const count = option('--grasps', 100), seed = option('--seed', 1), noise = option('--noise', 4), share = option('--step-share', 1);
  const mujoco = await loadMujoco();
  if (!mujoco) process.exit(77);
  const catalogue = resolve(import.meta.dirname ?? new URL('.', import.meta.url).pathname, '../../objects/catalogue');
  const records = exportSession(graspbench, session, ({hand}) => hand === 'shadow');
  // As many that graspbench passes as it fails, those that were drawn first.
  mkdirSync(out, {recursive: true});
  const drawn = makeGrasps(records, 4 * count, seed, noise);
  writeGrasps(drawn, join(out, 'grasps'), catalogue);
  execFileSync(graspbench, ['grasps', 'judge', join(out, 'grasps'), '--objects', catalogue, '--profile', 'dexgraspbench-fc',
                            '--jobs', '1', '--out', join(out, 'judged')], {stdio: ['ignore', 'ignore', 'inherit']});
  const judged = new Map(readFileSync(join(out, 'judged', 'journal.jsonl'), 'utf8').trim().split('\n').map(line => {
    const record = JSON.parse(line);
    return [`${record.source} ${record.index}`, record.result];
  }));
  for (const grasp of drawn) grasp.ours = judged.get(`${grasp.source} ${grasp.index}`);
  const chosen = [true, false].flatMap(passed => drawn.filter(({ours}) => ours.passed === passed).slice(0, count / 2))
      .sort((a, b) => a.source < b.source ? -1 : 1);
  const table = {both: 0, ours: 0, theirs: 0, neither: 0}, apart = [];
  let space = null, object = null;
  for (const grasp of chosen) {
    if (grasp.object !== object) {
      if (space) space.delete();
      space = new FreeSpace(mujoco, readFileSync(join(grasp.scene, 'scene.xml'), 'utf8'), share * STEP);
      object = grasp.object;
    }
    const theirs = space.judge(grasp), {ours} = grasp;
    ++table[ours.passed ? (theirs.passed ? 'both' : 'ours') : (theirs.passed ? 'theirs' : 'neither')];
    if (ours.passed === theirs.passed) continue;
    const words = (passed, stage, shift, degrees) =>
        `${passed ? 'pass' : `fail at ${stage}`}, ${(1e3 * shift).toFixed(1)} mm, ${degrees.toFixed(1)} deg`;
    apart.push(`${grasp.source} ${grasp.index}: here ${words(ours.passed, ours.failed_stage, ours.worst_shift_m, ours.worst_turn_deg)}; ` +
               `MuJoCo ${words(theirs.passed, theirs.stage, theirs.shift, theirs.turn * 180 / Math.PI)}`);
  }
  const same = table.both + table.neither;
  console.log(`same verdict ${same} of ${chosen.length}: both pass ${table.both}, both fail ${table.neither}, ` +
              `only here ${table.ours}, only MuJoCo ${table.theirs}`);
  for (const line of apart) console.log(line);
}
await main();
