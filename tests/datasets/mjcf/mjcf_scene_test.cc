#include "datasets/mjcf/mjcf_scene.h"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <cmath>
#include <functional>
#include <iterator>
#include <sstream>

#include "datasets/mjcf/commanded_motion.h"
#include "tests/datasets/mjcf/best_grasp_setup.h"

namespace graspbench {
namespace {

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
