#pragma once
/** @file
A grasp in YAML: an entry of hand.yaml for each standard grasp, and the body of a grasp file.

A posture lists the driven joints of each digit from base to tip: degrees, or millimetres for a
prismatic joint. The closing schedule is given per digit; omitted digits have no delay and speed 1.

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

/** The keys of an entry of `grasps` in hand.yaml, such as "grasps.ID.digits". */
const FileKeys& ListHandGraspKeys();

/** The keys of a grasp file (grasp_file.h). */
const FileKeys& ListGraspFileKeys();

/** The part of a file that describes a single grasp. */
struct GraspNode {
  YamlMap& map;
  const FileKeys& keys;  ///< known keys of the format
  std::string prefix;    ///< prefix of the grasp's keys in `keys`: "grasps.ID."
  std::string file;
  std::string where;  ///< prefix of the names of its parts in messages: "grasp g2, "
  Diagnostics& problems;
};

/** Reads the keys that both formats share; type, d and alpha are the taxon's. Adds to `problems`
digits that cannot grasp, postures outside the limits, and schedules that would never close a digit.
@param hand  null: unknown, so digits and postures are not checked. */
Grasp ReadGrasp(const Hand* hand, const GraspTaxon& taxon, const GraspNode& node);

/** Reads a posture and fills in coupled joints. Adds malformed numbers and angles outside the
limits to `problems`. @param where  name of the posture in messages: "grasp g2, pre_deg". */
void ReadPosture(const Hand& hand, const YAML::Node& node, const std::string& file,
                 const std::string& where, Diagnostics& problems, Eigen::VectorXd& q);

/** Formats a posture on one line; with six decimals, reading and writing reproduces the text. */
std::string FormatPosture(const Hand& hand, const Eigen::VectorXd& q, int decimals = 6);

/** The posture that is read back after `q` was written with `decimals` decimals. */
Eigen::VectorXd RoundPosture(const Hand& hand, const Eigen::VectorXd& q, int decimals);

/** Formats the closing schedules on one line, with six decimals. */
std::string FormatClosing(const Grasp& grasp);

}  // namespace graspbench
