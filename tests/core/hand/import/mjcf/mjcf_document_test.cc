#include "core/hand/import/mjcf/mjcf_document.h"

#include <gtest/gtest.h>
#include <tinyxml2.h>
#include <unistd.h>

#include <algorithm>

#include "core/base/files/files.h"
#include "core/base/units.h"
#include "core/hand/import/read_foreign_urdf.h"
#include "tests/core/hand/import/small_claw.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d Turn(char axis, double degrees) {
  return Eigen::AngleAxisd(RadFromDeg(degrees), Vector3d::Unit(axis - 'x')).toRotationMatrix();
}

/** The orientation that a body's attributes give. */
Matrix3d RotationOf(const std::string& attributes, const std::string& compiler = "") {
  Diagnostics problems;
  MjcfDocument document("m.xml", ".", {}, problems);
  EXPECT_TRUE(document.Parse("<mujoco><compiler " + compiler + "/><worldbody><body " + attributes +
                             "/></worldbody></mujoco>"));
  const auto body = document.ListChildren(*document.FindSections("worldbody").front()).front();
  const Matrix3d R = document.FindRotation({body, nullptr}, "body");
  EXPECT_EQ(problems.Format(), "");
  return R;
}

TEST(MjcfDocumentTest, OrientationsAreTheirClosedForms) {
  const auto expect_near = [](const Matrix3d& R, const Matrix3d& expected) {
    EXPECT_LT((R - expected).norm(), 1e-14) << R << "\n\n" << expected;
  };
  expect_near(RotationOf(""), Matrix3d::Identity());
  expect_near(RotationOf("quat=\"1 1 0 0\""), Turn('x', 90.0));
  expect_near(RotationOf("axisangle=\"0 0 2 30\""), Turn('z', 30.0));
  expect_near(RotationOf("axisangle=\"0 0 2 0.5\"", "angle=\"radian\""),
              Turn('z', DegFromRad(0.5)));
  expect_near(RotationOf("euler=\"10 20 30\""), Turn('x', 10) * Turn('y', 20) * Turn('z', 30));
  expect_near(RotationOf("euler=\"10 20 30\"", "eulerseq=\"XYZ\""),
              Turn('z', 30) * Turn('y', 20) * Turn('x', 10));
  expect_near(RotationOf("euler=\"10 20 30\"", "eulerseq=\"zYx\""),
              Turn('y', 20) * Turn('z', 10) * Turn('x', 30));
  expect_near(RotationOf("zaxis=\"0 -3 0\""), Turn('x', 90.0));
  expect_near(RotationOf("zaxis=\"0 0 -1\""), Turn('x', 180.0));
  expect_near(RotationOf("xyaxes=\"0 2 0 -1 5 0\""), Turn('z', 90.0));
}

TEST(MjcfDocumentTest, TheNearestClassCounts) {
  Diagnostics problems;
  MjcfDocument document("m.xml", ".", {}, problems);
  ASSERT_TRUE(document.Parse(
      "<mujoco><default><geom size=\"1\" rgba=\"1 0 0 1\" quat=\"1 1 0 0\"/><motor gear=\"3\"/>"
      "<default class=\"a\"><geom size=\"2\"/><default class=\"b\"><geom euler=\"0 0 90\"/>"
      "</default></default></default><worldbody><geom class=\"b\"/><geom size=\"5\"/>"
      "<geom class=\"none\"/></worldbody><actuator><position/></actuator></mujoco>"));
  const auto geoms = document.ListChildren(*document.FindSections("worldbody").front());
  const MjcfNode of_b = document.Resolve(*geoms[0], nullptr);
  EXPECT_STREQ(document.Find(of_b, "size"), "2");
  EXPECT_STREQ(document.Find(of_b, "rgba"), "1 0 0 1");
  EXPECT_LT((document.FindRotation(of_b, "geom") - Turn('z', 90.0)).norm(), 1e-14);
  const MjcfNode plain = document.Resolve(*geoms[1], nullptr);
  EXPECT_STREQ(document.Find(plain, "size"), "5");
  EXPECT_LT((document.FindRotation(plain, "geom") - Turn('x', 90.0)).norm(), 1e-14);
  EXPECT_STREQ(document.Find(document.Resolve(*geoms[2], of_b.defaults), "size"), "2");
  const auto actuators = document.ListChildren(*document.FindSections("actuator").front());
  EXPECT_STREQ(document.Find(document.Resolve(*actuators[0], nullptr), "gear"), "3");
  EXPECT_EQ(problems.Format(),
            "m.xml:1: warning: class \"none\" does not exist; as if it were not there");
}

TEST(MjcfDocumentTest, IncludedFilesStandInTheirPlace) {
  const fs::path folder =
      fs::path(testing::TempDir()) / ("mjcf_document_" + std::to_string(::getpid()));
  MakeFolder(folder);
  WriteFile(folder / "b.xml",
            "<mujocoinclude><body name=\"b\"/><include file=\"c.xml\"/>"
            "</mujocoinclude>");
  WriteFile(folder / "c.xml", "<any>\n<body name=\"c\"/></any>");
  WriteFile(folder / "ring.xml", "<any><include file=\"ring.xml\"/></any>");
  WriteFile(folder / "broken.xml", "<any>\n<body>");
  Diagnostics problems;
  MjcfDocument document((folder / "m.xml").string(), folder, {}, problems);
  ASSERT_TRUE(
      document.Parse("<mujoco><worldbody>\n<body name=\"a\"/><include file=\"b.xml\"/>"
                     "<body name=\"d\"/></worldbody></mujoco>"));
  std::string names;
  std::vector<int> lines;
  for (auto* body : document.ListChildren(*document.FindSections("worldbody").front())) {
    names += body->Attribute("name");
    lines.push_back(document.LineOf(*body));
  }
  EXPECT_EQ(names, "abcd");
  EXPECT_EQ(lines, (std::vector<int>{2, 0, 0, 2}));
  const std::string path = folder.string();
  const std::pair<std::string, std::string> cases[] = {
      {"ring.xml", path + "/ring.xml:1: error: <include> of \"ring.xml\", which is included "
                          "already; a model includes a file once"},
      {"broken.xml", path + "/broken.xml:2: error: not valid XML (XML_ERROR_MISMATCHED_ELEMENT)"},
      {"", "m.xml:1: error: <include> without a file"}};
  for (const auto& [file, told] : cases) {
    Diagnostics own;
    MjcfDocument bad("m.xml", folder, {}, own);
    EXPECT_FALSE(bad.Parse("<mujoco><include file=\"" + file + "\"/></mujoco>"));
    EXPECT_EQ(own.Format(), told);
  }
  fs::remove_all(folder);
}

TEST(MjcfDocumentTest, BadSettingsAreRefused) {
  const std::pair<const char*, const char*> cases[] = {
      {"eulerseq=\"xyw\"",
       "m.xml:1: error: eulerseq: expected three of x, y, z, X, Y, Z, found \"xyw\""},
      {"coordinate=\"global\"",
       "m.xml:1: error: coordinate=\"global\": places in the world's frame, which MuJoCo itself "
       "gave up; load and save the model with MuJoCo before version 2.3"}};
  for (const auto& [attribute, told] : cases) {
    Diagnostics problems;
    MjcfDocument document("m.xml", ".", {}, problems);
    EXPECT_FALSE(document.Parse("<mujoco><compiler " + std::string(attribute) + "/></mujoco>"));
    EXPECT_EQ(problems.Format(), told);
  }
}

/** What weighs of the claw's ff_middle, a capsule without <inertial>, in a changed model. */
std::vector<ForeignShape> ListWeights(const std::string& old_text, const std::string& new_text,
                                      const std::string& link_name = "ff_middle") {
  Diagnostics problems;
  const ForeignHand hand = ReadForeignMjcf(ReplaceOnce(kSmallClaw, old_text, new_text), "claw.xml",
                                           "no-such-folder", problems);
  for (const ForeignLink& link : hand.links) {
    if (link.name == link_name) return link.weights;
  }
  ADD_FAILURE() << problems.Format();
  return {};
}

TEST(MjcfGeomsTest, AGeomWeighsByItsMassElseItsDensity) {
  const std::string geom = "<geom name=\"ff_middle\"";
  std::vector<ForeignShape> weights = ListWeights(geom, geom);
  ASSERT_EQ(weights.size(), 1u);
  EXPECT_EQ(weights[0].weight->density, 1000.0);  // MuJoCo's default
  EXPECT_FALSE(weights[0].weight->mass);
  weights = ListWeights(geom, geom + " mass=\"0.02\"");
  EXPECT_EQ(weights[0].weight->mass, 0.02);
  // Of a class, as all else; seen or touched or not.
  weights = ListWeights("<geom type=\"capsule\" size=\"0.008\"/>",
                        "<geom type=\"capsule\" size=\"0.008\" density=\"7800\" contype=\"0\" "
                        "conaffinity=\"0\"/>");
  ASSERT_EQ(weights.size(), 1u);
  EXPECT_EQ(weights[0].weight->density, 7800.0);
  EXPECT_TRUE(ListWeights(geom, geom + " mass=\"0\"").empty());
  EXPECT_TRUE(ListWeights(geom, geom + " density=\"0\"").empty());
}

TEST(MjcfGeomsTest, TheCompilerSaysWhichGeomsWeigh) {
  const auto with = [](const std::string& setting, const std::string& link) {
    return ListWeights("<compiler ", "<compiler " + setting + " ", link).size();
  };
  EXPECT_EQ(with("inertiafromgeom=\"auto\"", "ff_middle"), 1u);
  EXPECT_EQ(with("inertiafromgeom=\"auto\"", "palm"), 0u);  // has an <inertial>
  EXPECT_EQ(with("inertiafromgeom=\"true\"", "palm"), 1u);
  EXPECT_EQ(with("inertiafromgeom=\"false\"", "ff_middle"), 0u);
  EXPECT_EQ(with("inertiagrouprange=\"0 2\"", "ff_middle"), 0u);  // all are of group 3
  EXPECT_EQ(with("inertiagrouprange=\"3 3\"", "ff_middle"), 1u);
}

}  // namespace
}  // namespace graspbench
