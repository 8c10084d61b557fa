#pragma once
/** @file
Named settings of sessions: the files of datasets/presets, `<name>.yaml` each. A preset is a session
file that stands in the place of the defaults; a session that begins with one freezes what it
contains, so a later change of the preset changes no session. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

struct Preset {
  std::string name;
  std::filesystem::path file;
  std::string about;  ///< its first line, which is a comment
};

/** Sorted by name. @throws Error(kIo) when a file of the folder cannot be read. */
[[nodiscard]] std::vector<Preset> ListPresets();

/** @throws Error(kNotFound) with suggestions; as ListPresets. */
[[nodiscard]] Preset FindPreset(const std::string& name);

}  // namespace graspbench
