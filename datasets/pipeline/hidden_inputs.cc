#include "datasets/pipeline/hidden_inputs.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "core/base/files/files.h"
#include "core/base/text/yaml.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

bool LeadsOutside(const fs::path& folder, const std::string& value) {
  const fs::path path(value);
  const bool goes_up = std::find(path.begin(), path.end(), "..") != path.end();
  std::error_code status;
  return (path.is_absolute() || goes_up) && value.find('\n') == value.npos &&
         fs::exists(path.is_absolute() ? path : folder / path, status);
}

class HiddenInputs {
 public:
  HiddenInputs(const PipelineStage& stage, const fs::path& file, Diagnostics& problems)
      : stage_(stage), file_(file), problems_(problems) {}

  void Check(const YAML::Node& node) {
    if (node.IsMap()) {
      for (const auto& item : node) Check(item.second);
    } else if (node.IsSequence()) {
      for (const auto& item : node) Check(item);
    } else if (node.IsScalar() && LeadsOutside(file_.parent_path(), node.Scalar())) {
      problems_.Fail(file_.string(), node.Mark().line + 1,
                     "stage " + stage_.name + " would read \"" + node.Scalar() +
                         "\", which the pipeline does not name: its changes would not be seen, and "
                         "no pack would hold it; put it beside the pipeline and give it to the "
                         "stage by inputs or files");
    }
  }

 private:
  const PipelineStage& stage_;
  const fs::path& file_;
  Diagnostics& problems_;
};

void CheckFile(const PipelineStage& stage, const fs::path& file, Diagnostics& problems) {
  const std::string ending = file.extension().string();
  if (ending != ".yaml" && ending != ".yml") return;
  Diagnostics syntax;  // which the stage's own command tells
  const YAML::Node root = ParseYaml(ReadFile(file), file.string(), syntax);
  if (syntax.num_errors() == 0) HiddenInputs(stage, file, problems).Check(root);
}

}  // namespace

void CheckHiddenInputs(const Pipeline& pipeline, const PipelineStage& stage,
                       Diagnostics& problems) {
  for (const StageInput& input : stage.inputs) {
    if (!input.stage.empty()) continue;
    const fs::path path = fs::path(pipeline.folder) / input.path;
    if (!fs::is_directory(path)) {
      if (fs::is_regular_file(path)) CheckFile(stage, path, problems);
      continue;
    }
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(path)) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) CheckFile(stage, file, problems);
  }
}

}  // namespace graspbench
