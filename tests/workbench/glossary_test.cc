#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "core/trial/judge/verdicts.h"
#include "datasets/records/trial_table.h"
#include "human_study/events/trial_analysis.h"

namespace graspbench {
namespace {

/** Columns of digits and of rules are explained once, with X for the digit and R for the rule. */
std::string Generalise(std::string column) {
  const auto replace = [&](const std::string& what, const std::string& with) {
    const size_t at = column.find(what);
    if (at != column.npos) column.replace(at, what.size(), with);
  };
  for (const char* digit : {"_TH", "_FF", "_MF", "_RF", "_LF"}) replace(digit, "_X");
  for (const VerdictRule& rule : ListVerdictRules()) {
    for (const std::string of : {"verdict", "score"}) replace(of + "_" + rule.id, of + "_R");
  }
  return column;
}

// The names of what is measured stand in the manual's glossary, so that a reader of a table finds
// each of them in one line.
TEST(Glossary, ExplainsEveryColumnOfTrialsAndEveryMeasureOfStudies) {
  const std::string glossary = ReadFile(GRASPBENCH_GLOSSARY);
  std::vector<std::string> names;
  for (const TrialColumn& column : ListTrialColumns({})) names.push_back(Generalise(column.name));
  for (const TrialMeasure& measure : TrialMeasureList()) names.emplace_back(measure.id);
  const std::vector<std::string> identities = {"trial_id", "hand", "object", "grasp", "trial"};
  for (const std::string& name : names) {
    if (std::find(identities.begin(), identities.end(), name) != identities.end()) continue;
    EXPECT_NE(glossary.find("`" + name + "`"), glossary.npos) << name;
  }
}

}  // namespace
}  // namespace graspbench
