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
    v("factors", factors);
    v("design", design);
    v("judge", judge);
    v("threshold", threshold);
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
