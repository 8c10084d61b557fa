#include <filesystem>
#include <memory>
#include <string>

#include "core/base/files/files.h"
#include "workbench/command.h"
#include "workbench/experiments/board/make_entry.h"

namespace graspbench {
namespace {

struct EntryOptions {
  std::string benchmark = kDefaultBenchmark;
  std::string notes;  ///< file
  EntryRequest request;
};

void Pack(EntryOptions& options) {
  options.request.benchmark = LoadBenchmark(options.benchmark);
  options.request.facts.notes = ReadFile(options.notes);
  PrintResult(MakeEntry(options.request).string() + "\n");
}

}  // namespace

void AddEntryCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "entry", "Pack a finished session as an entry of a named benchmark.",
      "  graspbench run --benchmark graspbench-21/1 --grasp rehearsed --out mine\n"
      "  graspbench entry mine --name Mine --by 'A. Person' --notes method.md --out mine.tar\n"
      "  graspbench board mine.tar theirs.tar --out board");
  const auto options = std::make_shared<EntryOptions>();
  EntryRequest& request = options->request;
  request.facts.licence = "CC-BY-4.0";
  command.AddRequired("session", request.session, "a finished session of the benchmark", "DIR");
  command
      .AddOption("--benchmark", options->benchmark, "a named benchmark, or its file", "NAME|FILE")
      ->Suggest(ListBenchmarks())
      ->ShowDefault();
  command.AddOption("--name", request.facts.name, "of the entry, at most 40 characters", "TEXT")
      ->Require();
  command.AddOption("--by", request.facts.by, "its author, at most 40 characters", "TEXT")
      ->Require();
  command.AddOption("--notes", options->notes, "the method in the author's words", "FILE")
      ->Require();
  command.AddOption("--date", request.facts.date, "that you declare; boards show its year",
                    "YYYY-MM-DD");
  command.AddOption("--licence", request.facts.licence, "of the pack", "TEXT")->ShowDefault();
  command
      .AddOption("--out", request.out, "new file .tar, or folder DIR for DIR/DIR.tar",
                 "PACK.TAR|DIR")
      ->Require();
  command.SetAction([options] { Pack(*options); });
}

}  // namespace graspbench
