// The exported script, run by R where it is installed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "core/base/files/files.h"
#include "core/base/random.h"
#include "human_study/statistics/tidy_export.h"
#include "human_study/statistics/within_anova.h"
#include "human_study/study/run/run_study.h"
#include "human_study/study/synthetic/demo_study.h"
#include "tests/human_study/faults.h"
#include "tests/human_study/statistics/known_studies.h"

namespace graspbench {
namespace {

bool HasR() { return std::system("Rscript --version > /dev/null 2>&1") == 0; }

/** What the script prints. */
std::string RunScript(const std::filesystem::path& folder) {
  const std::string command =
      "cd '" + folder.string() + "' && Rscript analysis.R > output.txt 2> errors.txt";
  EXPECT_EQ(std::system(command.c_str()), 0) << ReadFile(folder / "errors.txt");
  return ReadFile(folder / "output.txt");
}

TEST(TidyExport, TheScriptGivesTheKnownAnswersInR) {
  if (!HasR()) GTEST_SKIP() << "no Rscript on this machine";
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "tidy_export";
  std::filesystem::remove_all(folder);
  SaveTidyExport({MakeReachTable()}, folder);
  const std::string output = RunScript(folder);
  // Of Mauchly's p, R 4.2 has Anderson's 0.0017705, others 0.0017773 (within_anova.h).
  for (const char* known : {"179.17793", "0.03268208", "p-value = 0.00177", "1.24692623", "2.49799",
                            "2.38016", "0.82583333"}) {
    ExpectHolds(output, known);
  }
}

TEST(TidyExport, TheScriptStandsAwkwardNamesAndGapsInR) {
  if (!HasR()) GTEST_SKIP() << "no Rscript on this machine";
  MeasureTable table;
  table.measure = "grasp_forming_time_s";
  table.factors = {{"object", {"cup, \"blue\"", "box"}, {}, ""},
                   {"object width \\ mm", {"30 mm", "60 mm"}, {0.03, 0.06}, ""}};
  RandomStream random("awkward", "test");
  for (int person = 0; person < 6; ++person) {
    for (const std::string& object : table.factors[0].levels) {
      for (const std::string& width : table.factors[1].levels) {
        for (int trial = 0; trial < 3; ++trial) {
          table.rows.push_back({"P " + std::to_string(person),
                                "",
                                {object, width},
                                person == 5 && width == "60 mm" ? NAN : random.NextNormal()});
        }
      }
    }
  }
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "tidy_awkward";
  std::filesystem::remove_all(folder);
  SaveTidyExport({table}, folder);
  const std::string output = RunScript(folder);
  ExpectHolds(output, "left out: P 5");
  ExpectHolds(output, "object x object width \\\\ mm");
  EXPECT_EQ(ReadFile(folder / "errors.txt").find("Error"), std::string::npos)
      << ReadFile(folder / "errors.txt");
  const Answer<WithinAnova> anova = CalcWithinAnova(*CalcCellMeans(table));
  char f[32];
  std::snprintf(f, sizeof f, "%.5f", anova->effects[2].test->f);
  ExpectHolds(output, f);
}

/** trials.csv with two groups of persons, and every trial of a size in one of two sessions. */
void AddGroupsAndSessions(const std::filesystem::path& trials) {
  std::istringstream text(ReadFile(trials));
  std::string line, changed;
  for (int row = 0; std::getline(text, line); ++row) {
    const int person = row == 0 ? 0 : line[line.find_first_of("0123456789") + 1] % 2;
    changed += line +
               (row == 0 ? ",group,day"
                         : std::string(person == 0 ? ",old" : ",young") + "," +
                               std::to_string(1 + row % 2)) +
               "\n";
  }
  WriteFileAtomically(trials, changed);
}

TEST(RScript, RepeatsEveryRowOfAStudyWithGroupsSessionsAndHypotheses) {
  if (!HasR()) GTEST_SKIP() << "no Rscript on this machine";
  if (std::system("Rscript -e 'library(lmerTest)' > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "no lmerTest on this machine";
  }
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "r_script_study";
  std::filesystem::remove_all(folder);
  SyntheticOptions options = MakeDemoOptions();
  options.seed = "r script";
  options.trials_per_size = 4;
  WriteDemoStudy(MakeSyntheticStudy(options), folder / "input");
  AddGroupsAndSessions(folder / "input" / "trials.csv");
  WriteFileAtomically(folder / "input" / "hypotheses.csv",
                      "measure,slope,equal_within\npeak_opening_m,0.8,0.01\n");
  const Study study = LoadStudy(folder / "input" / "study.yaml", {},
                                {"bias_trials=0", "groups=[group]", "session=day"});
  AnalyseStudy(study, folder, {});
  const std::string output = RunScript(folder / "tidy");
  const std::string against = output.substr(output.find("==== against"));
  EXPECT_EQ(against.find("DIFFERS"), std::string::npos) << against;
  ExpectHolds(against, " 0 differ");
  // A new deal of contact times is not R's, and is named, as is the verdict that follows from it.
  ExpectHolds(against,
              "not repeated: independent digits, by permutation; independent digits, verdict");
}

}  // namespace
}  // namespace graspbench
