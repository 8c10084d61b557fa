#pragma once
/** @file
A hand's posture in YAML: degrees of the driven joints of each digit, from base to tip; of a
prismatic joint, millimetres.

    {TH: [0, -20, 10], FF: [4, -20, 0], MF: [15, -20, 4]} */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/text/yaml.h"
#include "core/hand/hand.h"

namespace graspbench {

/** Coupled joints are filled in. Wrong numbers and angles outside the limits go into `problems`.
@param where  what this posture is, for messages: "grasp g2, pre_deg". */
void ReadPosture(const Hand& hand, const YAML::Node& node, const std::string& file,
                 const std::string& where, Diagnostics& problems, Eigen::VectorXd& q);

/** On one line; with six decimals what is read is written again as it was. */
std::string FormatPosture(const Hand& hand, const Eigen::VectorXd& q, int decimals = 6);

/** The posture that is read when `q` was written with so many decimals. */
Eigen::VectorXd RoundPosture(const Hand& hand, const Eigen::VectorXd& q, int decimals);

/** The key "digits" of a grasp: at least two, all of this hand. */
void CheckGraspDigits(const Hand& hand, const std::vector<std::string>& digits, YamlMap& map);

}  // namespace graspbench
