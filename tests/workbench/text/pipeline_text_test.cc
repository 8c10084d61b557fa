#include "workbench/text/pipeline_text.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/base/files/files.h"
#include "tests/datasets/pipeline/made_commands.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

Pipeline MakeAwkward() {
  return ParsePipeline(
      "stages:\n"
      "  make: {command: make, inputs: {file: \"it's here.txt\"}, parameters: {set: "
      "'a={\"$1\"}'}}\n"
      "  said: {command: say it, inputs: {one: make}}\n",
      "p.yaml", MakeCommands());
}

TEST(PipelineText, NamesAreQuotedForYamlAndShell) {
  EXPECT_EQ(FormatDvc(MakeAwkward()),
            "stages:\n"
            "  make:\n"
            "    cmd: \"graspbench make 'it'\\\\''s here.txt' '--set=a={\\\"$1\\\"}' --out=make\"\n"
            "    deps:\n"
            "      - \"it's here.txt\"\n"
            "    outs:\n"
            "      - \"make\"\n"
            "  said:\n"
            "    cmd: \"mkdir -p said && graspbench say it make > said/output.txt\"\n"
            "    deps:\n"
            "      - \"make\"\n"
            "    outs:\n"
            "      - \"said\"\n");
  EXPECT_NE(FormatDot(MakeAwkward()).find("\"it's here.txt\" -> \"make\";"), std::string::npos);
  EXPECT_NE(FormatGraph(MakeAwkward()).find("said: mkdir -p said && graspbench say it make"),
            std::string::npos);
}

// Snakemake itself runs it: with a program in the place of graspbench that says how it was called.
TEST(PipelineText, SnakemakeRunsTheSnakefile) {
  if (std::system("snakemake --version >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "Debian's package snakemake is not installed";
  }
  const TemporaryFolder temporary;
  const fs::path& top = temporary.path();
  WriteFile(top / "it's here.txt", "input");
  WriteFile(top / "Snakefile", FormatSnakefile(MakeAwkward()));
  MakeFolder(top / "bin");
  WriteFile(
      top / "bin" / "graspbench",
      "#!/bin/sh\n[ \"$1\" = say ] && { cat make/words; exit 0; }\n"
      "mkdir make; for word; do echo \"<$word>\"; done > make/words; cat \"$2\" >> make/words\n");
  fs::permissions(top / "bin" / "graspbench", fs::perms::owner_all);
  const std::string line = "cd '" + top.string() + "' && PATH=\"" + (top / "bin").string() +
                           ":$PATH\" HOME=\"$PWD\" snakemake --cores 1 --nolock >log 2>&1";
  ASSERT_EQ(std::system(line.c_str()), 0) << ReadFile(top / "log");
  EXPECT_EQ(ReadFile(top / "said" / "output.txt"),
            "<make>\n<it's here.txt>\n<--set=a={\"$1\"}>\n<--out=make>\ninput");
}

TEST(PipelineText, NamesThatSnakemakeCannotHave) {
  const Pipeline pipeline = ParsePipeline("stages: {a: {command: make, inputs: {file: 'x{y}'}}}",
                                          "p.yaml", MakeCommands());
  EXPECT_THROW(FormatSnakefile(pipeline), Error);
  EXPECT_NE(FormatDvc(pipeline).find("- \"x{y}\""), std::string::npos);
}

}  // namespace
}  // namespace graspbench
