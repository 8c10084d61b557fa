#include "tests/workbench/experiments/pipeline_folder.h"

namespace graspbench {
namespace {

using ReplayPackSlowTest = PackFolder;

TEST_F(ReplayPackSlowTest, PeopleBesideRobots) { ExpectSameBytes("people_beside_robots"); }
TEST_F(ReplayPackSlowTest, SyntheticStudy) { ExpectSameBytes("synthetic_study"); }
TEST_F(ReplayPackSlowTest, OneObjectCampaign) { ExpectSameBytes("one_object_campaign"); }

}  // namespace
}  // namespace graspbench
