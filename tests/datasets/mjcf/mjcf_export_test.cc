#include "datasets/mjcf/mjcf_export.h"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <sstream>

#include "core/base/files/files.h"
#include "core/physics/implicit_world.h"
#include "core/trial/protocols/table_lift.h"
#include "tests/datasets/mjcf/best_grasp_setup.h"

namespace graspbench {

namespace {

TEST(MjcfExport, WritesTheSameBytesAgain) {
  const TrialSetup setup = MakeBestGraspSetup("tum-evolved", "toy_cube");
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "mjcf_export";
  MjcfExporter().Export(setup, folder / "a");
  MjcfExporter exporter;
  exporter.Export(setup, folder / "b");
  exporter.Export(setup, folder / "b");  // with the parts it cut before
  for (const char* file : {"scene.xml", "motion.csv"}) {
    const std::string content = ReadFile(folder / "a" / file);
    EXPECT_GT(content.size(), 1000u) << file;
    EXPECT_EQ(content, ReadFile(folder / "b" / file)) << file;
  }
}

TEST(CommandedMotion, IsThatOfTheTrial) {
  const TrialSetup setup = MakeBestGraspSetup("tum-evolved", "toy_cube");
  TableLift course(std::make_unique<ImplicitWorld>(*setup.hand, *setup.object, setup.sim), setup);
  const TrialResult result = course.Run();
  ASSERT_EQ(result.outcome, Outcome::kSuccess);
  const CommandedMotion motion = RecordMotion(setup);
  EXPECT_NEAR(setup.sim.step * static_cast<double>(motion.steps.size()), result.simulated_time,
              1e-9);
  EXPECT_EQ(motion.steps.back().command.q, course.last_command().q);
  EXPECT_EQ(motion.steps.back().phase, Phase::kHold);
}

TEST(CommandedMotion, GoesOnToTheEndOfTheHoldWhenTheObjectIsLost) {
  TrialSetup setup = MakeBestGraspSetup("tum-evolved", "toy_cube");
  setup.draw.offset_x = 0.3;  // out of reach
  TableLift course(std::make_unique<ImplicitWorld>(*setup.hand, *setup.object, setup.sim), setup);
  const TrialResult result = course.Run();
  ASSERT_EQ(result.outcome, Outcome::kNoContact);
  const CommandedMotion motion = RecordMotion(setup);
  const double rest =
      setup.sim.step * static_cast<double>(motion.steps.size()) - result.simulated_time;
  EXPECT_NEAR(rest, setup.strategy.lift_time + setup.strategy.hold_time, 2.1 * setup.sim.step);
  // From the first row to the last without a jump: no faster than the lift's course is.
  const double fastest = 1.875 * setup.grasp.approach_distance;  // minimum jerk, in one second
  for (size_t i = 1; i < motion.steps.size(); ++i) {
    const Eigen::Vector3d way =
        motion.steps[i].command.X_WH.translation() - motion.steps[i - 1].command.X_WH.translation();
    EXPECT_LE(way.norm(), 1.3 * fastest * setup.sim.step) << i;
  }
  EXPECT_NEAR(
      (motion.steps.back().command.X_WH.translation() - motion.start.X_WH.translation()).norm(),
      setup.grasp.approach_distance, 0.05);
  const std::string csv = FormatMotionCsv(*setup.hand, motion);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'),
            static_cast<std::ptrdiff_t>(motion.steps.size()) + 2);
}

using tinyxml2::XMLElement;

void ForEach(const XMLElement* element, const std::function<void(const XMLElement&)>& visit) {
  for (; element != nullptr; element = element->NextSiblingElement()) {
    visit(*element);
    ForEach(element->FirstChildElement(), visit);
  }
}

TEST(MjcfScene, HoldsTheWholeHandAndAStateOfItsSize) {
  for (const char* hand_id : {"tum-evolved", "shadow-evolved"}) {
    const TrialSetup setup = MakeBestGraspSetup(hand_id, "toy_cube");
    const CommandedMotion motion = RecordMotion(setup);
    ConvexPart part;
    part.vertices = {Eigen::Vector3d::Zero()};
    const std::vector<ConvexPart> parts = {part};
    const std::string text = FormatMjcf(setup, motion.start, parts);
    tinyxml2::XMLDocument document;
    ASSERT_EQ(document.Parse(text.c_str()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
    size_t num_sites = 0;
    for (size_t at = 0; (at = text.find("<site name=\"taxel/", at)) != text.npos; ++at) ++num_sites;
    EXPECT_EQ(num_sites, setup.hand->skin->elements.size());
    double mass = 0.0;
    int num_bodies = 0, num_joints = 0, num_drives = 0;
    std::string qpos;
    ForEach(document.RootElement(), [&](const XMLElement& element) {
      const std::string name = element.Name();
      if (name == "inertial") mass += element.DoubleAttribute("mass");
      num_bodies += name == "body";
      num_joints += name == "joint" && element.Attribute("axis") != nullptr;
      num_drives += name == "position";
      if (name == "key") qpos = element.Attribute("qpos");
    });
    double expected = setup.object->mass_properties.mass;
    int num_driven = 0;
    for (const HandLink& link : setup.hand->links) expected += link.mass;
    for (const HandJoint& joint : setup.hand->joints) num_driven += joint.coupled_to < 0;
    EXPECT_NEAR(mass, expected, 2e-6);  // with the speck that carries the hand
    EXPECT_EQ(num_bodies, static_cast<int>(setup.hand->links.size()) + 2);
    EXPECT_EQ(num_joints, setup.hand->num_joints() + 3);
    EXPECT_EQ(num_drives, num_driven + 3);
    std::istringstream numbers(qpos);
    const std::vector<double> values{std::istream_iterator<double>(numbers), {}};
    EXPECT_EQ(values.size(), static_cast<size_t>(num_joints) + 4 + 7);
  }
}

}  // namespace

}  // namespace graspbench
