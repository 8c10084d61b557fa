#include "reports/scenes/cell_pictures.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "core/shape/primitives.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {

namespace {

/** A hand that is one box, and a can that is another. */
SessionModels MakeModels() {
  Hand hand;
  hand.id = "tum";
  hand.name = "Box Hand";
  hand.links.resize(1);
  hand.visuals.push_back({0, MakeRoundedBox({0.05, 0.05, 0.1}, 0.005), {0.4f, 0.4f, 0.4f}});
  GraspObject can;
  can.id = can.name = "can";
  can.mesh = MakeRoundedBox({0.06, 0.06, 0.1}, 0.005);
  SessionModels models;
  models.hands["tum"] = std::make_shared<const Hand>(hand);
  models.objects["can"] = std::make_shared<const GraspObject>(can);
  return models;
}

std::vector<SceneSnapshot> MakeSnapshots() {
  std::vector<SceneSnapshot> snapshots;
  for (const Moment moment : {Moment::kPreGrasp, Moment::kClosed, Moment::kLifted}) {
    SceneSnapshot snapshot;
    snapshot.moment = moment;
    snapshot.X_WH = MakePose(Eigen::Vector3d(0.0, 0.0, 0.3));
    snapshot.X_WO = MakePose(Eigen::Vector3d(0.0, 0.0, 0.05));
    snapshots.push_back(snapshot);
  }
  return snapshots;
}

TEST(RenderCellPictures, DrawsTheFirstSuccessTheSameEveryTime) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 3);
  session.records[0].result.outcome = Outcome::kKnockedOver;
  for (TrialRecord& record : session.records) record.result.snapshots = MakeSnapshots();
  const SessionSummary summary = SummariseSession(session);
  const CellPictures pictures = RenderCellPictures(session, summary, MakeModels());
  EXPECT_TRUE(pictures.problems.empty());
  const Filmstrip& strip = pictures.by_cell.at("tum-can-g3").front();
  EXPECT_EQ(strip.record, &session.records[1]);
  ASSERT_EQ(strip.pictures.size(), 3u);
  EXPECT_EQ(strip.pictures[2].moment, Moment::kLifted);
  EXPECT_EQ(strip.pictures[0].webp.substr(8, 4), "WEBP");
  const CellPictures again = RenderCellPictures(session, summary, MakeModels());
  EXPECT_EQ(again.by_cell.at("tum-can-g3")[0].pictures[0].webp, strip.pictures[0].webp);
}

TEST(RenderCellPictures, EveryOtherOutcomeHasAStripOfItsFirstTrial) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 6);
  const Outcome outcomes[] = {Outcome::kNoContact,  Outcome::kSuccess,   Outcome::kPushedAway,
                              Outcome::kPushedAway, Outcome::kNoContact, Outcome::kSuccess};
  for (size_t i = 0; i < 6; ++i) {
    session.records[i].result.outcome = outcomes[i];
    session.records[i].result.snapshots = MakeSnapshots();
  }
  session.records[2].result.snapshots[0].q = Eigen::VectorXd::Zero(3);  // of another hand
  const CellPictures pictures =
      RenderCellPictures(session, SummariseSession(session), MakeModels());
  const std::vector<Filmstrip>& strips = pictures.by_cell.at("tum-can-g3");
  ASSERT_EQ(strips.size(), 3u);
  EXPECT_EQ(strips[0].record, &session.records[1]) << "the first success";
  EXPECT_EQ(strips[1].record, &session.records[0]);
  EXPECT_EQ(strips[2].record, &session.records[3]) << "the first that can be drawn";
}

TEST(RenderCellPictures, AnObjectThatFlewAwayDoesNotShrinkTheHand) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 2);
  session.records[0].result.snapshots = session.records[1].result.snapshots = MakeSnapshots();
  session.records[0].result.snapshots[2].X_WO.translation() << 5.0, 3.0, 0.0;
  session.records[1].result.snapshots[2].X_WO.translation() << 9.0, -3.0, 0.0;
  Session other = session;
  other.records[0] = other.records[1];
  const SessionSummary summary = SummariseSession(session), other_summary = SummariseSession(other);
  // Where it went must not matter for the camera, so the first picture is the same.
  EXPECT_EQ(RenderCellPictures(session, summary, MakeModels())
                .by_cell.at("tum-can-g3")[0]
                .pictures[0]
                .webp,
            RenderCellPictures(other, other_summary, MakeModels())
                .by_cell.at("tum-can-g3")[0]
                .pictures[0]
                .webp);
}

// The camera rises with hand and object and need not stand farther away for it.
TEST(RenderCellPictures, ALiftedObjectDoesNotShrinkTheHand) {
  const auto render_first = [](double rise_of_hand, double rise_of_object) {
    Session session = MakeSession({"tum"}, {"can"}, "g3", 1);
    session.records[0].result.snapshots = MakeSnapshots();
    SceneSnapshot& lifted = session.records[0].result.snapshots[2];
    lifted.X_WH.translation().z() += rise_of_hand;
    lifted.X_WO.translation().z() += rise_of_object;
    return RenderCellPictures(session, SummariseSession(session), MakeModels())
        .by_cell.at("tum-can-g3")[0]
        .pictures[0];
  };
  const Picture still = render_first(0.0, 0.0);
  EXPECT_EQ(render_first(0.1, 0.1).webp, still.webp);
  EXPECT_NE(render_first(0.0, 0.1).webp, still.webp) << "what moves alone is to be seen";
  EXPECT_EQ(still.thumbnail.substr(8, 4), "WEBP");
  EXPECT_LT(still.thumbnail.size(), still.webp.size());
}

TEST(RenderCellPictures, SnapshotsThatDoNotFitTheHandAreAProblem) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 1);
  session.records[0].result.snapshots = MakeSnapshots();
  session.records[0].result.snapshots[1].q = Eigen::VectorXd::Zero(3);
  const CellPictures pictures =
      RenderCellPictures(session, SummariseSession(session), MakeModels());
  EXPECT_TRUE(pictures.by_cell.empty());
  ASSERT_EQ(pictures.problems.size(), 1u);
  EXPECT_EQ(pictures.problems[0],
            "no trial of Box Hand, can, power (g3) has snapshots that fit the present hand");
}

TEST(WriteSessionReport, UnknownModelsCostThePicturesNotTheReport) {
  const Session session = MakeSession({"no_such_hand"}, {"can"}, "g3", 1);
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "report_test";
  const std::filesystem::path path = WriteSessionReport(folder, session);
  EXPECT_EQ(path, folder / "report" / "index.html");
  const std::string page = ReadFile(path);
  ExpectParts(page, {"no_such_hand", "Models: "});
  EXPECT_EQ(page.find(FindDataRoot().string()), std::string::npos) << "an absolute path";
}

TEST(ShownTrials, AreAllTrialsOfMostSessions) {
  const Session session = MakeSession({"tum"}, {"can", "cup", "mug"}, "g3", 1000);
  const SessionSummary summary = SummariseSession(session);
  for (const CellSummary& cell : summary.cells) {
    EXPECT_EQ(ChooseShownTrials(cell, summary), cell.records);
    EXPECT_TRUE(IsDrawnInFull(cell, summary));
  }
  EXPECT_EQ(DescribeShownTrials(1000, summary.cells[0]), "");
}

TEST(ShownTrials, AreEvenlySpacedInALargeSessionWhichSaysSo) {
  const Session session = MakeSession({"tum", "shadow"}, {"can", "cup"}, "g3", 2000);
  const SessionSummary summary = SummariseSession(session);
  const std::vector<const TrialRecord*> shown = ChooseShownTrials(summary.cells[1], summary);
  ASSERT_EQ(shown.size(), 750u);
  for (size_t i = 0; i < shown.size(); ++i) {
    EXPECT_EQ(shown[i]->plan.trial, static_cast<int>(i * 2000 / 750));
  }
  const std::string page = MakePageOf(session);
  ExpectSoundPage(page);
  ExpectParts(page, {"750 of 2000 trials, evenly spaced; export/trials.csv has all of them."});
  EXPECT_LT(page.size(), 10'000'000u);
}

TEST(ShownTrials, OfManyCellsTheFirstAreDrawnInFull) {
  std::vector<std::string> objects;
  for (int i = 0; i < 260; ++i) objects.push_back("object" + std::to_string(i));
  const Session session = MakeSession({"tum"}, objects, "g3", 1);
  const SessionSummary summary = SummariseSession(session);
  EXPECT_TRUE(IsDrawnInFull(summary.cells[249], summary));
  EXPECT_FALSE(IsDrawnInFull(summary.cells[250], summary));
  const std::string page = MakePageOf(session);
  ExpectSoundPage(page);  // every link to a cell has its place
  ExpectParts(page, {"too many conditions for one page"});
}

std::string Draw(Outcome outcome) {
  TrialResult result;
  result.outcome = outcome;
  return DrawFilmstrip({{Moment::kClosed, 1.25, "abc"}, {Moment::kLifted, 2.5, "def"}}, result,
                       "a <hand>")
      .markup();
}

TEST(Filmstrip, OnlyASuccessIsShownInItsHold) {
  EXPECT_NE(Draw(Outcome::kSuccess).find(">Hold, 2.50 s<"), std::string::npos);
  EXPECT_NE(Draw(Outcome::kPushedAway).find(">End, 2.50 s<"), std::string::npos);
  EXPECT_EQ(Draw(Outcome::kPushedAway).find("Hold"), std::string::npos);
  EXPECT_NE(Draw(Outcome::kPushedAway).find(">Stabilisation, 1.25 s<"), std::string::npos);
}

TEST(Filmstrip, EveryPictureHasWordsInItsPlace) {
  const std::string html = Draw(Outcome::kSuccess);
  ExpectParts(html, {"alt=\"a &lt;hand&gt;: Hold\"", "data:image/webp;base64,YWJj"});
}

}  // namespace

}  // namespace graspbench
