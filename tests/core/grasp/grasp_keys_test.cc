#include "core/grasp/grasp_keys.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/grasp/grasp_file.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

// What the rows say of a range is what the reader keeps to. (That they are complete:
// tests/workbench/text/file_formats_test.cc.)
TEST(GraspKeysTest, TheClosureAtContactIsAShare) {
  const Hand hand = LoadHand("tum");
  try {
    ParseGraspFile("placement: {closing_at_contact: 1.5}\n", "g.yaml", {&hand});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what())
                  .find("placement, closing_at_contact: 1.5 is out of range; expected 0 to 1"),
              std::string::npos)
        << error.what();
  }
  EXPECT_NE(FindFileKey(ListHandGraspKeys(), "grasps.ID.tilt_deg"), nullptr);
}

}  // namespace
}  // namespace graspbench
