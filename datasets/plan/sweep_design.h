#pragma once
/** @file
A sweep: a session whose conditions are the points of a design over factors (conditions.h). Every
condition meets the same draws, so that they are compared pair by pair.

    full            every combination of levels
    one-at-a-time   the base, and each level of each factor alone
    latin:N         the base and N points of a Latin hypercube (M. D. McKay, R. J. Beckman and W. J.
                    Conover, Technometrics 21, 1979): each level of a factor in as many points as
                    any other, give or take one, dealt by the session's seed

The first level of each factor is the base's. */

#include <string>
#include <vector>

#include "core/base/file_keys.h"
#include "datasets/plan/session_config.h"

namespace graspbench {

struct SweepConfig : SessionConfig {
  std::vector<std::string> factors;  ///< "model.mass_scale=1,0.5,2"
  std::string design = "full";
  bool judge = false;     ///< break what is held
  std::string threshold;  ///< of kThresholdScales: bisect each draw's grip on it; empty: do not

  template <class V>
  void Visit(V&& v) {
    v("factors", factors,
      {"list of KEY=VALUE,VALUE,..: a session's setting, grasp, delay.last, delay.first or "
       "backend; the base's level first",
       KeyType::kList});
    v("design", design, "full, one-at-a-time or latin:N (the base and up to N combinations)");
    v("judge", judge, "also break what is held; some five times as long");
    v("threshold", threshold,
      "margin or force: also find the smallest with which each draw succeeds, under every "
      "condition; at most six more trials each");
    SessionConfig::Visit(v);
  }
};

/** As LoadSessionConfig and ParseSessionConfig, of sweep.yaml. */
SweepConfig LoadSweepConfig(const std::string& path);
SweepConfig ParseSweepConfig(const std::string& text, const std::string& file);
const FileKeys& ListSweepKeys();

/** The session with its conditions.
@throws Error(kUsage) without factors, for one named twice or with fewer than two levels, a level
given twice, an unknown design, more than 10,000 conditions, a first level that no base can have;
as NormaliseSetting and CheckSessionConfig. */
SessionConfig MakeSweep(const SweepConfig& sweep);

}  // namespace graspbench
