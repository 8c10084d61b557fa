#include "datasets/pipeline/pipeline_state.h"

#include <gtest/gtest.h>

#include <random>

#include "core/base/files/files.h"
#include "tests/datasets/pipeline/made_commands.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

constexpr char kText[] =
    "stages:\n"
    "  a: {command: make, inputs: {file: x.yaml}, parameters: {set: n=1}}\n"
    "  b: {command: judge, inputs: {folder: a}}\n"
    "  c: {command: say it, inputs: {one: b}, files: [data]}\n";

class PipelineState : public testing::Test {
 protected:
  PipelineState() {
    MakeFolder(top_ / "data");
    WriteFile(top_ / "x.yaml", "x");
    WriteFile(top_ / "data" / "1.csv", "1");
    Make(kText);
  }

  Pipeline Parse(const std::string& text) const {
    return ParsePipeline(text, (top_ / "p.yaml").string(), MakeCommands());
  }
  std::vector<StageState> Find(const std::string& text, const std::string& program = "p1") const {
    return FindStageStates(Parse(text), results_, LoadPipelineLock(results_),
                           {{"program", program}});
  }
  /** "b: stage a is stale; .." of those that are stale. */
  std::vector<std::string> Tell(const std::string& text, const std::string& program = "p1") const {
    std::vector<std::string> told;
    for (const StageState& state : Find(text, program)) {
      if (state.IsFresh()) continue;
      told.push_back(state.stage + ":");
      for (const std::string& reason : state.reasons) told.back() += " " + reason + ";";
    }
    return told;
  }
  /** Pretends that each stage has run. */
  void Make(const std::string& text) const {
    PipelineLock lock;
    for (const StageState& state : Find(text)) {
      MakeFolder(results_ / state.stage);
      WriteFile(results_ / state.stage / "out.csv", "result of " + state.stage);
      lock[state.stage] =
          MakeLockedStage(*Parse(text).Find(state.stage), state.facts, results_, lock);
    }
    WritePipelineLock(results_, lock);
  }

  TemporaryFolder temporary_;
  fs::path top_ = temporary_.path(), results_ = top_ / "results";
};

using Told = std::vector<std::string>;

TEST_F(PipelineState, FreshUntilSomethingChanges) {
  EXPECT_EQ(Tell(kText), Told{});
  WriteFile(top_ / "x.yaml", "y");
  EXPECT_EQ(Tell(kText),
            (Told{"a: input x.yaml has changed;", "b: stage a is stale;", "c: stage b is stale;"}));
  WriteFile(top_ / "x.yaml", "x");
  EXPECT_EQ(Tell(kText), Told{});
  WriteFile(top_ / "data" / "2.csv", "2");
  fs::remove(top_ / "data" / "1.csv");
  EXPECT_EQ(Tell(kText),
            (Told{"c: input data/1.csv is not read any more; input data/2.csv is new;"}));
}

TEST_F(PipelineState, ParametersAndProgram) {
  std::string text = kText;
  text.replace(text.find("n=1"), 3, "n=2");
  EXPECT_EQ(Tell(text), (Told{"a: parameter set was n=1, is n=2;", "b: stage a is stale;",
                              "c: stage b is stale;"}));
  EXPECT_EQ(Tell(kText, "p2").size(), 3u);
  EXPECT_EQ(Tell(kText, "p2")[0], "a: the program is another build;");
}

// The same key gives the same bytes again, so those behind an edited result stay as they are.
TEST_F(PipelineState, AnEditedResultIsItsOwnStagesOnly) {
  WriteFile(results_ / "a" / "out.csv", "edited");
  EXPECT_EQ(Tell(kText), (Told{"a: result out.csv was edited;"}));
  EXPECT_TRUE(Find(kText)[0].is_edited);
  fs::remove_all(results_ / "a");
  EXPECT_EQ(Tell(kText), (Told{"a: its result is missing;"}));
  EXPECT_FALSE(Find(kText)[0].is_edited);
}

// The same bytes behind a link may be other ones tomorrow.
TEST_F(PipelineState, ALinkIsNoResult) {
  const fs::path file = results_ / "a" / "out.csv";
  fs::rename(file, top_ / "elsewhere.csv");
  fs::create_symlink(top_ / "elsewhere.csv", file);
  EXPECT_EQ(Tell(kText), (Told{"a: result out.csv was replaced by a link;"}));
  EXPECT_TRUE(Find(kText)[0].is_edited);
  Make(kText);
  fs::remove_all(file);
  WriteFile(file, "result of a");
  fs::rename(results_ / "a", top_ / "a");
  fs::create_directory_symlink(top_ / "a", results_ / "a");
  EXPECT_EQ(Tell(kText), (Told{"a: its result was replaced by a link;"}));
}

TEST_F(PipelineState, OtherBytesOfTheSameKeyMakeThoseBehindStale) {
  WriteFile(results_ / "a" / "out.csv", "from another processor");
  PipelineLock lock = LoadPipelineLock(results_);
  lock["a"] = MakeLockedStage(*Parse(kText).Find("a"), lock["a"].facts, results_, lock);
  WritePipelineLock(results_, lock);
  // Whether c will be is not known before b has run again.
  EXPECT_EQ(Tell(kText), (Told{"b: stage a gave different bytes in a repetition;"}));
}

// Any flipped bit and any cut: told, never taken for good.
TEST_F(PipelineState, ADamagedLockFileIsRefused) {
  const std::string whole = ReadFile(results_ / kPipelineLock);
  std::mt19937 random(1);
  for (int i = 0; i < 400; ++i) {
    std::string text = whole;
    if (i % 4 == 0) {
      text.resize(random() % text.size());
    } else {
      text[random() % text.size()] ^= static_cast<char>(1 << random() % 8);
    }
    WriteFile(results_ / kPipelineLock, text);
    EXPECT_THROW(LoadPipelineLock(results_), Error) << i;
  }
  fs::remove(results_ / kPipelineLock);
  EXPECT_EQ(LoadPipelineLock(results_).size(), 0u);
  EXPECT_EQ(Tell(kText).front(), "a: it has not run yet;");
}

}  // namespace
}  // namespace graspbench
