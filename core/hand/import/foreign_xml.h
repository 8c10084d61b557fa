#pragma once
/** @file
What the readers of foreign descriptions have in common. */

#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/hand/import/foreign_hand.h"
#include "core/hand/xml_text.h"

namespace graspbench {

/** q = offset + ratio q_other, the other joint by its name. */
struct NamedMimic {
  int joint = -1;  ///< index into ForeignHand::joints
  int line = 0;
  std::string follows;
  double ratio = 1.0;
  double offset = 0.0;
};

/** Ties joints to joints that follow nobody. Of itself, in a ring, of nobody, of what does not move:
the joint gets a drive of its own, with a warning. @param what  in messages, "<mimic>". */
void ResolveMimics(const std::vector<NamedMimic>& mimics, const std::string& what,
                   const std::string& file, Diagnostics& problems, ForeignHand& hand);

}  // namespace graspbench
