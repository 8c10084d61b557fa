#pragma once
/** @file
The interface between a trial and its controller: each observation, action and fact, with unit,
shape, frame and meaning. Adapters write and read by these tables, and the manual's page is tested
against them.

Shapes: n, joints with their own drive; m, all joints; d, digits of the hand; k, its tactile
elements; s, side of the image; rows, rows of an action. Frames: W world, z up; L the link.
Quaternions are w, x, y, z. */

#include <string>
#include <vector>

#include "core/trial/policy/hand_policy.h"

namespace graspbench {

/** Description of a value in a table of the manual. */
struct PolicyTerm {
  const char* name;
  const char* unit;   ///< empty: none
  const char* shape;  ///< "" for a number, "n", "k x 3"
  const char* frame;  ///< empty: none
  const char* meaning;
};

/** An observation, sent with every question. */
struct PolicyObservation {
  PolicyTerm term;
  /** Whether this trial sends it. */
  bool (*is_given)(const PolicyView& view);
  /** Appends its numbers, the last index of the shape fastest. */
  void (*find)(const PolicyView& view, std::vector<double>& values);
  bool is_number;                         ///< a single number; else a vector
  double PolicyConfig::*noise = nullptr;  ///< standard deviation; null: no noise
  bool is_picture = false;                ///< integers from 0 to 255, sent as bytes
};
const std::vector<PolicyObservation>& ListPolicyObservations();

/** The possible entries of an answer. */
const std::vector<PolicyTerm>& ListPolicyActions();

/** A fact of a trial, sent once before the first question. */
struct PolicyFact {
  PolicyTerm term;
  Json (*find)(const PolicyView& view);  ///< null: not sent in this trial
};
const std::vector<PolicyFact>& ListPolicyFacts();

/** Formats the tables of the manual as Markdown: observations, actions, facts. */
std::string FormatPolicyTerms();

}  // namespace graspbench
