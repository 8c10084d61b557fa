#include "workbench/pictures/scene_view.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/hand/load_hand.h"
#include "core/render/hand_scene.h"
#include "core/shape/primitives.h"
#include "objects/catalogue.h"

namespace graspbench {

namespace {

std::string FindMessage(const std::vector<std::string>& words) {
  try {
    ParseSceneView(words, "help view");
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(SceneView, WordsAreViews) {
  EXPECT_EQ(ParseSceneView({}, "").name, "grasp");
  EXPECT_EQ(ParseSceneView({"TOP"}, "").elevation_deg, 90.0);
  const SceneView view = ParseSceneView({"free", "-60", "20deg", "1.5"}, "");
  EXPECT_EQ(view.azimuth_deg, -60.0);
  EXPECT_EQ(view.elevation_deg, 20.0);
  EXPECT_EQ(view.zoom, 1.5);
}

TEST(SceneView, WhatIsNoneIsRefused) {
  EXPECT_NE(FindMessage({"inside"}).find("\"inside\" is not a view"), std::string::npos);
  EXPECT_NE(FindMessage({"frunt"}).find("did you mean \"front\""), std::string::npos);
  EXPECT_NE(FindMessage({"front", "3"}).find("see: help view"), std::string::npos);
  EXPECT_NE(FindMessage({"free", "3"}).find("azimuth and elevation"), std::string::npos);
  EXPECT_NE(FindMessage({"free", "3", "4", "1", "1"}).find("azimuth and"), std::string::npos);
  EXPECT_NE(FindMessage({"free", "3", "91"}).find("from -89 to 90 deg"), std::string::npos);
  EXPECT_NE(FindMessage({"free", "nan", "1"}).find("the azimuth"), std::string::npos);
}

// The camera stands where its angles say, as seen from what it looks at; twice the zoom is half the
// way.
TEST(SceneView, TheCameraStandsWhereTheAnglesSay) {
  Scene scene;
  Drawable ball;
  ball.mesh = std::make_shared<const TriMesh>(MakeSphere(0.05));
  ball.X_WM = MakePose(Eigen::Vector3d(0.1, 0.2, 0.3));
  scene.drawables = {ball};
  const auto place = [&](const std::vector<std::string>& words) {
    return PlaceCamera(ParseSceneView(words, ""), {scene}, Hand(), {}, Pose::Identity(), nullptr,
                       1.0);
  };
  const auto find_direction = [](const Camera& camera) {
    return Eigen::Vector3d((camera.p_WEye - camera.p_WTarget).normalized());
  };
  EXPECT_LT((find_direction(place({"right"})) -
             Eigen::Vector3d(std::cos(15.0 * kPi / 180), 0.0, std::sin(15.0 * kPi / 180)))
                .norm(),
            1e-9);
  EXPECT_LT((find_direction(place({"free", "90", "0"})) - Eigen::Vector3d::UnitY()).norm(), 1e-9);
  const Camera near = place({"free", "90", "0", "2"}), far = place({"free", "90", "0"});
  EXPECT_NEAR((far.p_WEye - far.p_WTarget).norm(), 2.0 * (near.p_WEye - near.p_WTarget).norm(),
              1e-12);
}

size_t CountFrames(const std::string& webp) {
  size_t count = 0;  // chunks of the container
  for (size_t at = webp.find("ANMF"); at != webp.npos; at = webp.find("ANMF", at + 4)) ++count;
  return count;
}

TEST(SceneFilm, HasAPictureForEveryInstantAndItsMarks) {
  const auto hand = std::make_shared<const Hand>(LoadHand("tum"));
  const auto object = LoadObject("golf_ball", FieldUse::kLater);
  const auto make_film = [&](bool is_marked) {
    SceneFilm film(hand, object);
    for (int i = 0; i < 3; ++i) {
      film.Add(0.1 * i, Eigen::VectorXd::Zero(hand->num_joints()),
               MakePose(Eigen::Vector3d(0.0, 0.0, 0.3 + 0.01 * i)), Pose::Identity());
      ContactMark mark;
      mark.force_W = Eigen::Vector3d::UnitX();
      mark.mu = 0.5;
      if (is_marked) film.Mark({mark}, 0.04);
    }
    return film;
  };
  size_t told = 0;
  const auto tell = [&told](size_t num_drawn) {
    told = num_drawn;
    return true;
  };
  const std::string bytes = make_film(false).Encode(SceneView(), 64, 48, tell);
  EXPECT_EQ(told, 3u);
  EXPECT_EQ(CountFrames(bytes), 3u);
  EXPECT_NE(bytes, make_film(true).Encode(SceneView(), 64, 48, tell)) << "marks are seen";
  EXPECT_EQ(bytes, make_film(false).Encode(SceneView(), 64, 48, tell));
  EXPECT_EQ(make_film(false).Encode(SceneView(), 64, 48, [](size_t) { return false; }), "");
}

}  // namespace

}  // namespace graspbench
