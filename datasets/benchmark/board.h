#pragma once
/** @file
What the entries of a benchmark hold, compared on the same draws.

A line of the board is one entry with one hand. Its trials are those that the board's own machine
has simulated again from the entry's configuration, grasps and recorded actions: no number comes
from the entry's records, which only count as reproduced or not.

Ranks: lines are sorted by success. From the best on, a line shares the rank of the first line of
that rank, unless the 95 % interval of their paired difference (datasets/analysis/pairs.h) excludes
zero. With held-out draws, these rank, and entries of recorded actions have no rank. Intervals are
not corrected for the number of entries. */

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

/** Largest share of trials that may end otherwise than recorded: another processor may decide a few
trials otherwise. Proposed. */
inline constexpr double kOtherOutcomes = 0.01;

/** The records of an entry beside its trials as simulated again. */
struct Reproduction {
  int num_trials = 0;
  int num_identical = 0;      ///< the re-simulation matches the record
  int num_other_outcome = 0;  ///< that end otherwise
  std::string first;          ///< difference, in words; empty: all are identical
  /** Of the results as simulated again, by hand, object and number, whatever the trials' ids. */
  std::string results_sha256 = {};

  bool is_within_tolerance() const { return num_other_outcome <= kOtherOutcomes * num_trials; }
};
/** @param again  the same plan. */
Reproduction CompareRecords(const Session& entry, const Session& again);

/** The part of a simulated trial that a board compares. */
struct BoardTrial {
  PlannedTrial plan;
  Outcome outcome = Outcome::kNotRun;
  double gct = kUnset, gft_ratio = kUnset;  ///< [s], 1; NaN: no closure that counts
  double breaking_force = kUnset;           ///< of a held object that was judged [N]
};
/** The trials of one entry on one seed. A board of many entries holds no more of them in memory. */
struct BoardDraws {
  SessionConfig config = {};
  std::filesystem::path folder = {};  ///< of the session
  std::vector<BoardTrial> trials = {};
};
BoardDraws TakeDraws(const Session& session);

struct BoardEntry {
  EntryFacts facts;
  std::string pack;    ///< name of the file
  std::string sha256;  ///< of its bytes
  Reproduction reproduction;
  BoardDraws public_draws;                  ///< simulated again
  std::optional<BoardDraws> held_out = {};  ///< none: not asked for, or recorded actions
  /** Margins of the draws that rank, where somebody has looked for them. */
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
  Tally tally;                           ///< of the draws that rank
  Tally public_tally;                    ///< of the public draws
  std::optional<double> gap;             ///< public success less held-out success
  ChangeEstimate behind;                 ///< success less that of the first line
  Spread gct, gft_ratio;                 ///< [s]; of the draws that rank
  Spread breaking_force;                 ///< of the held objects that were judged [N]
  std::vector<double> thresholds;        ///< margins of the draws that rank; infinite: none held
  std::map<std::string, Tally> objects;  ///< of the draws that rank
  /** The first failed public trial, else the first, by object. */
  std::map<std::string, const BoardTrial*> examples;
};

/** The best of some lines on some objects. */
struct GroupWinner {
  std::string group;  ///< "least friction", "hand tum"
  std::vector<std::string> objects;
  int num_lines = 0;  ///< that are compared
  const BoardLine* best = nullptr;
  const BoardLine* second = nullptr;  ///< null: there is one line
  Tally tally = {};                   ///< of the best
  ChangeEstimate lead = {};           ///< success of the best less that of the second
};

struct Board {
  Benchmark benchmark;
  std::optional<int> held_out_seed;
  std::string commitment;  ///< that the seed was checked against
  std::vector<BoardEntry> entries;
  std::vector<RefusedEntry> refused;
  std::vector<std::string> objects;  ///< of the draws that rank
  std::vector<BoardLine> lines;      ///< by rank; point to entries
  std::vector<GroupWinner> winners;
};

/** Fills lines and winners, and moves entries that repeat the results of an earlier one to those
refused. @param inputs  of the draws that rank, for the objects' friction and mass. */
void RankEntries(const SessionInputs& inputs, Board& board);

/** The 95 % interval of a difference lies above zero. */
bool IsSure(const ChangeEstimate& change);

std::vector<CsvColumn<BoardLine>> ListBoardColumns();
std::vector<CsvColumn<GroupWinner>> ListWinnerColumns();
std::vector<CsvColumn<RefusedEntry>> ListRefusedColumns();

}  // namespace graspbench
