#pragma once
/** @file
A grasp in free space: hand and object begin where the first stage has them, the object at rest; the
hand goes through its stages, and closes beyond the last where the profile says so
(CalcClosingCommand); then, from that instant each time, the object is pushed along each of
the six half axes of W with its mass times the profile's acceleration; or once, out of the palm; or
the hand lifts it from a table. The grasp passes when in every look the object has moved less than
the profile's limits from where it was at the start (of a lift: raised with it), and, where the
profile says so, is touched in the last; one that nothing touches, neither after closing nor at the
end of a push, fails. The first push that it does not stand decides.

The breaking load is the largest push that it stands along each of the six, found by bisection with
whole pushes, so what decides is the same: 0.05 relative, from 1/64 to 16 times the profile's.

Where the profile updates commands n times a stage, they jump: root and drives are asked for the
pose at (k + 1)/n of the way during the k-th part. The root turns along the shortest way at an even
rate, the joints go straight.

Source: DexGraspBench (Chen, Ke and Wang 2025), src/task/eval_func/{base, fc_mocap,
tabletop_mocap}.py of its main branch, read 2026-11; there each push repeats the stages, which is
the same instant. */

#include <string>
#include <vector>

#include "core/base/text/record_fields.h"
#include "core/base/units.h"
#include "core/trial/protocols/free_space_profile.h"
#include "core/trial/trial_trace.h"

namespace graspbench {

struct FreeSpaceResult {
  bool passed = false;
  std::string failed_stage;        ///< "limits", "start", a stage, "push +x", "lift"; empty: passed
  std::string reason;              ///< one sentence for a person; empty: passed
  bool is_numerical = false;       ///< the simulation failed, which tells nothing of the grasp
  int num_beyond_limits = 0;       ///< joints that a stage asks for more than their limits
  double start_penetration = 0.0;  ///< of hand and object at the first stage [m]
  double self_penetration = 0.0;   ///< of the hand in itself at the second stage [m]
  std::string touching;            ///< digits on the object after the last stage: "TH FF palm"
  double grip_force = 0.0;         ///< sum of normal forces after the last stage [N]
  /** Ferrari and Canny's, of these contacts (core/quality: convention ferrari-canny, moments by the
  largest distance of the surface from the centre of mass); 0: no force closure. */
  double epsilon = 0.0;
  double closing_shift = 0.0;  ///< object shift by the end of the last stage [m]
  double closing_turn_deg = 0.0;
  /** Largest push that the grasp stands along all six axes, to 5 % below, and the one along which
  more breaks it [N]; empty: none within 16 times the profile's. 0: not sought, or none stood. */
  ///@{
  double breaking_load = 0.0;
  std::string breaks_along;
  ///@}
  int num_stood = 0;         ///< pushes, of 6, or lifts, of 1
  double worst_shift = 0.0;  ///< of all looks [m]
  double worst_turn_deg = 0.0;
  int num_unconverged = 0;  ///< steps
  int num_steps = 0;

  template <class V>
  static void ListFields(V&& field) {
    using R = FreeSpaceResult;
    field("passed", &R::passed, FieldColumn{"", "verdict"});
    field("failed_stage", &R::failed_stage, FieldColumn{"", "where it failed"});
    field("reason", &R::reason, FieldColumn{"", "why"});
    field("is_numerical", &R::is_numerical);
    field("num_beyond_limits", &R::num_beyond_limits,
          FieldColumn{"", "joints that a stage asks for more than their limits"});
    field("start_penetration_m", &R::start_penetration,
          FieldColumn{"m", "of hand and object at the first stage"});
    field("self_penetration_m", &R::self_penetration,
          FieldColumn{"m", "of the hand in itself at the second stage"});
    field("touching", &R::touching, FieldColumn{"", "digits on the object after the last stage"});
    field("grip_force_n", &R::grip_force,
          FieldColumn{"N", "sum of normal forces after the last stage"});
    field("epsilon", &R::epsilon,
          FieldColumn{"", "of these contacts, ferrari-canny; 0: no force closure"});
    field("closing_shift_m", &R::closing_shift,
          FieldColumn{"m", "of the object by closing, before the test"});
    field("closing_turn_deg", &R::closing_turn_deg);
    field("breaking_load_n", &R::breaking_load,
          FieldColumn{"N",
                      "largest push resisted along all six axes, to 5 %; 0: not sought, or no push "
                      "was resisted"});
    field("breaks_along", &R::breaks_along,
          FieldColumn{"",
                      "the push along which more breaks it; empty with a load: 16 times the "
                      "profile's did not"});
    field("num_stood", &R::num_stood, FieldColumn{"", "pushes or lifts that the grasp resisted"});
    field("worst_shift_m", &R::worst_shift, FieldColumn{"m", "of the object, in all looks"});
    field("worst_turn_deg", &R::worst_turn_deg,
          FieldColumn{"deg", "turn of the object, in all looks"});
    field("num_unconverged", &R::num_unconverged);
    field("num_steps", &R::num_steps);
  }
};

/** Never throws for what happens in the physics. @pre the scene is of this profile. */
FreeSpaceResult RunFreeSpace(const ProfiledScene& scene, const FreeSpaceProfile& profile);

struct TracedFreeSpace {
  FreeSpaceResult result;  ///< that of RunFreeSpace, to the last byte
  /** From the start, where that could be, through the stages (closure) to the end of the lift
  (lift-off) or of a push (hold): the one that decides, or else moved the object most. */
  std::vector<TraceInstant> trace;
};
/** @param interval  of the instants, rounded up to whole steps; some 2 kB each [s] */
TracedFreeSpace TraceFreeSpace(const ProfiledScene& scene, const FreeSpaceProfile& profile,
                               double interval);

}  // namespace graspbench
