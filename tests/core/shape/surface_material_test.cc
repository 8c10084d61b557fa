#include "core/shape/surface_material.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/text/yaml.h"

namespace graspbench {
namespace {

std::string FindProblems(const std::string& text, SurfaceMaterial& surface) {
  Diagnostics problems;
  const FileKeys keys = ListSurfaceKeys(Needed::kNo, "");
  YamlMap map(ParseYaml(text, "surface.yaml", problems), "surface.yaml", "surface", problems,
              &keys);
  ReadSurface(map, Needed::kNo, surface);
  map.FinishKnownKeys();
  try {
    problems.ThrowIfErrors(ErrorKind::kFormat, "bad");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SurfaceMaterial, WhatIsLeftOutStaysUnset) {
  SurfaceMaterial surface;
  EXPECT_EQ(FindProblems("contact_stiffness_n_per_m: 3e4\ntorsion_radius_m: 0.002\n", surface), "");
  EXPECT_EQ(surface.stiffness, 3e4);
  EXPECT_EQ(surface.torsion_radius, 0.002);
  EXPECT_TRUE(std::isnan(surface.friction_static));
}

TEST(SurfaceMaterial, EveryProblemHasItsMessage) {
  SurfaceMaterial surface;
  const std::string message = FindProblems(
      "contact_stiffness_n_per_m: 1\nfriction_static: 0.3\nfriction_dynamic: 0.4\n"
      "torsion_radius_m: -1\nstickiness: 2\n",
      surface);
  for (const char* expected :
       {"surface.yaml:1: error: surface, contact_stiffness_n_per_m: 1 is out of range; expected "
        "100 to 10000000",
        "surface.yaml:3: error: surface, friction_dynamic: is larger than friction_static",
        "surface.yaml:4: error: surface, torsion_radius_m: -1 is out of range; expected 0 to 0.1",
        "surface.yaml:5: error: surface: unknown key \"stickiness\""}) {
    EXPECT_NE(message.find(expected), std::string::npos) << message << "\nlacks\n" << expected;
  }
  EXPECT_NE(FindProblems("friction_static: 0.3\n", surface).find("or neither"), std::string::npos);
}

}  // namespace
}  // namespace graspbench
