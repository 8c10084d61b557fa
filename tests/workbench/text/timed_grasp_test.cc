#include "workbench/text/timed_grasp.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/grasp/grasp_file.h"
#include "core/hand/load_hand.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/plan/session_plan.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {

namespace {

class TimedGraspTest : public testing::Test {
 protected:
  /** @param times  of a trial: thumb, index, middle [s]; NaN: no contact. */
  void Write(const std::vector<std::vector<double>>& times, const std::string& kept = "1") {
    std::string trials = "trial_id,is_kept\n";
    std::string events = "trial_id,event,digit,is_believed,time_s\n";
    const char* digits[] = {"TH", "FF", "MF"};
    for (size_t k = 0; k < times.size(); ++k) {
      const std::string id = "P01-" + std::to_string(k);
      trials += id + "," + kept + "\n";
      events += id + ",movement_onset,,1,0.0\n";
      for (size_t d = 0; d < times[k].size(); ++d) {
        const std::string time = std::isnan(times[k][d]) ? "" : std::to_string(times[k][d]);
        events += id + ",contact," + digits[d] + ",1," + time + "\n";
        events += id + ",contact," + digits[d] + ",0,9.9\n";  // of a detector that is not believed
      }
    }
    WriteFileAtomically(folder_.path() / "trials.csv", trials);
    WriteFileAtomically(folder_.path() / "events.csv", events);
    SealOutput(folder_.path(), {"trials.csv", "events.csv"}, {});
  }
  std::string FindFault(const std::vector<std::string>& digits = {"TH", "FF", "MF"}) {
    try {
      ReadStudyLags(folder_.path(), digits);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  TemporaryFolder folder_;
};

// Lags after the first: thumb 0.06, 0.04, 0.05; middle 0.01, 0.03, 0.02; the index is always first.
TEST_F(TimedGraspTest, LagsAreMediansAfterTheFirst) {
  Write({{1.06, 1.0, 1.01}, {2.04, 2.0, 2.03}, {0.55, 0.5, 0.52}, {7.0, NAN, 7.9}});
  const auto lags = ReadStudyLags(folder_.path(), {"TH", "FF", "MF"});
  ASSERT_EQ(lags.size(), 3u);
  EXPECT_EQ(lags.at("FF"), 0.0);
  EXPECT_NEAR(lags.at("TH"), 0.05, 1e-9);
  EXPECT_NEAR(lags.at("MF"), 0.02, 1e-9);
}

TEST_F(TimedGraspTest, RefusesWhatCannotBePlayed) {
  EXPECT_NE(FindFault().find("expected the result folder of graspbench study run"),
            std::string::npos);
  Write({{0.5, 0.6, 0.7}});
  EXPECT_NE(FindFault({"TH", "LF"}).find("no contact of the grasp's digit LF; it has FF, MF, TH"),
            std::string::npos)
      << FindFault({"TH", "LF"});
  Write({{0.5, 0.6, 0.7}}, "0");
  EXPECT_NE(FindFault().find("no contact in an included trial"), std::string::npos);
  Write({{0.5, 0.6, NAN}, {0.5, NAN, 0.6}});
  EXPECT_NE(FindFault().find("in no trial"), std::string::npos);
  Write({{500, 600, 512}});  // milliseconds
  EXPECT_NE(FindFault().find("would never close"), std::string::npos);
  Write({{500, 500.01, 500.02}});
  EXPECT_EQ(FindFault(), "");
  const auto events = folder_.path() / "events.csv";
  WriteFileAtomically(events, ReadFile(events) + "P01-0,contact,FF,1,0.5\n");
  EXPECT_NE(FindFault().find("damaged"), std::string::npos) << FindFault();
}

TEST_F(TimedGraspTest, TheFileIsReadBack) {
  Write({{1.06, 1.0, 1.01}});
  const Hand hand = LoadHand("tum");
  const TimedGrasp timed = MakeTimedGrasp({"tum", "g3", folder_.path(), ""});
  const GraspFile file = ParseGraspFile(timed.file, "grasp.yaml", {&hand});
  EXPECT_EQ(file.grasp.id, "g3-timed");
  EXPECT_EQ(file.grasp.closing.size(), 2u) << "the first needs no schedule";
  EXPECT_NEAR(file.grasp.closing.at("TH").delay, 0.06, 1e-9);
  EXPECT_EQ(file.grasp.closing.at("MF").speed, 1.0);
  EXPECT_TRUE(timed.summary.empty());
  const TimedGrasp plain = MakeTimedGrasp({"tum", "g3", "", ""});
  EXPECT_TRUE(ParseGraspFile(plain.file, "g.yaml", {&hand}).grasp.closing.empty());
  EXPECT_THROW(MakeTimedGrasp({"tum", "g9", "", ""}), Error);
}

// By the contacts of a trial of the written file, not by its delays.
TEST_F(TimedGraspTest, OnAnObjectTheContactsComeAsInTheStudy) {
  Write({{1.06, 1.0, 1.01}});
  const TimedGrasp timed = MakeTimedGrasp({"tum", "g1", folder_.path(), "golf_ball"});
  EXPECT_NE(timed.summary.find("FF 0, MF 10, TH 60 ms after the first"), std::string::npos)
      << timed.summary;
  const std::filesystem::path path = folder_.path() / "grasp.yaml";
  WriteFileAtomically(path, timed.file);
  SessionConfig config;
  config.hands = {"tum"};
  config.objects = {"golf_ball"};
  config.grasps = {path.string()};
  const SessionInputs inputs = LoadSessionInputs(config);
  TrialSetup setup = MakeTrialSetup(config, inputs, MakePlan(config, inputs).front());
  setup.draw = {};
  setup.draw.joint_error = Eigen::VectorXd::Zero(setup.hand->num_joints());
  std::map<std::string, double> times;
  for (const DigitContact& contact : TrialRunner(setup.hand, setup.object).Run(setup).contacts) {
    times[contact.digit] = contact.time;
  }
  EXPECT_NEAR(times["MF"] - times["FF"], 0.01, 0.0042);
  EXPECT_NEAR(times["TH"] - times["FF"], 0.06, 0.0042);
}

void WriteStudy(const std::filesystem::path& folder, const std::string& trials,
                const std::string& events) {
  WriteFileAtomically(folder / "trials.csv", trials);
  WriteFileAtomically(folder / "events.csv", events);
  SealOutput(folder, {"trials.csv", "events.csv"}, {});
}

TEST(StudyTouches, AContactIsFoundOrNeverHappenedOrIsNotKnown) {
  TemporaryFolder folder;
  WriteStudy(folder.path(), "trial_id,is_kept,object\na,1,can\nb,0,can\nc,1,\n",
             "trial_id,event,digit,is_believed,time_s,missing\n"
             "a,maximum_opening,,1,1.2,\n"
             "a,last_maximum_opening,,0,1.3,\n"
             "a,contact,TH,0,9.0,\n"
             "a,contact,TH,1,1.5,\n"
             "a,contact,FF,1,,in the hold it moves at 52 mm/s against the object\n"
             "a,contact,MF,1,,not usable here: known to 103 ms only\n"
             "b,contact,TH,1,1.5,\n"
             "c,contact,TH,1,2.5,\n");
  const std::vector<TrialTouches> touches = ReadStudyTouches(folder.path());
  ASSERT_EQ(touches.size(), 2u);
  EXPECT_EQ(touches[0].object, "can");
  EXPECT_EQ(touches[0].start, 1.2);
  ASSERT_EQ(touches[0].contacts.size(), 2u);
  EXPECT_EQ(touches[0].contacts[0].digit, "TH");
  EXPECT_TRUE(touches[0].contacts[0].is_opposing);
  EXPECT_EQ(touches[0].contacts[0].time, 1.5);
  EXPECT_EQ(touches[0].contacts[1].digit, "FF");
  EXPECT_TRUE(std::isnan(touches[0].contacts[1].time));
  EXPECT_TRUE(std::isnan(touches[1].start));
}

TEST(StudyTouches, DamagedAndMissingTablesAreRefused) {
  TemporaryFolder folder;
  EXPECT_THROW(ReadStudyTouches(folder.path()), Error);
  WriteStudy(folder.path(), "trial_id,is_kept\na,1\n",
             "trial_id,event,digit,is_believed\na,contact,TH,1\n");
  EXPECT_THROW(ReadStudyTouches(folder.path()), Error);  // no times
  WriteStudy(folder.path(), "trial_id,is_kept\na,1\n",
             "trial_id,event,digit,is_believed,time_s\na,contact,TH,1,soon\n");
  EXPECT_THROW(ReadStudyTouches(folder.path()), Error);
}

}  // namespace

}  // namespace graspbench
