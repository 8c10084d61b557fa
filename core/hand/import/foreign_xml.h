#pragma once
/** @file
What the readers of foreign XML have in common. */

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {

/** Finite numbers below 1e9, blanks or commas between them; nothing when something else stands
there. */
std::optional<std::vector<double>> ParseNumbers(const char* text);

/** The first three in quotes, "a", "b", "c" and 4 more. */
std::string JoinSome(const std::vector<std::string>& names);

/** Names of one kind of thing ("link"), each given once. */
class NameList {
 public:
  explicit NameList(std::string kind) : kind_(std::move(kind)) {}

  /** The name; another one where it is no text or taken, and then `changes` says so. */
  std::string Add(const char* text, std::vector<std::string>& changes);

 private:
  std::string kind_;
  std::set<std::string> taken_;
};

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
