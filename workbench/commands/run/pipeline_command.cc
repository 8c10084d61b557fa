#include <filesystem>
#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "workbench/command.h"
#include "workbench/stage_commands.h"
#include "workbench/terminal/terminal_observer.h"
#include "workbench/text/pipeline_text.h"

namespace graspbench {
namespace {

struct PipelineOptions {
  std::string file;
  std::filesystem::path results;  ///< empty: results/NAME
  std::filesystem::path pack;
  int num_workers = 1;
  bool as_dot = false;
  std::string form = "dvc";
  bool json = false;
};

Pipeline LoadWanted(const Command& program, PipelineOptions& options) {
  Pipeline pipeline = LoadPipeline(options.file, ListStageCommands(program));
  if (options.results.empty()) options.results = std::filesystem::path("results") / pipeline.name;
  return pipeline;
}

ExitCode Run(const Command& program, PipelineOptions options) {
  const Pipeline pipeline = LoadWanted(program, options);
  PipelineRequest request;
  request.results = options.results;
  request.program = FindProgramFacts();
  request.num_workers = options.num_workers;
  request.tell = [](const std::string& line) { PrintMessage(line); };
  const size_t num_run = RunPipeline(pipeline, request, CatchInterrupts()).size();
  PrintResult(FormatCount(static_cast<int64_t>(num_run), "stage") + " run, " +
              std::to_string(pipeline.stages.size() - num_run) + " fresh\nresults  " +
              options.results.string() + "\n");
  return kExitOk;
}

ExitCode ShowStatus(const Command& program, PipelineOptions options) {
  const Pipeline pipeline = LoadWanted(program, options);
  const auto states = FindStageStates(pipeline, options.results, LoadPipelineLock(options.results),
                                      FindProgramFacts());
  if (options.json) {
    PrintJson(MakeStatesJson(states));
  } else {
    PrintResult(FormatStageStates(states));
  }
  for (const StageState& state : states) {
    if (!state.IsFresh()) return kExitFailed;
  }
  return kExitOk;
}

Command& AddPart(Command& command, PipelineOptions& options, const std::string& name,
                 const std::string& text, const std::string& examples) {
  Command& part = AddSubcommand(command, name, text, examples);
  part.AddRequired("file", options.file, "the stages; see graspbench help pipeline.yaml",
                   "PIPELINE.YAML");
  return part;
}

void AddResultsOption(Command& part, PipelineOptions& options) {
  part.AddOption("--out", options.results, "folder of the stages' results", "DIR")
      ->ShowDefault("results/NAME");
}

void AddReplayPart(Command& program, Command& command) {
  Command& part = AddSubcommand(
      command, "replay",
      "Reproduce the results of a pack in a separate folder and compare them byte by byte.",
      "  graspbench pipeline replay pilot.tar --verify    exit code 3 when a byte differs\n"
      "  graspbench replay pilot.tar --verify             the same");
  const auto options = std::make_shared<PackReplayOptions>();
  part.AddRequired("pack", options->pack, "file of graspbench pipeline pack", "PACK.TAR");
  part.AddFlag("--verify", "compare the files (required)");
  part.AddOption("--out", options->folder,
                 "new folder that keeps the packed and the reproduced files", "DIR");
  AddJobsOption(part, options->num_workers);
  AddJsonOption(part, options->json);
  part.SetAction([&program, options] { return ReplayPackFile(program, *options); });
}

}  // namespace

void AddPipelineCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "pipeline", "Run named stages as a pipeline that others can reproduce.",
      "  graspbench pipeline run pilot.yaml        runs only the stale stages\n  graspbench "
      "pipeline pack pilot.yaml pilot.tar\n  graspbench help pipeline.yaml             every key");
  command.RequireSubcommand();
  const auto options = std::make_shared<PipelineOptions>();
  Command& run =
      AddPart(command, *options, "run", "Run the stale stages; repeat the command to continue.",
              "  graspbench pipeline run pilot.yaml --out results/pilot --jobs 2");
  AddResultsOption(run, *options);
  AddJobsOption(run, options->num_workers, "processors for all stages");
  run.SetAction([&program, options] { return Run(program, *options); });

  Command& status = AddPart(command, *options, "status", "List which stages are stale and why.",
                            "  graspbench pipeline status pilot.yaml    exit code 1 when one is");
  AddResultsOption(status, *options);
  AddJsonOption(status, options->json);
  status.SetAction([&program, options] { return ShowStatus(program, *options); });

  Command& graph = AddPart(command, *options, "graph", "Show the dependencies of the stages.",
                           "  graspbench pipeline graph pilot.yaml --dot | dot -Tsvg > pilot.svg");
  graph.AddFlag("--dot", options->as_dot, "for Graphviz");
  graph.SetAction([&program, options] {
    const Pipeline pipeline = LoadWanted(program, *options);
    PrintResult(options->as_dot ? FormatDot(pipeline) : FormatGraph(pipeline));
  });

  Command& write = AddPart(command, *options, "export", "Print the stages for DVC or Snakemake.",
                           "  graspbench pipeline export pilot.yaml --as snakemake > Snakefile");
  write.AddOption("--as", options->form, "dvc or snakemake", "FORM")
      ->OneOf({"dvc", "snakemake"})
      ->ShowDefault();
  write.SetAction([&program, options] {
    const Pipeline pipeline = LoadWanted(program, *options);
    PrintResult(options->form == "dvc" ? FormatDvc(pipeline) : FormatSnakefile(pipeline));
  });

  Command& pack = AddPart(command, *options, "pack", "Put inputs and results into one tar file.",
                          "  graspbench pipeline pack pilot.yaml pilot.tar");
  pack.AddRequired("pack", options->pack, "new file", "PACK.TAR");
  AddResultsOption(pack, *options);
  pack.SetAction([&program, options] {
    const Pipeline pipeline = LoadWanted(program, *options);
    MakePack(pipeline, options->results, FindProgramFacts(), options->pack);
    PrintResult(options->pack.string() + "\n");
  });
  AddReplayPart(program, command);
}

}  // namespace graspbench
