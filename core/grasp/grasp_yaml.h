#pragma once
/** @file
A grasp in YAML: what stands in hand.yaml for each standard grasp, and in files of their own.

A posture has degrees of the driven joints of each digit, from base to tip; of a prismatic joint,
millimetres. The closing schedule stands by digit; what is left out is that of all.

    digits: [TH, FF, MF]
    tilt_deg: -3
    palm_may_touch: true
    palm_gap_m: 0.003
    approach: above
    closing: {FF: {delay_s: 0.05, speed: 1.5}, TH: {speed: 0.8}}
    pre_deg: {TH: [0, -20, 10], FF: [4, -20, 0], MF: [15, -20, 4]}
    target_deg: {TH: [0, 20, 10], FF: [4, 30, 0], MF: [15, 30, 4]} */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/text/yaml.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"

namespace graspbench {

/** What each of `grasps` in hand.yaml may have: "grasps.ID.digits". */
const FileKeys& ListHandGraspKeys();

/** The keys of a grasp file (grasp_file.h). */
const FileKeys& ListGraspFileKeys();

/** The part of a file that describes one grasp. */
struct GraspNode {
  YamlMap& map;
  const FileKeys& keys;  ///< the format's rows
  std::string prefix;    ///< of the grasp's keys there: "grasps.ID."
  std::string file;
  std::string where;  ///< before the names of its parts in messages: "grasp g2, "
  Diagnostics& problems;
};

/** The keys that both formats have; type, d and alpha are the taxon's. Digits that do not grasp,
postures outside the limits, and schedules with which a digit would stay open for good, go into
`problems`. @param hand  null: not known, digits and postures are not judged. */
Grasp ReadGrasp(const Hand* hand, const GraspTaxon& taxon, const GraspNode& node);

/** Coupled joints are filled in. Wrong numbers and angles outside the limits go into `problems`.
@param where  what this posture is, for messages: "grasp g2, pre_deg". */
void ReadPosture(const Hand& hand, const YAML::Node& node, const std::string& file,
                 const std::string& where, Diagnostics& problems, Eigen::VectorXd& q);

/** On one line; with six decimals what is read is written again as it was. */
std::string FormatPosture(const Hand& hand, const Eigen::VectorXd& q, int decimals = 6);

/** The posture that is read when `q` was written with so many decimals. */
Eigen::VectorXd RoundPosture(const Hand& hand, const Eigen::VectorXd& q, int decimals);

/** The closing schedules on one line, with six decimals. */
std::string FormatClosing(const Grasp& grasp);

}  // namespace graspbench
