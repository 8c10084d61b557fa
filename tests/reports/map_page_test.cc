#include <gtest/gtest.h>

#include "reports/kind_pages.h"
#include "tests/datasets/analysis/map/made_map.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

TEST(MapPage, LeadsWithWhatItFoundAndNamesTrials) {
  const Session session = MakeMapSessionResult();
  const std::string page = MakeMapPage(session, LoadMap(session));
  const size_t finding = page.find("tum: matters.");
  ASSERT_NE(finding, std::string::npos);
  EXPECT_LT(finding, page.find("Maps</h2>"));
  ExpectParts(page, {"grip margin 1.5", ":0@delay.last=0.3"});
  EXPECT_EQ(page.find("<object0>"), std::string::npos);
}

TEST(MapPage, ListsObjectsWithTrialsAndSaysHowFineItIs) {
  Session session = MakeMapSessionResult();
  session.config.objects = {"can", "scans/pear"};
  const std::string page = MakeMapPage(session, LoadMap(session));
  const size_t objects = page.find("Object by object</h2>");
  ASSERT_NE(objects, std::string::npos);
  EXPECT_NE(page.find("<code>tum-object3-", objects), std::string::npos);
  ExpectParts(page, {"has at least 150 pairs of 20 objects",
                     "2 objects: 1 of the catalogue, 1 of the folder scans"});
}

}  // namespace
}  // namespace graspbench
