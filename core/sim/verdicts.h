#pragma once
/** @file
One grasp under published rules of success. Each rule starts from the same instant, the end of the
hold, and keeps its source's loads, times and thresholds; objects keep their own mass and friction,
where some sources set others.

  id                rule                                              passed              score
  lift_off          lifted, held and steady at the end of the hold    it was              1 or 0
  dexgraspbench     10 m/s^2 times the mass along six axes in turn,   never moved 50 mm   axes
passed 2 s each                                          or turned 15 deg    of 6 graspa turned by a
quarter, back, the other way, back,   not dropped         quarters 1 s each of 4 multigrippergrasp
gravity of 9.81 m/s^2 for 6 s, here along each    never moved 0.3 m   shortest time of six axes [s]
  nist_pull         pulled out of the grasp with growing force until  stands its weight   force [N]
                    it slips                                          once more

A rule that turns the hand, or that presses on the object in free space, is carried out by turning
gravity in the palm's frame: at the sources' slow speeds the object feels the same. GRASPA's turns
are taken about the palm's x axis. NIST gives a force, no threshold: that one is graspbench's, and
so is the direction, straight down.

Sources: Roethling 2007; DexGraspBench (Chen, Ke, Wang 2025); GRASPA 1.0 (Bottarel et al., RA-L
2020); MultiGripperGrasp (Casas Murrilo et al. 2024); NIST SP 1227 draft (Falco et al. 2018); loads
and thresholds as read in the tools' own code where there is code. */

#include <string>
#include <vector>

#include "core/sim/held_object.h"
#include "core/sim/judgement.h"

namespace graspbench {

struct VerdictRule {
  const char* id;
  const char* name;   ///< for tables
  const char* score;  ///< what the score is, with its unit
  const char* rule;   ///< one sentence
  Verdict (*judge)(const HeldObject& held);
};

/** All rules in the order of the table. */
const std::vector<VerdictRule>& ListVerdictRules();

/** Of a trial whose object was lost by the end of the hold: no load, every rule failed. */
Judgement MakeEmptyHandJudgement();

}  // namespace graspbench
