// MuJoCo, or null with a line that says what is missing.

export async function loadMujoco() {
  if (Number(process.versions.node.split('.')[0]) < 18) {
    console.log(`skipped: Node ${process.versions.node}, needs 18 or newer`);
    return null;
  }
  try {
    return await (await import('@mujoco/mujoco')).default();
  } catch (error) {
    if (error.code !== 'ERR_MODULE_NOT_FOUND') throw error;
    console.log('skipped: @mujoco/mujoco is not installed; run npm ci in tests/peer');
    return null;
  }
}
