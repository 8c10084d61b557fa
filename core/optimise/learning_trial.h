#pragma once
/** @file
What the optimisation keeps of a simulated trial, and the fitness it takes from it:

    sigma     sigma (core/trial/measures/stability.h), which is 0 when the object is lost,
              times G / g when the hand grips with g, more than the grip G that it may use
              (g: sum of its normal forces in the hold [N]), or
              - the opposing digit's smallest distance to the object [m] when that digit never
              touches, so that a thumb in the air is led towards the object
    strength  TrialResult::strength [N], of a held object times G / g, too, of a lost one minus
              1 N/m times the same distance

and for several trials their mean. Larger is better. Strength is found by pulling, with the grip
regulated on and drives that yield; sigma by statics beforehand. A trial that has a strength counts
with it. All contact forces at a posture grow about as one, so a pull that is withstood by squeezing
twice as hard is worth half; a grasp that needs less grip than it may use gains nothing by that. */

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/text/json.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_result.h"

namespace graspbench {

struct LearningTrial;
/** What is kept of the grasping digits, one object each. */
Json LearningDigitsToJson(const LearningTrial& trial);
void ReadLearningDigits(const Json& json, LearningTrial& trial);

struct LearningTrial {
  int draw = 0;  ///< number of the learning draw: 0 without any variation
  Outcome outcome = Outcome::kNotRun;
  double sigma = 0.0;
  StabilityPart stability;             ///< of the hold, from which sigma comes
  std::vector<DigitContact> contacts;  ///< of the grasping digits
  std::vector<double> closings;        ///< s at their first touch; NaN: never
  /** Joints of the whole hand at those touches (num_joints) [rad]; empty for a digit that never
  touched. No element unless they were asked for. */
  std::vector<Eigen::VectorXd> touch_postures;
  double opposing_gap = 0.0;       ///< smallest distance of the opposing digit [m]
  std::optional<double> strength;  ///< where it was asked for [N]
  ContactTiming timing;

  template <class V>
  static void ListFields(V&& field) {
    using T = LearningTrial;
    field("draw", &T::draw);
    field("outcome", &T::outcome);
    field("sigma", &T::sigma);
    field("quality", &T::stability, &StabilityPart::quality);
    field("normal_force_n", &T::stability, &StabilityPart::normal_force);
    field("slip_speed_m_per_s", &T::stability, &StabilityPart::slip_speed);
    field("opposition", &T::stability, &StabilityPart::opposition);
    field("opposing_gap_m", &T::opposing_gap);
    field("strength_n", &T::strength);
    field("digits", &LearningDigitsToJson, &ReadLearningDigits);
  }
};

/** @param keep_postures  those of the first touches, from which step 1 learns. */
LearningTrial MakeLearningTrial(int draw, const TrialResult& result, bool keep_postures);

/** A grip that no hand reaches [N]. */
inline constexpr double kAnyGrip = std::numeric_limits<double>::infinity();

/** @param grip_limit  G [N]. */
double CalcFitness(const LearningTrial& trial, double grip_limit = kAnyGrip);
/** The mean. @pre at least one. */
double CalcFitness(const std::vector<LearningTrial>& trials, double grip_limit = kAnyGrip);

/** Those of each trial, in their order; empty where the simulation failed. */
std::vector<std::vector<DigitContact>> ListContacts(const std::vector<LearningTrial>& trials);
int CountSuccesses(const std::vector<LearningTrial>& trials);
/** Mean of what the grasps stand, 0 where the object is lost [N]; NaN when it was never asked for.
*/
double CalcMeanStrength(const std::vector<LearningTrial>& trials);
/** Mean grip in the hold, of the trials that got there [N]; NaN without any. */
double CalcMeanGrip(const std::vector<LearningTrial>& trials);

Json ToJson(const LearningTrial& trial);
/** @throws Json::exception or Error(kFormat). Gives back the very same numbers. */
LearningTrial LearningTrialFromJson(const Json& json);

/** How much of what friction and grip allow a grasp uses, so that nobody asks a search for more:

    bound = mu_s N - m g      [N]

with N the sum of the hand's normal forces in the hold and m g the object's weight: pulled straight
down, contacts whose normals are horizontal resist with friction alone, at most mu_s times their
normal force each, of which the weight has its part. The weakest of the six pulls (learning_trial.h)
of a grasp by an object's sides is no larger, whichever digits press how much (Coulomb). At
equal grip no other grasp by the sides gets more than 1 / share of what this one has.

Blind to: a hand that reaches beneath the object or around a bar, which may have a share above 1;
digits that press harder when the object is pushed into them; moments and pulls along the fingers,
which may end a grasp earlier.

At least 0. @param normal_force  N [N].  @param weight  m g [N]. */
double CalcFrictionBound(double normal_force, double friction, double weight);

struct Headroom {
  double bound = 0.0;  ///< mean over the trials that held [N]; NaN: none did
  /** Mean strength (sigma where it was not asked for) of the trials that held, over the bound. */
  double share = 0.0;
};
/** By what factor a grasp by the sides may be stronger at equal grip: 1 / share, at least 1. */
double CalcMostGain(double share);

/** @param gravity  [m/s^2] */
Headroom CalcHeadroom(const std::vector<LearningTrial>& trials, const GraspObject& object,
                      double gravity);

}  // namespace graspbench
