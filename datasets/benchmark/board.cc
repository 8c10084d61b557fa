#include "datasets/benchmark/board.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "core/statistics/summary.h"
#include "datasets/session/find_trial.h"

namespace graspbench {
namespace {

constexpr size_t kGroupParts = 3;  // the third of the objects with least friction, mass, ..

bool IsRanked(const Board& board, const BoardLine& line) {
  return !board.held_out_seed || line.entry->held_out.has_value();
}

/** Draws on every line: success, or nothing where the line has no such draw. */
struct DrawTable {
  std::vector<std::string> objects;         ///< (draws)
  std::vector<std::vector<int>> successes;  ///< (lines x draws); -1: none
};

/** Of lines by their places. A hand is what an entry chooses: draws are the same for all hands. */
DrawTable MakeDrawTable(const std::vector<BoardLine>& lines) {
  DrawTable table;
  std::map<std::pair<std::string, int>, size_t> places;
  table.successes.resize(lines.size());
  for (size_t i = 0; i < lines.size(); ++i) {
    for (const BoardTrial& trial : lines[i].entry->ranking().trials) {
      if (trial.plan.hand != lines[i].hand) continue;
      const auto [place, is_new] =
          places.emplace(std::pair(trial.plan.object, trial.plan.trial), table.objects.size());
      if (is_new) table.objects.push_back(trial.plan.object);
      table.successes[i].resize(std::max(table.successes[i].size(), place->second + 1), -1);
      table.successes[i][place->second] = IsSuccess(trial.outcome);
    }
  }
  for (std::vector<int>& row : table.successes) row.resize(table.objects.size(), -1);
  return table;
}

/** Success of the second less that of the first. @param only  of these objects; empty: all. */
ChangeEstimate CompareLines(const DrawTable& table, size_t first, size_t second,
                            const std::set<std::string>& only = {}) {
  ObjectChanges changes;
  PairedCounts counts;
  OutcomeCounts outcomes;
  for (size_t draw = 0; draw < table.objects.size(); ++draw) {
    const int a = table.successes[first][draw], b = table.successes[second][draw];
    if (a < 0 || b < 0 || (!only.empty() && only.count(table.objects[draw]) == 0)) continue;
    changes[table.objects[draw]].push_back(double(b - a));
    counts.Add(a > 0, b > 0);
    outcomes.num_finished += 2;
    outcomes.num_successes += a + b;
  }
  return EstimateSuccessChange(changes, counts, ExplainUndecided(outcomes));
}

BoardLine MakeLine(const BoardEntry& entry, const std::string& hand) {
  BoardLine line;
  line.entry = &entry;
  line.hand = hand;
  std::vector<double> gct, gft_ratio, breaking_force;
  for (const BoardTrial& trial : entry.ranking().trials) {
    if (trial.plan.hand != hand) continue;
    line.tally.Count(trial.outcome);
    line.objects[trial.plan.object].Count(trial.outcome);
    breaking_force.push_back(trial.breaking_force);
    gct.push_back(trial.gct);
    gft_ratio.push_back(trial.gft_ratio);
  }
  for (const BoardTrial& trial : entry.public_draws.trials) {
    if (trial.plan.hand != hand) continue;
    line.public_tally.Count(trial.outcome);
    const BoardTrial*& example = line.examples[trial.plan.object];
    if (!example || (IsSuccess(example->outcome) && !IsSuccess(trial.outcome))) example = &trial;
  }
  if (entry.thresholds) {
    for (const DrawThreshold& draw : entry.thresholds->draws) {
      if (draw.draw.hand == hand && !std::isnan(draw.value)) line.thresholds.push_back(draw.value);
    }
  }
  if (entry.held_out) line.gap = line.public_tally.rate() - line.tally.rate();
  line.gct = CalcSpread(std::move(gct));
  line.gft_ratio = CalcSpread(std::move(gft_ratio));
  line.breaking_force = CalcSpread(std::move(breaking_force));
  return line;
}

/** By rank, then by rate, then by the names, so that the order of the packs changes nothing. */
void SortLines(const Board& board, std::vector<BoardLine>& lines) {
  const auto key = [&](const BoardLine& line) {
    return std::tuple(!IsRanked(board, line), -line.tally.rate(), line.entry->facts.name, line.hand,
                      line.entry->sha256);
  };
  std::sort(lines.begin(), lines.end(),
            [&](const BoardLine& a, const BoardLine& b) { return key(a) < key(b); });
}

/** @param hand  empty: of all. */
void SetRanks(const Board& board, const DrawTable& table, const std::string& hand,
              std::optional<int> BoardLine::*rank, std::vector<BoardLine>& lines) {
  std::optional<size_t> head;
  int position = 0;
  for (size_t i = 0; i < lines.size(); ++i) {
    if (!IsRanked(board, lines[i]) || (!hand.empty() && lines[i].hand != hand)) continue;
    ++position;
    const bool is_new = !head || IsSure(CompareLines(table, i, *head));
    if (is_new) head = i;
    lines[i].*rank = is_new ? position : *(lines[*head].*rank);
  }
}

/** A third of the objects, of the least or largest values, and those equal to the last of them. */
std::vector<std::string> TakeThird(std::vector<std::pair<double, std::string>> values,
                                   bool is_largest) {
  std::sort(values.begin(), values.end());
  if (is_largest) std::reverse(values.begin(), values.end());
  size_t count = values.size() / kGroupParts;
  while (count < values.size() && values[count].first == values[count - 1].first) ++count;
  values.resize(count);
  std::vector<std::string> objects;
  for (auto& value : values) objects.push_back(std::move(value.second));
  return objects;
}

std::vector<GroupWinner> ListGroups(const SessionInputs& inputs) {
  std::vector<std::pair<double, std::string>> friction, mass;
  std::vector<GroupWinner> groups(1);
  groups[0].group = "all objects";
  for (const auto& object : inputs.objects) {
    groups[0].objects.push_back(object->id);
    friction.emplace_back(object->surface.friction_static, object->id);
    mass.emplace_back(object->mass_properties.mass, object->id);
  }
  if (friction.size() >= kGroupParts) {
    groups.push_back({"least friction", TakeThird(friction, false)});
    groups.push_back({"most friction", TakeThird(friction, true)});
    groups.push_back({"lightest", TakeThird(mass, false)});
    groups.push_back({"heaviest", TakeThird(mass, true)});
  }
  if (groups[0].objects.size() == 1) groups.clear();
  for (const auto& object : inputs.objects) {
    groups.push_back({object->id, {object->id}});
  }
  return groups;
}

/** What distinguishes lines, and what a line says of it. */
struct LineDivision {
  const char* name;
  std::string (*describe)(const BoardLine& line);
};
constexpr LineDivision kDivisions[] = {
    {"hand", [](const BoardLine& line) { return line.hand; }},
    {"controller",
     [](const BoardLine& line) { return DescribeController(line.entry->public_draws.config); }},
    {"sensing",
     [](const BoardLine& line) { return DescribeSensing(line.entry->public_draws.config); }},
    {"year", [](const BoardLine& line) { return DescribeYear(line.entry->facts); }}};

using TakeLine = std::function<bool(const BoardLine& line)>;

void FindWinner(const Board& board, const DrawTable& table, const TakeLine& is_of,
                GroupWinner& group) {
  std::vector<std::pair<double, size_t>> order;  // of equal rates the better rank first
  std::vector<Tally> tallies(board.lines.size());
  for (size_t i = 0; i < board.lines.size(); ++i) {
    const BoardLine& line = board.lines[i];
    for (const std::string& object : group.objects) {
      const auto found = line.objects.find(object);
      if (found != line.objects.end()) AddTally(found->second, tallies[i]);
    }
    if (IsRanked(board, line) && is_of(line)) order.emplace_back(-tallies[i].rate(), i);
  }
  group.num_lines = static_cast<int>(order.size());
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  if (order.empty()) return;
  group.best = &board.lines[order[0].second];
  group.tally = tallies[order[0].second];
  group.num_tied =
      static_cast<int>(std::count_if(order.begin() + 1, order.end(),
                                     [&](const auto& one) { return one.first == order[0].first; }));
  if (order.size() < 2) return;
  group.second = &board.lines[order[1].second];
  group.lead = CompareLines(table, order[1].second, order[0].second,
                            {group.objects.begin(), group.objects.end()});
}

/** On groups of objects, of each kind of lines where there are several, and on each object. */
std::vector<GroupWinner> FindWinners(const Board& board, const SessionInputs& inputs,
                                     const DrawTable& table) {
  std::vector<GroupWinner> winners;
  for (const LineDivision& division : kDivisions) {
    std::set<std::string> kinds;
    for (const BoardLine& line : board.lines) {
      if (IsRanked(board, line)) kinds.insert(division.describe(line));
    }
    if (kinds.size() < 2) continue;
    for (const std::string& kind : kinds) {
      winners.push_back({division.name + (" " + kind), board.objects});
      FindWinner(
          board, table, [&](const BoardLine& line) { return division.describe(line) == kind; },
          winners.back());
    }
  }
  std::vector<GroupWinner> groups = ListGroups(inputs);
  for (GroupWinner& group : groups) {
    FindWinner(
        board, table, [](const BoardLine&) { return true; }, group);
  }
  const auto single = std::find_if(groups.begin(), groups.end(), [](const GroupWinner& group) {
    return group.objects.size() == 1;
  });
  winners.insert(winners.begin(), groups.begin(), single);
  winners.insert(winners.end(), single, groups.end());
  return winners;
}

/** Who repeats another's results in every trial has nothing of its own. */
void SetRepeatedAside(Board& board) {
  std::map<std::string, std::string> names;
  std::vector<BoardEntry> kept;
  for (BoardEntry& entry : board.entries) {
    const auto [first, is_new] = names.emplace(entry.reproduction.results_sha256, entry.facts.name);
    if (is_new) {
      kept.push_back(std::move(entry));
      continue;
    }
    board.refused.push_back({entry.pack, entry.facts.name,
                             "it has the same results in every trial as \"" + first->second +
                                 "\", which was given before it"});
  }
  board.entries = std::move(kept);
}

std::string NameLine(const BoardLine& line) { return line.entry->facts.name + ", " + line.hand; }

std::string FormatSpread(const Spread& spread, double unit, int decimals) {
  return spread.n == 0 ? "n/a" : FormatFixed(unit * spread.median, decimals);
}

/** "1.19 (1.09 to 1.41)", with the interval of order statistics; empty: not looked for. */
std::string FormatLineThreshold(const BoardLine& line) {
  if (line.thresholds.empty()) return {};
  const ThresholdScale& scale = kThresholdScales[0];
  const std::string text = FormatThreshold(scale, CalcMedian(line.thresholds));
  const auto interval = CalcMedianInterval(line.thresholds);
  if (!interval) return text;
  return text + " (" + FormatThreshold(scale, interval->low) + " to " +
         FormatThreshold(scale, interval->high) + ")";
}

std::string FormatPoints(const ChangeEstimate& change) {
  if (change.num_draws == 0) return "n/a";
  if (!change.interval) return FormatFixed(100.0 * change.estimate, 1) + " (no interval)";
  return FormatWithRange(100.0 * change.estimate, 100.0 * change.interval->low,
                         100.0 * change.interval->high, 1);
}

std::string FormatRank(const std::optional<int>& rank) {
  return rank ? std::to_string(*rank) : "public only";
}

double LowOf(const ChangeEstimate& change) {
  return change.interval ? change.interval->low : kUnset;
}
double HighOf(const ChangeEstimate& change) {
  return change.interval ? change.interval->high : kUnset;
}

}  // namespace

Reproduction CompareRecords(const Session& entry, const Session& again) {
  std::map<std::string, const TrialRecord*> records;
  for (const TrialRecord& record : again.records) records[record.plan.id] = &record;
  Reproduction found;
  std::map<std::string, std::string> results;
  for (const TrialRecord& record : entry.records) {
    ++found.num_trials;
    const PlannedTrial& plan = record.plan;
    const auto now = records.find(plan.id);
    std::string text = "was not simulated again";
    bool is_same_outcome = false;
    if (now != records.end()) {
      const TrialRecord whole = LoadWhole(again, *now->second);
      results[FormatJson({plan.hand, plan.object, plan.trial})] = FormatJson(ToJson(whole.result));
      const auto difference = FindFirstDifference(LoadWhole(entry, record), whole);
      if (!difference) {
        ++found.num_identical;
        continue;
      }
      is_same_outcome = record.result.outcome == whole.result.outcome;
      text = difference->field + " is " + difference->recorded + ", simulated again " +
             difference->now;
    }
    found.num_other_outcome += !is_same_outcome;
    if (found.first.empty()) found.first = NameTrial(plan) + ": " + text;
  }
  Sha256 sum;
  for (const auto& [draw, result] : results) sum.Add(draw + result + "\n");
  found.results_sha256 = sum.CalcDigest();
  return found;
}

BoardDraws TakeDraws(const Session& session) {
  BoardDraws draws = {session.config, session.folder};
  for (const TrialRecord& record : session.records) {
    BoardTrial& trial = draws.trials.emplace_back();
    trial.plan = record.plan;
    trial.outcome = record.result.outcome;
    if (record.judgement) trial.breaking_force = record.judgement->breaking_force;
    const ContactTiming& timing = record.result.timing;
    if (trial.outcome == Outcome::kNumericalFailure || timing.contact_before_start) continue;
    trial.gct = timing.gct;
    trial.gft_ratio = timing.gft_ratio;
  }
  return draws;
}

bool IsSure(const ChangeEstimate& change) { return change.interval && change.interval->low > 0.0; }

void RankEntries(const SessionInputs& inputs, Board& board) {
  SetRepeatedAside(board);
  board.lines.clear();
  board.objects.clear();
  for (const auto& object : inputs.objects) board.objects.push_back(object->id);
  std::set<std::string> hands;
  for (const BoardEntry& entry : board.entries) {
    for (const std::string& hand : entry.public_draws.config.hands) {
      board.lines.push_back(MakeLine(entry, hand));
      hands.insert(hand);
    }
  }
  SortLines(board, board.lines);
  const DrawTable table = MakeDrawTable(board.lines);
  SetRanks(board, table, "", &BoardLine::rank, board.lines);
  for (const std::string& hand : hands) {
    SetRanks(board, table, hand, &BoardLine::rank_of_hand, board.lines);
  }
  for (size_t i = 1; i < board.lines.size(); ++i) {
    if (IsRanked(board, board.lines[i])) board.lines[i].behind = CompareLines(table, 0, i);
  }
  board.winners = FindWinners(board, inputs, table);
}

std::vector<CsvColumn<BoardLine>> ListBoardColumns() {
  using Row = BoardLine;
  using C = CsvColumn<Row>;
  const auto interval = [](const Row& row) { return row.tally.rate_interval(); };
  return {
      C("rank", "integer", "", "position of the first line that shares it",
        [](const Row& row) {
          return row.rank ? Json(*row.rank) : Json(nullptr);
        }).Shown("Rank", [](const Row& row) { return FormatRank(row.rank); }),
      C("entry", "", "name that its author gave it",
        [](const Row& row) {
          return row.entry->facts.name;
        }).Shown("Entry"),
      C("hand", "", "id of the hand", &Row::hand).Shown("Hand"),
      C("success", "", "share of successes", [](const Row& row) { return row.tally.rate(); })
          .Shown("Success [%]",
                 [](const Row& row) { return FormatFixed(100.0 * row.tally.rate(), 1); }),
      C("success_low", "", "95 % Wilson interval",
        [interval](const Row& row) {
          return interval(row).low;
        }).Shown("95 % interval [%]", [](const Row& row) { return FormatRateInterval(row.tally); }),
      C("success_high", "", "95 % Wilson interval",
        [interval](const Row& row) { return interval(row).high; }),
      C("trials", "", "simulated again, that rank",
        [](const Row& row) {
          return row.tally.finished;
        }).Shown("n"),
      C("successes", "", "of these", [](const Row& row) { return row.tally.successes(); }),
      C("behind", "", "success less that of the first line",
        [](const Row& row) { return row.behind.estimate; })
          .Shown("Less than the first [points]",
                 [](const Row& row) {
                   return row.behind.num_draws == 0 ? std::string() : FormatPoints(row.behind);
                 }),
      C("behind_low", "", "95 % interval of the paired difference",
        [](const Row& row) { return LowOf(row.behind); }),
      C("behind_high", "", "95 % interval of the paired difference",
        [](const Row& row) { return HighOf(row.behind); }),
      C("public_less_held_out", "", "success on public draws less that on held-out draws",
        [](const Row& row) { return row.gap.value_or(kUnset); })
          .Shown("Public less held-out [points]",
                 [](const Row& row) {
                   return row.gap ? FormatFixed(100.0 * *row.gap, 1) : std::string();
                 }),
      C("grip_threshold", "",
        "median of the smallest margins with which a draw succeeds; empty: not looked for, or none "
        "held",
        [](const Row& row) {
          return row.thresholds.empty() ? kUnset : CalcMedian(row.thresholds);
        }).Shown("Grip threshold [margin]", FormatLineThreshold),
      C("breaking_force_n", "N",
        "median of the smallest pulls that took a held object out; empty: not judged",
        [](const Row& row) {
          return row.breaking_force.n == 0 ? kUnset : row.breaking_force.median;
        })
          .Shown("Breaking load [N]",
                 [](const Row& row) {
                   return row.breaking_force.n == 0 ? std::string()
                                                    : FormatSpread(row.breaking_force, 1.0, 1);
                 }),
      C("gct_s", "s", "median grasp closure time",
        [](const Row& row) {
          return row.gct.n == 0 ? kUnset : row.gct.median;
        }).Shown("GCT [s]", [](const Row& row) { return FormatSpread(row.gct, 1.0, 3); }),
      C("gft_ratio", "", "median of GFT / GCT: simultaneity of contacts",
        [](const Row& row) {
          return row.gft_ratio.n == 0 ? kUnset : row.gft_ratio.median;
        }).Shown("GFT% [%]", [](const Row& row) { return FormatSpread(row.gft_ratio, 100.0, 1); }),
      C("rank_of_hand", "integer", "", "the same among the lines of this hand",
        [](const Row& row) {
          return row.rank_of_hand ? Json(*row.rank_of_hand) : Json(nullptr);
        }).Shown("In hand", [](const Row& row) { return FormatRank(row.rank_of_hand); }),
      C("controller", "", "who closes the digits",
        [](const Row& row) {
          return DescribeController(row.entry->public_draws.config);
        }).Shown("Controller"),
      C("sensing", "", "declared: what the controller may know",
        [](const Row& row) {
          return DescribeSensing(row.entry->public_draws.config);
        }).Shown("Sensing (declared)"),
      C("by", "", "author", [](const Row& row) { return row.entry->facts.by; }).Shown("By"),
      C("year", "", "declared by the author",
        [](const Row& row) {
          return DescribeYear(row.entry->facts);
        }).Shown("Year (declared)"),
      C("identical", "", "records of the entry that the re-simulation matches",
        [](const Row& row) { return row.entry->reproduction.num_identical; })
          .Shown("Records reproduced",
                 [](const Row& row) {
                   const Reproduction& one = row.entry->reproduction;
                   std::string text =
                       std::to_string(one.num_identical) + " of " + std::to_string(one.num_trials);
                   if (one.num_other_outcome > 0) {
                     text += "; " + std::to_string(one.num_other_outcome) + " end otherwise";
                   }
                   return text;
                 }),
      C("other_outcome", "", "records whose trial ends otherwise",
        [](const Row& row) { return row.entry->reproduction.num_other_outcome; }),
      C("sha256", "", "of the pack", [](const Row& row) { return row.entry->sha256; })};
}

std::vector<CsvColumn<GroupWinner>> ListWinnerColumns() {
  using Row = GroupWinner;
  using C = CsvColumn<Row>;
  const auto name = [](const BoardLine* line) { return line ? NameLine(*line) : std::string(); };
  return {C("group", "", "of objects or of lines", &Row::group).Shown("Group"),
          C("num_objects", "", "how many objects count",
            [](const Row& row) {
              return static_cast<int>(row.objects.size());
            }).Shown("Objects"),
          C("num_lines", "", "how many lines are compared", &Row::num_lines).Shown("Lines"),
          C("best", "", "entry and hand", [name](const Row& row) { return name(row.best); })
              .Shown("Best",
                     [name](const Row& row) {
                       return name(row.best) +
                              (row.num_tied > 0
                                   ? ", tied with " + FormatCount(row.num_tied, "other")
                                   : "");
                     }),
          C("num_tied", "", "other lines with the success rate of the best", &Row::num_tied),
          C("successes", "", "of the best", [](const Row& row) { return row.tally.successes(); })
              .Shown("Successes",
                     [](const Row& row) {
                       return std::to_string(row.tally.successes()) + " of " +
                              std::to_string(row.tally.finished);
                     }),
          C("second", "", "entry and hand",
            [name](const Row& row) {
              return name(row.second);
            }).Shown("Second"),
          C("lead", "", "success of the best less that of the second",
            [](const Row& row) {
              return row.lead.estimate;
            }).Shown("Lead [points]", [](const Row& row) { return FormatPoints(row.lead); }),
          C("is_sure", "", "the 95 % interval of the lead excludes 0", [](const Row& row) {
            return IsSure(row.lead);
          }).Shown("Sure", [](const Row& row) {
            return row.second == nullptr ? "n/a" : IsSure(row.lead) ? "yes" : "no";
          })};
}

std::vector<CsvColumn<RefusedEntry>> ListRefusedColumns() {
  using C = CsvColumn<RefusedEntry>;
  return {C("pack", "", "file", &RefusedEntry::pack).Shown("Pack"),
          C("entry", "", "its name", &RefusedEntry::name).Shown("Entry"),
          C("reason", "", "why it has no rank", &RefusedEntry::reason).Shown("Reason")};
}

}  // namespace graspbench
