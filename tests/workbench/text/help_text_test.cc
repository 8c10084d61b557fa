#include "workbench/text/help_text.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/trial/grip/grip_record.h"
#include "core/trial/measures/diagnosis.h"
#include "core/trial/outcome.h"
#include "human_study/study/run/trial_removal.h"

namespace graspbench {
namespace {

TEST(HelpText, AMeasureIsExplainedByEachOfItsNames) {
  const std::string gft =
      "GFT, grasp forming time\n"
      "  max t_i - min t_i [s]; 0: all digits touch together\n"
      "  columns  gft_s, grasp_forming_time_s\n";
  for (const char* word : {"GFT", "gft", "Grasp forming time"}) EXPECT_EQ(ExplainWord(word), gft);
  for (const char* word : {"gftt", "", "-"}) EXPECT_EQ(ExplainWord(word), "") << word;
}

TEST(HelpText, AColumnIsExplainedWithItsMeasureAndTables) {
  const std::string text = ExplainWord("gft_s");
  EXPECT_EQ(text.find("GFT, grasp forming time\n"), 0u) << text;
  EXPECT_NE(text.find("\ngft_s\n  grasp forming time: first to last of the first contacts\n"
                      "  unit     s\n  type     number\n  in       trials.csv"),
            text.npos)
      << text;
  EXPECT_EQ(ExplainWord("tip_noise_TH_m").find("tip_noise_DIGIT_m\n"), 0u);
}

TEST(HelpText, OutcomesMechanismsReasonsPresetsAndWarningsAreExplained) {
  for (const OutcomeRow& row : kOutcomes) {
    if (row.value == Outcome::kNotRun) continue;
    EXPECT_NE(FindGlossaryEntry(row.name), nullptr) << row.name;
    const std::string text = "\n" + ExplainWord(row.name);
    EXPECT_NE(text.find("\n" + std::string(row.name) + "\n"), std::string::npos) << text;
  }
  for (const auto& row : kMechanisms) EXPECT_NE(FindGlossaryEntry(row.name), nullptr) << row.name;
  for (const auto& row : kGripFaults) {
    if (*row.name == 0) continue;
    EXPECT_NE(FindGlossaryEntry(row.name), nullptr) << row.name;
  }
  for (const TrialFlag& flag : TrialFlagList()) {
    EXPECT_NE(ExplainWord(flag.name).find(flag.text), std::string::npos) << flag.name;
  }
  EXPECT_NE(ExplainWord("gap_event").find("keys     markers.companions"), std::string::npos);
  EXPECT_EQ(ExplainWord("g3").find("g3\n  standard grasp: power\n"), 0u) << ExplainWord("g3");
  EXPECT_NE(ExplainWord("limited by").find("the reason why a digit"), std::string::npos);
  EXPECT_NE(ExplainWord("firm").find("set by   graspbench run --preset firm"), std::string::npos);
}

// A row of the glossary that names a column that no table has would lead nowhere.
TEST(HelpText, TheGlossaryNamesColumnsThatExist) {
  std::vector<std::string> columns;
  for (const TableFormat& table : ListTableFormats()) {
    for (const TableColumn& column : table.columns) columns.push_back(column.name);
  }
  for (const GlossaryEntry& entry : ListGlossary()) {
    for (const std::string& name : entry.columns) {
      EXPECT_NE(std::find(columns.begin(), columns.end(), name), columns.end()) << name;
    }
  }
}

TEST(HelpText, ASettingIsExplainedWithUnitRangeDefaultAndPlace) {
  EXPECT_EQ(ExplainFileKey("sim.step_s"),
            "sim.step_s\n"
            "  time step of the physics\n"
            "  unit     s\n"
            "  range    0.0001 to 0.01\n"
            "  default  0.002\n"
            "  set in   session.yaml, sweep.yaml, profile.yaml\n"
            "  or by    graspbench run --set sim.step_s=VALUE\n");
  // A number without unit.
  const std::string scale = ExplainFileKey("model.friction_scale");
  EXPECT_NE(scale.find("  unit     none\n  range    0 to 10\n  default  1.0\n"), scale.npos)
      << scale;
  // A key of another file is set there only.
  const std::string mass = ExplainFileKey("mass_kg");
  EXPECT_NE(mass.find("object.yaml"), mass.npos) << mass;
  EXPECT_EQ(mass.find("--set"), mass.npos) << mass;
  EXPECT_EQ(ExplainFileKey("model.friction_scal"), "");
}

TEST(HelpText, AMisspeltSettingOrItsLastPartSuggestsItsName) {
  const std::string suggestion = "; did you mean \"model.friction_scale\"?";
  EXPECT_EQ(SuggestWords("model.frction_scale", {"run"}), suggestion);
  EXPECT_EQ(SuggestWords("friction_scale", {"run"}), suggestion);
  EXPECT_EQ(SuggestWords("rum", {"run"}), "; did you mean \"run\"?");
}

}  // namespace
}  // namespace graspbench
