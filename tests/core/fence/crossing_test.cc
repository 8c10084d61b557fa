#include "core/fence/crossing.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/pose.h"

namespace graspbench {

enum class Shade : uint8_t { kLight, kDark };
template <>
inline constexpr int kNumValues<Shade> = 2;

struct Lamp {
  std::string name;
  std::vector<Shade> shades;
  std::optional<bool> is_on;
  std::map<std::string, std::vector<float>> curves;
  std::vector<std::pair<std::string, double>> places;
  Pose X_WL = Pose::Identity();
  std::vector<Eigen::Vector3d> corners;
};
template <class Values>
void CrossMembers(Values& values, Lamp& lamp) {
  Cross(values, lamp.name, lamp.shades, lamp.is_on, lamp.curves, lamp.places, lamp.X_WL,
        lamp.corners);
}

namespace {

std::string Send(Lamp lamp) {
  OutgoingValues values;
  Cross(values, lamp);
  return values.bytes();
}

Lamp MakeLamp() {
  Lamp lamp;
  lamp.name = std::string("a\0b\xff", 4);
  lamp.shades = {Shade::kDark, Shade::kLight};
  lamp.is_on = false;
  lamp.curves["x"] = {1.5F, std::numeric_limits<float>::quiet_NaN()};
  lamp.places = {{"here", 0.1}, {"", -0.0}};
  lamp.X_WL.translation() = Eigen::Vector3d(1, 2, 3);
  lamp.corners = {{1, 2, 3}, {4, 5, 6}};
  return lamp;
}

TEST(CrossingTest, WhatArrivesIsWhatLeft) {
  const std::string sent = Send(MakeLamp());
  IncomingValues values(sent);
  Lamp lamp;
  Cross(values, lamp);
  EXPECT_EQ(Send(lamp), sent);
  EXPECT_EQ(lamp.name, MakeLamp().name);
  EXPECT_EQ(lamp.is_on, false);
  EXPECT_EQ(lamp.curves.at("x")[0], 1.5F);
  EXPECT_EQ(lamp.X_WL.translation().z(), 3.0);
  EXPECT_EQ(lamp.corners[1], Eigen::Vector3d(4, 5, 6));
}

TEST(CrossingTest, NothingThatDoesNotFitIsBelieved) {
  const std::string sent = Send(MakeLamp());
  for (size_t size = 0; size < sent.size(); ++size) {
    IncomingValues values(std::string_view(sent).substr(0, size));
    Lamp lamp;
    EXPECT_THROW(Cross(values, lamp), Error) << size;
  }
  std::string shade = sent;
  shade[8 + 4 + 8] = 2;  // behind the name and the count
  IncomingValues values(shade);
  Lamp lamp;
  EXPECT_THROW(Cross(values, lamp), Error);
}

}  // namespace
}  // namespace graspbench
