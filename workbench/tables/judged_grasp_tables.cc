#include "workbench/tables/judged_grasp_tables.h"

#include <cmath>

#include "core/base/text/text.h"
#include "workbench/tables/text_table.h"

namespace graspbench {

std::string FormatJudged(const JudgedSummary& summary) {
  TextTable table(
      {"profile", "grasps", "passed", "95 % interval", "agreement with labels", "most failed at"});
  for (const ProfileSummary& profile : summary.profiles) {
    const double kappa = profile.labels.num_pairs() > 0 ? CalcKappa(profile.labels) : kUnset;
    table.AddRow({profile.profile, std::to_string(profile.num_judged),
                  std::to_string(profile.num_passed),
                  FormatRateInterval(profile.num_passed, profile.num_judged) + " %",
                  std::isfinite(kappa) ? "kappa " + FormatFixed(kappa, 2) : "-",
                  profile.stages.empty() ? "-" : profile.stages.front().first});
  }
  return table.Format();
}

Json MakeJson(const JudgedSummary& summary) {
  Json profiles = Json::array();
  for (const ProfileSummary& profile : summary.profiles) {
    const Interval interval = CalcWilsonInterval(profile.num_passed, profile.num_judged);
    profiles.push_back({{"profile", profile.profile},
                        {"judged", profile.num_judged},
                        {"passed", profile.num_passed},
                        {"numerical_failures", profile.num_numerical},
                        {"interval_low", interval.low},
                        {"interval_high", interval.high},
                        {"labelled", profile.labels.num_pairs()},
                        {"kappa", JsonNumber(CalcKappa(profile.labels))},
                        {"jitter_share", JsonNumber(profile.jitter_share)}});
  }
  return profiles;
}

}  // namespace graspbench
