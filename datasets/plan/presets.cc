#include "datasets/plan/presets.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/files/files.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

std::string FindFirstComment(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.rfind("# ", 0) == 0 ? line.substr(2) : "";
}

}  // namespace

std::vector<Preset> ListPresets() {
  std::vector<Preset> presets;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(FindDataRoot() / "datasets" / "presets", none)) {
    const fs::path& file = entry.path();
    if (file.extension() != ".yaml") continue;
    presets.push_back({file.stem().string(), file, FindFirstComment(ReadFile(file))});
  }
  std::sort(presets.begin(), presets.end(),
            [](const Preset& a, const Preset& b) { return a.name < b.name; });
  return presets;
}

Preset FindPreset(const std::string& name) {
  std::vector<std::string> names;
  for (const Preset& preset : ListPresets()) {
    if (preset.name == name) return preset;
    names.push_back(preset.name);
  }
  throw Error(ErrorKind::kNotFound, "no preset \"" + name + "\"" + SuggestNames(name, names));
}

}  // namespace graspbench
