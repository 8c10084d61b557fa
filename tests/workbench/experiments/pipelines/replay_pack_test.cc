#include "workbench/experiments/pipelines/replay_pack.h"

#include "tests/workbench/experiments/pipeline_folder.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

using ReplayPackTest = PackFolder;

TEST_F(ReplayPackTest, SmallBenchmark) { ExpectSameBytes("small_benchmark"); }

// Three are in replay_pack_slow_test.cc; no test has the half hours of "argument" and
// "board".
TEST_F(ReplayPackTest, EveryPipelineThatIsShippedHasItsTest) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(GRASPBENCH_PIPELINES_FOLDER)) {
    if (entry.path().extension() == ".yaml" &&
        ReadFile(entry.path()).find("\nstages:") != std::string::npos) {
      names.insert(entry.path().stem());
    }
  }
  EXPECT_EQ(names, (std::set<std::string>{"argument", "board", "small_benchmark", "synthetic_study",
                                          "one_object_campaign", "people_beside_robots"}));
}

// A pack whose manifest fits and whose result does not: somebody packed what was not made this way.
TEST_F(ReplayPackTest, AResultThatIsNotReproducedIsNamed) {
  WriteFile(
      top_ / "p.yaml",
      "stages:\n  a: {command: run, parameters: {hand: tum, object: golf_ball, trials: 1}}\n");
  ASSERT_EQ(Run("\"$GB\" pipeline run p.yaml --out out"), 0) << Log();
  // Forged in place, and vouched for by the lock file as if the stage had written it.
  std::string csv = ReadFile(top_ / "out" / "a" / "export" / "trials.csv");
  csv[csv.find('\n') + 5] ^= 1;
  WriteFile(top_ / "out" / "a" / "export" / "trials.csv", csv);
  PipelineLock lock = LoadPipelineLock(top_ / "out");
  Pipeline pipeline;
  PipelineStage stage;
  stage.name = "a";
  lock["a"] = MakeLockedStage(stage, lock["a"].facts, top_ / "out", lock);
  WritePipelineLock(top_ / "out", lock);
  ASSERT_EQ(Run("\"$GB\" pipeline pack p.yaml p.tar --out out"), 0) << Log();
  EXPECT_EQ(Run("\"$GB\" replay p.tar --verify"), 3);
  EXPECT_NE(Log().find("a/export/trials.csv differs from byte " +
                       std::to_string(csv.find('\n') + 6) + " on, in line 2"),
            std::string::npos)
      << Log();
}

}  // namespace
}  // namespace graspbench
