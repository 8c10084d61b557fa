#include "core/physics/imperfect_drive.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graspbench {

void FollowWithHysteresis(double width, double command, DriveMemory& memory) {
  if (!memory.has_followed) memory.piston = command;
  memory.has_followed = true;
  memory.piston_before = memory.piston;
  memory.piston = std::clamp(memory.piston, command - 0.5 * width, command + 0.5 * width);
}

ScalarForce MakeDriveFriction(const JointDrive& drive, const DriveMemory& memory, int dof,
                              double h) {
  const double limit = memory.slides ? drive.friction_dynamic : drive.friction_static;
  return {dof, -kDriveBristleStiffness * memory.stretch,
          kDriveBristleStiffness * (h + kDriveBristleDampingTime), -limit, limit};
}

void FinishDriveFriction(const ScalarForce& friction, double v, double h, DriveMemory& memory) {
  const double tau = friction.offset - friction.gain * v;
  const bool is_at_limit = tau <= friction.lower || tau >= friction.upper;
  memory.stretch += h * v;
  if (is_at_limit) {
    memory.stretch = -std::clamp(tau, friction.lower, friction.upper) / kDriveBristleStiffness;
  }
  memory.slides = memory.slides ? std::abs(v) >= kStribeckSpeed : is_at_limit;
}

ScalarForce MakeCouplingForce(double compliance, double deviation, int dof, double h) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double stiffness = 1.0 / compliance;
  return {dof, -stiffness * deviation, stiffness * (0.5 * h + kCouplingDampingTime), -kInfinity,
          kInfinity};
}

}  // namespace graspbench
