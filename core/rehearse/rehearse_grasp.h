#pragma once
/** @file
Chooses a grasp by trying candidates (grasp_candidates.h) on imagined draws before the first trial.

    order      candidates one after the other, each on draws 0, 1, .. until one is not held
    proof      one that is held in all `num_draws` goes on to kNumProofDraws, until a second one is
               lost: the first of many candidates that holds a few draws often does so by luck
    choice     the first that proves itself; else those of the longest run, and at least three, are
               tried on all draws (of the proof, where one came to it), and that held most is taken,
               of equal ones that with the longest run, then that with the lowest grip threshold,
               else the first
    posture    where nothing was held in all draws and a search is asked for: an evolution strategy
               (core/optimise/methods/search.h) starts from the choice and tries so many postures;
               fitness is the run, of equal ones how far the first lost draw came. The choice is
               made again among all
    threshold  the smallest of the shares 1/2, 1/4, 1/8 of the grip with which draw 0 is still
               held; 1 where none is

So the cost is that of one trial for each candidate that fails at once. Every second draw has a
wrong model, friction times kDoubtFriction and mass times kDoubtMass, so that what is chosen does not
stand on an edge. All candidates meet the same draws.

The simulation is asked, so that the caller says what a draw is. Its draws must be none on which
the choice is judged later: of many candidates one that is held by luck is chosen, and on the
draws of its choice it looks better than it is. Proposed by graspbench. */

#include <functional>
#include <string>
#include <vector>

#include "core/base/text/record_fields.h"
#include "core/rehearse/grasp_candidates.h"
#include "core/trial/outcome.h"

namespace graspbench {

inline constexpr int kNumProofDraws = 12;  ///< in all
inline constexpr double kDoubtFriction = 0.8, kDoubtMass = 1.2;
/** Whether the draw of this number has the wrong model. */
inline bool IsDoubtful(int draw) { return draw % 2 == 1; }

struct RehearsalConfig {
  int num_candidates = 40;  ///< at most
  int num_draws = 4;
  int num_postures = 0;  ///< that a search tries where no candidate is held in all draws; 0: none
};
bool operator==(const RehearsalConfig& a, const RehearsalConfig& b);

/** One imagined trial. */
struct RehearsalQuestion {
  int draw = 0;
  double grip_share = 1.0;  ///< of the strategy's grip
};
struct RehearsalAnswer {
  Outcome outcome = Outcome::kNotRun;
  std::string reason;  ///< why it failed
};
using RunRehearsal = std::function<RehearsalAnswer(const Grasp& grasp, const RehearsalQuestion&)>;

/** A candidate and what was found of it. */
struct RehearsedCandidate {
  GraspCandidate candidate;
  std::vector<Outcome> outcomes;  ///< by draw, until one is not held; of finalists all
  std::string reason;             ///< of its first failure
  double grip_threshold = 1.0;    ///< share of the grip; 1 where it was not looked for

  int CountHeld() const;
  std::string FormatHeld() const;      ///< "11 of 12"
  std::string FormatInterval() const;  ///< Wilson's at 95 %: "65 to 99 %"
  /** Held draws before the first that was not. */
  int FindRun() const;

  template <class V>
  static void ListFields(V&& field) {
    using R = RehearsedCandidate;
    field("candidate", &R::candidate);
    field("outcomes", &R::outcomes);
    field("reason", &R::reason);
    field("grip_threshold", &R::grip_threshold);
  }
};

struct Rehearsal {
  std::vector<RehearsedCandidate> tried;  ///< in order
  int chosen = 0;                         ///< index into them
  int num_trials = 0;                     ///< in all

  const RehearsedCandidate& choice() const { return tried[static_cast<size_t>(chosen)]; }
  /** Held in every draw of rehearsal. */
  bool is_robust() const {
    return choice().CountHeld() == static_cast<int>(choice().outcomes.size());
  }

  template <class V>
  static void ListFields(V&& field) {
    field("tried", &Rehearsal::tried);
    field("chosen", &Rehearsal::chosen);
    field("trials", &Rehearsal::num_trials);
  }
};

/** @pre the maker has a grasp, and the configuration a candidate and a draw. */
Rehearsal RehearseGrasp(const CandidateMaker& maker, const RehearsalConfig& config,
                        const RunRehearsal& run);

}  // namespace graspbench
