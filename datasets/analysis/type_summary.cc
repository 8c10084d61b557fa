#include "datasets/analysis/type_summary.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/text/text.h"
#include "core/trial/measures/grasp_types.h"
#include "datasets/analysis/pairs.h"

namespace graspbench {

namespace {

/** Of the normal force in the hold, what each digit and the rest of the hand bears. */
class PartShares {
 public:
  void Add(const TrialResult& result) {
    const double all = result.stability.hold.normal_force;
    if (!result.grip || result.touch || !(all > 0.0)) return;
    double rest = 1.0;
    for (const DigitGripRecord& digit : result.grip->digits) {
      const double share = std::isnan(digit.held) ? 0.0 : digit.held / all;
      sums_[digit.digit] += share;
      rest -= share;
    }
    sums_["palm"] += std::max(0.0, rest);
    ++num_trials_;
  }
  std::string Format() const {
    std::string text;
    for (const auto& [part, sum] : sums_) {
      text +=
          fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", part, 100.0 * sum / num_trials_);
    }
    return text;
  }

 private:
  std::map<std::string, double> sums_;
  int num_trials_ = 0;
};

}  // namespace

double TypeSummary::share() const {
  return asked.empty() || num_held == 0 ? kUnset : static_cast<double>(num_as_called) / num_held;
}

std::vector<TypeSummary> ListTypeSummaries(const Session& session) {
  std::map<std::pair<std::string, std::string>, TypeSummary> types;
  std::map<std::pair<std::string, std::string>, PartShares> shares;
  for (const TrialRecord& record : session.records) {
    const TrialResult& result = record.result;
    if (IsNumericalFailure(result.outcome)) continue;
    const std::string grasp = FindUsedGrasp(record);
    const std::pair key(record.plan.hand, grasp);
    TypeSummary& type = types[key];
    type.hand = record.plan.hand;
    type.grasp = grasp;
    if (const GraspTypeRule* rule = FindGraspTypeRule(grasp)) {
      type.asked = RowOf(kOppositions, rule->opposition).name;
    }
    ++type.num_finished;
    if (!result.opposition) continue;
    ++type.num_held;
    ++type.found[static_cast<size_t>(*result.opposition)];
    type.num_as_called += IsAsCalled(grasp, result);
    shares[key].Add(result);
  }
  std::vector<TypeSummary> list;
  for (auto& [key, type] : types) {
    type.parts = shares[key].Format();
    list.push_back(std::move(type));
  }
  return list;
}

std::vector<CsvColumn<TypeSummary>> ListTypeColumns() {
  using Row = TypeSummary;
  using C = CsvColumn<Row>;
  const auto count = [](Opposition opposition) {
    return [opposition](const Row& row) { return row.found[static_cast<size_t>(opposition)]; };
  };
  return {
      C("hand", "", "", &Row::hand).Shown("hand"),
      C("grasp", "", "", &Row::grasp).Shown("grasp"),
      C("finished", "", "finished trials", &Row::num_finished).Shown("n"),
      C("asked", "", "opposition intended by the grasp", &Row::asked).Shown("intended"),
      C("held", "", "trials that end with the object in the hand", &Row::num_held).Shown("held"),
      C("pad", "", "held by pad opposition", count(Opposition::kPad)).Shown("pad"),
      C("palm", "", "held by palm opposition: the palm bears 10 % of the normal force",
        count(Opposition::kPalm))
          .Shown("palm"),
      C("side", "", "held by side opposition", count(Opposition::kSide)).Shown("side"),
      C("as_called_share", "", "held trials with the intended opposition", &Row::share)
          .Shown("as intended [%]",
                 [](const Row& row) { return FormatFixed(100.0 * row.share(), 0); }),
      C("parts", "", "mean share of the normal force in the hold, by part", &Row::parts)
          .Shown("parts that bear")};
}

std::string FormatTypeLine(const std::vector<TypeSummary>& types) {
  int num_held = 0, num_as_called = 0;
  for (const TypeSummary& type : types) {
    if (type.asked.empty()) continue;
    num_held += type.num_held;
    num_as_called += type.num_as_called;
  }
  if (num_held == 0) return "";
  return fmt::format("{} of {} held trials have the intended opposition", num_as_called, num_held);
}

}  // namespace graspbench
