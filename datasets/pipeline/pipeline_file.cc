#include "datasets/pipeline/pipeline_file.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <set>

#include "core/base/files/files.h"
#include "core/base/text/yaml.h"
#include "datasets/pipeline/stable_files.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** Names in the folder of results that are not a stage's. */
constexpr const char* kTakenNames[] = {kStageInputs, "logs"};

bool IsStageName(const std::string& name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && name.size() <= 64 && std::isalpha(static_cast<unsigned char>(name[0])) &&
         std::all_of(name.begin(), name.end(), is_plain) &&
         std::find(std::begin(kTakenNames), std::end(kTakenNames), name) == std::end(kTakenNames);
}

/** Below the folder, in one spelling only: "a/b". */
bool IsInside(const std::string& path) {
  const fs::path name(path);
  if (path.empty() || path.back() == '/' || name.is_absolute()) return false;
  if (path.find_first_of("\n\r") != path.npos || path.find('\0') != path.npos) return false;
  return name.lexically_normal() == name && *name.begin() != ".." && path != ".";
}

std::vector<std::string> ListNamesOf(const std::vector<StageCommand>& commands) {
  std::vector<std::string> names;
  for (const StageCommand& command : commands) names.push_back(command.name);
  return names;
}

const StageOption* FindOption(const StageCommand& command, const std::string& name) {
  for (const StageOption& option : command.options) {
    if (option.name == name) return &option;
  }
  return nullptr;
}

class StageReader {
 public:
  StageReader(const std::string& file, const std::set<std::string>& names, Diagnostics& problems)
      : file_(file), names_(names), problems_(problems) {}

  PipelineStage Read(const std::string& name, const YAML::Node& node,
                     const std::vector<StageCommand>& commands) {
    PipelineStage stage;
    stage.name = name;
    stage.line = LineOf(node);
    where_ = "stage " + name;
    YamlMap map(node, file_, where_, problems_, &ListPipelineKeys(), "stages.");
    std::string command;
    map.Read("command", command);
    const YAML::Node inputs = map.Child("inputs", Needed::kNo);
    const YAML::Node files = map.Child("files", Needed::kNo);
    const YAML::Node parameters = map.Child("parameters", Needed::kNo);
    map.FinishKnownKeys();
    const auto known = std::find_if(commands.begin(), commands.end(),
                                    [&](const StageCommand& c) { return c.name == command; });
    if (known == commands.end()) {
      if (!command.empty()) {
        map.Fail("command", "no command \"" + command + "\" that a stage can be" +
                                SuggestNames(command, ListNamesOf(commands)));
      }
      return stage;
    }
    stage.command = *known;
    ReadInputs(inputs, stage);
    for (const auto& [path, line] : ReadTexts(files, "files")) AddInput("", path, line, stage);
    ReadParameters(parameters, stage);
    CheckNeeded(stage);
    return stage;
  }

 private:
  void Fail(int line, const std::string& text) {
    problems_.Fail(file_, line, where_ + ": " + text);
  }

  /** One text or several, with their lines; quoted ones may be anything. */
  std::vector<std::pair<std::string, int>> ReadTexts(const YAML::Node& node,
                                                     const std::string& what) {
    std::vector<std::pair<std::string, int>> texts;
    if (!node.IsDefined() || node.IsNull()) return texts;
    const auto add = [&](const YAML::Node& item) {
      const bool is_text = item.IsScalar() && !item.Scalar().empty() &&
                           item.Scalar().find_first_of("\n\r") == std::string::npos &&
                           item.Scalar().find('\0') == std::string::npos;
      if (is_text) {
        texts.emplace_back(item.Scalar(), LineOf(item));
      } else {
        Fail(LineOf(item), what + ": expected a text of one line, or a list of such");
      }
    };
    if (node.IsSequence()) {
      for (const YAML::Node& item : node) add(item);
    } else {
      add(node);
    }
    return texts;
  }

  /** The entries of a map whose keys are options of the command. */
  void ReadOptions(const YAML::Node& node, const std::string& what, const StageCommand& command,
                   const std::function<void(const StageOption&, const YAML::Node&, int)>& take) {
    if (!node.IsDefined() || node.IsNull()) return;
    if (!node.IsMap()) return Fail(LineOf(node), what + ": expected a map of keys and values");
    std::set<std::string> seen;
    for (const auto& item : node) {
      const std::string key = item.first.IsScalar() ? item.first.Scalar() : "";
      const int line = LineOf(item.first);
      const StageOption* option = FindOption(command, key);
      if (!seen.insert(key).second) {
        Fail(line, what + ": \"" + key + "\" is given twice");
      } else if (option && option->is_own) {
        Fail(line, what + ": \"" + key +
                       "\" is set by the pipeline; a stage writes into the folder of its own name, "
                       "and no clock ends its trials");
      } else if (!option) {
        std::vector<std::string> names;
        for (const StageOption& one : command.options) {
          if (!one.is_own) names.push_back(one.name);
        }
        Fail(line, what + ": graspbench " + command.name + " has no \"" + key + "\"" +
                       SuggestNames(key, names));
      } else {
        take(*option, item.second, line);
      }
    }
  }

  void ReadInputs(const YAML::Node& node, PipelineStage& stage) {
    ReadOptions(node, "inputs", stage.command,
                [&](const StageOption& option, const YAML::Node& value, int line) {
                  if (!option.takes_value) {
                    return Fail(line, "inputs: \"" + option.name +
                                          "\" takes no file; list it under parameters");
                  }
                  for (const auto& [path, at] : ReadTexts(value, "inputs, " + option.name)) {
                    AddInput(option.name, path, at, stage);
                  }
                });
  }

  void AddInput(const std::string& option, const std::string& path, int line,
                PipelineStage& stage) {
    if (!IsInside(path)) {
      return Fail(line, "the input \"" + path +
                            "\" is not below the pipeline's folder; expected a path such as "
                            "study/study.yaml, so that the pipeline can be packed");
    }
    const std::string first = path.substr(0, path.find('/'));
    const bool is_stage = names_.count(first) > 0;
    if (is_stage && first == stage.name) return Fail(line, "it is its own input");
    stage.inputs.push_back({option, path, is_stage ? first : "", line});
  }

  void ReadParameters(const YAML::Node& node, PipelineStage& stage) {
    ReadOptions(node, "parameters", stage.command,
                [&](const StageOption& option, const YAML::Node& value, int line) {
                  ReadParameter(option, value, line, stage);
                });
    std::sort(stage.parameters.begin(), stage.parameters.end(),
              [](const StageParameter& a, const StageParameter& b) { return a.option < b.option; });
  }

  void ReadParameter(const StageOption& option, const YAML::Node& value, int line,
                     PipelineStage& stage) {
    if (option.is_argument) {
      return Fail(line, "parameters: \"" + option.name +
                            "\" is a file that the command reads; list it under inputs");
    }
    StageParameter parameter = {option.name, {}};
    if (!option.takes_value) {
      bool is_set = false;
      if (!value.IsScalar() || !YAML::convert<bool>::decode(value, is_set)) {
        return Fail(line, "parameters, " + option.name + ": expected true or false");
      }
      if (is_set) stage.parameters.push_back(parameter);
      return;
    }
    for (const auto& [text, at] : ReadTexts(value, "parameters, " + option.name)) {
      if (text.find('/') != text.npos) {
        Fail(at, "parameters, " + option.name + ": \"" + text +
                     "\" is a path; list files and folders that a stage reads under inputs");
      }
      parameter.values.push_back(text);
    }
    if (parameter.values.empty()) {
      return Fail(line, "parameters, " + option.name + ": expected a value");
    }
    stage.parameters.push_back(parameter);
  }

  void CheckNeeded(const PipelineStage& stage) {
    for (const StageOption& option : stage.command.options) {
      const bool is_given =
          std::any_of(stage.inputs.begin(), stage.inputs.end(),
                      [&](const StageInput& input) { return input.option == option.name; }) ||
          std::any_of(stage.parameters.begin(), stage.parameters.end(),
                      [&](const StageParameter& p) { return p.option == option.name; });
      if (!option.is_needed || option.is_own || is_given) continue;
      Fail(stage.line, "graspbench " + stage.command.name + " needs " +
                           (option.is_argument ? "the input \"" : "\"") + option.name + "\"");
    }
  }

  const std::string& file_;
  const std::set<std::string>& names_;
  Diagnostics& problems_;
  std::string where_;
};

/** Each stage behind those that it needs, else in the order of the file; a circle is a problem. */
void SortStages(const std::string& file, std::vector<PipelineStage>& stages,
                Diagnostics& problems) {
  std::vector<PipelineStage> sorted;
  std::set<std::string> done;
  while (!stages.empty()) {
    const auto next = std::find_if(stages.begin(), stages.end(), [&](const PipelineStage& stage) {
      const std::vector<std::string> needed = stage.ListNeeded();
      return std::all_of(needed.begin(), needed.end(),
                         [&](const std::string& name) { return done.count(name) > 0; });
    });
    if (next == stages.end()) {
      std::string names;
      for (const PipelineStage& stage : stages) {
        names += (names.empty() ? "" : ", ") + stage.name;
      }
      problems.Fail(file, stages.front().line,
                    "these stages depend on each other in a cycle: " + names);
      return;
    }
    done.insert(next->name);
    sorted.push_back(std::move(*next));
    stages.erase(next);
  }
  stages = std::move(sorted);
}

}  // namespace

std::vector<std::string> PipelineStage::ListNeeded() const {
  std::set<std::string> names;
  for (const StageInput& input : inputs) {
    if (!input.stage.empty()) names.insert(input.stage);
  }
  return {names.begin(), names.end()};
}

const PipelineStage* Pipeline::Find(const std::string& stage) const {
  for (const PipelineStage& one : stages) {
    if (one.name == stage) return &one;
  }
  return nullptr;
}

const FileKeys& ListPipelineKeys() {
  static const FileKeys keys = {
      {"about", "", "what it is for, in a sentence"},
      {"stages", kRequired, KeyType::kMap,
       "a map from the name of a stage (also of its folder) to its description"},
      {"stages.command", kRequired, "a command of graspbench, for example run or study run"},
      {"stages.inputs", "", KeyType::kMap,
       "a map from an argument or option of the command to a file, folder or stage; a part of a "
       "stage is also possible, for example benchmark/export/trials.csv"},
      {"stages.files", "",
       "further files that the command reads, for example recordings named in an input"},
      {"stages.parameters", "", KeyType::kMap,
       "a map from an option of the command, without dashes, to its value, a list, or true"},
  };
  return keys;
}

Pipeline ParsePipeline(const std::string& text, const std::string& file,
                       const std::vector<StageCommand>& commands) {
  Diagnostics problems;
  Pipeline pipeline;
  pipeline.file = file;
  pipeline.name = pipeline.file.stem().string();
  const fs::path above = pipeline.file.parent_path();
  pipeline.folder = above.empty() ? "." : above.string();
  const YAML::Node root = ParseYaml(text, file, problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the pipeline cannot be used");
  YamlMap map(root, file, "pipeline", problems, &ListPipelineKeys());
  map.Read("about", pipeline.about, Needed::kNo);
  const YAML::Node stages = map.Child("stages");
  map.FinishKnownKeys();
  if (stages.IsDefined() && (!stages.IsMap() || stages.size() == 0)) {
    map.Fail("stages", "expected a map of at least one stage");
  }
  std::set<std::string> names;
  if (stages.IsDefined() && stages.IsMap()) {
    for (const auto& item : stages) {
      const std::string name = item.first.IsScalar() ? item.first.Scalar() : "";
      if (!IsStageName(name)) {
        problems.Fail(file, LineOf(item.first),
                      "\"" + name +
                          "\" is no name of a stage; expected small letters, digits and "
                          "_, a letter first, and not inputs or logs");
      } else if (!names.insert(name).second) {
        problems.Fail(file, LineOf(item.first), "the stage \"" + name + "\" is given twice");
      }
    }
    StageReader reader(file, names, problems);
    for (const auto& item : stages) {
      const std::string name = item.first.IsScalar() ? item.first.Scalar() : "";
      PipelineStage stage = reader.Read(name, item.second, commands);
      stage.line = LineOf(item.first);
      pipeline.stages.push_back(std::move(stage));
    }
  }
  if (problems.num_errors() == 0) SortStages(file, pipeline.stages, problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the pipeline cannot be used");
  return pipeline;
}

Pipeline LoadPipeline(const fs::path& file, const std::vector<StageCommand>& commands) {
  Pipeline pipeline = ParsePipeline(ReadFile(file), file.string(), commands);
  Diagnostics problems;
  for (const PipelineStage& stage : pipeline.stages) {
    for (const StageInput& input : stage.inputs) {
      std::error_code status;
      if (!input.stage.empty() || fs::exists(fs::path(pipeline.folder) / input.path, status)) {
        continue;
      }
      problems.Fail(file.string(), input.line,
                    "stage " + stage.name + ": the input \"" + input.path +
                        "\" is neither a stage nor a file or folder in \"" + pipeline.folder +
                        "\"");
    }
    CheckHiddenInputs(pipeline, stage, problems);
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the pipeline cannot be used");
  return pipeline;
}

std::string FindCopied(const PipelineStage& stage) {
  for (const StageOption& option : stage.command.options) {
    if (!option.is_argument) continue;
    for (const StageInput& input : stage.inputs) {
      if (input.option == option.name) return input.stage.empty() ? input.path : input.stage;
    }
  }
  return {};
}

std::vector<std::string> ListStageWords(const PipelineStage& stage, const std::string& inputs) {
  std::vector<std::string> words;
  for (size_t start = 0; start < stage.command.name.size();) {
    const size_t end = std::min(stage.command.name.find(' ', start), stage.command.name.size());
    words.push_back(stage.command.name.substr(start, end - start));
    start = end + 1;
  }
  const std::string copied = stage.command.place == StagePlace::kCopy ? FindCopied(stage) : "";
  const auto place = [&](const StageInput& input) {
    return input.stage.empty() && !inputs.empty() ? inputs + "/" + input.path : input.path;
  };
  for (const StageOption& option : stage.command.options) {
    for (const StageInput& input : stage.inputs) {
      if (input.option != option.name) continue;
      const bool is_copy =
          option.is_argument && (input.stage.empty() ? input.path : input.stage) == copied;
      if (is_copy) {
        words.push_back(stage.name + input.path.substr(copied.size()));
      } else {
        words.push_back(option.is_argument ? place(input)
                                           : "--" + option.name + "=" + place(input));
      }
    }
  }
  for (const StageParameter& parameter : stage.parameters) {
    const std::string name = "--" + parameter.option;
    if (parameter.values.empty()) words.push_back(name);
    for (const std::string& value : parameter.values) words.push_back(name + "=" + value);
  }
  if (stage.command.place == StagePlace::kOwn) words.push_back("--out=" + stage.name);
  return words;
}

}  // namespace graspbench
