#include "reports/scenes/scene_3d.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <limits>

#include "core/base/files/files.h"
#include "reports/page/layout.h"
#include "tests/reports/made_trial.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

std::string MakePageWith(const std::vector<TrialView>& shown) {
  TrialViews views;
  Html body;
  for (const TrialView& view : shown) body += views.Add(view);
  body += views.MakeModels();
  return AddScript(MakePage({"Views", ""}, {}, body), views.MakeScript());
}

TEST(TrialViews, SayInWordsWhatTheSceneShows) {
  const std::string page = MakePageWith({MakeTrialView()});
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  const tinyxml2::XMLElement* view = FindById(*document.RootElement(), "view");
  ASSERT_NE(view, nullptr);
  const std::string text = ListText(*view);
  // End of, time, contacts, grip, thumb, lifted by 0.1 t.
  for (const char* row :
       {"placing 0.500 0 0.00 0.00 50.0", "closure 1.000 1 2.00 2.00 100.0",
        "stabilisation 1.500 1 3.00 3.00 150.0", "lift-off 2.000 1 4.00 4.00 200.0"}) {
    std::string spaced;
    for (char c : text) {
      if (c != ' ' || spaced.empty() || spaced.back() != ' ') spaced += c;
    }
    EXPECT_NE(spaced.find(row), std::string::npos) << row << " in " << spaced.substr(0, 600);
  }
  EXPECT_STREQ(view->Attribute("data-time"), "1.5000") << "before lift-off";
  EXPECT_EQ(page, MakePageWith({MakeTrialView()})) << "same input, same bytes";
}

TEST(TrialViews, BeginWhereATrialBeganToFailWithTheContactMarked) {
  TrialView trial = MakeTrialView();
  Diagnosis diagnosis;
  diagnosis.mechanism = Mechanism::kSagged;
  diagnosis.time = 1.76;
  diagnosis.part = "TH";
  trial.traced.result.diagnosis = diagnosis;
  const auto find_view = [](const std::string& page, tinyxml2::XMLDocument& document) {
    ParsePage(page, document);
    return FindById(*document.RootElement(), "view");
  };
  tinyxml2::XMLDocument failed, early;
  const tinyxml2::XMLElement* view = find_view(MakePageWith({trial}), failed);
  EXPECT_STREQ(view->Attribute("data-time"), "1.7000") << "the last instant up to then";
  EXPECT_STREQ(view->Attribute("data-failed"), "2") << "the sliding link touches";
  EXPECT_NE(ListText(*view).find("sagged at 1.760 s"), std::string::npos);
  trial.traced.result.diagnosis->time = 0.3;
  view = find_view(MakePageWith({trial}), early);
  EXPECT_STREQ(view->Attribute("data-time"), "0.3000");
  EXPECT_STREQ(view->Attribute("data-failed"), "") << "nothing touches yet";
}

TEST(TrialViews, HaveEveryModelOnce) {
  TrialView a = MakeTrialView(), b = MakeTrialView(), c = MakeTrialView();
  b.anchor = "b";
  c.anchor = "c";
  GraspObject other = *c.object;
  other.content_hash = "another";
  c.object = std::make_shared<const GraspObject>(other);
  tinyxml2::XMLDocument document;
  ParsePage(MakePageWith({a, b, c}), document);
  const tinyxml2::XMLElement& root = *document.RootElement();
  const auto hands = ListAttribute(root, "data-hand"), objects = ListAttribute(root, "data-object");
  EXPECT_EQ(hands, (std::vector<std::string>{"model-1", "model-1", "model-1"}));
  EXPECT_EQ(objects, (std::vector<std::string>{"model-2", "model-2", "model-3"}));
  for (const char* model : {"model-1", "model-2", "model-3", "view-motion", "b-motion"}) {
    EXPECT_NE(FindById(root, model), nullptr) << model;
  }
  EXPECT_EQ(FindById(root, "model-4"), nullptr);
}

TEST(TrialViews, NamesStayText) {
  const std::string evil = "</script><img src=x onerror=\"alert(1)\">]]>";
  TrialView view = MakeTrialView();
  view.name = evil;
  Hand hand = *view.hand;
  hand.digits[0].name = hand.links[1].name = hand.joints[0].name = evil;
  view.hand = std::make_shared<const Hand>(hand);
  view.traced.result.reason = evil;
  const std::string page = MakePageWith({view});
  EXPECT_EQ(page.find("<img src=x"), std::string::npos);
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  EXPECT_EQ(FindById(*document.RootElement(), "view")->Attribute("data-label"),
            "3-D scene of " + evil);
}

TEST(TrialViews, WithoutACourseAreOneSentence) {
  TrialView none = MakeTrialView(), lost = MakeTrialView();
  none.traced.trace.clear();
  lost.anchor = "lost";
  lost.traced.trace[3].X_WO.translation().z() = std::numeric_limits<double>::quiet_NaN();
  const std::string page = MakePageWith({none, lost});
  EXPECT_EQ(page.find("scene-3d"), std::string::npos);
  EXPECT_EQ(page.find("GLTFLoader"), std::string::npos) << "no view, no script for it";
  ExpectParts(page, {"there is no motion to show", "id=\"lost\""});
}

/** The page as a browser without any network has it after its scripts ran. */
std::string OpenInBrowser(const std::filesystem::path& folder, const std::string& address) {
  const std::string command =
      "timeout 300 chromium --headless --no-sandbox --enable-unsafe-swiftshader "
      "--use-angle=swiftshader --disable-background-networking --no-first-run "
      "--host-resolver-rules='MAP * ~NOTFOUND' --virtual-time-budget=20000 --user-data-dir='" +
      (folder / "profile").string() + "' --dump-dom 'file://" + address + "' >'" +
      (folder / "dom.html").string() + "' 2>'" + (folder / "log").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << ReadFile(folder / "log");
  return ReadFile(folder / "dom.html");
}

TEST(TrialViews, OpenInABrowserFromAFileWithoutNetwork) {
  if (std::system("command -v chromium >/dev/null") != 0) GTEST_SKIP() << "no chromium here";
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("scene_3d_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  WriteFileAtomically(folder / "page.html", MakePageWith({MakeTrialView()}));
  const std::string closed = OpenInBrowser(folder, (folder / "page.html").string());
  ExpectParts(closed, {"Show in 3-D"});
  EXPECT_EQ(closed.find("<canvas"), std::string::npos);
  const std::string opened = OpenInBrowser(folder, (folder / "page.html").string() + "#view");
  ExpectParts(opened, {"class=\"scene-3d open\"", "<canvas",
                       "1.50 s, stabilisation: 1 contact, 3.00 N normal to the object"});
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace graspbench
