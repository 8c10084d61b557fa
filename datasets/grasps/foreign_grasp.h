#pragma once
/** @file
A grasp that somebody else made, as its file states it: what every reader gives and every protocol
takes. Frames: R is the hand's root link as the file's hand has it, O the object as its mesh is
drawn (after scaling). Nothing here is converted to a hand of graspbench; map_to_hand.h does that. */

#include <optional>
#include <string>
#include <vector>

#include "core/base/pose.h"

namespace graspbench {

/** Where root and joints are at one stage, in the order in which the hand goes through them. */
struct GraspStage {
  std::string name;            ///< "pregrasp", "grasp", "squeeze"
  Pose X_OR;                   ///< [m]
  std::vector<double> joints;  ///< by ForeignGrasp::joint_names [rad], of a prismatic joint [m]
};

struct ForeignGrasp {
  std::string source;                    ///< the file's name without its folder
  int index = 0;                         ///< of the grasp in its file, from 0
  std::string format;                    ///< id of the reader
  std::string hand;                      ///< as the file names it; empty: it does not
  std::string root_link;                 ///< R; empty: the file does not say
  std::vector<std::string> joint_names;  ///< of the file's hand, in the file's order
  std::string object;                    ///< the file's path or name of the mesh
  double scale = 1.0;                    ///< of the mesh as drawn
  Pose X_WO = Pose::Identity();          ///< in the file's world
  std::vector<GraspStage> stages;        ///< at least one
  std::optional<bool> label;             ///< the file's own verdict
  std::vector<std::string> assumptions;  ///< what the file does not say and was taken for granted
};

}  // namespace graspbench
