/** @file
A session, an optimisation or a campaign of the user's own hand, object and grasp file is complete:
moved elsewhere and with the originals gone it is continued, judged, exported and reported from any
working directory. */

#include <gtest/gtest.h>

#include <map>

#include "core/grasp/grasp_file.h"
#include "core/hand/load_hand.h"
#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"
#include "tests/sessions/test_folder.h"
#include "tests/support/run_program.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

class MovedSession : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(top_ / "mine" / "block");
    fs::copy(FindDataRoot() / "core" / "hand" / "models" / "tum", top_ / "mine" / "my_hand",
             fs::copy_options::recursive);
    WriteFile(top_ / "mine" / "block" / "block.obj",
              FormatObj(MakeRoundedBox({0.05, 0.05, 0.08}, 0.004), 1e3));
    WriteFile(top_ / "mine" / "block" / "object.yaml",
              "name: block\nmesh: block.obj\nmesh_unit: mm\nmass_kg: 0.05\n"
              "friction_static: 0.5\nfriction_dynamic: 0.4\n");
    const Hand hand = LoadHand((top_ / "mine" / "my_hand").string());
    Grasp grasp = LoadStandardGrasps(hand).front();
    const std::string made_from = grasp.id;
    grasp.id = "my-grasp";
    WriteFile(top_ / "mine" / "my.yaml", FormatGraspFile(hand, grasp, made_from));
  }
  void TearDown() override { fs::current_path(testing::TempDir()); }
  static int Call(const std::vector<std::string>& arguments) { return WaitFor(Start(arguments)); }

  /** Names and bytes of all files. */
  static std::map<std::string, std::string> ReadAll(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file()) {
        files[entry.path().lexically_relative(folder).string()] = ReadFile(entry.path());
      }
    }
    return files;
  }

  /** The originals go, the folder moves, and so does the working directory. */
  fs::path Move(const char* folder) const {
    fs::remove_all(top_ / "mine");
    fs::create_directories(top_ / "elsewhere");
    fs::rename(top_ / folder, top_ / "elsewhere" / "moved");
    fs::current_path("/");
    return top_ / "elsewhere" / "moved";
  }

  /** A copy is as precious as what never changes. */
  static void ExpectRefusalOfAChangedCopy(const fs::path& folder) {
    const fs::path mesh = folder / "inputs" / "objects" / "block" / "block.obj";
    WriteFile(mesh, ReadFile(mesh) + "\n");
    EXPECT_EQ(Call({"report", folder.string()}), 3);
    EXPECT_EQ(Call({"verify", folder.string()}), 3);
  }

  const TestFolder own_{"moved_session"};
  const fs::path& top_ = own_.path();
};

TEST_F(MovedSession, NeedsNothingButItsFolder) {
  fs::current_path(top_);
  const std::vector<std::string> session = {
      "run",        "--hand",  "mine/my_hand",      "--object",
      "mine/block", "--grasp", "best,mine/my.yaml", "--trials",
      "2",          "--out"};
  const auto run = [&](const std::string& out, const std::string& more) {
    std::vector<std::string> arguments = session;
    arguments.push_back(out);
    if (!more.empty()) arguments.push_back(more);
    return Call(arguments);
  };
  ASSERT_EQ(run("whole", ""), 0);
  ASSERT_EQ(Call({"judge", "whole"}), 0);
  ASSERT_EQ(run("planned", "--plan-only"), 0);
  const fs::path whole = top_ / "whole", moved = Move("planned");
  ASSERT_EQ(Call({"run", "--resume", "--out", moved.string()}), 0);
  ASSERT_EQ(Call({"judge", moved.string()}), 0);
  EXPECT_EQ(Call({"verify", moved.string()}), 0);
  for (const char* file :
       {"plan.jsonl", "export/trials.csv", "index.sqlite", "report/index.html"}) {
    ExpectSameFile(whole / file, moved / file);
  }

  const auto before = ReadAll(moved);
  fs::permissions(moved, fs::perms::owner_write, fs::perm_options::remove);
  const fs::path table = top_ / "table", page = top_ / "page";
  EXPECT_EQ(Call({"export", moved.string(), "--out", table.string()}), 0);
  EXPECT_EQ(Call({"report", moved.string(), "--out", page.string()}), 0);
  EXPECT_EQ(Call({"export", moved.string(), "--mjcf", "all", "--out", (top_ / "scenes").string()}),
            0);
  fs::permissions(moved, fs::perms::owner_write, fs::perm_options::add);
  EXPECT_TRUE(ReadAll(moved) == before);
  ExpectSameFile(table / "export" / "trials.csv", moved / "export" / "trials.csv");
  ExpectSameFile(page / "report" / "index.html", moved / "report" / "index.html");

  ExpectRefusalOfAChangedCopy(moved);
}

TEST_F(MovedSession, AnOptimisationNeedsNothingButItsFolder) {
  fs::current_path(top_);
  const auto optimise = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"optimise", "--hand",        "mine/my_hand",
                                          "--object", "mine/block",    "--step",
                                          "2",        "--evaluations", "3"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Call(arguments);
  };
  EXPECT_EQ(optimise({"--grasp", "mine/my.yaml", "--out", "whole"}), 2) << "no standard grasp";
  ASSERT_EQ(optimise({"--out", "whole"}), 0);
  ASSERT_EQ(optimise({"--out", "planned", "--plan-only"}), 0);
  const fs::path whole = top_ / "whole", moved = Move("planned");
  EXPECT_EQ(Call({"optimise", "--resume"}), 2) << "of which folder?";
  EXPECT_EQ(Call({"optimise", "--resume", "--seed", "2", "--out", moved.string()}), 2);
  ASSERT_EQ(Call({"optimise", "--resume", "--out", moved.string()}), 0);
  for (const char* file : {"scene.json", "manifest.json", "journal.jsonl", "result.json",
                           "individuals.csv", "new-target.yaml"}) {
    ExpectSameFile(whole / file, moved / file);
  }
  EXPECT_EQ(Call({"optimise", "--replay", "1", "--out", moved.string()}), 0);
  EXPECT_EQ(Call({"verify", moved.string()}), 0);
  const fs::path mesh = moved / "inputs" / "objects" / "block" / "block.obj";
  WriteFile(mesh, ReadFile(mesh) + "\n");
  EXPECT_EQ(Call({"optimise", "--resume", "--out", moved.string()}), 3);
}

TEST_F(MovedSession, ACampaignNeedsNothingButItsFolder) {
  fs::current_path(top_);
  const auto run = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"campaign",
                                          "--hand",
                                          "mine/my_hand",
                                          "--object",
                                          "mine/block",
                                          "--evaluations",
                                          "3",
                                          "--trials",
                                          "2",
                                          "--set",
                                          "optimise.choice_trials=2",
                                          "--set",
                                          "optimise.check_pairs=20"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Call(arguments);
  };
  ASSERT_EQ(run({"--out", "whole"}), 0);
  ASSERT_EQ(run({"--out", "planned", "--plan-only"}), 0);
  const fs::path whole = top_ / "whole", moved = Move("planned");
  EXPECT_EQ(Call({"campaign", "--resume", "--trials", "3", "--out", moved.string()}), 2);
  ASSERT_EQ(Call({"campaign", "--resume", "--out", moved.string()}), 0);
  const std::string scene = "scenes/my_hand-block/";
  for (const std::string& file :
       {std::string("campaign.json"), std::string("summary.csv"), scene + "journal.jsonl",
        scene + "result.json", std::string("benchmark/export/trials.csv"),
        std::string("report/index.html")}) {
    ExpectSameFile(whole / file, moved / file);
  }
  EXPECT_EQ(Call({"optimise", "--replay", "1", "--out", (moved / scene).string()}), 0);
  EXPECT_EQ(Call({"verify", moved.string()}), 0);

  const auto before = ReadAll(moved);
  fs::permissions(moved, fs::perms::owner_write, fs::perm_options::remove);
  const fs::path page = top_ / "page";
  EXPECT_EQ(Call({"report", moved.string(), "--out", page.string()}), 0);
  fs::permissions(moved, fs::perms::owner_write, fs::perm_options::add);
  EXPECT_TRUE(ReadAll(moved) == before);
  ExpectSameFile(page / "report" / "index.html", moved / "report" / "index.html");
  ExpectRefusalOfAChangedCopy(moved);
}

}  // namespace
}  // namespace graspbench
