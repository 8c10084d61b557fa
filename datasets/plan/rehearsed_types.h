#pragma once
/** @file
Which standard grasp a hand uses on an object for "best", the default. If the object names one for
the hand (best_grasp in object.yaml), it is used. Otherwise imagined trials choose among the
standard grasps, each placed by the rule (core/rehearse). For the shipped hands and objects this was
done once, under the default settings; objects/catalogue/rehearsed_types.json stores the choice with
the hash of the rehearsal. For others it is done when the session is made, under its settings.
Sessions with other settings also use the stored choice, so that they compare the same grasps. It is
looked up by its hash, so a changed hand, object or approach is rehearsed again.

"predicted" is the choice by geometry alone (grasp_choice.h). The thesis (4.2) chooses by executing
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

/** Command that regenerates the stored choice, from the root of the sources. */
inline constexpr char kRehearseTypes[] =
    "graspbench rehearse --types --draws 20 --out results/types && cp results/types/types.json "
    "objects/catalogue/rehearsed_types.json";
inline constexpr int kShippedTypeDraws = 20;  ///< in that command
inline constexpr int kTypeDraws = 4;          ///< in a session's own rehearsal

struct RehearsedType {
  std::string hand, object;  ///< ids
  std::string grasp;         ///< id of the standard grasp
  int held = 0, draws = 0;   ///< imagined trials: successful, all
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
/** Keyed by hand and object id. */
using RehearsedTypes = std::map<std::pair<std::string, std::string>, RehearsedType>;

/** Formats the types as a JSON list, one line per type. */
std::string FormatTypes(const RehearsedTypes& types);
/** Parses the text of FormatTypes. @param file  its name in messages. @throws Error(kFormat). */
RehearsedTypes ParseTypes(const std::string& text, const std::string& file);

/** The types in objects/catalogue/rehearsed_types.json, read once. */
const RehearsedTypes& LoadShippedTypes();
/** Returns the stored choice for the task's hand, grasps and object; nothing if it must be
rehearsed. */
std::optional<RehearsedType> FindShippedType(const RehearsalTask& task);

/** Whether the session or one of its conditions uses "best". */
bool HasBestGrasp(const SessionConfig& config);

/** Restricts a rehearsal to the standard grasps alone, each placed by the rule, without an arm. */
RehearsalTask MakeTypeTask(RehearsalTask task, int num_draws);
/** Whether rehearsal must choose: the hand has standard grasps for the object, and the object names
none as best. */
bool NeedsType(const RehearsalTask& task);
RehearsedType MakeType(const RehearsalTask& task, const Rehearsal& rehearsal);

}  // namespace graspbench
