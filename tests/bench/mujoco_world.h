#pragma once
/** @file
The scene of a trial in MuJoCo, behind the interface of our own world, so that the very same course
of a trial runs on it and is judged by the same rules.

The same: links, masses, inertias, axes, limits, drives (stiffness, torque limit, damping), coupled
joints and the rule by which they move, spheres against object and table, capsules against each
other without friction, the root's course, mass and centre of mass of the object, gravity. Where the
two differ, MuJoCo is spared work:

- the object is a sphere, cylinder or box of the object's size; ours is queried as a distance field;
- friction is the static coefficient only;
- the damping of a drive does not count against its torque limit;
- two links whose capsules touch in the rest posture are never looked at.

The root has one slide joint, or two when it comes from the side, of 1e6 kg, whose course is set at
every step: MuJoCo's own mocap bodies have no speed, and would let friction hold the object back. */

#include <memory>
#include <string>
#include <vector>

#include "core/physics/world.h"

namespace graspbench {

enum class PrimitiveShape { kSphere, kCylinder, kBox };  ///< cylinder along z

/** What a user sets in MuJoCo. The defaults are an expert's; with 50 passes to no tolerance it does
not creep, with a geom per ball it has our points of contact. */
struct MujocoConfig {
  double step = 0.002;           ///< [s]
  double impratio = 100.0;       ///< stiffness of friction over that of normal contact
  double time_constant = 0.005;  ///< of contacts, limits and equalities (solref) [s]
  double impedance_min = 0.95, impedance_max = 0.99;  ///< solimp
  /** One geom per capsule of a link in place of one per ball; links then rub on each other. */
  bool has_capsules_only = true;
  int noslip_iterations = 5;
  double noslip_tolerance = 1e-6;
};

class MujocoWorld : public World {
 public:
  /** @param approach_W  unit; the root moves along it and along z. */
  MujocoWorld(const Hand& hand, const GraspObject& object, PrimitiveShape shape,
              const SimConfig& sim, const MujocoConfig& config, const Eigen::Vector3d& approach_W);
  ~MujocoWorld() override;

  // Nothing but a trial and its repetition is asked of this world.
  std::unique_ptr<World> Clone() const override;                                  ///< kUnsupported
  void SetGravity(const Eigen::Vector3d&) override;                               ///< kUnsupported
  void SetExternalLoad(const Eigen::Vector3d&, const Eigen::Vector3d&) override;  ///< kUnsupported

  void Reset(const WorldState& state) override;
  StepReport Step(const WorldCommand& command) override;
  void FindHandContacts(std::vector<HandContact>& contacts) const override;
  double CalcEnergyResidual() override;  ///< NaN: not known

  /** Brings dynamics() to the state, as a regulated grip needs it after each step. MuJoCo does not
  need it, so that it is no part of a step. */
  void UpdateDynamics();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace graspbench
