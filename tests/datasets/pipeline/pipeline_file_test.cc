#include "datasets/pipeline/pipeline_file.h"

#include <gtest/gtest.h>

#include "tests/datasets/find_error.h"
#include "tests/datasets/pipeline/made_commands.h"

namespace graspbench {
namespace {

using Words = std::vector<std::string>;

std::string FindFault(const std::string& text) {
  try {
    ParsePipeline(text, "p.yaml", MakeCommands());
  } catch (const Error& fault) {
    return fault.what();
  }
  return "";
}

TEST(PipelineFile, StagesComeBehindThoseThatTheyNeed) {
  const Pipeline pipeline = ParsePipeline(
      "stages:\n"
      "  c: {command: judge, inputs: {folder: b}}\n"
      "  b: {command: judge, inputs: {folder: a/benchmark}}\n"
      "  d: {command: make}\n"
      "  a: {command: make, inputs: {file: x.yaml}}\n",
      "some/where/p.yaml", MakeCommands());
  ASSERT_EQ(pipeline.stages.size(), 4u);
  Words names;
  for (const PipelineStage& stage : pipeline.stages) names.push_back(stage.name);
  EXPECT_EQ(names, (Words{"d", "a", "b", "c"}));
  EXPECT_EQ(pipeline.name, "p");
  EXPECT_EQ(pipeline.folder, "some/where");
  EXPECT_EQ(pipeline.Find("c")->ListNeeded(), Words{"b"});
  EXPECT_EQ(pipeline.Find("d")->ListNeeded(), Words{});
  EXPECT_EQ(pipeline.Find("c")->line, 2);
}

TEST(PipelineFile, CommandLinesNameWhatLiesInTheFolderOfResults) {
  const Pipeline pipeline = ParsePipeline(
      "stages:\n"
      "  a:\n"
      "    command: make\n"
      "    inputs: {file: x.yaml, hand: hands/mine}\n"
      "    files: [more, x.yaml]\n"
      "    parameters: {fast: true, set: [a=1, 'b=2 3'], slow: no}\n"
      "  b: {command: judge, inputs: {folder: a/inner}}\n"
      "  c: {command: say it, inputs: {one: a, two: [b/t.csv, c.csv]}}\n",
      "p.yaml", MakeCommands());
  EXPECT_EQ(ListStageWords(pipeline.stages[0]),
            (Words{"make", "inputs/x.yaml", "--hand=inputs/hands/mine", "--fast", "--set=a=1",
                   "--set=b=2 3", "--out=a"}));
  EXPECT_EQ(ListStageWords(pipeline.stages[0], "")[1], "x.yaml");
  // All of the result is copied, and the command works inside the copy.
  EXPECT_EQ(FindCopied(pipeline.stages[1]), "a");
  EXPECT_EQ(ListStageWords(pipeline.stages[1]), (Words{"judge", "b/inner"}));
  EXPECT_EQ(ListStageWords(pipeline.stages[2]),
            (Words{"say", "it", "a", "b/t.csv", "inputs/c.csv"}));
  EXPECT_EQ(pipeline.stages[0].inputs.size(), 4u);
  EXPECT_EQ(pipeline.folder, ".");
}

TEST(PipelineFile, FaultsHaveLines) {
  const std::pair<const char*, const char*> cases[] = {
      {"stages: [a]\n", "p.yaml:1: error: pipeline, stages: expected a map"},
      {"stages:\n  a: 3\n", "p.yaml:2: error: stage a: expected a map"},
      {"stages:\n  a: {command: mkae}\n", "p.yaml:2: error: stage a, command: no command \"mkae\""},
      {"stages:\n  a:\n    command: make\n    inputs: {filee: x}\n",
       "p.yaml:4: error: stage a: inputs: graspbench make has no \"filee\"; did you mean "
       "\"file\"?"},
      {"stages:\n  a:\n    command: make\n    inputs: {file: [x, ../y]}\n",
       "p.yaml:4: error: stage a: the input \"../y\" is not below the pipeline's folder"},
      {"stages:\n  a:\n    command: make\n    inputs:\n      file: a/b\n",
       "p.yaml:5: error: stage a: it is its own input"},
      {"stages:\n  a:\n    command: make\n    files: [{}]\n",
       "p.yaml:4: error: stage a: files: expected a text"},
      {"stages:\n  a:\n    command: make\n    parameters: {out: x}\n",
       "p.yaml:4: error: stage a: parameters: \"out\" is set by the pipeline"},
      {"stages:\n  a:\n    command: make\n    parameters: {fast: 3}\n",
       "p.yaml:4: error: stage a: parameters, fast: expected true or false"},
      {"stages:\n  a:\n    command: make\n    inputs: {fast: x}\n",
       "p.yaml:4: error: stage a: inputs: \"fast\" takes no file"},
      {"stages:\n  a: {command: judge}\n",
       "p.yaml:2: error: stage a: graspbench judge needs the input \"folder\""},
      {"stages:\n  a: {command: judge, parameters: {folder: x}}\n",
       "stage a: parameters: \"folder\" is a file that the command reads"},
      {"stages:\n  inputs: {command: make}\n", "p.yaml:2: error: \"inputs\" is no name of a stage"},
      {"stages:\n  a: {command: make}\n  a: {command: make}\n", "p.yaml:3: error: the stage \"a\""},
      {"stages:\n  b: {command: make}\n  a: {command: judge, inputs: {folder: c}}\n"
       "  c: {command: judge, inputs: {folder: a}}\n",
       "p.yaml:3: error: these stages depend on each other in a cycle: a, c"},
  };
  for (const auto& [text, fault] : cases) {
    EXPECT_TRUE(Has(FindFault(text), fault)) << text << FindFault(text);
  }
}

TEST(PipelineFile, NothingOutsideOfItsFolderCanBeNamed) {
  for (const char* path :
       {"/etc/passwd", "..", ".", "a/../b", "./a", "a//b", "a/", "''", "\"a\\nb\"", "\"a\\0b\""}) {
    EXPECT_NE(FindFault(std::string("stages: {a: {command: make, inputs: {file: ") + path + "}}}"),
              "")
        << path;
  }
}

}  // namespace
}  // namespace graspbench
