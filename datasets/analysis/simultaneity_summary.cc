#include "datasets/analysis/simultaneity_summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/statistics/multiple_tests.h"

namespace graspbench {
namespace {

struct SimultaneityMeasure {
  const char* id;
  const char* name;
  double ContactTiming::*value;
};
constexpr SimultaneityMeasure kSimultaneityMeasures[] = {
    {"gft_s", "GFT", &ContactTiming::gft},
    {"got_s", "GOT", &ContactTiming::got},
    {"gft_ratio", "GFT%", &ContactTiming::gft_ratio},
    {"got_ratio", "GOT%", &ContactTiming::got_ratio}};

/** What takes part of one trial. */
struct TimedTrial {
  ContactTiming timing;
  std::vector<double> responses;  // in the order of ListGraspResponses()
};
/** By object and grasp. */
using HandCells = std::map<std::pair<std::string, std::string>, std::vector<TimedTrial>>;

/** A campaign's variant that kept the grasp before it gives the same trials again. Angles that were
rounded for a file move them by parts of a million. */
bool IsCopy(const std::vector<TimedTrial>& cell, const std::vector<TimedTrial>& before) {
  constexpr double kSame = 1e-6;
  size_t num_timed = 0, num_same = 0;
  for (size_t i = 0; i < std::min(cell.size(), before.size()); ++i) {
    const double a = cell[i].timing.gct, b = before[i].timing.gct;
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    ++num_timed;
    num_same += std::abs(a - b) <= kSame * std::abs(b);
  }
  return num_timed > 0 && 2 * num_same > num_timed;
}

void DropCopies(HandCells& cells) {
  for (auto cell = cells.begin(); cell != cells.end();) {
    const bool is_copy = std::any_of(cells.begin(), cell, [&](const auto& before) {
      return before.first.first == cell->first.first && IsCopy(cell->second, before.second);
    });
    cell = is_copy ? cells.erase(cell) : std::next(cell);
  }
}

HandCells GroupHandCells(const Session& session, const std::string& hand) {
  HandCells cells;
  for (const TrialRecord& record : session.records) {
    if (record.plan.hand != hand) continue;
    const TrialRecord whole = LoadWhole(session, record);
    TimedTrial trial = {record.result.timing, {}};
    for (const GraspResponse& response : ListGraspResponses()) {
      trial.responses.push_back(response.value(whole));
    }
    cells[{record.plan.object, record.plan.grasp}].push_back(std::move(trial));
  }
  DropCopies(cells);
  return cells;
}

std::vector<PairedGroup> MakeGroups(const HandCells& cells, const SimultaneityMeasure& measure,
                                    size_t response) {
  std::vector<PairedGroup> groups;
  for (const auto& [name, trials] : cells) {
    PairedGroup group;
    for (const TimedTrial& trial : trials) {
      group.a.push_back(trial.timing.contact_before_start ? kUnset : trial.timing.*measure.value);
      group.b.push_back(trial.responses[response]);
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

bool IsAnywhere(const HandCells& cells, size_t response) {
  for (const auto& [name, trials] : cells) {
    for (const TimedTrial& trial : trials) {
      if (std::isfinite(trial.responses[response])) return true;
    }
  }
  return false;
}

void RelateHand(const Session& session, const std::string& hand,
                std::vector<SimultaneityRelation>& relations) {
  const HandCells cells = GroupHandCells(session, hand);
  const std::vector<GraspResponse>& responses = ListGraspResponses();
  for (const SimultaneityMeasure& measure : kSimultaneityMeasures) {
    for (size_t i = 0; i < responses.size(); ++i) {
      if (!IsAnywhere(cells, i)) continue;
      const std::string id = hand + " " + measure.id + " " + responses[i].shown.id;
      relations.push_back({hand, measure.id, &responses[i],
                           CalcWithinCorrelation(MakeGroups(cells, measure, i), id)});
    }
  }
}

}  // namespace

std::vector<SimultaneityRelation> SummariseSimultaneity(const Session& session) {
  std::vector<SimultaneityRelation> relations;
  std::set<std::string> seen;
  for (const TrialRecord& record : session.records) {
    if (seen.insert(record.plan.hand).second) RelateHand(session, record.plan.hand, relations);
  }
  std::vector<double> p;
  for (const SimultaneityRelation& row : relations) {
    p.push_back(row.relation ? row.relation->p : kUnset);
  }
  const std::vector<double> adjusted = AdjustHolm(p);
  for (size_t i = 0; i < relations.size(); ++i) relations[i].p_holm = adjusted[i];
  return relations;
}

std::string NameTimingMeasure(const std::string& measure) {
  const auto found =
      std::find_if(std::begin(kSimultaneityMeasures), std::end(kSimultaneityMeasures),
                   [&measure](const SimultaneityMeasure& row) { return measure == row.id; });
  GRASPBENCH_DEMAND(found != std::end(kSimultaneityMeasures), measure);
  return found->name;
}

Json ToJson(const SimultaneityRelation& row) {
  Json json = {{"hand", row.hand}, {"measure", row.measure}, {"response", row.response->shown.id}};
  if (!row.relation) {
    json["correlation"] = nullptr;
    json["reason"] = row.relation.reason();
    return json;
  }
  const WithinCorrelation& relation = *row.relation;
  json["cells"] = relation.num_groups;
  json["trials"] = relation.num_pairs;
  json["correlation"] = JsonNumber(relation.correlation);
  json["low"] = relation.interval ? JsonNumber(relation.interval->low) : Json();
  json["high"] = relation.interval ? JsonNumber(relation.interval->high) : Json();
  json["p"] = JsonNumber(relation.p);
  json["p_holm"] = JsonNumber(row.p_holm);
  return json;
}

}  // namespace graspbench
