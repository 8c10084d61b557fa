#include "datasets/analysis/simultaneity_summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/base/text/csv.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/statistics/multiple_tests.h"
#include "core/trial/measures/object_in_hand.h"

namespace graspbench {

namespace {

using Record = const TrialRecord&;

double OfSuccess(Record record, double value) {
  return IsSuccess(record.result.outcome) ? value : kUnset;
}

double FindSuccess(Record record) {
  if (record.result.outcome == Outcome::kNumericalFailure) return kUnset;
  return IsSuccess(record.result.outcome) ? 1.0 : 0.0;
}

}  // namespace

const std::vector<GraspResponse>& ListGraspResponses() {
  static const std::vector<GraspResponse> responses = {
      {{"success", "success [%]", 100.0, 1}, FindSuccess},
      {{"shift_m", "push before lift-off [mm]", MmFromM(1.0), 2},
       [](Record record) { return CalcDisturbance(record.result).before_lift.shift; }},
      {{"turn_rad", "turn before lift-off [deg]", DegFromRad(1.0), 2},
       [](Record record) { return CalcDisturbance(record.result).before_lift.turn; }},
      {{"shift_in_hand_m", "in-hand displacement [mm]", MmFromM(1.0), 2},
       [](Record record) {
         return OfSuccess(record, CalcDisturbance(record.result).in_hand.shift);
       }},
      {{"turn_in_hand_rad", "turn in the hand [deg]", DegFromRad(1.0), 2},
       [](Record record) {
         return OfSuccess(record, CalcDisturbance(record.result).in_hand.turn);
       }},
      {{"hold_slip_m", "slip in the hold [mm]", MmFromM(1.0), 3},
       [](Record record) { return OfSuccess(record, record.result.hold_slip); }},
      {{"sigma_n", "sigma [N]", 1.0, 2},
       [](Record record) { return OfSuccess(record, record.result.stability.sigma); }},
      {{"breaking_force_n", "breaking force [N]", 1.0, 2},
       [](Record record) {
         return record.judgement ? OfSuccess(record, record.judgement->breaking_force) : kUnset;
       }},
  };
  return responses;
}

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

std::string NameResponse(const SimultaneityRelation& row) {
  const std::string label = row.response->shown.label;
  return label.substr(0, label.find(" ["));
}

std::string FormatRho(const SimultaneityRelation& row) {
  if (!row.relation) return "n/a";
  const Interval range =
      row.relation->interval ? *row.relation->interval : Interval{kUnset, kUnset};
  return FormatWithRange(row.relation->correlation, range.low, range.high, 2);
}

namespace {

std::vector<CsvColumn<SimultaneityRelation>> ListRelationColumns() {
  using Row = SimultaneityRelation;
  using C = CsvColumn<Row>;
  // Without a relation the file has neither counts nor numbers.
  const auto count = [](int WithinCorrelation::*member) {
    return [member](const Row& row) { return row.relation ? (*row.relation).*member : 0; };
  };
  const auto bound = [](double Interval::*member) {
    return [member](const Row& row) {
      return row.relation && row.relation->interval ? (*row.relation->interval).*member : kUnset;
    };
  };
  const auto p = [](const Row& row) { return row.relation ? row.relation->p : kUnset; };
  const auto correlation = [](const Row& row) {
    return row.relation ? row.relation->correlation : kUnset;
  };
  return {
      C("hand", "", "", &Row::hand).Shown("hand"),
      C("measure", "", "", &Row::measure)
          .Shown("measure", [](const Row& row) { return NameTimingMeasure(row.measure); }),
      C("response", "", "",
        [](const Row& row) {
          return row.response->shown.id;
        }).Shown("of the trial", NameResponse),
      C("cells", "", "", count(&WithinCorrelation::num_groups)).Shown("conditions"),
      C("trials", "", "in conditions with informative trials", count(&WithinCorrelation::num_pairs))
          .Shown("trials"),
      C("correlation", "", "", correlation).Shown("rank correlation", FormatRho),
      {"low", "", "", bound(&Interval::low)},
      {"high", "", "", bound(&Interval::high)},
      C("p", "", "two-sided, by permutation within conditions", p)
          .Shown("p", [p](const Row& row) { return FormatFixed(p(row), 4); }),
      C("p_holm", "", "after Holm, over the table", &Row::p_holm)
          .Shown("p of all", [](const Row& row) { return FormatFixed(row.p_holm, 3); })};
}

}  // namespace

ShownTable ShowRelations(const std::vector<SimultaneityRelation>& relations) {
  return ShowTable(ListRelationColumns(), relations);
}

Json MakeRelationsJson(const std::vector<SimultaneityRelation>& relations) {
  Json list = MakeJsonRows(ListRelationColumns(), relations);
  for (size_t i = 0; i < relations.size(); ++i) {
    if (relations[i].relation) continue;
    for (const char* key : {"cells", "trials", "low", "high", "p", "p_holm"}) list[i].erase(key);
    list[i]["reason"] = relations[i].relation.reason();
  }
  return list;
}

}  // namespace graspbench
