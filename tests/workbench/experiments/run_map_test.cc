#include "workbench/experiments/run_map.h"

#include <gtest/gtest.h>

#include "datasets/plan/map_design.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

TEST(RunMap, IsASessionThatGoesOnAndRefusesAnother) {
  const TemporaryFolder temporary;
  MapRequest request;
  request.base.hands = {"tum"};
  request.base.objects = {"golf_ball"};
  request.is_quick = true;
  request.out = temporary.path() / "map";
  Observer observer;
  const std::atomic<bool> stop = true;
  const PreparedSession map = PrepareMap(request);
  EXPECT_FALSE(RunMap(map, request, 1, observer, stop));
  EXPECT_TRUE(IsMap(LoadSession(request.out).config));
  EXPECT_EQ(PrepareMap(request).session.plan.size(), map.session.plan.size());
  request.base.objects = {"can"};
  EXPECT_THROW(PrepareMap(request), Error);
}

}  // namespace
}  // namespace graspbench
