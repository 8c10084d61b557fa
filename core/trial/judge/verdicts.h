#pragma once
/** @file
One grasp under published rules of success. Each rule starts from the same instant, the end of the
hold, and keeps its source's loads, times and thresholds; objects keep their own mass and friction,
where some sources set others.

  id                 rule                                           passed if           score
  lift_off           lifted, held and steady at the end             it was              1 or 0
  dexgraspbench      10 m/s^2 times the mass, six axes, 2 s each    always < 50 mm      axes of 6
                                                                    and < 15 deg
  graspa             a quarter turn, back, other way, back, 1 s     not dropped         of 4 turns
  multigrippergrasp  gravity of 9.81 m/s^2 along six axes, 6 s      always < 0.3 m      time [s]
  nist_pull          pulled with growing force until it slips       stands its weight   force [N]
                                                                    once more

A rule that turns the hand, or that presses on the object in free space, is carried out by turning
gravity in the palm's frame: at the sources' slow speeds the object feels the same. GRASPA's turns
are taken about the palm's x axis. NIST gives a force, no threshold: that one is graspbench's, and
so is the direction, straight down.

Sources: Roethling 2007; DexGraspBench (Chen, Ke, Wang 2025); GRASPA 1.0 (Bottarel et al., RA-L
2020); MultiGripperGrasp (Casas Murrilo et al. 2024); NIST SP 1227 draft (Falco et al. 2018); loads
and thresholds as read in the tools' own code where there is code. */

#include <string>
#include <vector>

#include "core/trial/judge/held_object.h"
#include "core/trial/judge/judgement.h"

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
