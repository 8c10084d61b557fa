#pragma once
/** @file
What passes between a trial and its controller: each observation, action and fact once, with unit,
shape, frame and meaning. Adapters write and read by these tables, and the manual's page is tested
against them.

Shapes: n, joints with a drive of their own; m, all joints; d, digits of the hand; k, its tactile
elements; s, the side of the picture; rows, of an action. Frames: W world, z up; L the link.
Quaternions are w, x, y, z. */

#include <string>
#include <vector>

#include "core/trial/policy/hand_policy.h"

namespace graspbench {

/** What a table of the manual says of a value. */
struct PolicyTerm {
  const char* name;
  const char* unit;   ///< empty: none
  const char* shape;  ///< "" a number, "n", "k x 3"
  const char* frame;  ///< empty: none
  const char* meaning;
};

/** An observation: given with every question. */
struct PolicyObservation {
  PolicyTerm term;
  /** Whether this trial gives it. */
  bool (*is_given)(const PolicyView& view);
  /** Appends its numbers, the last index of the shape fastest. */
  void (*find)(const PolicyView& view, std::vector<double>& values);
  bool is_number;                         ///< else a vector
  double PolicyConfig::*noise = nullptr;  ///< standard deviation; null: it has none
  bool is_picture = false;                ///< whole numbers from 0 to 255, sent as bytes
};
const std::vector<PolicyObservation>& ListPolicyObservations();

/** What an answer may hold. */
const std::vector<PolicyTerm>& ListPolicyActions();

/** A fact of a trial: given once, before the first question. */
struct PolicyFact {
  PolicyTerm term;
  Json (*find)(const PolicyView& view);  ///< null: this trial does not give it
};
const std::vector<PolicyFact>& ListPolicyFacts();

/** The tables of the manual, as Markdown: observations, actions, facts. */
std::string FormatPolicyTerms();

}  // namespace graspbench
