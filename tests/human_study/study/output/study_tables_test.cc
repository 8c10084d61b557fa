#include "human_study/study/output/study_tables.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/base/files/files.h"
#include "core/base/text/json.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

void AddTrial(const char* person, const char* level, double gft, StudyResult& result) {
  StudyTrial trial;
  trial.participant = person;
  trial.levels = {level};
  trial.analysis.emplace().timing.gft = gft;
  result.trials.push_back(trial);
}

TEST(WideTable, HasARowAPersonAndAColumnACondition) {
  StudyResult result;
  result.study.config.measures = {"grasp_forming_time_s"};
  Factor factor;
  factor.name = "size";
  factor.levels = {"3.5 cm", "gro\u00df"};
  result.study.factors = {factor};
  AddTrial("=1+1", "3.5 cm", 0.25, result);
  AddTrial("=1+1", "3.5 cm", 0.75, result);
  AddTrial("=1+1", "gro\u00df", 0.125, result);
  AddTrial("p2", "gro\u00df", std::nan(""), result);
  AddTrial("p2", "3.5 cm", 1.0, result);
  AddTrial("p2", "3.5 cm", 9.0, result);
  result.trials.back().removed = "a reason";
  AddTrial("nobody", "3.5 cm", 9.0, result);
  result.trials.back().removed = "a reason";
  const fs::path folder = fs::path(::testing::TempDir()) / ("wide_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  WriteWideTable(result, folder);
  EXPECT_EQ(ReadFile(folder / "wide.csv"),
            "participant,grasp_forming_time_s_3_5_cm,grasp_forming_time_s_gro_,num_trials_3_5_cm,"
            "num_trials_gro_\n"
            "'=1+1,0.5,0.125,2,1\n"
            "p2,1.0,,1,1\n");
  const Json schema = Json::parse(ReadFile(folder / "wide.schema.json"));
  EXPECT_EQ(schema["fields"][2]["description"], "mean of grasp forming time (GFT): size gro\u00df");
  EXPECT_EQ(schema["fields"][2]["unit"], "s");
  // Without factors there is one condition; without trials a heading.
  result.study.factors.clear();
  for (StudyTrial& trial : result.trials) trial.levels.clear();
  WriteWideTable(result, folder);
  EXPECT_EQ(ReadFile(folder / "wide.csv").substr(0, 55),
            "participant,grasp_forming_time_s,num_trials\n'=1+1,0.375");
  result.trials.clear();
  WriteWideTable(result, folder);
  EXPECT_EQ(ReadFile(folder / "wide.csv"), "participant,grasp_forming_time_s,num_trials\n");
  fs::remove_all(folder);
}

TEST(WideTable, NamesAreThoseThatSpssTakes) {
  const std::string many(80, 'a');
  const std::vector<std::string> names =
      MakeColumnNames({"=cmd()", "x-1", "X 1", "", "1st", many, many + "b", "\u00e4\u00f6"});
  EXPECT_EQ(names,
            (std::vector<std::string>{"v_cmd__", "x_1", "X_1_2", "v", "v1st", std::string(64, 'a'),
                                      std::string(62, 'a') + "_2", "v__"}));
}

}  // namespace
}  // namespace graspbench
