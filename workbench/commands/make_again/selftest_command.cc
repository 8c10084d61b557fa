
#include "core/base/text/text.h"
#include "core/physics/known_answers/known_answer.h"
#include "workbench/command.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

std::string FormatNumber(double value, const std::string& unit) {
  return FormatSignificant(value, 6) + (unit.empty() ? "" : " " + unit);
}

/** Runs a check and prints its part of the sheet; the number of answers that failed. */
int PrintCheck(const KnownAnswerCheck& check, const std::vector<KnownAnswer>& answers) {
  TextTable table({"", "answer", "expected", "obtained", "tolerance"});
  int num_failed = 0;
  for (const KnownAnswer& answer : answers) {
    if (!answer.passes()) ++num_failed;
    table.AddRow(
        {answer.passes() ? "pass" : "FAIL", answer.what, FormatNumber(answer.expected, answer.unit),
         FormatNumber(answer.obtained, answer.unit), FormatNumber(answer.tolerance, answer.unit)});
  }
  PrintResult(check.name + ": " + check.source + "\n" + table.Format() + "\n");
  return num_failed;
}

Json ToJson(const KnownAnswerCheck& check, const std::vector<KnownAnswer>& answers) {
  Json list = Json::array();
  for (const KnownAnswer& answer : answers) {
    list.push_back({{"answer", answer.what},
                    {"unit", answer.unit},
                    {"expected", JsonNumber(answer.expected)},
                    {"obtained", JsonNumber(answer.obtained)},
                    {"tolerance", JsonNumber(answer.tolerance)},
                    {"pass", answer.passes()}});
  }
  return {{"check", check.name}, {"source", check.source}, {"answers", list}};
}

ExitCode RunSelftest(bool json) {
  Json sheet = Json::array();
  int num_answers = 0, num_failed = 0;
  for (const KnownAnswerCheck& check : ListKnownAnswerChecks()) {
    const std::vector<KnownAnswer> answers = check.run();
    num_answers += static_cast<int>(answers.size());
    if (json) {
      sheet.push_back(ToJson(check, answers));
      for (const KnownAnswer& answer : answers) num_failed += answer.passes() ? 0 : 1;
    } else {
      num_failed += PrintCheck(check, answers);
    }
  }
  if (json) {
    PrintJson({{"num_answers", num_answers}, {"num_failed", num_failed}, {"checks", sheet}});
  } else {
    PrintResult(std::to_string(num_answers - num_failed) + " of " +
                FormatCount(num_answers, "known answer") + " obtained\n");
  }
  return num_failed == 0 ? kExitOk : kExitFailed;
}

}  // namespace

void AddSelftestCommand(Command& program) {
  Command& command = AddSubcommand(program, "selftest",
                                   "Run the physics verification cases and print the results.",
                                   "  graspbench selftest\n"
                                   "  graspbench selftest --json");
  Option* json = command.AddFlag("--json", "print one JSON object");
  command.SetAction([json] { return RunSelftest(json->IsGiven()); });
}

}  // namespace graspbench
