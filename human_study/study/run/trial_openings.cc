#include "human_study/study/run/trial_openings.h"

#include <cmath>

namespace graspbench {
namespace {

/** Largest value between two instants; NaN without any. */
double FindLargest(const ScalarCurve& curve, double begin, double end) {
  double largest = std::nan("");
  const SampleRun run = FindSamples(curve.times, begin, end);
  for (size_t i = run.first; i < run.last; ++i) {
    const double value = curve.At(i);
    if (curve.IsValid(i) && !(value <= largest)) largest = value;
  }
  return largest;
}

}  // namespace

std::vector<OpeningValues> CalcOpenings(FilteredTrial& trial, const TrialAnalysis& analysis,
                                        const AnalysisOptions& options) {
  const double last_contact = FindLastContact(analysis.contacts);
  const double begin = analysis.movement.onset.time;
  const auto find_open = [&](const ScalarCurve& curve) {
    return FindLargest(curve, begin, last_contact);
  };
  std::vector<OpeningValues> values;
  for (const HandOpening& opening : HandOpeningList()) {
    const ScalarCurve curve = CalcOpeningCurve(trial, opening, options.opening.cutoff);
    OpeningValues value;
    value.open = find_open(curve);
    value.closed = ValueNear(curve, last_contact);
    const std::vector<DigitTrack>& digits = trial.trial().digits;
    for (const DigitTrack& digit : digits) {
      const bool can_leave_out = !digit.is_thumb && digits.size() > 2;
      const ScalarCurve without =
          can_leave_out ? CalcOpeningCurve(trial, opening, options.opening.cutoff, digit.digit)
                        : ScalarCurve();
      value.open_without.push_back(can_leave_out ? find_open(without) : std::nan(""));
      value.closed_without.push_back(can_leave_out ? ValueNear(without, last_contact)
                                                   : std::nan(""));
    }
    values.push_back(value);
  }
  return values;
}

std::vector<double> SampleOpening(const TrialAnalysis& analysis) {
  const double begin = analysis.movement.onset.time, last = FindLastContact(analysis.contacts);
  std::vector<double> course;
  for (size_t step = 0; step < kNumOpeningSteps; ++step) {
    const double share = static_cast<double>(step) / (kNumOpeningSteps - 1);
    course.push_back(ValueNear(analysis.opening, begin + share * (last - begin)));
  }
  return course;
}

}  // namespace graspbench
