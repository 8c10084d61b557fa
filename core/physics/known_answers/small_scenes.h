#pragma once
/** @file
Bodies and small hands made in code, with masses, forces and shapes known in closed form: the scenes
of the known answers and of the tests. */

#include <functional>

#include "core/hand/hand.h"
#include "core/physics/implicit_world.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

/** The defaults but for the step [s]. */
SimConfig MakeStepConfig(double step);
inline constexpr double kAnswerSteps[] = {0.0005, 0.001, 0.002, 0.004};  ///< of most answers [s]
std::string FormatStep(double step);                                     ///< "step 500 us"

/** A solid of this mesh with its own distance field; `size` is that of its bounding box. */
GraspObject MakeSolid(TriMesh mesh, double mass, double mu_s, double mu_d);

/** A box of 60 x 40 x 20 mm. */
GraspObject MakeBlock(double mass);

/** An upright prism with `num_sides` flat sides at distance `apothem` from its axis; the normal of
the first is x. */
TriMesh MakePrism(int num_sides, double apothem, double height);

/** A root so heavy that it stays where it is, and nothing else. */
Hand MakeBareHand();

/** Appends a link along its z, turning about `axis` at X_PJ, without drive, limits or surface. */
void AddRodLink(Hand& hand, int parent, const Pose& X_PJ, const Eigen::Vector3d& axis, double mass,
                double length);

/** Fingers around the vertical axis, evenly spread from x on. Each is one ball that is pressed
inwards with `force`, its contact point at distance `radius` from the axis: it hangs straight below
the finger's pivot, so that neither friction nor gravity has a moment about the pivot and the normal
force is the drive's torque over the lever, exactly. H lies kSqueezeLever above the contacts. */
Hand MakeSqueezeHand(int num_fingers, double radius, double force, double pad_torsion_radius);
inline constexpr double kSqueezeLever = 0.1;  ///< [m]

/** A hand, an object and a command that does not change. */
class SmallWorld {
 public:
  SmallWorld(const SmallWorld&) = delete;  // the world refers to the hand beside it
  SmallWorld(Hand hand, GraspObject object, const SimConfig& config);
  /** A body alone; the hand's root hangs 10 m above. */
  SmallWorld(GraspObject object, const SimConfig& config);

  WorldState& start() { return start_; }  ///< at rest with all joints at zero unless changed
  /** Begins at start(); the drives are commanded to `q`. */
  void Reset(const Eigen::VectorXd& q);
  void Reset() { Reset(start_.q); }

  StepReport Step();
  /** Steps for `duration`; the last report. */
  StepReport Run(double duration);
  /** Lets gravity grow evenly from what it is to `gravity_W`. */
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

/* An object squeezed by fingers of known force that its weight then pulls on: the scene of
thresholds of friction, of torsion and of pads. */

struct Squeeze {
  int num_fingers = 2;
  double force = 5.0;  ///< of each finger [N]
  double mass = 0.1;
  double mu = 0.5;
  double torsion_radius = 0.0;
  SoftPad pad;              ///< of the fingers
  double off_centre = 0.0;  ///< of the fingers along y from the object's centre [m]
  double step = 0.002;
};

/** Squeezed without weight for 0.3 s, then the weight comes slowly. */
class SqueezeScene {
 public:
  /** @param half_width  of the object between the fingers. */
  SqueezeScene(const Squeeze& squeeze, GraspObject object, double half_width);

  SmallWorld& world() { return world_; }
  double CalcFall() const;  ///< [m]
  double CalcTilt() const;  ///< of the object's y axis from the horizontal [rad]

 private:
  SmallWorld world_;
};

/** The value between `low` and `high` at which `holds` changes, to one part in 500 of `high`; NaN:
it does not. */
double FindThreshold(double low, double high, const std::function<bool(double)>& holds);

}  // namespace graspbench
