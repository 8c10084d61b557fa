#pragma once
/** @file
Bodies and small hands made in code, with masses, forces and shapes in closed form: the scenes of
the known answers and of the tests. */

#include <functional>

#include "core/hand/hand.h"
#include "core/physics/implicit_world.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

/** Returns the default configuration with another step [s]. */
SimConfig MakeStepConfig(double step);
inline constexpr double kAnswerSteps[] = {0.0005, 0.001, 0.002, 0.004};  ///< for most answers [s]
std::string FormatStep(double step);                                     ///< "step 500 us"

/** Makes a solid from this mesh, with its own distance field; `size` is that of its bounding
box. */
GraspObject MakeSolid(TriMesh mesh, double mass, double mu_s, double mu_d);

/** Makes a box of 60 x 40 x 20 mm. */
GraspObject MakeBlock(double mass);

/** Makes an upright prism with `num_sides` flat sides at distance `apothem` from its axis; the
normal of the first side is x. */
TriMesh MakePrism(int num_sides, double apothem, double height);

/** Makes a hand that is only a root, so heavy that it does not move. */
Hand MakeBareHand();

/** Appends a link along its z axis that turns about `axis` at X_PJ, without drive, limits or
surface. */
void AddRodLink(Hand& hand, int parent, const Pose& X_PJ, const Eigen::Vector3d& axis, double mass,
                double length);

/** Makes fingers around the vertical axis, evenly spaced from x on. Each is one ball that is
pressed inwards with `force`, its contact point at distance `radius` from the axis. The contact
point is directly below the finger's pivot. So neither friction nor gravity has a moment about the
pivot, and the normal force is exactly the drive's torque divided by the lever. H is kSqueezeLever
above the contacts. */
Hand MakeSqueezeHand(int num_fingers, double radius, double force, double pad_torsion_radius);
inline constexpr double kSqueezeLever = 0.1;  ///< [m]

/** A hand, an object and a constant command. */
class SmallWorld {
 public:
  SmallWorld(const SmallWorld&) = delete;  // the world refers to the hand stored here
  SmallWorld(Hand hand, GraspObject object, const SimConfig& config);
  /** A single body; the hand's root is 10 m above. */
  SmallWorld(GraspObject object, const SimConfig& config);

  WorldState& start() { return start_; }  ///< initially at rest with all joints at zero
  /** Restarts at start(); the drives are commanded to `q`. */
  void Reset(const Eigen::VectorXd& q);
  void Reset() { Reset(start_.q); }

  StepReport Step();
  /** Steps for `duration` and returns the last report. */
  StepReport Run(double duration);
  /** Changes gravity linearly from its current value to `gravity_W`. */
  void RampGravity(const Eigen::Vector3d& gravity_W, double duration);

  const Hand& hand() const { return hand_; }
  ImplicitWorld& world() { return world_; }
  const WorldState& state() const { return world_.state(); }
  int num_unconverged() const { return num_unconverged_; }  ///< steps since Reset
  double CalcPotentialEnergy();  ///< of the hand's links, zero at z = 0 [J]

 private:
  Hand hand_;
  GraspObject object_;
  SimConfig config_;
  ImplicitWorld world_;
  WorldState start_;
  WorldCommand command_;
  int num_unconverged_ = 0;
};

/* An object that is squeezed by fingers of known force and then pulled by its weight: the scene
for thresholds of friction, of torsion and of pads. */

struct Squeeze {
  int num_fingers = 2;
  double force = 5.0;  ///< of each finger [N]
  double mass = 0.1;
  double mu = 0.5;
  double torsion_radius = 0.0;
  SoftPad pad;              ///< of the fingers
  double off_centre = 0.0;  ///< offset of the fingers along y from the object's centre [m]
  double step = 0.002;
};

/** Squeezes for 0.3 s without weight, then applies the weight slowly. */
class SqueezeScene {
 public:
  /** @param half_width  half the object's width between the fingers [m]. */
  SqueezeScene(const Squeeze& squeeze, GraspObject object, double half_width);

  SmallWorld& world() { return world_; }
  double CalcFall() const;  ///< [m]
  double CalcTilt() const;  ///< of the object's y axis from the horizontal [rad]

 private:
  SmallWorld world_;
};

/** Returns the value between `low` and `high` at which `holds` changes, to one part in 500 of
`high`; NaN if it does not change. */
double FindThreshold(double low, double high, const std::function<bool(double)>& holds);

}  // namespace graspbench
