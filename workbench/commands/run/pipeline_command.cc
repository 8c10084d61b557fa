#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/pack_replay.h"
#include "workbench/stage_commands.h"
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

Pipeline LoadWanted(const CLI::App& program, PipelineOptions& options) {
  Pipeline pipeline = LoadPipeline(options.file, ListStageCommands(program));
  if (options.results.empty()) options.results = std::filesystem::path("results") / pipeline.name;
  return pipeline;
}

ExitCode Run(const CLI::App& program, PipelineOptions options) {
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

ExitCode ShowStatus(const CLI::App& program, PipelineOptions options) {
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

CLI::App& AddPart(CLI::App& command, PipelineOptions& options, const std::string& name,
                  const std::string& text, const std::string& examples) {
  CLI::App& part = AddSubcommand(command, name, text, examples);
  part.add_option("file", options.file, "the stages; see graspbench help pipeline.yaml")
      ->required()
      ->option_text("PIPELINE.YAML");
  return part;
}

void AddResultsOption(CLI::App& part, PipelineOptions& options) {
  part.add_option("--out", options.results, "folder of the stages' results")
      ->option_text("DIR")
      ->default_str("results/NAME");
}

void AddReplayPart(CLI::App& program, CLI::App& command, ExitCode& exit_code) {
  CLI::App& part = AddSubcommand(
      command, "replay", "Make a pack's results again elsewhere and compare them byte for byte.",
      "  graspbench pipeline replay pilot.tar --verify    exit code 3 when a byte differs\n"
      "  graspbench replay pilot.tar --verify             the same");
  const auto options = std::make_shared<PackReplayOptions>();
  part.add_option("pack", options->pack, "file of graspbench pipeline pack")
      ->required()
      ->option_text("PACK.TAR");
  part.add_flag("--verify", "compare; a pack is not replayed for anything else");
  part.add_option("--out", options->folder, "new folder that keeps what was packed and made")
      ->option_text("DIR");
  AddJobsOption(part, options->num_workers);
  part.add_flag("--json", options->json, "print one JSON object");
  part.callback([&program, options, &exit_code] { exit_code = ReplayPackFile(program, *options); });
}

}  // namespace

void AddPipelineCommand(CLI::App& program, ExitCode& exit_code) {
  CLI::App& command = AddSubcommand(
      program, "pipeline", "Make results by named stages that others can make again.",
      "  graspbench pipeline run pilot.yaml        the stages that are stale, and no other\n"
      "  graspbench pipeline pack pilot.yaml pilot.tar\n"
      "  graspbench help pipeline.yaml             every key");
  command.require_subcommand(1);
  const auto options = std::make_shared<PipelineOptions>();
  CLI::App& run = AddPart(command, *options, "run", "Run what is stale; the same again goes on.",
                          "  graspbench pipeline run pilot.yaml --out results/pilot --jobs 2");
  AddResultsOption(run, *options);
  AddJobsOption(run, options->num_workers, "processors for all stages");
  run.callback([&program, options, &exit_code] { exit_code = Run(program, *options); });

  CLI::App& status = AddPart(command, *options, "status",
                             "Say of each stage whether it is stale, and because of what.",
                             "  graspbench pipeline status pilot.yaml    exit code 1 when one is");
  AddResultsOption(status, *options);
  status.add_flag("--json", options->json, "print one JSON object");
  status.callback([&program, options, &exit_code] { exit_code = ShowStatus(program, *options); });

  CLI::App& graph = AddPart(command, *options, "graph", "Show what needs what.",
                            "  graspbench pipeline graph pilot.yaml --dot | dot -Tsvg > pilot.svg");
  graph.add_flag("--dot", options->as_dot, "for Graphviz");
  graph.callback([&program, options] {
    const Pipeline pipeline = LoadWanted(program, *options);
    PrintResult(options->as_dot ? FormatDot(pipeline) : FormatGraph(pipeline));
  });

  CLI::App& write =
      AddPart(command, *options, "export", "Print the same stages for DVC, Snakemake.",
              "  graspbench pipeline export pilot.yaml --as snakemake > Snakefile");
  write.add_option("--as", options->form, "dvc or snakemake")
      ->check(CLI::IsMember({"dvc", "snakemake"}))
      ->option_text("FORM")
      ->capture_default_str();
  write.callback([&program, options] {
    const Pipeline pipeline = LoadWanted(program, *options);
    PrintResult(options->form == "dvc" ? FormatDvc(pipeline) : FormatSnakefile(pipeline));
  });

  CLI::App& pack = AddPart(command, *options, "pack", "Put inputs and results into one tar file.",
                           "  graspbench pipeline pack pilot.yaml pilot.tar");
  pack.add_option("pack", options->pack, "new file")->required()->option_text("PACK.TAR");
  AddResultsOption(pack, *options);
  pack.callback([&program, options] {
    const Pipeline pipeline = LoadWanted(program, *options);
    MakePack(pipeline, options->results, FindProgramFacts(), options->pack);
    PrintResult(options->pack.string() + "\n");
  });
  AddReplayPart(program, command, exit_code);
}

}  // namespace graspbench
