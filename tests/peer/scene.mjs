// A trial that `graspbench export DIR --mjcf TRIAL` wrote, carried out in MuJoCo.
//
// What this file does beside stepping: it gives the actuators the commanded motion, and for hands
// whose distal joints follow their middle joints "middle-first" it decides which of each pair is
// locked (the rule is told in core/hand/coupling.h).

import {readFileSync} from 'node:fs';
import {join} from 'node:path';

const EQUALITY_STATE = 512;      // mjSTATE_EQ_ACTIVE: data.eq_active itself cannot be read in 3.14
const EQUALITY_NUMBERS = 11;     // mjNEQDATA
const DEGREE = Math.PI / 180;
const RELEASE_TIME = 0.02;       // a link that let go for this long no longer blocks its finger [s]

/** The rows of motion.csv as objects of numbers; `phase` stays text. */
export function readMotion(path) {
  const [heading, ...lines] = readFileSync(path, 'utf8').trim().split('\n');
  const names = heading.split(',');
  return lines.map(line => Object.fromEntries(
      line.split(',').map((cell, i) => [names[i], names[i] === 'phase' ? cell : Number(cell)])));
}

/** Changes that a variant of the referee makes in the file's text. */
const EDITS = {
  as_written: xml => xml,
  // The balls of graspbench collide in place of the capsules.
  balls: xml => xml.replace(/<geom name="[^"]*\/[^"]*"[^>]*type="(capsule|sphere)"[^>]*>/g, geom =>
      /group="3"/.test(geom) ?
          geom.replace(/contype="0" conaffinity="0"/, '') :
          geom.replace(/\/>$/, ' contype="0" conaffinity="0"/>')),
  sliding_friction: xml => scaleFriction(
      xml, readNumber(xml, 'friction_dynamic') / readObjectFriction(xml)),
  friction_up: xml => scaleFriction(xml, 1.1),
  friction_down: xml => scaleFriction(xml, 1 / 1.1),
  half_step: xml => xml.replace(/timestep="([^"]*)"/, (_, step) => `timestep="${step / 2}"`),
  stiff_contact: xml => xml.replace(/solimp="0.95 0.99 0.001"/, 'solimp="0.99 0.998 0.001"'),
};
export const VARIANTS = Object.keys(EDITS);

function readNumber(xml, name) {
  return Number(xml.match(new RegExp(`<numeric name="${name}" data="([^"]*)"`))[1]);
}

function readText(xml, name) {
  return xml.match(new RegExp(`<text name="${name}" data="([^"]*)"`))[1];
}

function readObjectFriction(xml) {
  return Number(xml.match(/<geom name="object\/0"[^>]*friction="([^ "]*)/)[1]);
}

function scaleFriction(xml, factor) {
  return xml.replace(/(<geom name="(?!table)[^>]*friction=")([^"]*)"/g, (_, head, numbers) =>
      `${head}${numbers.split(' ').map(x => x * factor).join(' ')}"`);
}

export class Scene {
  /** @param folder with scene.xml and motion.csv */
  constructor(mujoco, folder, variant = 'as_written') {
    this.mujoco = mujoco;
    this.xml = EDITS[variant](readFileSync(join(folder, 'scene.xml'), 'utf8'));
    this.motion = readMotion(join(folder, 'motion.csv'));
    this.model = mujoco.MjModel.from_xml_string(this.xml);
    this.data = new mujoco.MjData(this.model);
    mujoco.mj_resetDataKeyframe(this.model, this.data, 0);
    mujoco.mj_forward(this.model, this.data);
    const {mjOBJ_BODY, mjOBJ_GEOM, mjOBJ_JOINT, mjOBJ_ACTUATOR, mjOBJ_EQUALITY} = mujoco.mjtObj;
    this.find = (type, name) => mujoco.mj_name2id(this.model, type.value, name);
    this.geomNames = Array.from({length: this.model.ngeom},
        (_, i) => mujoco.mj_id2name(this.model, mjOBJ_GEOM.value, i));
    this.objectBody = this.find(mjOBJ_BODY, 'object');
    this.palmBody = this.find(mjOBJ_BODY, readText(this.xml, 'palm'));
    this.table = this.find(mjOBJ_GEOM, 'table');
    this.objectJoint = this.find(mjOBJ_JOINT, 'object');
    this.step = this.model.opt.timestep;
    this.armForceLimit = readNumber(this.xml, 'arm_force_limit_n');
    this.armMomentLimit = readNumber(this.xml, 'arm_moment_limit_nm');
    this.liftDistance = readNumber(this.xml, 'lift_distance_m');
    this.graspingDigits = readText(this.xml, 'grasping_digits').split(' ');
    this.actuators = Object.keys(this.motion[0]).filter(name => name !== 'phase' && name !== 'time_s')
        .map(name => ({column: name, index: this.find(mjOBJ_ACTUATOR, actuatorOf(name))}));
    for (const {column, index} of this.actuators) {
      if (index < 0) throw new Error(`${folder}: motion.csv moves ${column}, scene.xml has no such actuator`);
    }
    this.pairs = this.findPairs(mjOBJ_JOINT, mjOBJ_EQUALITY);
    this.contacts = [];
  }

  delete() {
    this.data.delete();
    this.model.delete();
  }

  /** Pairs of joints of which one is locked. */
  findPairs(joints, equalities) {
    const pairs = [];
    for (const [, middle, distal] of this.xml.matchAll(/<fixed name="([^"+]*)\+([^"]*)"/g)) {
      const middleJoint = this.find(joints, middle), distalJoint = this.find(joints, distal);
      const middleBody = this.model.jnt_bodyid[middleJoint];
      pairs.push({
        command: `${middle}_rad`,
        middle: this.model.jnt_qposadr[middleJoint],
        distal: this.model.jnt_qposadr[distalJoint],
        upper: this.model.jnt_range[2 * middleJoint + 1],
        lockMiddle: this.find(equalities, `lock/${middle}`),
        lockDistal: this.find(equalities, `lock/${distal}`),
        bodies: [middleBody, this.model.body_parentid[middleBody]],
        distalMoves: false,
        blockedAt: -Infinity,
      });
    }
    return pairs;
  }

  /** Which joint of a pair moves: the middle one until it is blocked or at its end. */
  chooseLocks(command) {
    const {qpos, time} = this.data;
    let changed = false;
    for (const pair of this.pairs) {
      if (this.contacts.some(c => pair.bodies.includes(c.body))) pair.blockedAt = time;
      const closing = command[pair.command] > qpos[pair.middle] + qpos[pair.distal];
      const isBlocked = time - pair.blockedAt < RELEASE_TIME;
      const isAtEnd = qpos[pair.middle] >= pair.upper - (pair.distalMoves ? 1.0 : 0.5) * DEGREE;
      const distalMoves = closing ? (isBlocked || isAtEnd) && qpos[pair.distal] < qpos[pair.middle] :
                                    qpos[pair.distal] > 0;
      if (distalMoves === pair.distalMoves) continue;
      pair.distalMoves = distalMoves;
      const lock = distalMoves ? pair.lockMiddle : pair.lockDistal;
      this.model.eq_data[EQUALITY_NUMBERS * lock] = qpos[distalMoves ? pair.middle : pair.distal];
      changed = true;
    }
    if (!changed) return;
    const active = new Float64Array(this.model.neq).fill(1);
    for (const pair of this.pairs) {
      active[pair.lockMiddle] = pair.distalMoves ? 1 : 0;
      active[pair.lockDistal] = pair.distalMoves ? 0 : 1;
    }
    this.mujoco.mj_setState(this.model, this.data, active, EQUALITY_STATE);
  }

  /** One step towards a row of the motion; looking at the contacts takes as long as the step. */
  advance(command, looks = true) {
    this.chooseLocks(command);
    const ctrl = this.data.ctrl;
    for (const {column, index} of this.actuators) ctrl[index] = command[column];
    this.mujoco.mj_step(this.model, this.data);
    if (looks) this.readContacts();
  }

  /** The arm gives as much force or moment as it can. */
  isArmOverloaded() {
    const {qfrc_actuator: force, qfrc_spring: spring, qfrc_damper: damper} = this.data;
    for (let i = 0; i < 3; ++i) {  // slides first, then the ball
      if (Math.abs(force[i]) >= this.armForceLimit) return true;
      if (Math.abs(spring[3 + i] + damper[3 + i]) >= this.armMomentLimit) return true;
    }
    return false;
  }

  /** Contacts of the object with a force: {digit, body, force, depth}; the table is "table". */
  readContacts() {
    this.contacts = [];
    const all = this.data.contact;
    for (let i = 0; i < this.data.ncon; ++i) {
      const contact = all.get(i);
      const {geom1, geom2, dist, efc_address: address} = contact;
      contact.delete();
      if (address < 0) continue;
      const first = this.model.geom_bodyid[geom1], second = this.model.geom_bodyid[geom2];
      if (first !== this.objectBody && second !== this.objectBody) continue;
      const other = first === this.objectBody ? geom2 : geom1;
      const force = this.data.efc_force[address];
      if (!(force > 0)) continue;
      this.contacts.push({
        digit: other === this.table ? 'table' : this.geomNames[other].split('/')[0],
        body: this.model.geom_bodyid[other], force, depth: -dist,
      });
    }
    all.delete();
  }

  /** Farthest point of the object from its centre of mass [m]. */
  objectRadius() {
    const body = this.xml.slice(this.xml.indexOf('<body name="object"'));
    const centre = body.match(/<inertial mass="[^"]*" pos="([^"]*)"/)[1].split(' ').map(Number);
    let radius = 0;
    for (const [, text] of this.xml.matchAll(/<mesh [^>]*vertex="([^"]*)"/g)) {
      const v = text.split(' ').map(Number);
      for (let i = 0; i < v.length; i += 3) {
        radius = Math.max(radius, Math.hypot(v[i] - centre[0], v[i + 1] - centre[1], v[i + 2] - centre[2]));
      }
    }
    return radius;
  }

  /** Place and rotation (rows) of a body. */
  bodyPose(body) {
    const {xpos, xmat} = this.data;
    return {
      place: Array.from(xpos.slice(3 * body, 3 * body + 3)),
      matrix: Array.from(xmat.slice(9 * body, 9 * body + 9)),
    };
  }

  /** The object's pose, with the place of its centre of mass. */
  objectPose() {
    const b = this.objectBody;
    return {...this.bodyPose(b), centre: Array.from(this.data.xipos.slice(3 * b, 3 * b + 3))};
  }
}

/** "arm_x_m" moves arm/x, "arm_x_m_per_s" its speed, "FFJ3_rad" the joint FFJ3. */
function actuatorOf(column) {
  const arm = column.match(/^arm_([xyz])_m(_per_s)?$/);
  if (arm) return `arm/${arm[1]}${arm[2] ? '/speed' : ''}`;
  return column.replace(/_rad$/, '');
}
