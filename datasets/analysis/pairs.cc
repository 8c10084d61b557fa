#include "datasets/analysis/pairs.h"

#include <algorithm>
#include <utility>

#include "core/base/text/text.h"
#include "core/statistics/bootstrap.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

constexpr int kNumChangeResamples = 1999;

/** Hand and object. */
using DrawnScene = std::pair<std::string, std::string>;

/** A compared side by its place. */
struct PlacedSide {
  size_t place;
  std::optional<std::string> hand;
};

/** The compared sides of each session by their conditions. */
using SidesOf = std::map<std::optional<std::string>, std::vector<PlacedSide>>;

std::vector<std::pair<const Session*, SidesOf>> GroupBySession(
    const std::vector<ComparedSide>& sides) {
  std::vector<std::pair<const Session*, SidesOf>> sessions;
  for (size_t k = 0; k < sides.size(); ++k) {
    auto found = std::find_if(sessions.begin(), sessions.end(),
                              [&](const auto& known) { return known.first == sides[k].session; });
    if (found == sessions.end()) {
      found = sessions.insert(sessions.end(), {sides[k].session, {}});
    }
    found->second[sides[k].condition].push_back({k, sides[k].hand});
  }
  return sessions;
}

/** Calls `visit(side, planned or record)` for what is on a side, in the list's order. */
template <class List, class FindPlan, class Visit>
void VisitSides(const SidesOf& sides, const List& list, FindPlan find_plan, Visit visit) {
  for (const auto& one : list) {
    const PlannedTrial& planned = find_plan(one);
    const auto found = sides.find(planned.condition);
    if (found == sides.end()) continue;
    for (const PlacedSide& side : found->second) {
      if (side.hand.value_or(planned.hand) == planned.hand) visit(side.place, one);
    }
  }
}

const PlannedTrial& TakePlan(const PlannedTrial& planned) { return planned; }
const PlannedTrial& TakePlanOf(const TrialRecord& record) { return record.plan; }

/** Names the draws of trials. */
class DrawNames {
 public:
  DrawNames(const std::vector<std::pair<const Session*, SidesOf>>& sessions, bool is_any_hand)
      : is_any_hand_(is_any_hand) {
    std::map<std::pair<size_t, DrawnScene>, std::string> grasps;
    for (const auto& [session, sides] : sessions) {
      VisitSides(sides, session->plan, TakePlan, [&](size_t side, const PlannedTrial& planned) {
        const DrawnScene scene = FindScene(planned);
        const auto first = grasps.emplace(std::pair(side, scene), planned.grasp).first;
        if (first->second != planned.grasp) several_.insert(scene);
      });
    }
  }

  std::string Name(const Session& session, const PlannedTrial& planned) const {
    const DrawnScene scene = FindScene(planned);
    const TrialDraw draw = MakeObjectDraw(session.config, planned.object, planned.trial);
    return FormatJson({scene.first, scene.second, several_.count(scene) > 0 ? planned.grasp : "",
                       planned.trial, draw.offset_x, draw.offset_y, draw.offset_yaw});
  }

 private:
  bool is_any_hand_;
  std::set<DrawnScene> several_;  ///< what some side grasps in several ways

  DrawnScene FindScene(const PlannedTrial& planned) const {
    return {is_any_hand_ ? "" : planned.hand, planned.object};
  }
};

}  // namespace

std::string FindUsedGrasp(const TrialRecord& record) {
  return record.result.sight_grasp.value_or(record.plan.grasp);
}

std::vector<ComparedDraw> ListComparedDraws(const std::vector<ComparedSide>& sides,
                                            bool is_any_hand) {
  const auto sessions = GroupBySession(sides);
  const DrawNames names(sessions, is_any_hand);
  std::map<std::string, size_t> places;
  std::vector<ComparedDraw> draws;
  for (const auto& [session, sides_of] : sessions) {
    const auto name = [&, s = session](const PlannedTrial& planned) {
      return names.Name(*s, planned);
    };
    VisitSides(sides_of, session->plan, TakePlan, [&](size_t side, const PlannedTrial& planned) {
      const auto [place, is_new] = places.emplace(name(planned), draws.size());
      if (is_new) {
        draws.push_back({planned.hand, planned.object,
                         std::vector<const PlannedTrial*>(sides.size(), nullptr),
                         std::vector<const TrialRecord*>(sides.size(), nullptr)});
      }
      draws[place->second].planned[side] = &planned;
    });
    VisitSides(sides_of, session->records, TakePlanOf, [&](size_t side, const TrialRecord& record) {
      const auto place = places.find(name(record.plan));
      if (place != places.end() && draws[place->second].planned[side]) {
        draws[place->second].records[side] = &record;
      }
    });
  }
  return draws;
}

OutcomeCounts CountOutcomes(const std::set<const TrialRecord*>& records) {
  OutcomeCounts counts;
  for (const TrialRecord* record : records) {
    ++counts.num_finished;
    counts.num_successes += IsSuccess(record->result.outcome);
  }
  return counts;
}

std::string ExplainUndecided(const OutcomeCounts& compared, const OutcomeCounts& left_out) {
  const auto [num, num_successes] = compared;
  if (num == 0) return "no trial is finished";
  if (num_successes > 0 && num_successes < num) return "";
  const bool succeed = num_successes > 0;
  const int num_others =
      succeed ? left_out.num_finished - left_out.num_successes : left_out.num_successes;
  if (num_others == 0) {
    return "success not testable: all " + FormatCount(num, "trial") +
           (succeed ? " succeed" : " fail");
  }
  return "success not testable: all " + FormatCount(num, "trial") + " compared " +
         (succeed ? "succeed, " : "fail, ") + std::to_string(num_others) + " of " +
         std::to_string(left_out.num_finished) + " left out " +
         (num_others == 1 ? (succeed ? "fails" : "succeeds") : (succeed ? "fail" : "succeed"));
}

ChangeEstimate EstimateChange(const ObjectChanges& changes) {
  std::vector<const std::vector<double>*> objects;
  std::vector<double> all;
  for (const auto& [object, values] : changes) {
    if (values.empty()) continue;
    objects.push_back(&values);
    all.insert(all.end(), values.begin(), values.end());
  }
  ChangeEstimate change;
  change.num_draws = static_cast<int>(all.size());
  change.num_objects = static_cast<int>(objects.size());
  if (all.empty()) return change;
  change.estimate = CalcMean(all);
  const Answer<BootstrapInterval> drawn = CalcBootstrap(
      objects.size(),
      [&](const std::vector<size_t>& members) {
        double sum = 0.0, count = 0.0;
        for (const size_t member : members) {
          for (const double value : *objects[member]) sum += value;
          count += static_cast<double>(objects[member]->size());
        }
        return sum / count;
      },
      "change over objects", kNumChangeResamples);
  change.interval = drawn ? Answer<Interval>(drawn->interval) : Answer<Interval>(drawn.none());
  return change;
}

ChangeEstimate EstimateSuccessChange(const ObjectChanges& changes,
                                     const std::optional<PairedCounts>& pairs,
                                     const std::string& undecided) {
  ChangeEstimate change = EstimateChange(changes);
  if (change.num_draws == 0) return change;
  if (!undecided.empty()) {
    change.interval = NoAnswer{undecided};
  } else if (!change.interval && pairs) {
    change.interval = CalcPairedDifferenceInterval(*pairs);
    change.is_of_these_objects = true;
  }
  return change;
}

std::string DescribeCounts(const std::vector<std::pair<int, std::string>>& counts) {
  std::string text;
  for (const auto& [count, what] : counts) {
    if (count == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  }
  return text;
}

}  // namespace graspbench
