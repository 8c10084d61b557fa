#include "reports/page/provenance.h"

#include <gtest/gtest.h>

#include "core/base/text/json.h"
#include "core/physics/sim_config.h"
#include "reports/page/layout.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

TEST(MakeBibtex, GivesTheWholeEntriesAskedForAndNoOthers) {
  const std::string text = MakeBibtex({"wilson1927", "holm1979"});
  EXPECT_EQ(text.rfind("@software{graspbench,", 0), 0u);
  for (const char* part : {"The graspbench developers", "year    = {20", "commit "}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  EXPECT_NE(text.find("@article{wilson1927,"), std::string::npos);
  EXPECT_NE(text.find("10.1080/01621459.1927.10502953"), std::string::npos);
  EXPECT_NE(text.find("@article{holm1979,"), std::string::npos);
  EXPECT_EQ(text.find("efron1987"), std::string::npos);
  int depth = 0;
  for (const char c : text) depth += c == '{' ? 1 : c == '}' ? -1 : 0;
  EXPECT_EQ(depth, 0);
  EXPECT_EQ(text.substr(text.size() - 3), "\n}\n");
}

TEST(DescribePhysics, NamesAnotherThanTheProgramsOwn) {
  const std::string now = std::to_string(kPhysicsVersion);
  EXPECT_EQ(DescribePhysics(kPhysicsVersion), "");
  EXPECT_EQ(DescribePhysics(8), "; simulated with physics 8, this graspbench has " + now);
  EXPECT_NE(DescribePhysics(0).find("its folder does not name"), std::string::npos);
}

TEST(MakeJsonLd, HostileTextsStayTextsAndCannotEndTheScript) {
  PageFrame frame = {"</script><b>&", "\"sub\""};
  frame.facts = {{"Seed", "<!--"}};
  const std::string text = MakeJsonLd(frame);
  for (const char c : {'<', '>', '&'}) EXPECT_EQ(text.find(c), std::string::npos) << c;
  const Json json = Json::parse(text);
  EXPECT_EQ(json.at("name"), "</script><b>&");
  EXPECT_EQ(json.at("description"), "\"sub\"");
  EXPECT_EQ(json.at("additionalProperty").back().at("value"), "<!--");
}

TEST(DrawProvenance, StandsInThePageWithCommandFactsAndReferences) {
  PageFrame frame = {"title"};
  frame.commands = {"graspbench report DIR"};
  frame.facts = {{"Seed", "17"}};
  frame.references = {"halton1960"};
  const std::string page = MakePage(frame, {}, MakeMethodsText({"We grasped."}));
  ExpectSoundPage(page);
  tinyxml2::XMLDocument document;
  ParsePage(page, document);
  const std::string text = ListText(*FindById(*document.RootElement(), "provenance"));
  for (const char* part : {"graspbench report DIR", "Seed 17", "Simbody", "@article{halton1960"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  }
}

}  // namespace
}  // namespace graspbench
