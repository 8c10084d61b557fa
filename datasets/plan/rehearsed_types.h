#pragma once
/** @file
Which standard grasp a hand takes on an object by "best", the default. What the object names for the
hand (best_grasp of object.yaml) is taken. Else imagined trials choose among the standard grasps,
each as the rule places it (core/rehearse): for the shipped hands and objects once, stored in
objects/catalogue/rehearsed_types.json with the hash of the rehearsal, for others when the session
is made, under its settings. The stored choice is that under the default settings; sessions with
other settings take it, too, so that they compare the same grasps. It is found by its hash, so that
a hand, an object or an approach that is another is rehearsed.

"predicted" is the choice by geometry alone (grasp_choice.h). The thesis (4.2) chooses by trying
every grasp on every object. */

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/text/record_fields.h"

namespace graspbench {

struct Rehearsal;
struct RehearsalTask;
struct SessionConfig;

/** Names of grasps in a configuration. */
inline constexpr const char* kBestGrasp = "best";
inline constexpr const char* kPredictedGrasp = "predicted";

/** Makes the stored choice again, from the root of the sources. */
inline constexpr char kRehearseTypes[] =
    "graspbench rehearse --types --draws 20 --out results/types && cp results/types/types.json "
    "objects/catalogue/rehearsed_types.json";
inline constexpr int kShippedTypeDraws = 20;  ///< as there
inline constexpr int kTypeDraws = 4;          ///< of what a session rehearses itself

struct RehearsedType {
  std::string hand, object;  ///< ids
  std::string grasp;         ///< id of the standard grasp
  int held = 0, draws = 0;   ///< of its imagined trials
  std::string hash;          ///< of the rehearsal (rehearsed_grasps.h)

  template <class V>
  static void ListFields(V&& field) {
    using R = RehearsedType;
    field("hand", &R::hand);
    field("object", &R::object);
    field("grasp", &R::grasp);
    field("held", &R::held);
    field("draws", &R::draws);
    field("hash", &R::hash);
  }
};
/** By hand and object. */
using RehearsedTypes = std::map<std::pair<std::string, std::string>, RehearsedType>;

/** A JSON list, one line each. */
std::string FormatTypes(const RehearsedTypes& types);
/** @param file  its name in messages. @throws Error(kFormat). */
RehearsedTypes ParseTypes(const std::string& text, const std::string& file);

/** Those of objects/catalogue/rehearsed_types.json, read once. */
const RehearsedTypes& LoadShippedTypes();
/** The stored choice for the task's hand, grasps and object; nothing: it is to be rehearsed. */
std::optional<RehearsedType> FindShippedType(const RehearsalTask& task);

/** Whether the session, or one of its conditions, asks for "best". */
bool HasBestGrasp(const SessionConfig& config);

/** The same rehearsal of the standard grasps alone, each as the rule places it. */
RehearsalTask MakeTypeTask(RehearsalTask task, int num_draws);
/** Whether rehearsal chooses: the hand has standard grasps for the object, which names none. */
bool NeedsType(const RehearsalTask& task);
RehearsedType MakeType(const RehearsalTask& task, const Rehearsal& rehearsal);

}  // namespace graspbench
