#pragma once
/** @file
The hands and objects of a session, as far as they can still be loaded, for names and pictures. */

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "datasets/analysis/session_summary.h"

namespace graspbench {

struct SessionModels {
  std::map<std::string, std::shared_ptr<const Hand>> hands;
  std::map<std::string, std::shared_ptr<const GraspObject>> objects;
  std::vector<std::string> problems;  ///< what a reader must know of them

  /** The name for a person; the id when the model is missing. */
  std::string NameOfHand(const std::string& id) const;
  std::string NameOfObject(const std::string& id) const;
  /** "thumb"; the digit's id when the hand is missing. */
  std::string NameOfDigit(const std::string& hand, const std::string& digit) const;
  /** Null when missing. */
  std::shared_ptr<const Hand> FindHand(const std::string& id) const;
  std::shared_ptr<const GraspObject> FindObject(const std::string& id) const;
};

/** Loads the session's hands and objects. When they cannot be loaded or have changed since, that
becomes a problem and no error: the results stand without them. */
SessionModels LoadSessionModels(const Session& session);

/** "power (g3)"; the id alone when it is none of the standard grasps. */
std::string NameOfGrasp(const std::string& id);

/** "TUM Hand, can, power (g3)". */
std::string NameOfCell(const CellSummary& cell, const SessionModels& models);

}  // namespace graspbench
