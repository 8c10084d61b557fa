#pragma once
/** @file The moments of a trial whose posture is kept, for pictures and numbers. */

#include <string>

#include "core/base/enum_table.h"
#include "core/base/json.h"

namespace graspbench {

enum class Moment { kPreGrasp, kClosed, kLifted };
struct MomentRow {
  Moment value;
  const char* name;   ///< in files and options
  const char* words;  ///< as a heading
};
inline constexpr MomentRow kMoments[] = {{Moment::kPreGrasp, "pregrasp", "Pre-grasp"},
                                         {Moment::kClosed, "closed", "Closed"},
                                         {Moment::kLifted, "lifted", "Lifted"}};

inline const char* NameOf(Moment moment) { return RowOf(kMoments, moment).name; }

inline Json ToJson(Moment moment) { return NameOf(moment); }
/** @throws Error(kFormat). */
inline void ReadJson(const Json& json, Moment& moment) {
  moment = RowFromName(kMoments, json.get<std::string>(), "moment").value;
}

}  // namespace graspbench
