#include "workbench/tables/map_tables.h"

#include <gtest/gtest.h>

#include "tests/datasets/analysis/map/made_map.h"

namespace graspbench {
namespace {

TEST(MapTables, BeginWithTheFindingAndListEveryLevel) {
  const std::string text = FormatMap(LoadMap(MakeMapSessionResult()));
  EXPECT_EQ(text.rfind("tum: matters.", 0), 0u) << text;
  for (const MapFactorRow& factor : ListMapFactors()) {
    for (const MapLevelRow& level : factor.levels) {
      EXPECT_NE(text.find(factor.name + " " + level.name), std::string::npos) << level.name;
    }
  }
}

}  // namespace
}  // namespace graspbench
