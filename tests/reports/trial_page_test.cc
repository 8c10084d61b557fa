#include "reports/trial_page.h"

#include <gtest/gtest.h>

#include "core/shape/primitives.h"
#include "tests/reports/made_trial.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

TrialPageData MakeData() {
  Hand hand;
  hand.id = "box";
  hand.name = "Box Hand";
  hand.links.resize(1);
  hand.visuals.push_back({0, MakeRoundedBox({0.05, 0.05, 0.1}, 0.005), {0.4f, 0.4f, 0.4f}});
  GraspObject can;
  can.id = can.name = "can";
  can.mesh = MakeRoundedBox({0.06, 0.06, 0.1}, 0.005);
  TrialPageData data;
  data.setup.hand = std::make_shared<const Hand>(hand);
  data.setup.object = std::make_shared<const GraspObject>(can);
  data.record.plan = {"0123456789abcdef", "box", "can", "g3", 4};
  data.record.result.outcome = Outcome::kDroppedWhileHolding;
  data.record.result.reason = "it fell after 0.3 s";
  data.record.result.stability.sigma = 1.25;
  data.record.result.grip_force = 7.5;
  SceneSnapshot snapshot;
  snapshot.X_WH = MakePose(Eigen::Vector3d(0.0, 0.0, 0.3));
  data.record.result.snapshots = {snapshot};
  data.cards = {{"Scene", "a <b> & c\n"}};
  data.script = {"note </pre><script>alert(1)</script>", "run"};
  return data;
}

int CountElements(const tinyxml2::XMLNode& node, const std::string& name) {
  int count = 0;
  for (const auto* child = node.FirstChildElement(); child; child = child->NextSiblingElement()) {
    count += (child->Name() == name) + CountElements(*child, name);
  }
  return count;
}

TEST(TrialPage, SaysHowItEndedAndHowToGetThere) {
  const std::string page = MakeTrialPage(MakeData());
  ExpectParts(page,
              {"Box Hand, can, power (g3)", "Outcome: dropped while holding: it fell after 0.3 s.",
               "1.25", "7.50", "a &lt;b&gt; &amp; c", "note &lt;/pre&gt;&lt;script&gt;"});
  EXPECT_EQ(page, MakeTrialPage(MakeData()));
}

TEST(TrialPage, IsWellFormedWithTheScriptOfEveryPage) {
  const std::string page = MakeTrialPage(MakeData());
  ExpectSoundPage(page);
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  EXPECT_EQ(CountElements(document, "script"), 2);
  EXPECT_EQ(CountElements(document, "section"), 9);
  EXPECT_EQ(CountElements(document, "img"), 1);
}

TEST(TrialPage, IsTitledByTheTrialAndSaysWhatIsWrong) {
  TrialPageData data = MakeData();
  tinyxml2::XMLDocument sound, faulty;
  ParsePage(MakeTrialPage(data), sound);
  EXPECT_NE(
      ListText(*FindById(*sound.RootElement(), "findings")).find("No errors and no warnings."),
      std::string::npos);
  data.name = "box-can-g3:4";
  data.warnings = {"differs from its record in gct_s"};
  data.record.result.num_steps = 100;
  data.record.result.num_unconverged = 3;
  data.setup.draw.offset_x = 0.0123;
  ParsePage(MakeTrialPage(data), faulty);
  const std::string text = ListText(*faulty.RootElement());
  ExpectParts(text, {"Trial box-can-g3:4", "0123456789abcdef", "differs from its record in gct_s",
                     "In 3 of 100 steps the solver missed its tolerance.",
                     "The object was 12.3 mm and 0.0 mm off its nominal position"});
}

TEST(TrialPage, ATrialWithoutPicturesAndContactsIsAPageToo) {
  TrialPageData data = MakeData();
  data.record.result.snapshots.clear();
  data.cards.clear();
  data.script.clear();
  const std::string page = MakeTrialPage(data);
  ExpectParts(page, {"Nothing touched the object.", "before its first picture"});
}

TEST(TrialPage, ShowsTheCourseThatWasKept) {
  TrialPageData data = MakeData();
  const TrialView view = MakeTrialView();
  data.setup.hand = view.hand;
  data.setup.object = view.object;
  data.record.result.snapshots.clear();
  data.traced = view.traced;
  const std::string page = MakeTrialPage(data);
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  const tinyxml2::XMLElement* course = FindById(*document.RootElement(), "course");
  ASSERT_NE(course, nullptr);
  EXPECT_NE(FindById(*course, "view"), nullptr);
  EXPECT_NE(ListText(*course).find("three.js authors"), std::string::npos) << "its licence";
  ExpectParts(page, {"script-src 'sha256-"});
}

}  // namespace
}  // namespace graspbench
