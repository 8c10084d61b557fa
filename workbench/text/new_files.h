#pragma once
/** @file
The files that `graspbench new` writes: small, working examples. */

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace graspbench {

namespace assets {  // files of new_hand/, new_arm/
extern const std::string_view kHandUrdf, kHandYaml, kArmYaml;
}

/** A file's name and content. */
using NewFile = std::pair<std::string, std::string>;

/** Lists the kinds: "session", "sweep", "object", "hand", "arm", "study", and "trials" (of real
hands, for a campaign). */
std::vector<std::string> ListNewKinds();

/** Returns the files of one kind, with a comment on each key. @pre one of ListNewKinds(). */
std::vector<NewFile> MakeNewFiles(const std::string& kind);

/** Reads the files as the commands do. @throws Error(kFormat). */
void CheckNewFiles(const std::string& kind, const std::string& folder);

}  // namespace graspbench
