#pragma once
/** @file
Chooses a grasp by testing candidates (grasp_candidates.h) in simulated draws before the first
trial.

    order      candidates run one after the other, each on draws 0, 1, .. until one is not held
    proof      a candidate held in all `num_draws` continues to kNumProofDraws, until a second draw
               is lost: the first of many candidates that holds a few draws often does so by chance
    choice     the first that passes the proof. Otherwise those of the longest run, and at least
               three, are tested on all draws (on those of the proof if one reached it). The one
               that held most is chosen; ties are decided by the longest run, then by the lowest
               grip threshold, then by order
    posture    if none passed the proof and a search is requested: an evolution strategy
               (core/optimise/methods/search.h) starts from the choice and tests `num_postures`
               postures. The fitness is the run; between equal runs it is the progress of the first
               lost draw. The start and the postures of the longest runs are then tested on more
               draws, and the one that held most is chosen
    threshold  the smallest of the shares 1/2, 1/4, 1/8 of the grip with which draw 0 is still
               held; 1 if there is none

A candidate that fails at once thus costs one trial only. Every second draw has a wrong model, with
friction times kDoubtFriction and mass times kDoubtMass, so that the choice is not borderline. All
candidates run on the same draws.

Trials are run by a callback, so that the caller defines the draws. They must differ from the draws
on which the choice is evaluated later. Among many candidates, one that held by chance is chosen,
and its success rate on the draws of the choice is biased upwards. Proposed by graspbench. */

#include <functional>
#include <string>
#include <vector>

#include "core/base/text/record_fields.h"
#include "core/rehearse/grasp_candidates.h"
#include "core/trial/outcome.h"

namespace graspbench {

inline constexpr int kNumProofDraws = 12;  ///< total, including `num_draws`
inline constexpr double kDoubtFriction = 0.8, kDoubtMass = 1.2;
/** Whether the draw of this number has the wrong model. */
inline bool IsDoubtful(int draw) { return draw % 2 == 1; }

struct RehearsalConfig {
  int num_candidates = 40;  ///< at most
  int num_draws = 4;
  int num_postures = 0;  ///< postures to search if no candidate passes the proof; 0: none
};
bool operator==(const RehearsalConfig& a, const RehearsalConfig& b);

/** One simulated trial. */
struct RehearsalQuestion {
  int draw = 0;
  double grip_share = 1.0;  ///< of the strategy's grip
};
struct RehearsalAnswer {
  Outcome outcome = Outcome::kNotRun;
  std::string reason;  ///< why it failed
};
using RunRehearsal = std::function<RehearsalAnswer(const Grasp& grasp, const RehearsalQuestion&)>;

/** A candidate and its results. */
struct RehearsedCandidate {
  GraspCandidate candidate;
  std::vector<Outcome> outcomes;  ///< by draw, until one is not held; for finalists all
  std::string reason;             ///< reason of its first failure
  double grip_threshold = 1.0;    ///< share of the grip; 1 if it was not searched

  int CountHeld() const;
  std::string FormatHeld() const;      ///< "11 of 12"
  std::string FormatInterval() const;  ///< Wilson interval at 95 %: "65 to 99 %"
  /** Number of held draws before the first that was not held. */
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
  std::vector<RehearsedCandidate> tried;  ///< in the order of testing
  int chosen = 0;                         ///< index into `tried`
  int num_trials = 0;                     ///< total

  const RehearsedCandidate& choice() const { return tried[static_cast<size_t>(chosen)]; }
  /** Whether the choice was held in every draw of the rehearsal. */
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

/** @pre the maker has at least one grasp, and the configuration a candidate and a draw. */
Rehearsal RehearseGrasp(const CandidateMaker& maker, const RehearsalConfig& config,
                        const RunRehearsal& run);

}  // namespace graspbench
