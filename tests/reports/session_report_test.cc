#include "reports/session_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/hand/load_hand.h"
#include "objects/catalogue.h"
#include "reports/page/html.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

TEST(SessionReport, EveryNumberStandsInThePageWithoutScript) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 3);
  session.records[1] = MakeRecord(session.plan[1], Outcome::kSlippedInLiftOff);
  const std::string page = MakePageOf(session);
  ExpectSoundPage(page);
  const std::string text = TextOf(page);
  ExpectParts(text,
              {"Success: tum, 2 of 3 trials (66.7\u00A0%, 95\u00A0% interval 20.8 to 93.9\u00A0%)",
               "slipped in lift-off (1 of 1)",
               "1 slipped in lift-off",
               "0.610",
               "0.600 to 0.620",
               "0.200",
               "0.100",
               "32.8",
               "16.4",
               "0.63",
               "5.67",
               "98.7",
               "1.2",
               "3.4",
               "-0.321",
               "0.321",
               "1234",
               "3702",
               "id0",
               "id1",
               "id2",
               "the thumb came late",
               "FF [s]",
               "MF [s]",
               "TH [s]"});
}

// Without a rule of the style sheet, a part is black and its text cannot be read.
TEST(SessionReport, EveryOutcomeHasAColourByDayAndByNight) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", kNumOutcomes);
  size_t next = 0;
  for (const Outcome outcome : ListOutcomes()) session.records[next++].result.outcome = outcome;
  const std::string page = MakePageOf(session);
  for (int k = 0; k < kNumOutcomes; ++k) {
    const std::string part = "part" + std::to_string(k);
    ExpectParts(page,
                {"class=\"part " + part + "\"", "." + part + " { fill: var(--" + part + "); }"});
    const std::string colour = "--" + part + ": #";
    EXPECT_NE(page.find(colour), page.rfind(colour)) << part;
  }
}

TEST(SessionReport, ThumbComesFirst) {
  const std::string text = TextOfId(MakePageOf(MakeSession({"tum"}, {"can"}, "g3", 1)), "cells");
  EXPECT_LT(text.find("TH [s]"), text.find("FF [s]"));
}

TEST(SessionReport, HostileNamesStayText) {
  const std::string hostile = "</script><img src=x onerror=\"a\">&\xff\u202E";
  Session session = MakeSession({hostile}, {"'\"><b>", "<!--"}, "g3", 1);
  session.records[0].result.reason = hostile;
  session.records[0].result.contacts[0].digit = hostile;
  session.findings.Warn("journal/" + hostile, 3, hostile);
  const std::string page = MakePageOf(session);
  ExpectSoundPage(page);
  EXPECT_EQ(page.find("<img"), std::string::npos);
  EXPECT_EQ(page.find("<b>\""), std::string::npos);
  EXPECT_EQ(page.find("<!--"), std::string::npos);
  EXPECT_EQ(page.find("\u202E"), std::string::npos);
}

TEST(SessionReport, AnEmptySessionIsSaidToBeEmpty) {
  const std::string page = MakePageOf(Session());
  ExpectSoundPage(page);
  ExpectParts(TextOfId(page, "result"), {"This session has no trials."});
  ExpectParts(TextOfId(page, "findings"), {"No errors and no warnings."});
}

TEST(SessionReport, APlanWithoutRecordsIsNotComplete) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 2);
  session.records.clear();
  const std::string page = MakePageOf(session);
  ExpectSoundPage(page);
  ExpectParts(TextOfId(page, "result"),
              {"0 of 2 planned trials are finished", "No trial has finished yet."});
}

TEST(SessionReport, AnIncompleteSessionSaysSoAtTheTopAndPerCell) {
  Session session = MakeSession({"tum"}, {"can", "cup"}, "g3", 2);
  session.records.pop_back();
  const std::string page = MakePageOf(session);
  ExpectSoundPage(page);
  const std::string result = TextOfId(page, "result");
  EXPECT_LT(result.find("This session is not complete."), result.find("Success: "));
  ExpectParts(result, {"3 of 4 planned trials are finished"});
  ExpectParts(TextOfId(page, "findings"), {"tum, cup, power (g3): 1 of 2 planned trials missing"});
  ExpectParts(TextOfId(page, "tum-cup-g3"), {"1 of 2 planned trials missing"});
}

TEST(SessionReport, NumericalFailuresAreListedWithTheirReason) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 2);
  session.records[1] = MakeRecord(session.plan[1], Outcome::kNumericalFailure);
  session.records[1].result.reason = "the solve diverged at 1.234 s";
  const std::string page = MakePageOf(session);
  ExpectSoundPage(page);
  ExpectParts(TextOfId(page, "health"), {"the solve diverged at 1.234 s"});
  ExpectParts(TextOfId(page, "findings"), {"1 trial failed numerically; "});
  ExpectParts(TextOfId(page, "result"), {"1 of 2 trials (50.0\u00A0%"});
}

TEST(SessionReport, NonsenseStandsFirstAmongTheFindings) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 3);
  session.records[1].result.outcome = Outcome::kNotPhysical;
  session.records[1].result.reason = "the hand is 1.20 mm inside the object (limit 1 mm)";
  session.records[2].result.outcome = Outcome::kNumericalFailure;
  const std::string page = MakePageOf(session);
  ExpectSoundPage(page);
  const std::string findings = TextOfId(page, "findings");
  const size_t nonsense = findings.find(
      "Not physical and therefore not a success: tum, can, power (g3), trial 1: the hand is 1.20 "
      "mm inside the object");
  ASSERT_NE(nonsense, std::string::npos) << findings;
  const size_t numerical = findings.find("1 trial failed numerically; ");
  ASSERT_NE(numerical, std::string::npos) << findings;
  EXPECT_LT(nonsense, numerical);
  ExpectParts(TextOfId(page, "result"), {"1 of 3 trials"});
  ExpectParts(TextOfId(page, "tum-can-g3"), {"*"});  // a median of two trials
}

TEST(SessionReport, ContactBeforeTheStartOfClosureIsToldApart) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 1);
  TrialResult& result = session.records[0].result;
  result.contacts[0].time = -0.2;  // GCT 0.6, GFT 0.8, GOT 0.7
  result.timing = CalcContactTiming(result.contacts, 0.0);
  const std::string page = MakePageOf(session);
  EXPECT_EQ(TextOfId(page, "table").find("133.3"), std::string::npos);
  ExpectParts(TextOfId(page, "tum-can-g3"),
              {"Early contact (before the start of closure) in 1 trial"});
  ExpectParts(TextOfId(page, "findings"), {"tum, can, power (g3): in 1 trial a digit"});
}

TEST(SessionReport, DamagedJournalLinesAndMissingModelsAreTold) {
  const Session session = [] {
    Session made = MakeSession({"tum"}, {"can"}, "g3", 2);
    made.findings.Warn("journal/2.jsonl", 17, "checksum does not fit");
    made.records.pop_back();  // the trial of the damaged line
    return made;
  }();
  SessionModels models;
  models.problems = {"the object \"can\" cannot be loaded: gone"};
  CellPictures pictures;
  pictures.problems = {"no pictures could be drawn: libOSMesa.so.8 is missing"};
  const std::string page =
      MakeSessionReport({session, SummariseSession(session), models, pictures});
  ExpectSoundPage(page);
  const std::string findings = TextOfId(page, "findings");
  ExpectParts(findings, {"Warning in journal/2.jsonl, line 17: checksum does not fit",
                         "the object \"can\" cannot be loaded: gone", "libOSMesa.so.8 is missing"});
  ExpectParts(TextOfId(page, "tum-can-g3"), {"No pictures of this condition; the reason is"});
  ExpectParts(TextOfId(page, "result"), {"4 findings"});
}

// A line torn by a kill costs nothing once its trial has run again.
TEST(SessionReport, AFinishedSessionDoesNotTellHowItWasInterrupted) {
  const Session smooth = MakeSession({"tum"}, {"can"}, "g3", 2);
  Session interrupted = smooth;
  interrupted.findings.Warn("journal/0.jsonl", 1, "skipped: the line is torn");
  const auto page = [](const Session& session) {
    return MakeSessionReport({session, SummariseSession(session), SessionModels(), CellPictures()});
  };
  EXPECT_EQ(page(interrupted), page(smooth));
}

// From the sentence at the top to the list, from there to all values of the trial.
TEST(SessionReport, EveryFailureIsTwoLinksFromTheTop) {
  Session session = MakeSession({"tum"}, {"can", "cup"}, "g3", 3);
  session.records[4].result.outcome = Outcome::kPushedAway;
  session.records[4].result.reason = "the object was pushed aside";
  const std::string page = MakePageOf(session);
  ExpectSoundPage(page);
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  const tinyxml2::XMLElement& root = *document.RootElement();
  const auto top = ListAttribute(*FindById(root, "result"), "href");
  EXPECT_NE(std::find(top.begin(), top.end(), "#failures"), top.end());
  const std::string anchor = "trial-" + session.records[4].plan.id;
  // Its trial, and the command that makes its scene in 3-D.
  EXPECT_EQ(ListAttribute(*FindById(root, "failures"), "href"),
            (std::vector<std::string>{"#" + anchor, "#further"}));
  ExpectParts(TextOfId(page, "failures"), {"tum-cup-g3:1", "the object was pushed aside"});
  ASSERT_NE(FindById(root, anchor), nullptr);
  ExpectParts(ListText(*FindById(root, anchor)), {session.records[4].plan.id});
}

TEST(SessionReport, PicturesAreInsideWithTextInTheirPlace) {
  const Session session = MakeSession({"tum"}, {"can"}, "g3", 1);
  const SessionSummary summary = SummariseSession(session);
  CellPictures pictures;
  pictures.by_cell["tum-can-g3"] = {
      {&session.records[0], {{Moment::kPreGrasp, 0.0, "abc"}, {Moment::kClosed, 1.25, "def"}}}};
  const std::string page = MakeSessionReport({session, summary, SessionModels(), pictures});
  ExpectSoundPage(page);
  ExpectParts(page,
              {"src=\"data:image/webp;base64,YWJj\"", "alt=\"tum, can, power (g3): Pre-grasp\""});
  ExpectParts(TextOfId(page, "tum-can-g3"), {"Stabilisation, 1.25 s"});
}

TEST(SessionReport, TheFirstScreenShowsAPictureAndTheWeakestCells) {
  Session session = MakeSession({"tum"}, {"can", "cup", "ball"}, "g3", 4);
  for (const size_t i : {4, 5, 6}) session.records[i].result.outcome = Outcome::kPushedAway;
  session.records[8].result.outcome = Outcome::kNoContact;
  const SessionSummary summary = SummariseSession(session);
  CellPictures pictures;
  pictures.by_cell["tum-can-g3"] = {{&session.records[0], {{Moment::kClosed, 1.0, "abc", "xyz"}}}};
  pictures.by_cell["tum-cup-g3"] = {
      {&session.records[7], {{Moment::kClosed, 1.0, "good", "small good"}}},
      {&session.records[4], {{Moment::kLifted, 2.0, "bad", "small bad"}}}};
  const std::string page = MakeSessionReport({session, summary, SessionModels(), pictures});
  ExpectSoundPage(page);
  const std::string result = TextOfId(page, "result");
  const size_t worst = result.find("tum, cup, g3  1 of 4 pushed away");
  const size_t second = result.find("tum, ball, g3  3 of 4 no contact");
  ASSERT_NE(worst, std::string::npos) << result;
  ASSERT_NE(second, std::string::npos) << result;
  EXPECT_LT(worst, second);
  EXPECT_EQ(result.find("tum, can, g3"), std::string::npos) << "it has no failure";
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  const std::vector<std::string> images =
      ListAttribute(*FindById(*document.RootElement(), "result"), "src");
  EXPECT_EQ(images, (std::vector<std::string>{MakeDataUri("image/webp", "small bad"),
                                              MakeDataUri("image/webp", "abc")}));
}

TEST(SessionReport, SeveralGraspsGetAColumnEach) {
  Session session = MakeSession({"tum"}, {"can"}, "g1", 1);
  const Session more = MakeSession({"tum"}, {"can"}, "g3", 1);
  session.plan.push_back(more.plan[0]);
  session.records.push_back(more.records[0]);
  session.records[1].plan.id = session.plan[1].id = "another";
  const std::string page = MakePageOf(session);
  ExpectSoundPage(page);
  ExpectParts(TextOfId(page, "map"), {"g1 g3 tum"});
}

TEST(SessionReport, TheBenchmarkFitsIntoTenMegabytes) {
  std::vector<std::string> objects;
  for (int i = 0; i < 21; ++i) objects.push_back("object" + std::to_string(i));
  const Session session = MakeSession({"tum", "shadow"}, objects, "g1", 10);
  const SessionSummary summary = SummariseSession(session);
  CellPictures pictures;
  const std::string webp(45000, 'x');  // more than a picture of this size takes
  for (const CellSummary& cell : summary.cells) {
    pictures.by_cell[cell.key] = {
        {cell.records[0],
         {{Moment::kPreGrasp, 0, webp}, {Moment::kClosed, 1, webp}, {Moment::kLifted, 2, webp}}}};
  }
  const std::string page = MakeSessionReport({session, summary, SessionModels(), pictures});
  EXPECT_LT(page.size(), 10'000'000u);
  ExpectSoundPage(page);
}

TEST(SessionReport, ShowsWhatSettingsChange) {
  const Session session = MakeSession({"tum"}, {"can"}, "g3", 2);
  SensitivityData data;
  for (const TrialRecord& record : session.records) {
    TrialMeasures& measures = data["model.mass_scale=2.0"][record.plan.id];
    measures = MakeTrialMeasures(record);
    measures.outcome = Outcome::kKnockedOver;
    measures.gft += 0.123;
  }
  const std::string page = MakeSessionReport({session, SummariseSession(session), SessionModels(),
                                              CellPictures(), SummariseSensitivity(session, data)});
  ExpectSoundPage(page);
  const std::string section = TextOfId(page, "sensitivity");
  ExpectParts(section, {"model.mass_scale=2.0", "-100.0 (", "123"});
  EXPECT_EQ(TextOfId(page, "further").find("graspbench sensitivity"), std::string::npos);
}

// Beliefs 1 and 2 mm beside the draw; 40 touches of which 39 were felt in time, 10 elsewhere.
TEST(SessionReport, ShowsWhatTheHandSawAndFelt) {
  Session session = MakeSession({"tum"}, {"can"}, "g3", 2);
  EXPECT_EQ(MakePageOf(session).find("id=\"sensors\""), std::string::npos);
  session.config.positioning = "true";
  session.config.touch = "sensed";
  for (TrialRecord& record : session.records) {
    const TrialDraw draw = MakeObjectDraw(session.config, "can", record.plan.trial);
    record.result.believed_x = draw.offset_x + 0.001 * (1 + record.plan.trial);
    record.result.believed_y = draw.offset_y;
    record.result.believed_yaw = draw.offset_yaw;
    record.result.touch = TouchRecord{20, 20 - record.plan.trial, 0, 5, 0.004, {1.0}};
  }
  SensitivityData varied;  // one of the two trials fails by camera
  varied["positioning=camera"][session.records[0].plan.id].outcome = Outcome::kSuccess;
  varied["positioning=camera"][session.records[1].plan.id].outcome = Outcome::kNotSeen;
  const std::string page =
      MakeSessionReport({session, SummariseSession(session), SessionModels(), CellPictures(),
                         SummariseSensitivity(session, varied)});
  ExpectSoundPage(page);
  const std::string text = TextOfId(page, "sensors");
  ExpectParts(text, {"Success, true", "Success, camera", "0 of 1 trial", "1.50", "2.00",
                     "39 of 40 (97.5", "10 of 50 (20.0", "Never detected"});
}

TEST(SessionReport, ShowsWhatTheCameraChose) {
  Session session = MakeSession({"tum"}, {"can"}, "by-sight", 3);
  session.config.grasps = {"by-sight"};
  for (TrialRecord& record : session.records) record.result.sight_grasp = "g3";
  session.records[1].result.sight_grasp = "g1";
  SessionModels models;
  models.hands["tum"] = std::make_shared<const Hand>(LoadHand("tum"));
  models.objects["can"] = LoadObject("can");
  const std::string page =
      MakeSessionReport({session, SummariseSession(session), models, CellPictures()});
  ExpectSoundPage(page);
  ExpectParts(TextOfId(page, "table"), {"by-sight: 2 g3, 1 g1"});
  EXPECT_EQ(TextOfId(page, "further").find("positioning=camera"), std::string::npos);
  EXPECT_NE(page.find("id=\"sensors\""), std::string::npos);
}

// GFT falls with the number of the trial, the slip grows with it.
TEST(SessionReport, ShowsWhatGoesWithSimultaneity) {
  Session session = MakeSession({"tum"}, {"can", "cup", "box", "key", "pen", "tape"}, "g3", 8);
  for (TrialRecord& record : session.records) {
    record.result.timing.gft = 0.2 - 0.01 * record.plan.trial;
    record.result.hold_slip = 0.001 * (1 + record.plan.trial);
  }
  const std::string section = TextOfId(MakePageOf(session), "simultaneity");
  ExpectParts(section, {"GFT with slip in the hold (-1.00"});
  EXPECT_EQ(section.find("GFT with sigma"), std::string::npos) << section;  // all alike
  ExpectParts(TextOfId(MakePageOf(MakeSession({"tum"}, {"can"}, "g3", 2)), "simultaneity"),
              {"too few trials of a condition that differ"});
}

// What was not run is one line at the end, each with a command, instead of empty sections.
TEST(SessionReport, NamesExperimentsThatWereNotRun) {
  const std::string page = MakePageOf(MakeSession({"tum"}, {"can"}, "g3", 2));
  ExpectParts(
      TextOfId(page, "further"),
      // ListText puts a space behind every element.
      {"Not run for this session: graspbench judge DIR  (breaking forces); graspbench "
       "threshold DIR  (grip thresholds); graspbench sensitivity DIR  (effect of unmeasured "
       "parameters); graspbench check-numerics DIR  (",
       "--set touch=sensed  (", "graspbench report DIR --3d  (interactive 3-D scenes)."});
  for (const char* id : {"quality", "thresholds", "sensitivity", "sensors", "views"}) {
    EXPECT_EQ(page.find("id=\"" + std::string(id) + "\""), std::string::npos) << id;
  }
  EXPECT_EQ(TextOfId(MakePageOf(MakeJudgedSession()), "further").find("judge"), std::string::npos);
}

TEST(SessionReport, ShowsWhatTheJudgeFound) {
  const std::string page = MakePageOf(MakeJudgedSession());
  ExpectParts(page, {"24 judged grasps", "18 of 24"});
}

}  // namespace
}  // namespace graspbench
