#include "human_study/events/doubts/thumb_label.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/base/units.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

using Column = Eigen::Index;

constexpr size_t kEnough = 200;    // samples
constexpr double kOpen = 0.9;      // of the largest span
constexpr double kClear = 15e-3;   // [m]
constexpr double kRowShare = 1.2;  // a row that is this many times as long is another one
constexpr double kSureRowShare = 1.8;
constexpr std::array<std::string_view, 4> kRow = {"FF", "MF", "RF", "LF"};

/** What one sign says: 1 the label is right, -1 exchanged, 0 nothing. */
int JudgeBy(double expected_longer, double expected_shorter, double share, double clear) {
  if (expected_longer > std::max(share * expected_shorter, expected_shorter + clear)) return 1;
  if (expected_shorter > std::max(share * expected_longer, expected_longer + clear)) return -1;
  return 0;
}

double CalcBetween(const Trajectory& a, const Trajectory& b, size_t i) {
  const auto column = static_cast<Column>(i);
  return a.IsValid(i) && b.IsValid(i) ? (a.p.col(column) - b.p.col(column)).norm() : std::nan("");
}

/** Median distance over some samples [m]; NaN when never seen together. */
double CalcDistance(const Trajectory& a, const Trajectory& b, const std::vector<size_t>& samples) {
  std::vector<double> values;
  for (const size_t i : samples) {
    if (const double value = CalcBetween(a, b, i); !std::isnan(value)) values.push_back(value);
  }
  return CalcMedian(std::move(values));
}

/** Samples in which two tips are far apart. */
std::vector<size_t> FindOpen(const Trajectory& a, const Trajectory& b, double until) {
  std::vector<size_t> samples;
  std::vector<double> spans;
  const SampleRun run = FindSamples(a.times, a.times.front(), until);
  const size_t step = std::max<size_t>(1, run.size() / kEnough);
  for (size_t i = run.first; i < run.last; i += step) {
    const double span = CalcBetween(a, b, i);
    if (!std::isnan(span)) samples.push_back(i), spans.push_back(span);
  }
  if (spans.empty()) return samples;
  const double open = kOpen * *std::max_element(spans.begin(), spans.end());
  size_t num_open = 0;
  for (size_t k = 0; k < spans.size(); ++k) {
    if (spans[k] >= open) samples[num_open++] = samples[k];
  }
  samples.resize(num_open);
  return samples;
}

bool Touches(const DigitContactEvents& contact) {
  return std::any_of(contact.by_detector.begin(), contact.by_detector.end(),
                     [](const EventTime& event) { return event.IsFound() || IsUnresolved(event); });
}

/** Fingers of the trial in the order of the row; null where none is recorded or touches. */
using Fingers = std::array<const DigitTrack*, kRow.size()>;

Fingers FindFingers(const ReachTrial& trial, const std::vector<DigitContactEvents>& contacts) {
  Fingers fingers{};
  for (size_t k = 0; k < kRow.size(); ++k) {
    for (size_t d = 0; d < trial.digits.size(); ++d) {
      if (trial.digits[d].digit == kRow[k] && Touches(contacts[d])) fingers[k] = &trial.digits[d];
    }
  }
  return fingers;
}

/** Sum of the distances of neighbours [m]; 0 without two neighbours. */
double CalcRow(const Fingers& fingers, const std::vector<size_t>& samples) {
  double length = 0.0;
  for (size_t k = 1; k < fingers.size(); ++k) {
    if (!fingers[k - 1] || !fingers[k]) continue;
    length += CalcDistance(fingers[k - 1]->tip, fingers[k]->tip, samples);
  }
  return length;
}

/** As labelled, and with the thumb in the place of that finger. */
struct Rows {
  const DigitTrack* finger = nullptr;
  double labelled = 0.0, exchanged = 0.0;  ///< [m]

  double Gain() const { return labelled - exchanged; }
};

/** The exchange that would shorten the row most; without a finger where there is no row. */
Rows FindBestExchange(const DigitTrack& thumb, const Fingers& fingers, double until) {
  Rows best;
  for (size_t k = 0; k < fingers.size(); ++k) {
    const bool has_neighbour =
        (k > 0 && fingers[k - 1]) || (k + 1 < fingers.size() && fingers[k + 1]);
    if (!fingers[k] || !has_neighbour) continue;
    Fingers exchanged = fingers;
    exchanged[k] = &thumb;
    const std::vector<size_t> open = FindOpen(thumb.tip, fingers[k]->tip, until);
    const Rows rows = {fingers[k], CalcRow(fingers, open), CalcRow(exchanged, open)};
    if (!best.finger || rows.Gain() > best.Gain()) best = rows;
  }
  return best;
}

}  // namespace

ThumbCheck CheckThumb(const ReachTrial& trial, const std::vector<DigitContactEvents>& contacts,
                      double until) {
  const DigitTrack& thumb = trial.digits.front();
  if (!thumb.is_thumb) return {};
  const Rows rows = FindBestExchange(thumb, FindFingers(trial, contacts), until);
  const DigitTrack& finger = rows.finger ? *rows.finger : trial.digits[1];
  const int by_row = JudgeBy(rows.exchanged, rows.labelled, kRowShare, kClear);
  const bool is_sure = JudgeBy(rows.exchanged, rows.labelled, kSureRowShare, 2.0 * kClear) != 0;
  int by_wrist = 0;
  if (trial.wrist.size() > 0) {
    const std::vector<size_t> open = FindOpen(thumb.tip, finger.tip, until);
    by_wrist = JudgeBy(CalcDistance(trial.wrist, finger.tip, open),
                       CalcDistance(trial.wrist, thumb.tip, open), 1.0, kClear);
  }
  const int judged = is_sure ? 2 * by_row : by_row + by_wrist;
  if (judged == 0) return {ThumbLabel::kNotTold, ""};
  if (judged > 0) return {};
  if (judged == -1) return {ThumbLabel::kUnlikely, ""};
  return {ThumbLabel::kExchanged,
          fmt::format("the tips that are called fingers are a row of {:.0f} mm, with the labels of "
                      "thumb and digit {} exchanged of {:.0f} mm: they are likely exchanged "
                      "through the whole file. Correct markers in study.yaml",
                      MmFromM(rows.labelled), finger.digit, MmFromM(rows.exchanged))};
}

}  // namespace graspbench
