#pragma once
/** @file
Compares the entries of a benchmark on the same draws.

A line of the board is one entry with one hand. Its trials are re-simulated on the board's machine
from the entry's configuration, grasps and recorded actions. No number comes from the entry's
records; they are only checked for reproduction.

Lines are ranked by success rate. A line shares the rank of the line above unless it is
significantly worse than the first line of that rank: the 95 % interval of their paired difference
(datasets/analysis/pairs.h) excludes zero. If there are held-out draws, these determine the rank,
and entries of recorded actions have none. Intervals are not corrected for the number of entries. */

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text/csv.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/pairs.h"
#include "datasets/analysis/session_summary.h"
#include "datasets/benchmark/benchmark_file.h"
#include "datasets/benchmark/entry_pack.h"

namespace graspbench {

/** Largest share of trials whose outcome may differ from the record, since another processor may
change a few outcomes. Proposed. */
inline constexpr double kOtherOutcomes = 0.01;

/** Comparison of an entry's records with its re-simulated trials. */
struct Reproduction {
  int num_trials = 0;
  int num_identical = 0;      ///< the re-simulation matches the record
  int num_other_outcome = 0;  ///< trials with another outcome
  std::string first;          ///< first difference, in words; empty: all are identical
  /** Hash of the re-simulated results by hand, object and number, independent of trial ids. */
  std::string results_sha256 = {};

  bool is_within_tolerance() const { return num_other_outcome <= kOtherOutcomes * num_trials; }
};
/** @param again  the re-simulation of the same plan. */
Reproduction CompareRecords(const Session& entry, const Session& again);

/** The parts of a simulated trial that a board compares. */
struct BoardTrial {
  PlannedTrial plan;
  Outcome outcome = Outcome::kNotRun;
  double gct = kUnset, gft_ratio = kUnset;  ///< [s], 1; NaN: no valid closure
  double breaking_force = kUnset;           ///< of a judged held object [N]
};
/** The trials of one entry on one seed: all that a board of many entries holds in memory. */
struct BoardDraws {
  SessionConfig config = {};
  std::filesystem::path folder = {};  ///< of the session
  std::vector<BoardTrial> trials = {};
};
BoardDraws TakeDraws(const Session& session);

struct BoardEntry {
  EntryFacts facts;
  std::string pack;    ///< file name
  std::string sha256;  ///< of the file
  Reproduction reproduction;
  BoardDraws public_draws;                  ///< re-simulated
  std::optional<BoardDraws> held_out = {};  ///< none: not requested, or recorded actions
  /** Margin thresholds of the ranking draws, if searched. */
  std::optional<ThresholdSummary> thresholds = {};

  const BoardDraws& ranking() const { return held_out ? *held_out : public_draws; }
};
struct RefusedEntry {
  std::string pack, name;  ///< name is empty where it cannot be read
  std::string reason;
};

/** One entry with one hand. */
struct BoardLine {
  const BoardEntry* entry = nullptr;
  std::string hand;
  std::optional<int> rank, rank_of_hand;
  Tally tally;                           ///< of the ranking draws
  Tally public_tally;                    ///< of the public draws
  std::optional<double> gap;             ///< public minus held-out success rate
  ChangeEstimate behind;                 ///< success rate minus that of the first line
  Spread gct, gft_ratio;                 ///< [s]; of the ranking draws
  Spread breaking_force;                 ///< of judged held objects [N]
  std::vector<double> thresholds;        ///< margins of the ranking draws; infinite: none held
  std::map<std::string, Tally> objects;  ///< of the ranking draws
  /** By object, the first failed public trial, else the first trial. */
  std::map<std::string, const BoardTrial*> examples;
};

/** The best line in a group of lines and objects. */
struct GroupWinner {
  std::string group;  ///< "least friction", "hand tum"
  std::vector<std::string> objects;
  int num_lines = 0;  ///< number of compared lines
  const BoardLine* best = nullptr;
  const BoardLine* second = nullptr;  ///< null: there is only one line
  Tally tally = {};                   ///< of the best line
  ChangeEstimate lead = {};           ///< success rate of the best minus that of the second
  int num_tied = 0;                   ///< other lines with the best's success rate
};

struct Board {
  Benchmark benchmark;
  std::optional<int> held_out_seed;
  std::string commitment;  ///< against which the seed was checked
  std::vector<BoardEntry> entries;
  std::vector<RefusedEntry> refused;
  std::vector<std::string> objects;  ///< of the ranking draws
  std::vector<BoardLine> lines;      ///< by rank; point to entries
  std::vector<GroupWinner> winners;
};

/** Fills lines and winners, and moves entries that repeat the results of an earlier one to
`refused`.
@param inputs  of the ranking draws, for the objects' friction and mass. */
void RankEntries(const SessionInputs& inputs, Board& board);

/** Whether the 95 % interval of a difference lies above zero. */
bool IsSure(const ChangeEstimate& change);

std::vector<CsvColumn<BoardLine>> ListBoardColumns();
std::vector<CsvColumn<GroupWinner>> ListWinnerColumns();
std::vector<CsvColumn<RefusedEntry>> ListRefusedColumns();

}  // namespace graspbench
