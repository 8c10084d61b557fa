#pragma once
/** @file
The moments of a trial whose posture is kept, for pictures and numbers. Each stands for a phase of
the strategy: the pre-grasp at the object, the end of stabilisation, the end of the trial. */

#include <string>

#include "core/base/enum_table.h"
#include "core/base/text/json.h"
#include "core/grasp/strategy.h"

namespace graspbench {

enum class Moment { kPreGrasp, kClosed, kLifted };
struct MomentRow {
  Moment value;
  const char* name;  ///< in records
  Phase phase;       ///< gives its name in options and headings
};
inline constexpr MomentRow kMoments[] = {{Moment::kPreGrasp, "pregrasp", Phase::kPreGrasp},
                                         {Moment::kClosed, "closed", Phase::kStabilisation},
                                         {Moment::kLifted, "lifted", Phase::kHold}};

/** That of its phase. */
inline const char* NameOf(Moment moment) { return NameOf(RowOf(kMoments, moment).phase); }

inline Json ToJson(Moment moment) { return RowOf(kMoments, moment).name; }
/** @throws Error(kFormat). */
inline void ReadJson(const Json& json, Moment& moment) {
  moment = RowFromName(kMoments, json.get<std::string>(), "moment").value;
}

}  // namespace graspbench
