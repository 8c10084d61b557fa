#pragma once
/** @file
What `graspbench new` writes: small examples that can be used as they are. */

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace graspbench {

namespace assets {  // of new_hand/, new_arm/
extern const std::string_view kHandUrdf, kHandYaml, kArmYaml;
}

/** A file's name and content. */
using NewFile = std::pair<std::string, std::string>;

/** "session", "sweep", "object", "hand", "arm", "study", "trials": of real hands, for a campaign. */
std::vector<std::string> ListNewKinds();

/** The files of one kind, each key with what it is. @pre one of ListNewKinds(). */
std::vector<NewFile> MakeNewFiles(const std::string& kind);

/** Reads them as the commands do. @throws Error(kFormat). */
void CheckNewFiles(const std::string& kind, const std::string& folder);

}  // namespace graspbench
