/** @file
Causes of failures in simulated trials against what their trajectories show: contact forces, the
object's motion and the table's force step by step. The criteria are computed here from the
trajectory, and are looser than the diagnosis by what its samples of 10 ms cannot see. */

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>

#include "core/base/units.h"
#include "core/trial/trial_trace.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kSample = 0.01, kInterruption = 0.03;  // [s]
constexpr double kGrasped =
    0.5;  // of opposition: what was pushed before was grasped all the same [s]

struct Sight {
  double time, shift, rise, table;  // [s], [m], [m], [N]
  bool oppose;                      // two parts of the hand press against each other
};

/** By the law of cosines: |a + b| of two forces 110 degrees apart. */
bool Oppose(const Vector3d& a, const Vector3d& b) {
  const double cosine =
      ((a + b).squaredNorm() - a.squaredNorm() - b.squaredNorm()) / (2.0 * a.norm() * b.norm());
  return a.norm() >= 0.05 && b.norm() >= 0.05 && cosine < -0.3420201433;
}

std::vector<Sight> Watch(const TrialSetup& setup, const std::vector<TraceInstant>& trace) {
  const Vector3d& p_OOcm = setup.object->mass_properties.p_OOcm;
  const Vector3d rest_W = trace.front().X_WO * p_OOcm;
  std::vector<Sight> sights;
  for (const TraceInstant& instant : trace) {
    std::map<int, Vector3d> force_W;  // by digit; -1: the palm
    for (const HandContact& contact : instant.contacts) {
      auto [at, is_new] =
          force_W.try_emplace(setup.hand->FindDigitOfLink(contact.link), Vector3d::Zero());
      at->second += contact.normal_force * contact.nhat_W;
    }
    bool oppose = false;
    for (const auto& a : force_W) {
      for (const auto& b : force_W) oppose = oppose || Oppose(a.second, b.second);
    }
    const Vector3d moved_W = instant.X_WO * p_OOcm - rest_W;
    sights.push_back(
        {instant.time, moved_W.head<2>().norm(), moved_W.z(), instant.table_force, oppose});
  }
  return sights;
}

/** The largest shift before two parts first pressed against each other, for longer than a sample
can miss. */
double FindShiftBeforeOpposing(const std::vector<Sight>& sights) {
  double largest = 0.0, since = kUnset;
  for (const Sight& sight : sights) {
    if (!sight.oppose) since = kUnset;
    if (sight.oppose && std::isnan(since)) since = sight.time;
    if (sight.time - since > 0.02 + 2.0 * kSample) break;
    if (std::isnan(since)) largest = std::max(largest, sight.shift);
  }
  return largest;
}

/** The longest time in which two parts press against each other, without a break [s]. */
double FindLongestOpposed(const std::vector<Sight>& sights) {
  double longest = 0.0, since = kUnset;
  for (const Sight& sight : sights) {
    if (!sight.oppose) since = kUnset;
    if (sight.oppose && std::isnan(since)) since = sight.time;
    if (sight.oppose) longest = std::max(longest, sight.time - since);
  }
  return longest;
}

/** The share of the time between in which two parts press against each other. */
double FindOpposedShare(const std::vector<Sight>& sights, double from, double until) {
  int num = 0, num_opposed = 0;
  for (const Sight& sight : sights) {
    if (sight.time < from || sight.time > until) continue;
    ++num;
    num_opposed += sight.oppose;
  }
  return num > 0 ? static_cast<double>(num_opposed) / num : 0.0;
}

const Sight& At(const std::vector<Sight>& sights, double time) {
  for (const Sight& sight : sights) {
    if (sight.time >= time - 1e-9) return sight;
  }
  return sights.back();
}

void Check(const Diagnosis& found, const std::vector<Sight>& sights) {
  const double shift = FindShiftBeforeOpposing(sights);
  switch (found.mechanism) {
    case Mechanism::kPushed:
      EXPECT_GT(shift, 0.0045);
      EXPECT_LT(At(sights, found.time).shift, 0.0055) << "it begins with the touch";
      EXPECT_LT(FindLongestOpposed(sights), kGrasped + 2.0 * kSample);
      break;
    case Mechanism::kSqueezedOut:
    case Mechanism::kSlid:
      if (FindLongestOpposed(sights) < kGrasped - 2.0 * kSample) {
        EXPECT_LT(shift, 0.0055);
      }
      EXPECT_GT(FindOpposedShare(sights, found.time - kInterruption, found.time), 0.4);
      EXPECT_LT(FindOpposedShare(sights, found.time + kInterruption + kSample, HUGE_VAL), 0.2);
      break;
    default:
      break;
  }
}

/** How many failures have which mechanism. */
std::map<Mechanism, int> CheckFailures(const std::vector<std::string>& objects, double offset) {
  SessionConfig config;
  config.objects = objects;
  config.grasps = {"predicted"};  // types by rehearsal seldom fail
  config.variation.offset = offset;
  const SessionInputs inputs = LoadSessionInputs(config);
  std::map<Mechanism, int> causes;
  for (const PlannedTrial& planned : MakePlan(config, inputs)) {
    const TrialSetup setup = MakeTrialSetup(config, inputs, planned);
    TrialRunner runner(setup.hand, setup.object);
    const TracedTrial traced = TraceTrial(runner, setup, setup.sim.step);
    if (!traced.result.diagnosis || traced.trace.empty()) continue;
    const Diagnosis& found = *traced.result.diagnosis;
    SCOPED_TRACE(DescribeTrial(planned) + ": " + NameOf(found.mechanism));
    const std::vector<Sight> sights = Watch(setup, traced.trace);
    Check(found, sights);
    const bool hangs = sights.back().rise > 0.06 && traced.trace.back().grip_force > 0.0;
    EXPECT_FALSE(hangs && traced.result.reason.find("stayed behind") != std::string::npos)
        << traced.result.reason;
    ++causes[found.mechanism];
  }
  for (const auto& [cause, count] : causes) std::cout << NameOf(cause) << " " << count << "\n";
  return causes;
}

TEST(FailureCauses, OfPredictedGraspsAreSeenInTheTrajectories) {
  std::map<Mechanism, int> causes =
      CheckFailures({"can", "golf_ball", "light_bulb", "folding_rule"}, 0.005);
  EXPECT_GE(causes[Mechanism::kSqueezedOut], 10);
}

TEST(FailureCauses, OfObjectsFarFromTheirPlaceAreSeenInTheTrajectories) {
  std::map<Mechanism, int> causes = CheckFailures({"can", "golf_ball", "light_bulb"}, 0.03);
  EXPECT_GE(causes[Mechanism::kPushed], 3);
}

}  // namespace
}  // namespace graspbench
