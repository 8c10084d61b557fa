#include "datasets/analysis/judge_evidence.h"

#include <cmath>
#include <map>
#include <tuple>

#include "core/statistics/proportion.h"
#include "core/statistics/ranks.h"
#include "core/trial/judge/judge.h"
#include "datasets/records/trial_table.h"

namespace graspbench {
namespace {

/** Enough for two digits of an interval of thousands of trials, in seconds. */
constexpr int kNumJudgeResamples = 400;

struct HeldMeasure {
  std::string column;
  double sign = 1.0;  ///< -1: smaller is better
};

std::vector<HeldMeasure> ListHeldMeasures() {
  std::vector<HeldMeasure> measures = {
      {"sigma"}, {"sigma_stabilisation"}, {"sigma_proposed"}, {"epsilon"}};
  for (const QualityConvention& convention : ListQualityConventions()) {
    measures.push_back(
        {NameEpsilonColumn(convention), convention.epsilon == EpsilonRule::kTwoMinus ? -1.0 : 1.0});
  }
  measures.push_back({"volume"});
  measures.push_back({"grip_force_n"});
  return measures;
}

const char* const kEarlyMeasures[] = {"sigma_stabilisation", "epsilon", "grip_force_n"};

/** Trials of one cell, by their place among the trials that are asked about. */
using Cells = std::vector<std::vector<size_t>>;

Cells GroupByCell(const std::vector<const TrialRecord*>& trials) {
  std::map<std::tuple<std::string, std::string, std::string>, std::vector<size_t>> cells;
  for (size_t i = 0; i < trials.size(); ++i) {
    const PlannedTrial& plan = trials[i]->plan;
    cells[{plan.hand, plan.object, plan.grasp}].push_back(i);
  }
  Cells result;
  for (auto& [name, members] : cells) result.push_back(std::move(members));
  return result;
}

/** Missing values, which mean that the measure found nothing to measure, count as 0. */
std::vector<double> TakeColumn(const std::vector<TrialColumn>& columns, const std::string& name,
                               const std::vector<const TrialRecord*>& trials) {
  std::vector<double> values;
  for (const TrialColumn& column : columns) {
    if (column.name != name) continue;
    for (const TrialRecord* trial : trials) {
      const Json value = column.value(*trial);
      values.push_back(value.is_null() ? 0.0 : value.get<double>());
    }
  }
  return values;
}

/** Draws cells; `statistic` sees the chosen trials. */
template <class Statistic>
Answer<BootstrapInterval> DrawCells(const Cells& cells, const std::string& id,
                                    Statistic&& statistic) {
  return CalcBootstrap(
      cells.size(),
      [&](const std::vector<size_t>& members) {
        std::vector<size_t> trials;
        for (size_t cell : members) {
          trials.insert(trials.end(), cells[cell].begin(), cells[cell].end());
        }
        const Answer<double> answer = statistic(trials);
        return answer ? *answer : std::nan("");
      },
      id, kNumJudgeResamples);
}

std::vector<RankEvidence> CalcRanks(const std::vector<TrialColumn>& columns,
                                    const std::vector<const TrialRecord*>& judged,
                                    const Cells& cells) {
  const std::vector<double> force = TakeColumn(columns, "breaking_force_n", judged);
  std::vector<RankEvidence> ranks;
  for (const HeldMeasure& measure : ListHeldMeasures()) {
    std::vector<double> values = TakeColumn(columns, measure.column, judged);
    for (double& value : values) value *= measure.sign;
    ranks.push_back({measure.column, DrawCells(cells, "judge " + measure.column,
                                               [&](const std::vector<size_t>& trials) {
                                                 std::vector<double> a, b;
                                                 for (size_t trial : trials) {
                                                   a.push_back(values[trial]);
                                                   b.push_back(force[trial]);
                                                 }
                                                 return CalcSpearman(a, b);
                                               })});
  }
  return ranks;
}

std::vector<RocEvidence> CalcRoc(const std::vector<TrialColumn>& columns,
                                 const std::vector<const TrialRecord*>& finished,
                                 const Cells& cells) {
  std::vector<RocEvidence> roc;
  for (const std::string measure : kEarlyMeasures) {
    const std::vector<double> values = TakeColumn(columns, measure, finished);
    roc.push_back(
        {measure, DrawCells(cells, "success " + measure, [&](const std::vector<size_t>& trials) {
           std::vector<double> scores;
           std::vector<bool> is_success;
           for (size_t trial : trials) {
             scores.push_back(values[trial]);
             is_success.push_back(finished[trial]->result.outcome == Outcome::kSuccess);
           }
           return CalcRocArea(scores, is_success);
         })});
  }
  return roc;
}

Json ToJson(const Answer<BootstrapInterval>& answer) {
  if (!answer) return Json{{"estimate", nullptr}, {"reason", answer.reason()}};
  return Json{{"estimate", JsonNumber(answer->estimate)},
              {"low", JsonNumber(answer->interval.low)},
              {"high", JsonNumber(answer->interval.high)}};
}

}  // namespace

double Agreement::share() const {
  return CalcShare(num_both + num_neither, num_both + num_neither + num_first + num_second);
}

JudgeEvidence CalcJudgeEvidence(const std::vector<TrialRecord>& records) {
  JudgeEvidence evidence;
  std::vector<const TrialRecord*> judged, finished;
  for (const TrialRecord& record : records) {
    if (record.result.outcome == Outcome::kNumericalFailure) continue;
    finished.push_back(&record);
    evidence.num_successes += record.result.outcome == Outcome::kSuccess;
    if (record.judgement) judged.push_back(&record);
  }
  evidence.num_finished = static_cast<int>(finished.size());
  evidence.num_judged = static_cast<int>(judged.size());
  const Cells judged_cells = GroupByCell(judged);
  evidence.num_cells = static_cast<int>(judged_cells.size());
  if (judged.empty()) return evidence;
  const std::vector<TrialColumn> columns = ListTrialColumns({});
  evidence.ranks = CalcRanks(columns, judged, judged_cells);
  evidence.roc = CalcRoc(columns, finished, GroupByCell(finished));
  const size_t num_rules = ListVerdictRules().size();
  for (const VerdictRule& rule : ListVerdictRules()) evidence.rules.push_back(rule.name);
  evidence.agreements.assign(num_rules, std::vector<Agreement>(num_rules));
  for (const TrialRecord* trial : judged) {
    const std::vector<Verdict>& verdicts = trial->judgement->verdicts;
    for (size_t a = 0; a < num_rules; ++a) {
      for (size_t b = 0; b < num_rules; ++b) {
        Agreement& agreement = evidence.agreements[a][b];
        const bool first = verdicts[a].passed, second = verdicts[b].passed;
        ++(first ? (second ? agreement.num_both : agreement.num_first)
                 : (second ? agreement.num_second : agreement.num_neither));
      }
    }
  }
  return evidence;
}

namespace {

CellLoads CalcLoads(const CellSummary& cell, Seat seat) {
  std::vector<double> force, moment, sigma, epsilon;
  for (const TrialRecord* record : cell.records) {
    if (!record->judgement || FindSeat(record->result) != seat) continue;
    force.push_back(record->judgement->breaking_force);
    moment.push_back(record->judgement->breaking_moment);
    sigma.push_back(record->result.stability.sigma);
    epsilon.push_back(record->result.stability.stabilisation.quality);
  }
  return {&cell,
          seat,
          static_cast<int>(force.size()),
          CalcSpread(force),
          CalcSpread(moment),
          CalcSpread(sigma),
          CalcSpread(epsilon)};
}

}  // namespace

std::vector<CellLoads> ListCellLoads(const SessionSummary& summary) {
  std::vector<CellLoads> list;
  for (const CellSummary& cell : summary.cells) {
    for (const Seat seat : kSeats) {
      const CellLoads loads = CalcLoads(cell, seat);
      if (loads.num_judged > 0) list.push_back(loads);
    }
  }
  return list;
}

Json ToJson(const JudgeEvidence& evidence) {
  Json ranks = Json::array(), roc = Json::array(), passed = Json::object();
  for (const RankEvidence& rank : evidence.ranks) {
    ranks.push_back({{"measure", rank.measure},
                     {"rank_correlation_with_breaking_force", ToJson(rank.correlation)}});
  }
  for (const RocEvidence& area : evidence.roc) {
    roc.push_back({{"measure", area.measure}, {"roc_area_for_success", ToJson(area.area)}});
  }
  for (size_t i = 0; i < evidence.rules.size(); ++i) {
    passed[evidence.rules[i]] = evidence.agreements[i][i].num_both;
  }
  return Json{{"num_judged", evidence.num_judged},
              {"num_cells", evidence.num_cells},
              {"num_finished", evidence.num_finished},
              {"num_successes", evidence.num_successes},
              {"ranks", ranks},
              {"roc", roc},
              {"passed", passed}};
}

}  // namespace graspbench
