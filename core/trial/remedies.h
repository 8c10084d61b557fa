#pragma once
/** @file
Remedies for a failed trial: it is run again with one change, on its own sampled initial pose (draw)
and on new draws of its condition. A single draw shows little: many failures are borderline, and any
other draw may hold.

    placebo      the object moved by 0.2 mm along x and 0.2 degrees: if it holds, the failure was
                 borderline
    available    grip x 2 and x 4 (safety factor and minimum force, or force), a firm grip (by
    to a user    posture; if it is one, by margin as in sessions by default), simultaneous touch
                 (each digit delayed by its lead over the last), half the closing speed, the hand
                 8 mm higher or lower, another grasp
    diagnostic   the least friction factor of 1.1, 1.25, 1.5 and 2 that holds, no offset, no joint
    only         error, half the mass; on the failed draw only

Each remedy that is available to a user runs on the first 4 of 20 new draws. The four with the
largest net gain run on 10, and the best of these on all 20. Other grasps and the remaining remedies
compete separately (successive halving; K. Jamieson and A. Talwalkar, AISTATS 2016). Ties are
decided by whether the remedy holds on the failed draw, then by order. The rehearsed grasp comes
first, since it was chosen on simulated draws. Net gain is the number of improved minus that of
worsened draws. A short explanation tests only placebo, grip x 4, a firm (or regulated) grip, the
lower hand and other grasps, on the first 4 draws. Proposed by graspbench. */

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text/record_fields.h"
#include "core/trial/trial_runner.h"

namespace graspbench {

inline constexpr int kNumFreshDraws = 20;
inline constexpr int kNumFirstDraws = 4;
/** Least net gain for which a remedy is named, out of `num_draws` new draws: two, or a fifth of
them. The best of some twenty remedies gains two or three of twenty draws by chance. */
inline int CalcLeastNetGain(int num_draws) { return std::max(2, num_draws / 5); }

/** Result of one remedy. */
struct RemedyResult {
  std::string id;      ///< "grip-x2", "grasp-g3", "friction-x1.25", ..
  bool holds = false;  ///< on the failed draw
  int num_draws = 0;   ///< new draws on which it ran; 0: diagnostic only
  int num_mended = 0;  ///< of these: it holds and the unchanged trial fails
  int num_broken = 0;  ///< the reverse

  int net_gain() const { return num_mended - num_broken; }

  template <class V>
  static void ListFields(V&& field) {
    using R = RemedyResult;
    field("id", &R::id);
    field("holds", &R::holds);
    field("num_draws", &R::num_draws);
    field("num_mended", &R::num_mended);
    field("num_broken", &R::num_broken);
  }
};

/** Extent of an explanation: all of the above, or the most frequently helpful remedies on four new
draws. */
enum class ExplainDepth { kShort, kFull };

struct Explanation {
  bool is_on_edge = false;             ///< borderline: the placebo holds
  std::vector<int> held;               ///< by new draw, 1 if the unchanged trial holds, else 0
  std::vector<RemedyResult> remedies;  ///< in the order above

  int num_draws() const { return static_cast<int>(held.size()); }  ///< new draws
  int num_held() const;
  bool is_short() const { return num_draws() < kNumFreshDraws; }
  /** Returns the first remedy with the largest net gain over all new draws, or null if that is
  below CalcLeastNetGain. @param is_grasp  among other grasps, or among the remaining remedies. */
  const RemedyResult* FindBest(bool is_grasp) const;

  template <class V>
  static void ListFields(V&& field) {
    using E = Explanation;
    field("is_on_edge", &E::is_on_edge);
    field("held", &E::held);
    field("remedies", &E::remedies);
  }
};

/** Name of a remedy in reports, such as "twice the grip". */
std::string NameRemedy(const std::string& id);
bool IsAnotherGrasp(const RemedyResult& remedy);

/** A failed trial, with the data that an explanation needs. */
struct FailedTrial {
  TrialSetup setup;
  TrialResult result;
  std::vector<TrialDraw> fresh;  ///< new draws of its condition, in no session
  std::vector<Grasp> grasps;     ///< other grasps of the hand for the object
};

/** Applies a remedy. The object of the result may be another one. */
TrialSetup ApplyRemedy(const std::string& id, const FailedTrial& failed, TrialSetup setup);

/** Runs the trials: some 150, or 40 for a short explanation. @param runner  for the setup's hand
and object. @pre no controller moves the digits, and the trial uses the default backend. */
Explanation ExplainFailure(TrialRunner& runner, const FailedTrial& failed,
                           ExplainDepth depth = ExplainDepth::kFull);

/** Formats one paragraph, such as "Without a remedy 0 of 20 fresh draws of the condition hold.
..". */
std::string DescribeExplanation(const Explanation& explanation);

/** Lists the remedies that hold on more new draws, for a table: "the hand 8 mm lower: 12 of 20;
grasp g3: 18 of 20". */
std::string SummariseExplanation(const Explanation& explanation);

}  // namespace graspbench
