#include "datasets/trajectory/trajectory_form.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/trial/trial_runner.h"
#include "datasets/records/trial_record.h"
#include "objects/catalogue.h"
#include "tests/datasets/mjcf/best_grasp_setup.h"
#include "tests/datasets/session/fake_session.h"

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
  ASSERT_GE(ListTrajectoryForms().size(), 5u);
  for (const TrajectoryForm& form : ListTrajectoryForms()) {
    EXPECT_EQ(&FindTrajectoryForm(form.name), &form);
    EXPECT_EQ(&FindTrajectoryForm("folder/a." + std::string(form.name)), &form);
  }
  try {
    FindTrajectoryForm("a.bag");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUsage);
    EXPECT_STREQ(
        error.what(),
        "--trajectory: \"a.bag\" has none of the known endings: .glb, .csv, .mcap, .h5, .npz");
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
  ASSERT_EQ(files.size(), 5u);
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

TEST(TrajectoryForm, TablesHoldEveryTactileElement) {
  const TrialTrajectory& trajectory = GetTrajectory();
  const auto files = MakeTrajectoryFiles(FindTrajectoryForm("csv"), trajectory);
  const auto taxels = ReadCsv(files[3].bytes), elements = ReadCsv(files[4].bytes);
  const std::vector<TactileElement>& skin = trajectory.hand->skin->elements;
  ASSERT_EQ(elements.size(), skin.size() + 1);
  ASSERT_EQ(taxels.size(), trajectory.traced.trace.size() + 1);
  ASSERT_EQ(taxels[0].size(), skin.size() + 1);
  for (size_t i = 0; i < skin.size(); ++i) {
    EXPECT_EQ(elements[i + 1][1], trajectory.hand->links[static_cast<size_t>(skin[i].link)].name);
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<Eigen::Index>(axis);
      EXPECT_EQ(std::stod(elements[i + 1][3 + axis]), skin[i].p_LE[at]);
      EXPECT_EQ(std::stod(elements[i + 1][6 + axis]), skin[i].normal_L[at]);
    }
  }
  // Elements bear what presses on sensed surface: never more than the grip.
  double most = 0.0;
  for (size_t row = 1; row < taxels.size(); ++row) {
    double sum = 0.0;
    for (size_t i = 1; i < taxels[row].size(); ++i) sum += std::stod(taxels[row][i]);
    EXPECT_LE(sum, trajectory.traced.trace[row - 1].grip_force + 1e-9);
    most = std::max(most, sum);
  }
  EXPECT_GT(most, 0.1);
}

TEST(TrajectoryForm, ACollectionHoldsSeveralTrials) {
  const auto one = FindTrajectoryForm("h5").collect(), two = FindTrajectoryForm("h5").collect();
  one->Add(GetTrajectory());
  two->Add(GetTrajectory());
  two->Add(GetTrajectory());
  EXPECT_GT(two->Finish().size(), one->Finish().size() * 3 / 2);
}

const PlannedTrial kPlanned = {"0123456789abcdef", "tum", "mug", "g2", 1};

/** Steps of 2 ms for one second; closure begins at 0.301 s, between two instants at 60 Hz. */
TracedTrial MakeTraced() {
  TracedTrial traced;
  for (int step = 0; step <= 500; ++step) {
    TraceInstant instant;
    instant.time = 0.002 * step;
    instant.phase = step <= 151 ? Phase::kPlacing : Phase::kClosure;
    instant.next_phase = step < 151 ? Phase::kPlacing : Phase::kClosure;
    traced.trace.push_back(instant);
  }
  traced.closure_start = 0.302;
  traced.result.phases = {{"closure", 0.0}};
  traced.result.contact_events = {{0.1, ContactEventKind::kTouch, "F1", "link", kUnset},
                                  {0.2, ContactEventKind::kLost, "F1", "link", 0.5}};
  return traced;
}

TEST(Trajectory, KeepsTheFirstStepOfEachIntervalAndTheEndsOfPhases) {
  const TrialTrajectory trajectory = MakeTrajectory(kPlanned, {}, MakeTraced(), 60.0);
  const std::vector<TraceInstant>& kept = trajectory.traced.trace;
  // 0, 1/60 .. 60/60 s are 61 instants; 1 s is a step itself. One more ends the phase.
  ASSERT_EQ(kept.size(), 62u);
  EXPECT_DOUBLE_EQ(kept[1].time, 0.018);  // 16.7 ms
  EXPECT_DOUBLE_EQ(kept[2].time, 0.034);  // 33.3 ms
  EXPECT_DOUBLE_EQ(kept[3].time, 0.050);  // exactly
  EXPECT_DOUBLE_EQ(kept.back().time, 1.0);
  int num_ends = 0;
  for (const TraceInstant& instant : kept) {
    if (instant.next_phase == instant.phase) continue;
    EXPECT_DOUBLE_EQ(instant.time, 0.302);
    ++num_ends;
  }
  EXPECT_EQ(num_ends, 1);
}

TEST(Trajectory, EveryStepAtTheRateOfTheSteps) {
  EXPECT_EQ(MakeTrajectory(kPlanned, {}, MakeTraced(), 500.0).traced.trace.size(), 501u);
  EXPECT_EQ(MakeTrajectory(kPlanned, {}, MakeTraced(), 1000.0).traced.trace.size(), 501u);
}

TEST(Trajectory, EventsCountFromTheStartOfPlacing) {
  const auto events = ListTrajectoryEvents(MakeTrajectory(kPlanned, {}, MakeTraced(), 60.0));
  ASSERT_EQ(events.size(), 4u);
  EXPECT_EQ(events[0].phase, "placing");
  EXPECT_EQ(events[1].phase, "closure");
  EXPECT_DOUBLE_EQ(events[1].time, 0.302);
  EXPECT_EQ(events[2].kind, "touch");
  EXPECT_DOUBLE_EQ(events[2].time, 0.402);
  EXPECT_EQ(events[3].kind, "lost");
  EXPECT_EQ(events[3].impulse, 0.5);
}

TEST(Trajectory, NamesTheRecordByItsLineWithoutTheChecksum) {
  const TrialRecord record = MakeFakeRecord(kPlanned);
  std::string line = FormatJournalLine(record);
  line = line.substr(0, line.rfind(",\"xxh64\"")) + "}";
  EXPECT_EQ(CalcRecordSha256(kPlanned, record.result), CalcSha256(line));
}

}  // namespace

}  // namespace graspbench
