// The exported scenes against sources of their own: hand.urdf, object.yaml, the object's mesh, and
// what graspbench says of the hand. `node tests/peer/scene_test.mjs GRASPBENCH`

import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {test} from 'node:test';
import {fileURLToPath} from 'node:url';
import {loadMujoco} from './load.mjs';
import {Scene, VARIANTS} from './scene.mjs';
import {exportSession} from './session.mjs';

const SKIPPED = 77;
const ROOT = fileURLToPath(new URL('../..', import.meta.url));
const DEGREE = Math.PI / 180;
const graspbench = process.argv[2];
const mujoco = await loadMujoco();
if (!mujoco) process.exit(SKIPPED);

const ask = args => JSON.parse(execFileSync(graspbench, [...args, '--json'], {encoding: 'utf8'}));
const near = (a, b, tolerance, what) => assert.ok(Math.abs(a - b) <= tolerance, `${what}: ${a} and ${b}`);

/** Numbers that differ from call to call and not from run to run. */
function* draw(seed) {
  for (let x = seed;;) {
    x = (1103515245 * x + 12345) % 2147483648;
    yield x / 2147483648;
  }
}

const folder = mkdtempSync(join(tmpdir(), 'referee-'));
execFileSync(graspbench, ['run', '--object', 'cup,golf_ball', '--trials', '1', '--out', join(folder, 's')],
    {stdio: 'ignore'});
const records = exportSession(graspbench, join(folder, 's'));
const sceneOf = (hand, object, variant) =>
    new Scene(mujoco, records.find(r => r.hand === hand && r.object === object).scene, variant);
process.on('exit', () => rmSync(folder, {recursive: true, force: true}));

for (const hand of ['tum', 'shadow']) {
  const scene = sceneOf(hand, 'cup');
  const {model, data} = scene;
  const {mjOBJ_BODY, mjOBJ_JOINT, mjOBJ_ACTUATOR} = mujoco.mjtObj;
  const shown = ask(['hand', 'show', hand]);

  test(`${hand}: joints, ranges and drives are the hand's`, () => {
    assert.equal(model.njnt, shown.joints.length + 4 + 1);  // the arm's, the object's
    for (const joint of shown.joints) {
      const id = scene.find(mjOBJ_JOINT, joint.name);
      assert.ok(id >= 0, joint.name);
      near(model.jnt_range[2 * id], DEGREE * joint.lower_deg, 1e-9, joint.name);
      near(model.jnt_range[2 * id + 1], DEGREE * joint.upper_deg, 1e-9, joint.name);
      const drive = scene.find(mjOBJ_ACTUATOR, joint.name);
      assert.equal(drive >= 0, joint.coupled_to === undefined, joint.name);
      if (drive < 0) continue;
      near(model.actuator_gainprm[10 * drive], joint.stiffness_nm_per_rad, 1e-12, joint.name);
      near(-model.actuator_biasprm[10 * drive + 2], joint.damping_nms_per_rad, 1e-12, joint.name);
      near(model.actuator_forcerange[2 * drive + 1], joint.torque_limit_nm, 1e-12, joint.name);
    }
  });

  test(`${hand}: masses and inertias are those of hand.urdf`, () => {
    const urdf = readFileSync(join(ROOT, 'core/hand/models', hand, 'hand.urdf'), 'utf8');
    let number = 0;
    for (const [, name, text] of urdf.matchAll(/<link name="([^"]*)">([\s\S]*?)<\/link>/g)) {
      const mass = text.match(/<mass value="([^"]*)"/);
      const id = scene.find(mjOBJ_BODY, `hand/${name}`);
      if (!mass || id < 0) continue;
      ++number;
      near(model.body_mass[id], Number(mass[1]), 1e-12, name);
      const I = Object.fromEntries([...text.matchAll(/\b(i[xyz]{2})="([^"]*)"/g)].map(m => [m[1], Number(m[2])]));
      const theirs = Array.from(model.body_inertia.slice(3 * id, 3 * id + 3));
      const trace = I.ixx + I.iyy + I.izz;
      near(theirs.reduce((a, b) => a + b), trace, 1e-6 * trace, `${name}, trace`);
      const det = I.ixx * (I.iyy * I.izz - I.iyz ** 2) - I.ixy * (I.ixy * I.izz - I.iyz * I.ixz) +
          I.ixz * (I.ixy * I.iyz - I.iyy * I.ixz);
      near(theirs.reduce((a, b) => a * b), det, 1e-6 * det, `${name}, determinant`);
    }
    assert.ok(number > 8, `${number} links`);
    const object = scene.objectBody;
    near(model.body_mass.reduce((a, b) => a + b) - model.body_mass[object], shown.mass_kg, 2e-6, 'hand');
  });

  test(`${hand}: links stand where graspbench's kinematics puts them`, () => {
    const random = draw(7);
    for (let pose = 0; pose < 10; ++pose) {
      const names = [];
      for (const joint of shown.joints) {
        if (joint.coupled_to !== undefined) continue;
        const angle = joint.lower_deg + random.next().value * (joint.upper_deg - joint.lower_deg);
        names.push(`${joint.name}=${angle}`);
        data.qpos[model.jnt_qposadr[scene.find(mjOBJ_JOINT, joint.name)]] = DEGREE * angle;
      }
      for (const joint of shown.joints) {
        if (joint.coupled_to === undefined) continue;
        const at = name => model.jnt_qposadr[scene.find(mjOBJ_JOINT, name)];
        data.qpos[at(joint.name)] = shown.coupling === 'even' ? data.qpos[at(joint.coupled_to)] : 0;
      }
      mujoco.mj_kinematics(model, data);
      const expected = ask(['hand', 'fk', hand, '--joints', names.join(',')]);
      const palm = scene.bodyPose(scene.palmBody);
      const inPalm = v => [0, 1, 2].map(i => [0, 1, 2].reduce((s, k) => s + palm.matrix[3 * k + i] * v[k], 0));
      let digits = 0;
      for (const [digit, pose_] of Object.entries(expected)) {
        const name = scene.geomNames.filter(n => n.startsWith(`${digit}/`)).pop().split('/')[1];
        const link = scene.bodyPose(scene.find(mjOBJ_BODY, `hand/${name}`));
        const place = inPalm(link.place.map((x, i) => x - palm.place[i]));
        for (let i = 0; i < 3; ++i) near(place[i], pose_.p_m[i], 1e-9, `${digit}, pose ${pose}`);
        for (let column = 0; column < 3; ++column) {
          const turned = inPalm([0, 1, 2].map(row => link.matrix[3 * row + column]));
          for (let i = 0; i < 3; ++i) near(turned[i], pose_.R[i][column], 1e-9, `${digit}, R`);
        }
        ++digits;
      }
      assert.equal(digits, shown.digits.length);
    }
  });
  test.after?.(() => scene.delete());
}

test('the object has the mass of object.yaml and the inertia of its mesh', () => {
  const scene = sceneOf('tum', 'golf_ball');
  const {model, objectBody: id} = scene;
  const yaml = readFileSync(join(ROOT, 'objects/catalogue/golf_ball/object.yaml'), 'utf8');
  const mass = Number(yaml.match(/mass_kg: (\S+)/)[1]);
  near(model.body_mass[id], mass, 1e-12, 'mass');
  const p = [], faces = [];
  const obj = readFileSync(join(ROOT, 'objects/catalogue/golf_ball/mesh.obj'), 'utf8');
  for (const line of obj.split('\n')) {
    const [kind, ...cells] = line.split(/\s+/);
    if (kind === 'v') p.push(cells.slice(0, 3).map(x => Number(x) / 1000));
    if (kind === 'f') faces.push(cells.slice(0, 3).map(x => parseInt(x, 10) - 1));
  }
  // Sum of signed tetrahedra against the origin, about which the ball's mesh is centred.
  let volume = 0, moment = 0;
  for (const [a, b, c] of faces.map(f => f.map(i => p[i]))) {
    const six = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
        a[2] * (b[0] * c[1] - b[1] * c[0]);
    volume += six / 6;
    for (let i = 0; i < 3; ++i) {
      moment += six / 60 * (a[i] ** 2 + b[i] ** 2 + c[i] ** 2 + a[i] * b[i] + a[i] * c[i] + b[i] * c[i]);
    }
  }
  const trace = 2 * mass / volume * moment;
  const theirs = model.body_inertia.slice(3 * id, 3 * id + 3).reduce((a, b) => a + b);
  near(theirs, trace, 1e-3 * trace, 'trace of the inertia');  // the centre of mass is that of the file
  near(scene.objectRadius(), Math.max(...p.map(v => Math.hypot(...v))), 2e-5, 'radius');
  scene.delete();
});

test('friction is that of object.yaml, torsion on pads alone is that of hand.yaml', () => {
  const read = (path, key) => Number(readFileSync(join(ROOT, path), 'utf8').match(new RegExp(`${key}: (\\S+)`))?.[1]);
  const mu = read('objects/catalogue/golf_ball/object.yaml', 'friction_static');
  for (const hand of ['tum', 'shadow']) {
    const scene = sceneOf(hand, 'golf_ball'), {model, geomNames} = scene;
    // Of soft pads, as the Shadow Hand has on every link, the patch decides the radius: no number of the file.
    const radius = read(`core/hand/models/${hand}/hand.yaml`, 'pad_torsion_radius_m');
    const pads = new Set();
    geomNames.forEach((name, geom) => {
      if (!name || name === 'table' || name.startsWith('object/')) return;
      const hasTorsion = model.geom_condim[geom] === 4;
      near(model.geom_friction[3 * geom], mu, 1e-12, name);
      if (!Number.isNaN(radius)) near(model.geom_friction[3 * geom + 1], hasTorsion ? mu * radius : 0, 1e-12, name);
      if (hasTorsion) pads.add(name.split('/').slice(0, 2).join('/'));
    });
    if (!Number.isNaN(radius)) assert.equal(pads.size, ask(['hand', 'show', hand]).digits.length, [...pads].join(' '));
    near(model.geom_friction[3 * scene.table], 0.4, 1e-12, 'table');
    scene.delete();
  }
});

test('the trial starts without contact of the hand, the object at rest on the table', () => {
  for (const record of records) {
    const scene = new Scene(mujoco, record.scene);
    scene.readContacts();
    assert.deepEqual(scene.contacts.filter(c => c.digit !== 'table'), [], record.trial_id);
    for (let t = 0; t < 0.02; t += scene.step) scene.advance(scene.motion[1]);
    near(scene.objectPose().place[2], Number(scene.xml.match(/name="object" pos="\S+ \S+ ([^"]*)"/)[1]), 5e-4,
        'height');
    scene.delete();
  }
});

test('the commanded motion has the phases of the record and ends at the lift height', () => {
  for (const record of records) {
    const scene = new Scene(mujoco, record.scene);
    const rows = scene.motion, closure = rows.find(row => row.phase === 'closure').time_s;
    for (const {name, time_s: time} of record.result.phases.filter(phase => phase.name !== 'done')) {
      const started = rows.find(row => row.phase === name).time_s;
      near(started - closure, time, 0.0021, `${record.trial_id} ${name}`);
    }
    const lift = rows.findIndex(row => row.phase === 'lift-off');
    near(rows.at(-1).arm_z_m - rows[lift].arm_z_m, scene.liftDistance, 1e-4, 'lift');
    scene.delete();
  }
});

test('the arm carries the hand without load, and gives way as a spring of its stiffness', () => {
  for (const hand of ['tum', 'shadow']) {
    const scene = sceneOf(hand, 'cup'), {data} = scene;
    const settle = () => {
      for (let t = 0; t < 0.3; t += scene.step) scene.advance(scene.motion[0], false);
      return Array.from(data.qpos.slice(0, 7));
    };
    const free = settle();
    for (const axis of [0, 1, 2]) near(free[axis], 0, 2e-5, `${hand}, place`);
    near(2 * Math.hypot(free[4], free[5], free[6]), 0, 2e-5, `${hand}, turn`);
    data.qfrc_applied[2] = 20;
    const pushed = settle();
    near(pushed[2] - free[2], 20 / 2e4, 1e-5, `${hand}, 20 N`);
    assert.equal(scene.isArmOverloaded(), false);
    data.qfrc_applied[2] = 120;
    settle();
    assert.equal(scene.isArmOverloaded(), true);
    scene.delete();
  }
});

test('every variant differs from what was written and can be opened', () => {
  for (const hand of ['tum', 'shadow']) {
    const written = sceneOf(hand, 'cup');
    for (const variant of VARIANTS.slice(1)) {
      const other = sceneOf(hand, 'cup', variant);
      assert.notEqual(other.xml, written.xml, variant);
      other.delete();
    }
    written.delete();
  }
});

test('the same trial gives the same bits', () => {
  const end = () => {
    const scene = sceneOf('shadow', 'cup');
    for (let i = 1; i < 150; ++i) scene.advance(scene.motion[i]);
    const qpos = Array.from(scene.data.qpos);
    scene.delete();
    return qpos;
  };
  assert.deepEqual(end(), end());
});
