// The benchmark's rule of success, written anew from the README: after the lift the object has left
// the table and stays in the hand through the hold, without touching the table, and at its end it
// moves by less than 5 mm/s against the palm, less than 1 mm deep in the hand, and the arm was never
// overloaded.

const LIFTED_SHARE = 0.5;     // of the lift's height
const STEADY_SPEED = 0.005;   // [m/s]
const STEADY_DEPTH = 0.001;   // [m]
const SPEED_TIME = 0.05;      // over which the speed at the end is taken [s]
const LOOK_INTERVAL = 5;      // rows of the motion between two looks at the contacts of a grip

const norm = v => Math.hypot(...v);
const minus = (a, b) => a.map((x, i) => x - b[i]);

/** Turn from one rotation matrix to another [rad]. */
function angleBetween(a, b) {
  const trace = a.reduce((sum, x, i) => sum + x * b[i], 0);
  return Math.acos(Math.min(1, Math.max(-1, (trace - 1) / 2)));
}

/** Carries out the whole motion of a scene and says what came of it. */
export function runTrial(scene) {
  const {motion} = scene;
  const substeps = Math.round((motion[1].time_s - motion[0].time_s) / scene.step);
  const closureStart = motion.find(row => row.phase === 'closure').time_s;
  const liftRow = motion.findIndex(row => row.phase === 'lift-off');
  const start = scene.objectPose();
  const firstTouch = {};
  let phase = '', grip = 0, closedGrip = 0, tableInHold = false, settled = null, before = null;
  let holdStart = 0, holdEnd = motion[motion.length - 1].time_s, worstDepth = 0;
  let isOverloaded = false, touchedHeight = null, closureRise = null;
  const holdGrips = [];

  for (let row = 1; row < motion.length; ++row) {
    const command = motion[row], isLast = row === motion.length - 1;
    if (command.phase !== phase) {
      phase = command.phase;
      if (phase === 'lift-off') {
        closedGrip = grip;
        if (touchedHeight !== null) closureRise = heightInHand(scene) - touchedHeight;
      }
      if (phase === 'hold') holdStart = scene.data.time;
    }
    for (let k = 1; k <= substeps; ++k) {
      const grasps = scene.graspingDigits.every(digit => digit in firstTouch);
      const looks = k === substeps && (!grasps || isLast || row % LOOK_INTERVAL === 0);
      scene.advance(substeps === 1 ? command : mix(motion[row - 1], command, k / substeps), looks);
    }
    if (!before && scene.data.time >= holdEnd - SPEED_TIME) {
      before = {...relativePose(scene), time: scene.data.time};
    }
    isOverloaded ||= scene.isArmOverloaded();
    const hand = scene.contacts.filter(contact => contact.digit !== 'table');
    grip = hand.reduce((sum, contact) => sum + contact.force, 0);
    if (touchedHeight === null && hand.length > 0) touchedHeight = heightInHand(scene);
    for (const contact of hand) {
      if (row < liftRow) firstTouch[contact.digit] ??= scene.data.time - closureStart;
      worstDepth = Math.max(worstDepth, contact.depth);
    }
    if (phase === 'hold') {
      if (row % LOOK_INTERVAL === 0) holdGrips.push(grip);
      if (hand.length < scene.contacts.length) tableInHold = true;
      if (!settled && scene.data.time >= 0.5 * (holdStart + holdEnd)) settled = relativePose(scene);
    }
  }

  const end = scene.objectPose(), held = relativePose(scene);
  const rise = end.place[2] - start.place[2];
  const speed = norm(minus(held.place, before.place)) / (scene.data.time - before.time);
  const isFinite = Number.isFinite(rise) && Number.isFinite(speed);
  const isLifted = rise > LIFTED_SHARE * scene.liftDistance;
  const depth = Math.max(0, ...scene.contacts.filter(c => c.digit !== 'table').map(c => c.depth));
  const isHeld = isFinite && isLifted && grip > 0 && !tableInHold;
  const isSteady = isHeld && speed <= STEADY_SPEED;
  const success = isSteady && depth <= STEADY_DEPTH && !isOverloaded;
  return {
    success,
    outcome: success ? 'success' : !isFinite ? 'not finite' : isOverloaded ? 'arm overloaded' :
        isSteady ? 'not physical' : isHeld ? 'moving in the hand' :
        isLifted ? 'lost while holding' : 'left behind',
    firstTouch, closedGrip, closureRise,
    holdGrip: holdGrips.reduce((sum, force) => sum + force, 0) / holdGrips.length,
    rise, speed, worstDepth,
    steadyDepth: success ? depth : null,
    creep: success ? norm(minus(held.place, settled.place)) +
        scene.objectRadius() * angleBetween(held.matrix, settled.matrix) : null,
  };
}

/** Of the object's centre of mass above the palm's origin [m]. */
const heightInHand = scene => scene.objectPose().centre[2] - scene.bodyPose(scene.palmBody).place[2];

/** Of the object's centre of mass in the palm's frame. */
function relativePose(scene) {
  const pose = scene.objectPose(), palm = scene.bodyPose(scene.palmBody);
  const column = (matrix, i) => [matrix[i], matrix[3 + i], matrix[6 + i]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const offset = minus(pose.centre, palm.place);
  const matrix = [];
  for (let i = 0; i < 3; ++i) {
    for (let j = 0; j < 3; ++j) matrix.push(dot(column(palm.matrix, i), column(pose.matrix, j)));
  }
  return {place: [0, 1, 2].map(i => dot(column(palm.matrix, i), offset)), matrix};
}

function mix(a, b, share) {
  const row = {};
  for (const key of Object.keys(b)) {
    row[key] = typeof b[key] === 'number' ? a[key] + share * (b[key] - a[key]) : b[key];
  }
  return row;
}
