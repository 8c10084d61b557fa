#pragma once
/** @file
What would have held: a failed trial run again with one thing changed, on its own draw and on fresh
draws of its condition. One draw alone says little: many failures stand on an edge, where any other
draw may hold.

    placebo      the object 0.2 mm along x and 0.2 degrees aside: where it holds, the trial failed
                 on an edge
    what a user  grip x 2 and x 4 (margin and least force, or force), a firm grip (by posture; where
    can do       it is one, by margin as sessions do by default), digits that touch together (each
                 later by what it touched before the last), closing at half the speed, the hand 8 mm
                 higher or lower, another grasp
    what only    friction at the least factor of 1.1, 1.25, 1.5 and 2 that holds, no offset, no joint
    explains     error, half the mass; on the failed draw alone

Each remedy that a user can do runs on the first 4 of 20 fresh draws, the four with the largest net
gain on 10, the best of those on all 20: among other grasps, and among the rest (successive halving;
K. Jamieson and A. Talwalkar, AISTATS 2016). Of equal ones that which holds on the failed draw, then
the first; the rehearsed grasp comes first, since imagined draws have chosen it.
Net gain is what a remedy mends less what it breaks. A short explanation tries placebo, grip x 4,
firm (or regulated) grip, the lower hand and other grasps on the first 4 and asks no further.
Proposed by graspbench. */

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text/record_fields.h"
#include "core/trial/trial_runner.h"

namespace graspbench {

inline constexpr int kNumFreshDraws = 20;
inline constexpr int kNumFirstDraws = 4;
/** Net gain from which a remedy is named, of so many fresh draws: two, and a fifth of them. Of some
twenty remedies the best gains two or three of twenty draws by chance. */
inline int CalcLeastNetGain(int num_draws) { return std::max(2, num_draws / 5); }

/** What one remedy did. */
struct RemedyResult {
  std::string id;      ///< "grip-x2", "grasp-g3", "friction-x1.25", ..
  bool holds = false;  ///< on the failed draw
  int num_draws = 0;   ///< fresh ones that it ran on; 0: it only explains
  int num_mended = 0;  ///< of those: it holds, and the trial as it is does not
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

/** How much is tried: all of the above, or the remedies that help most often, on four fresh
draws. */
enum class ExplainDepth { kShort, kFull };

struct Explanation {
  bool is_on_edge = false;             ///< the placebo holds
  std::vector<int> held;               ///< 1 or 0 by fresh draw, as the trial is
  std::vector<RemedyResult> remedies;  ///< in the order above

  int num_draws() const { return static_cast<int>(held.size()); }  ///< fresh ones
  int num_held() const;
  bool is_short() const { return num_draws() < kNumFreshDraws; }
  /** The first of those with the largest net gain over all fresh draws, if that is enough.
  @param is_grasp  among other grasps, or among the rest. */
  const RemedyResult* FindBest(bool is_grasp) const;

  template <class V>
  static void ListFields(V&& field) {
    using E = Explanation;
    field("is_on_edge", &E::is_on_edge);
    field("held", &E::held);
    field("remedies", &E::remedies);
  }
};

/** "twice the grip", for a person. */
std::string NameRemedy(const std::string& id);
bool IsAnotherGrasp(const RemedyResult& remedy);

/** A failed trial with what it takes to ask further. */
struct FailedTrial {
  TrialSetup setup;
  TrialResult result;
  std::vector<TrialDraw> fresh;  ///< draws of its condition that no session has
  std::vector<Grasp> grasps;     ///< others that the hand can do on the object
};

/** A remedy applied. The setup's object may be another one. */
TrialSetup ApplyRemedy(const std::string& id, const FailedTrial& failed, TrialSetup setup);

/** Runs the trials, some 150, or shortly 40. @param runner  of the setup's hand and object.
@pre no controller moves the digits, and the default backend does the trial. */
Explanation ExplainFailure(TrialRunner& runner, const FailedTrial& failed,
                           ExplainDepth depth = ExplainDepth::kFull);

/** "As it is, 0 of 20 fresh draws hold. Another grasp: g3 holds 18 of 20; ..". One paragraph. */
std::string DescribeExplanation(const Explanation& explanation);

/** "the hand 8 mm lower: 12 of 20; grasp g3: 18 of 20": what holds more fresh draws, for a
table. */
std::string SummariseExplanation(const Explanation& explanation);

}  // namespace graspbench
