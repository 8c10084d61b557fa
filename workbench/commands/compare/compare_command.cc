#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "core/base/error.h"
#include "datasets/session/session_store.h"
#include "workbench/command.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/tables/comparison_tables.h"

namespace graspbench {
namespace {

struct CompareOptions {
  std::string before, after;
  bool json = false;
};

/** @throws Error(kUsage) for one folder given twice. */
void RefuseSameFolder(const CompareOptions& options) {
  std::error_code status;  // a folder that is not there is refused when it is loaded
  if (!std::filesystem::equivalent(options.before, options.after, status)) return;
  throw Error(ErrorKind::kUsage,
              "\"" + options.before + "\" and \"" + options.after +
                  "\" are the same folder; expected two sessions. Two hands of one session are "
                  "compared by its report and by graspbench run --resume --out " +
                  QuoteForShell(options.before));
}

void Compare(const CompareOptions& options) {
  RefuseSameFolder(options);
  const Session before = LoadSession(options.before, OnDamage::kRefuse, RecordParts::kBrief);
  const Session after = LoadSession(options.after, OnDamage::kRefuse, RecordParts::kBrief);
  const ComparedSessions result = CompareAll(before, after);
  options.json ? PrintJson(ToJson(result)) : PrintResult(FormatComparison(result));
}

}  // namespace

void AddCompareCommand(Command& program) {
  Command& command =
      AddSubcommand(program, "compare", "Compare two sessions trial by trial, on the same draws.",
                    "  graspbench compare results/before results/after\n"
                    "  graspbench compare results/standard results/optimised --json\n"
                    "  graspbench compare results/tum results/own-hand   one hand each: the hands");
  const auto options = std::make_shared<CompareOptions>();
  command.AddRequired("before", options->before, "a session", "DIR");
  command.AddRequired("after", options->after, "the session to compare it with", "DIR");
  AddJsonOption(command, options->json);
  command.SetAction([options] { Compare(*options); });
}

}  // namespace graspbench
