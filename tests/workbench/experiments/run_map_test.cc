#include "workbench/experiments/run_map.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
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

TEST(RunMap, CopiesOfOneBodyAreRefusedBeforeAnythingIsMade) {
  const TemporaryFolder temporary;
  const std::filesystem::path ball = FindDataRoot() / "objects" / "catalogue" / "golf_ball";
  MapRequest request;
  request.base.hands = {"tum"};
  for (const char* id : {"one", "two"}) {
    std::filesystem::copy(ball, temporary.path() / id, std::filesystem::copy_options::recursive);
    request.base.objects.push_back((temporary.path() / id).string());
  }
  request.base.objects.erase(request.base.objects.begin());  // "all"
  request.out = temporary.path() / "map";
  try {
    PrepareMap(request);
    FAIL() << "copies were taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("\"one\" and \"two\" are the same body"),
              std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(request.out));
}

}  // namespace
}  // namespace graspbench
