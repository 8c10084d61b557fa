#include "datasets/plan/map_design.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "datasets/plan/conditions.h"

namespace graspbench {
namespace {

/** The regions of a part, as often as their undelayed trials are planned: once each. */
std::vector<std::vector<size_t>> ListRegionsOf(const SessionConfig& config) {
  std::vector<Condition> undelayed = {{}};
  for (const Condition& condition : config.conditions) {
    if (ApplyCondition(condition, config).late == LateDigit::kNone) undelayed.push_back(condition);
  }
  return ListMapLevels(undelayed, config);
}

TEST(MapDesign, TwoLevelsOfTwoFactorsMeetEquallyOften) {
  for (const MapPart& part : ListMapParts(false)) {
    const auto regions = ListRegionsOf(MakeMapSession(part, SessionConfig()));
    EXPECT_EQ(regions.size(), part.varies_grip ? 28u : 16u) << part.id;
    EXPECT_EQ(std::set(regions.begin(), regions.end()).size(), regions.size()) << part.id;
    const size_t num_factors = ListMapFactors().size();
    for (size_t a = 0; a < num_factors; ++a) {
      for (size_t b = a + 1; b < num_factors; ++b) {
        std::map<std::pair<size_t, size_t>, int> counts;
        // A firm grip has no drive law: without it the fraction is whole.
        for (const auto& region : regions) {
          if (region[2] != 3) ++counts[{region[a], region[b]}];
        }
        for (const auto& [levels, count] : counts) {
          EXPECT_EQ(count, counts.begin()->second) << part.id << " " << a << " " << b;
        }
      }
    }
  }
}

// Some sixty trials of a region: 21 objects three draws each, 29 two, 79 one, one object no more
// than three.
TEST(MapDesign, MoreObjectsHaveFewerDraws) {
  const MapPart part = ListMapParts(false).front();
  SessionConfig base;
  EXPECT_EQ(MakeMapSession(part, base).trials, 3);
  for (const auto& [num_objects, trials] : {std::pair(1, 3), {29, 2}, {79, 1}, {300, 1}}) {
    base.objects.clear();
    for (int i = 0; i < num_objects; ++i) base.objects.push_back("thing" + std::to_string(i));
    EXPECT_EQ(MakeMapSession(part, base).trials, trials) << num_objects;
  }
}

TEST(MapDesign, AMapIsKnownByItsConditions) {
  SessionConfig base;
  base.hands = {"tum"};
  base.seed = 7;
  SessionConfig config = MakeMapSession(ListMapParts(true).front(), base);
  EXPECT_TRUE(IsMap(config));
  EXPECT_TRUE(IsMap(MakeMapSession(ListMapParts(false).front(), base)));
  EXPECT_FALSE(IsMap(base));
  config.conditions.pop_back();
  EXPECT_FALSE(IsMap(config));
}

}  // namespace
}  // namespace graspbench
