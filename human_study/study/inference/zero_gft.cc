#include "human_study/study/inference/zero_gft.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/statistics/summary.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {

ZeroGft CalcZeroGft(const std::vector<StudyTrial>& trials) {
  constexpr int kNumDraws = 50;
  ZeroGft zero;
  std::vector<double> gfts;
  for (const StudyTrial& trial : trials) {
    if (!trial.IsKept() || !trial.analysis) continue;
    std::vector<double> uncertainties;
    for (const DigitContactEvents& digit : trial.analysis->contacts) {
      if (digit.contact.IsFound()) uncertainties.push_back(digit.own_uncertainty);
    }
    if (uncertainties.size() < 2) continue;
    ++zero.num_trials;
    RandomStream random(trial.id, "true GFT zero");
    for (int i = 0; i < kNumDraws; ++i) {
      double first = INFINITY, last = -INFINITY;
      for (const double uncertainty : uncertainties) {
        const double error = uncertainty * random.NextNormal();
        first = std::min(first, error);
        last = std::max(last, error);
      }
      gfts.push_back(last - first);
    }
  }
  if (gfts.empty()) return zero;
  std::sort(gfts.begin(), gfts.end());
  zero.median = CalcSortedQuantile(gfts, 0.5);
  zero.limit = CalcSortedQuantile(gfts, 0.95);
  return zero;
}

}  // namespace graspbench
