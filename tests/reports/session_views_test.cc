#include "reports/session_views.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "reports/page/layout.h"
#include "tests/reports/made_trial.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

/** A cell of five trials, of which the second, fourth and last failed, two of them alike. */
class SessionViewsTest : public testing::Test {
 protected:
  SessionViewsTest() : made_(MakeTrialView()), session_(MakeSession({"box"}, {"box"}, "g1", 5)) {
    models_.hands["box"] = made_.hand;
    models_.objects["box"] = made_.object;
    SceneSnapshot snapshot;
    snapshot.q = Eigen::VectorXd::Zero(2);
    for (TrialRecord& record : session_.records) record.result.snapshots = {snapshot};
    session_.records[1].result.outcome = Outcome::kPushedAway;
    session_.records[3].result.outcome = Outcome::kNoContact;
    session_.records[4].result.outcome = Outcome::kPushedAway;
  }

  /** What the page shows, of trials that end as recorded. */
  std::string Draw(const TrialTracer& trace) {
    const SessionViews views =
        DrawSessionViews(session_, SummariseSession(session_), models_, trace);
    return AddScript(MakePage({"Session", ""}, {}, views.body), views.script);
  }
  TracedTrial Trace(const PlannedTrial& planned) const {
    TracedTrial traced = made_.traced;
    traced.result = session_.records[static_cast<size_t>(planned.trial)].result;
    return traced;
  }

  TrialView made_;
  Session session_;
  SessionModels models_;
};

TEST_F(SessionViewsTest, ShowsEveryFailureAndThenOneSuccess) {
  const std::string page = Draw([&](const PlannedTrial& planned) { return Trace(planned); });
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  const tinyxml2::XMLElement& root = *document.RootElement();
  for (const char* id : {"view-id0", "view-id1", "view-id3", "view-id4"}) {
    EXPECT_NE(FindById(root, id), nullptr) << id;
  }
  EXPECT_EQ(FindById(root, "view-id2"), nullptr) << "a second success";
  EXPECT_LT(page.find("id=\"view-id4\""), page.find("id=\"view-id0\""));
  ExpectParts(page, {"trial 1: pushed away"});
  EXPECT_EQ(page.find("Not as recorded"), std::string::npos);
}

TEST_F(SessionViewsTest, SaysWhatIsNotAsRecorded) {
  const std::string page = Draw([&](const PlannedTrial& planned) {
    TracedTrial traced = Trace(planned);
    if (planned.trial == 1) traced.result.grip_force = 1.25;
    return traced;
  });
  ExpectParts(page, {"differs from its record in grip_force_n: recorded 5.67, now 1.25"});
  EXPECT_EQ(page.find("Not as recorded"), page.rfind("Not as recorded")) << "the others are";
}

TEST_F(SessionViewsTest, SaysWhatCannotBeCarriedOut) {
  const std::string page = Draw([&](const PlannedTrial& planned) -> TracedTrial {
    if (planned.trial == 0) throw Error(ErrorKind::kNotFound, "the <box> is gone");
    return Trace(planned);
  });
  ExpectParts(page, {"the &lt;box&gt; is gone", "id=\"view-id1\""});
}

TEST_F(SessionViewsTest, OfASessionWithoutModelsThereAreNone) {
  const SessionViews views = DrawSessionViews(session_, SummariseSession(session_), {},
                                              [&](const PlannedTrial& p) { return Trace(p); });
  EXPECT_TRUE(views.body.empty());
  EXPECT_TRUE(views.script.script.empty());
}

}  // namespace
}  // namespace graspbench
