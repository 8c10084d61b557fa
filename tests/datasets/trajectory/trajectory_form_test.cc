#include "datasets/trajectory/trajectory_form.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/trial/trial_runner.h"
#include "objects/catalogue.h"
#include "tests/datasets/mjcf/best_grasp_setup.h"

namespace graspbench {
namespace {

/** Simulated once for all tests. */
const TrialTrajectory& GetTrajectory() {
  static const TrialTrajectory trajectory = [] {
    TrialSetup setup = MakeBestGraspSetup("tum-evolved", "golf_ball");
    setup.object = CompleteObject(setup.object);
    TrialRunner runner(setup.hand, setup.object);
    const PlannedTrial planned = {"0123456789abcdef", "tum", "golf_ball", "g1", 0};
    return MakeTrajectory(planned, setup, TraceTrial(runner, setup, 0.0), 60.0);
  }();
  return trajectory;
}

TEST(TrajectoryForm, IsFoundByEndingAndByName) {
  ASSERT_GE(ListTrajectoryForms().size(), 4u);
  for (const TrajectoryForm& form : ListTrajectoryForms()) {
    EXPECT_EQ(&FindTrajectoryForm(form.name), &form);
    EXPECT_EQ(&FindTrajectoryForm("folder/a." + std::string(form.name)), &form);
  }
  try {
    FindTrajectoryForm("a.bag");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_STREQ(error.what(),
                 "--trajectory: \"a.bag\" ends in none of the forms there are: .glb, .csv, .mcap, "
                 ".h5");
  }
}

TEST(TrajectoryForm, EachGivesTheSameBytesAgain) {
  for (const TrajectoryForm& form : ListTrajectoryForms()) {
    const std::vector<TrajectoryFile> files = MakeTrajectoryFiles(form, GetTrajectory());
    const std::vector<TrajectoryFile> again = MakeTrajectoryFiles(form, GetTrajectory());
    ASSERT_EQ(files.size(), again.size());
    EXPECT_EQ(files.front().ending, "." + std::string(form.name));
    for (size_t i = 0; i < files.size(); ++i) {
      EXPECT_FALSE(files[i].bytes.empty()) << form.name;
      EXPECT_TRUE(files[i].bytes == again[i].bytes) << form.name << " " << files[i].ending;
    }
  }
}

/** Cells of a table without quotes. */
std::vector<std::vector<std::string>> ReadCsv(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, std::vector<std::string>(1));
  for (const char letter : text) {
    if (letter == '\n') {
      rows.push_back({""});
    } else if (letter == ',') {
      rows.back().push_back("");
    } else {
      rows.back().back() += letter;
    }
  }
  rows.pop_back();
  return rows;
}

// What other programs read of MCAP and HDF5 is compared in read_trajectories.py.
TEST(TrajectoryForm, TablesHoldInstantsContactsAndEvents) {
  const TrialTrajectory& trajectory = GetTrajectory();
  const auto files = MakeTrajectoryFiles(FindTrajectoryForm("csv"), trajectory);
  ASSERT_EQ(files.size(), 3u);
  const auto instants = ReadCsv(files[0].bytes), contacts = ReadCsv(files[1].bytes),
             events = ReadCsv(files[2].bytes);
  EXPECT_EQ(instants.size(), trajectory.traced.trace.size() + 1);
  EXPECT_EQ(events.size(), 1 + ListTrajectoryEvents(trajectory).size());
  // The normal forces of an instant's contacts add up to its grip force.
  const auto force = static_cast<size_t>(
      std::find(contacts[0].begin(), contacts[0].end(), "normal_force_n") - contacts[0].begin());
  ASSERT_LT(force, contacts[0].size());
  for (const TraceInstant& instant : trajectory.traced.trace) {
    double sum = 0.0;
    for (size_t row = 1; row < contacts.size(); ++row) {
      if (std::stod(contacts[row][0]) == instant.time) sum += std::stod(contacts[row][force]);
    }
    EXPECT_NEAR(sum, instant.grip_force, 1e-9) << instant.time;
  }
}

TEST(TrajectoryForm, ACollectionHoldsSeveralTrials) {
  const auto one = FindTrajectoryForm("h5").collect(), two = FindTrajectoryForm("h5").collect();
  one->Add(GetTrajectory());
  two->Add(GetTrajectory());
  two->Add(GetTrajectory());
  EXPECT_GT(two->Finish().size(), one->Finish().size() * 3 / 2);
}

}  // namespace
}  // namespace graspbench
