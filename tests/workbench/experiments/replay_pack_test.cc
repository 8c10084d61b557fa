#include "workbench/experiments/replay_pack.h"

#include "tests/workbench/experiments/pipeline_folder.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class ReplayPackTest : public PipelineFolder {
 protected:
  /** Packed here, made again elsewhere as somebody else would, on one processor instead of two. */
  void ExpectSameBytes(const std::string& name) const {
    const std::string file =
        "'" + (fs::path(GRASPBENCH_PIPELINES_FOLDER) / (name + ".yaml")).string() + "'";
    ASSERT_EQ(Run("\"$GB\" pipeline run " + file + " --jobs 2"), 0) << Log();
    ASSERT_EQ(Run("\"$GB\" pipeline pack " + file + " p.tar"), 0) << Log();
    fs::create_directories(top_ / "home of" / "else");
    ASSERT_EQ(Run("env -i HOME=\"$PWD/home of/else\" USER=else LOGNAME=else TZ=Asia/Kolkata "
                  "LANG=de_DE.UTF-8 LC_ALL=tr_TR.UTF-8 PATH=\"$PATH\" sh -c 'cd \"$HOME\" && exec "
                  "\"$0\" replay ../../p.tar --verify --jobs 1' \"$GB\""),
              0)
        << Log();
    EXPECT_NE(Log().find("program  the same"), std::string::npos) << Log();
    const std::string bytes = ReadFile(top_ / "p.tar");
    for (const std::string& trace : {top_.string(), std::string(GRASPBENCH_PIPELINES_FOLDER)}) {
      EXPECT_EQ(bytes.find(trace), std::string::npos) << trace;
    }
  }
};

TEST_F(ReplayPackTest, SmallBenchmark) { ExpectSameBytes("small_benchmark"); }
TEST_F(ReplayPackTest, SyntheticStudy) { ExpectSameBytes("synthetic_study"); }
TEST_F(ReplayPackTest, OneObjectCampaign) { ExpectSameBytes("one_object_campaign"); }
TEST_F(ReplayPackTest, PeopleBesideRobots) { ExpectSameBytes("people_beside_robots"); }

TEST_F(ReplayPackTest, EveryPipelineThatIsShippedHasItsTest) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(GRASPBENCH_PIPELINES_FOLDER)) {
    if (entry.path().extension() == ".yaml" &&
        ReadFile(entry.path()).find("\nstages:") != std::string::npos) {
      names.insert(entry.path().stem());
    }
  }
  EXPECT_EQ(names, (std::set<std::string>{"small_benchmark", "synthetic_study",
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
