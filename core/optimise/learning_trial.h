#pragma once
/** @file
The data of a simulated trial that the optimisation stores, and the fitness computed from it:

    sigma     sigma (core/trial/measures/stability.h), which is 0 if the object is lost, times G / g
              if the grip g exceeds the grip G that the hand may use (g: sum of its normal forces in
              the hold [N]); or minus the opposing digit's smallest distance from the object [m] if
              that digit never touches, to guide a thumb in the air towards the object
    strength  TrialResult::strength [N], also times G / g if the object is held; if it is lost,
              minus 1 N/m times the same distance

The fitness of several trials is their mean; larger is better. Strength is measured by pulling, with
the grip still regulated and compliant drives. Sigma is predicted by statics before a pull. If a
trial has a strength, this is its fitness. The contact forces of a posture grow approximately in
proportion, so a pull that is resisted by squeezing twice as hard counts half. A grasp that uses
less grip than allowed gains nothing. */

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/text/json.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_result.h"

namespace graspbench {

struct LearningTrial;
/** The stored data of the grasping digits, one JSON object per digit. */
Json LearningDigitsToJson(const LearningTrial& trial);
void ReadLearningDigits(const Json& json, LearningTrial& trial);

struct LearningTrial {
  int draw = 0;  ///< number of the learning draw; 0: without variation
  Outcome outcome = Outcome::kNotRun;
  double sigma = 0.0;
  StabilityPart stability;             ///< of the hold, from which sigma is computed
  std::vector<DigitContact> contacts;  ///< of the grasping digits
  std::vector<double> closings;        ///< s at their first touch; NaN: never
  /** Joints of the hand at those touches (num_joints) [rad]; empty for a digit that never touched.
  The list is empty unless postures were requested. */
  std::vector<Eigen::VectorXd> touch_postures;
  double opposing_gap = 0.0;       ///< smallest distance of the opposing digit from the object [m]
  std::optional<double> strength;  ///< only on request [N]
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

/** @param keep_postures  store the postures of first touches, from which step 1 learns. */
LearningTrial MakeLearningTrial(int draw, const TrialResult& result, bool keep_postures);

/** No limit of the grip [N]. */
inline constexpr double kAnyGrip = std::numeric_limits<double>::infinity();

/** @param grip_limit  G [N]. */
double CalcFitness(const LearningTrial& trial, double grip_limit = kAnyGrip);
/** Mean fitness. @pre at least one trial. */
double CalcFitness(const std::vector<LearningTrial>& trials, double grip_limit = kAnyGrip);

/** Contacts by trial, in order; empty if the simulation failed. */
std::vector<std::vector<DigitContact>> ListContacts(const std::vector<LearningTrial>& trials);
int CountSuccesses(const std::vector<LearningTrial>& trials);
/** Mean strength, with 0 for a lost object [N]; NaN if it was never requested. */
double CalcMeanStrength(const std::vector<LearningTrial>& trials);
/** Mean grip in the hold, over the trials that reached it [N]; NaN if none did. */
double CalcMeanGrip(const std::vector<LearningTrial>& trials);

Json ToJson(const LearningTrial& trial);
/** Reproduces the numbers exactly. @throws Json::exception or Error(kFormat). */
LearningTrial LearningTrialFromJson(const Json& json);

/** Upper bound of the strength that friction and grip allow, to judge how much a search can still
gain:

    bound = mu_s N - m g      [N], at least 0

where N is the sum of the hand's normal forces in the hold and m g the object's weight. When pulled
straight down, contacts with horizontal normals resist by friction only: at most mu_s times their
normal force each, part of which bears the weight. For a grasp by an object's sides, the weakest of
the six pulls (learning_trial.h) is at most this bound, however the force is distributed over the
digits (Coulomb). At equal grip no other grasp by the sides exceeds 1 / share times this one.

Not covered: a hand that reaches beneath the object or around a bar, whose share may exceed 1, and
digits that press harder when the object is pushed into them. Moments and pulls along the fingers
may break a grasp earlier.

@param normal_force  N [N].  @param weight  m g [N]. */
double CalcFrictionBound(double normal_force, double friction, double weight);

struct Headroom {
  double bound = 0.0;  ///< mean over the trials that held [N]; NaN: none did
  /** Mean strength of the trials that held (sigma if strength was not requested), over the
  bound. */
  double share = 0.0;
};
/** Largest factor by which a grasp by the sides can be stronger at equal grip: 1 / share, >= 1. */
double CalcMostGain(double share);

/** @param gravity  [m/s^2] */
Headroom CalcHeadroom(const std::vector<LearningTrial>& trials, const GraspObject& object,
                      double gravity);

}  // namespace graspbench
