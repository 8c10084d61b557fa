// The camera calibrated as a person would: pictures of a chessboard, OpenCV's own detection and
// fit.

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "core/vision/wrist_camera.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr int kColumns = 10, kRows = 7;  // squares; a corner less each way lies inside
constexpr double kSquare = 0.025;        // [m]
constexpr int kNumPictures = 15;

/** The squares whose column and row sum to an even number (parity 0) or an odd one, flat at z = 0,
around the middle, in a margin of half a square that belongs to neither. */
TriMesh MakeSquares(int parity) {
  TriMesh mesh;
  for (int i = 0; i < kColumns; ++i) {
    for (int j = 0; j < kRows; ++j) {
      if ((i + j) % 2 != parity) continue;
      const double x = (i - 0.5 * kColumns) * kSquare, y = (j - 0.5 * kRows) * kSquare;
      const int first = static_cast<int>(mesh.vertices.size());
      mesh.vertices.insert(mesh.vertices.end(), {Vector3d(x, y, 0.0), Vector3d(x + kSquare, y, 0.0),
                                                 Vector3d(x + kSquare, y + kSquare, 0.0),
                                                 Vector3d(x, y + kSquare, 0.0)});
      mesh.triangles.push_back(Eigen::Vector3i(first, first + 1, first + 2));
      mesh.triangles.push_back(Eigen::Vector3i(first, first + 2, first + 3));
    }
  }
  return mesh;
}

Scene MakeBoardScene(const Pose& X_WB) {
  Scene scene;
  scene.has_table = false;  // the background is the board's white margin
  for (const int parity : {0, 1}) {
    Drawable squares;
    squares.mesh = std::make_shared<const TriMesh>(MakeSquares(parity));
    squares.X_WM = X_WB;
    squares.colour =
        parity == 0 ? Eigen::Vector3f(0.02f, 0.02f, 0.02f) : Eigen::Vector3f(0.9f, 0.9f, 0.9f);
    scene.drawables.push_back(squares);
  }
  return scene;
}

/** Over the whole picture, tilted by 35 degrees in all directions. The camera looks down at it. */
Pose DrawBoardPose(RandomStream& random, int picture) {
  constexpr double kTilt = 0.61;
  const double turn = 2.0 * kPi * 4.0 * picture / kNumPictures;
  const double x = 0.1 * (picture % 3 - 1), y = 0.07 * (picture / 3 % 3 - 1);
  const Eigen::AngleAxisd tilt(kTilt, Vector3d(std::cos(turn), std::sin(turn), 0.0));
  const Eigen::AngleAxisd yaw(random.NextUniform(-0.3, 0.3), Vector3d::UnitZ());
  return MakePose((tilt * yaw).toRotationMatrix(), Vector3d(x, y, random.NextUniform(-0.03, 0.03)));
}

/** Of corners as the board has them, row by row. */
std::vector<cv::Point3f> ListBoardCorners() {
  std::vector<cv::Point3f> corners;
  for (int j = 0; j < kRows - 1; ++j) {
    for (int i = 0; i < kColumns - 1; ++i) {
      corners.emplace_back(static_cast<float>(i * kSquare), static_cast<float>(j * kSquare), 0.0f);
    }
  }
  return corners;
}

TEST(CalibrationTest, FifteenChessboardsGiveTheLens) {
  auto hand = std::make_shared<Hand>(LoadHand("tum"));
  hand->camera->k1 = -0.2;
  CameraConfig config;
  config.has_shadows = true;  // smooth edges, as a lens gives them
  WristCamera camera(hand, LoadObject("toy_cube"), config);
  const Lens& lens = camera.lens();
  const Pose X_WK = camera.CalcLookPose({});

  RandomStream random("calibration", "boards");
  std::vector<std::vector<cv::Point2f>> seen;
  for (int picture = 0; picture < kNumPictures; ++picture) {
    const uint64_t seed = random.NextBits();
    Image image = camera.TakePicture(MakeBoardScene(DrawBoardPose(random, picture)), X_WK, &seed);
    cv::Mat colour(image.height, image.width, CV_8UC3, image.rgb.data()), grey;
    cv::cvtColor(colour, grey, cv::COLOR_RGB2GRAY);
    std::vector<cv::Point2f> corners;
    // The older search, findChessboardCorners, takes seconds where it misses a board on white; what
    // this one finds is off where the board is tilted, so that the focal length comes out 0.5 %
    // long.
    if (!cv::findChessboardCornersSB(grey, cv::Size(kColumns - 1, kRows - 1), corners)) continue;
    cv::cornerSubPix(grey, corners, cv::Size(5, 5), cv::Size(-1, -1),
                     {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 60, 1e-4});
    seen.push_back(corners);
  }
  ASSERT_EQ(seen.size(), static_cast<size_t>(kNumPictures)) << "a board was not detected";

  const std::vector<std::vector<cv::Point3f>> boards(seen.size(), ListBoardCorners());
  cv::Mat intrinsics, distortion;
  std::vector<cv::Mat> turns, shifts;
  const double residual =
      cv::calibrateCamera(boards, seen, cv::Size(lens.width, lens.height), intrinsics, distortion,
                          turns, shifts, cv::CALIB_FIX_K3);
  const double fx = intrinsics.at<double>(0, 0), fy = intrinsics.at<double>(1, 1);
  const double cx = intrinsics.at<double>(0, 2) + 0.5, cy = intrinsics.at<double>(1, 2) + 0.5;
  RecordProperty("residual_px", std::to_string(residual));
  RecordProperty("intrinsics", cv::format("%.3f %.3f %.3f %.3f", fx, fy, cx, cy));
  EXPECT_LT(residual, 0.15);
  EXPECT_NEAR(fx / lens.focal_x, 1.0, 0.002);
  EXPECT_NEAR(fy / lens.focal_y, 1.0, 0.002);
  EXPECT_NEAR(cx, lens.centre_x, 0.002 * lens.focal_x);
  EXPECT_NEAR(cy, lens.centre_y, 0.002 * lens.focal_y);
  // k1 and k2 trade with each other; what counts is how far they move a point.
  const double k1 = distortion.at<double>(0), k2 = distortion.at<double>(1);
  RecordProperty("distortion", cv::format("%.4f %.4f", k1, k2));
  for (const double slope : {0.3, 0.45, 0.6}) {  // the picture's edge is at 0.67
    const double r2 = slope * slope;
    EXPECT_NEAR((k1 * r2 + k2 * r2 * r2) / (lens.k1 * r2), 1.0, 0.02) << slope;
  }
}

}  // namespace
}  // namespace graspbench
