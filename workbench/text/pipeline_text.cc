#include "workbench/text/pipeline_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "workbench/experiments/machines/shell_quote.h"

namespace graspbench {
namespace {

/** One line for a shell in the pipeline's folder. */
std::string MakeShellLine(const PipelineStage& stage) {
  std::string line = "graspbench";
  for (const std::string& word : ListStageWords(stage, "")) line += " " + QuoteForShell(word);
  const std::string name = stage.name;  // plain by its alphabet
  if (stage.command.place == StagePlace::kCopy) {
    return "cp -R " + QuoteForShell(FindCopied(stage)) + " " + name + " && " + line;
  }
  if (stage.command.place == StagePlace::kText) {
    return "mkdir -p " + name + " && " + line + " > " + name + "/" + kStageOutput;
  }
  return line;
}

/** Files, folders and the results of stages, each once. */
std::vector<std::string> ListDependencies(const PipelineStage& stage) {
  std::set<std::string> names;
  for (const StageInput& input : stage.inputs) {
    names.insert(input.stage.empty() ? input.path : input.stage);
  }
  return {names.begin(), names.end()};
}

/** In double quotes, as YAML, Python and Graphviz read them. */
std::string Quote(const std::string& text) { return FormatJson(Json(text)); }

}  // namespace

std::string FormatStageStates(const std::vector<StageState>& states) {
  size_t width = 0;
  for (const StageState& state : states) width = std::max(width, state.stage.size());
  std::string text;
  for (const StageState& state : states) {
    if (state.IsFresh()) text += fmt::format("{:<{}}  fresh\n", state.stage, width);
    for (const std::string& reason : state.reasons) {
      const bool is_first = &reason == &state.reasons.front();
      text += fmt::format("{:<{}}  {:5}  {}\n", is_first ? state.stage : "", width,
                          is_first ? "stale" : "", reason);
    }
  }
  return text;
}

Json MakeStatesJson(const std::vector<StageState>& states) {
  Json stages = Json::array();
  for (const StageState& state : states) {
    stages.push_back({{"stage", state.stage},
                      {"state", state.IsFresh() ? "fresh" : "stale"},
                      {"reasons", state.reasons}});
  }
  return {{"stages", stages}};
}

std::string FormatGraph(const Pipeline& pipeline) {
  std::string text;
  for (const PipelineStage& stage : pipeline.stages) {
    text += fmt::format("{}: {}\n", stage.name, MakeShellLine(stage));
    for (const std::string& name : ListDependencies(stage)) {
      text += fmt::format("  <- {}{}\n", name, pipeline.Find(name) ? "" : " (file)");
    }
  }
  return text;
}

std::string FormatDot(const Pipeline& pipeline) {
  std::string text = "digraph " + Quote(pipeline.name) + " {\n  rankdir=LR;\n";
  std::set<std::string> files;
  std::string edges;
  for (const PipelineStage& stage : pipeline.stages) {
    text += fmt::format("  {} [shape=box, label={}];\n", Quote(stage.name),
                        Quote(stage.name + "\n" + stage.command.name));
    for (const std::string& name : ListDependencies(stage)) {
      if (!pipeline.Find(name)) files.insert(name);
      edges += fmt::format("  {} -> {};\n", Quote(name), Quote(stage.name));
    }
  }
  for (const std::string& file : files) text += fmt::format("  {} [shape=note];\n", Quote(file));
  return text + edges + "}\n";
}

std::string FormatDvc(const Pipeline& pipeline) {
  std::string text = "stages:\n";
  for (const PipelineStage& stage : pipeline.stages) {
    text += fmt::format("  {}:\n    cmd: {}\n", stage.name, Quote(MakeShellLine(stage)));
    const std::vector<std::string> names = ListDependencies(stage);
    if (!names.empty()) text += "    deps:\n";
    for (const std::string& name : names) text += fmt::format("      - {}\n", Quote(name));
    text += fmt::format("    outs:\n      - {}\n", Quote(stage.name));
  }
  return text;
}

namespace {

/** In a command braces stand for Snakemake's own names, unless doubled. */
std::string QuoteForSnakemake(const std::string& plain) {
  std::string text;
  for (const char c : plain) {
    text += c;
    if (c == '{' || c == '}') text += c;
  }
  return Quote(text);
}

void CheckForSnakemake(const std::string& name) {
  if (name.find_first_of("{}") == name.npos) return;
  throw Error(ErrorKind::kUnsupported, "the input \"" + name +
                                           "\" has braces in its name, which Snakemake takes for "
                                           "wildcards; rename it");
}

}  // namespace

std::string FormatSnakefile(const Pipeline& pipeline) {
  std::string text = "rule all:\n    input:\n";
  for (const PipelineStage& stage : pipeline.stages) {
    text += fmt::format("        {},\n", Quote(stage.name));
  }
  for (const PipelineStage& stage : pipeline.stages) {
    text += fmt::format("\nrule stage_{}:\n", stage.name);
    const std::vector<std::string> names = ListDependencies(stage);
    if (!names.empty()) text += "    input:\n";
    for (const std::string& name : names) {
      CheckForSnakemake(name);
      text += fmt::format("        {},\n", Quote(name));
    }
    text += fmt::format("    output:\n        directory({})\n", Quote(stage.name));
    text += fmt::format("    shell:\n        {}\n", QuoteForSnakemake(MakeShellLine(stage)));
  }
  return text;
}

std::string FormatPackReplay(const PackReplay& replay) {
  std::string text;
  if (replay.first) text += replay.first->file + " " + replay.first->text + "\n";
  text += fmt::format("same     {} of {} of {}\n", replay.num_files - replay.num_different,
                      FormatCount(replay.num_files, "file"),
                      FormatCount(static_cast<int64_t>(replay.stages.size()), "stage"));
  text += replay.is_same_program()
              ? "program  the same version and commit\n"
              : fmt::format("program  {}, packed with {}\n", FormatJson(replay.versions),
                            FormatJson(replay.packed_versions));
  return text;
}

Json MakePackReplayJson(const PackReplay& replay) {
  Json first;
  if (replay.first) first = {{"file", replay.first->file}, {"text", replay.first->text}};
  return {{"stages", replay.stages},
          {"num_files", replay.num_files},
          {"num_different", replay.num_different},
          {"first_difference", first},
          {"versions", replay.versions},
          {"packed_versions", replay.packed_versions}};
}

}  // namespace graspbench
