#pragma once
/** @file
Off-screen rendering of a list of meshes with poses and colours through a camera into an image.

OSMesa core 3.3 is loaded at first use, and all GL functions come from its own loader. So programs
without pictures have no cost, and libGL cannot interfere. Edges are smoothed, and the shadow on the
ground is soft. The same scene gives the same bytes with the same Mesa version. */

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/pose.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

struct Drawable {
  std::shared_ptr<const TriMesh> mesh;  ///< shared, so that a hand is uploaded once
  Pose X_WM = Pose::Identity();         ///< mesh frame in the world
  Eigen::Vector3f colour = Eigen::Vector3f(0.7f, 0.7f, 0.7f);  ///< linear RGB
  double crease_angle = 0.7;  ///< edges sharper than this stay sharp [rad]
  bool is_mark = false;       ///< annotation, in front of all others, without shadow
  /** A framing camera (hand_scene.h) keeps this drawable in the picture; others may fade at its
  edge. */
  bool must_be_seen = true;
};

/** Pinhole camera that looks from `p_WEye` at `p_WTarget`. The world's z is up in the picture (if
the camera looks straight down: y). Nothing nearer than 10 mm is drawn.
@pre eye and target differ, 0 < field_of_view < pi. */
struct Camera {
  Eigen::Vector3d p_WEye = Eigen::Vector3d(0.4, -0.5, 0.35);    ///< [m]
  Eigen::Vector3d p_WTarget = Eigen::Vector3d(0.0, 0.0, 0.06);  ///< [m]
  double field_of_view = 0.6;                                   ///< vertical [rad]
};

/** A camera with any position and orientation. A point at (x, y, z) in K (x right, y down, z
forward) appears at

    u = focal_x x / z + centre_x,   v = focal_y y / z + centre_y

pixels from the picture's left and upper edge; the centre of the first pixel is at (0.5, 0.5).
Nothing nearer than 10 mm is drawn. @pre the focal lengths are positive. */
struct PinholeCamera {
  Pose X_WK = Pose::Identity();
  double focal_x = 580.0;   ///< [pixel]
  double focal_y = 580.0;   ///< [pixel]
  double centre_x = 320.0;  ///< [pixel]
  double centre_y = 240.0;  ///< [pixel]
};

inline const Eigen::Vector3f kPaper = Eigen::Vector3f(237.0f, 238.0f, 240.0f) / 255.0f;

struct Scene {
  std::vector<Drawable> drawables;
  bool has_table = true;                     ///< the plane z = 0, which receives the shadow
  bool has_grid = true;                      ///< lines on the table, 50 mm apart
  Eigen::Vector3f table_srgb = kPaper;       ///< fully lit table, encoded, 0 to 1
  Eigen::Vector3f background_srgb = kPaper;  ///< empty background, encoded, 0 to 1
};

/** 8-bit sRGB, rows from the top. */
struct Image {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgb;  ///< (height x width x 3)
};

/** Content at the centre of each pixel, rows from the top: the ground truth for detection in
pictures. */
struct GeometryPicture {
  static constexpr int kNothing = -1, kTable = -2;
  int width = 0;
  int height = 0;
  std::vector<int> id;       ///< index of the drawable (not of a mark), kTable or kNothing
  std::vector<float> depth;  ///< z in K [m]; 0: nothing
};

enum class RenderQuality {
  kFull,
  /** For cameras that take many pictures: no shadows, no smoothing of edges. */
  kFast,
  /** For display in a terminal many times per second: as kFast, and meshes are coarsened to some
  8,000 triangles in total. */
  kDraft
};

/** For a program that draws a single picture: shaders compile 0.2 s faster and run slower by a
sixth, with the same bytes. It must be called before the first Renderer is created. */
void CompileShadersQuickly();

/** Draws pictures of one size. For a Camera the lights are fixed relative to its heading: the key
light comes from the front left, high up, so shadows fall to the right and back. For a PinholeCamera
they are fixed in the world, as if it looked along y, and nothing fades at the picture's edge.

Two threads may not use it at once; each thread may have its own. Meshes are uploaded at their first
use and kept as long as they have an owner, so a filmstrip costs little more than its pixels.
@pre a mesh does not change after it was drawn. */
class Renderer {
 public:
  /** @throws Error(kEnvironment) if neither OSMesa nor EGL can be loaded, stating what to install;
  Error(kRange) for sides outside 1 to 4096 pixels. */
  Renderer(int width, int height, RenderQuality quality = RenderQuality::kFull);
  ~Renderer();
  Image Render(const Scene& scene, const Camera& camera);
  Image Render(const Scene& scene, const PinholeCamera& camera);
  /** Renders with one sample per pixel, with meshes of the same quality as in the pictures. */
  GeometryPicture RenderGeometry(const Scene& scene, const PinholeCamera& camera);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/** Encodes as PNG, lossless and without time stamps. */
std::string EncodePng(const Image& image);

/** Encodes as WebP, lossy, for pages with many pictures that are displayed at reduced size. A hand
of 480 x 360 pixels takes some 8 KB. Every current browser supports it.
@throws Error(kUnsupported) if a side exceeds 16383 pixels. */
std::string EncodeWebp(const Image& image);

/** Encodes an animated WebP file, which every current browser supports. It takes the pictures one
by one, so that a long video needs the memory of few. */
class AnimatedWebp {
 public:
  /** @throws Error(kUnsupported) if a side is outside 1 to 16383 pixels. */
  AnimatedWebp(int width, int height);
  ~AnimatedWebp();
  /** Adds a picture of the constructor's size.
  @param time  time at which its display starts [s], stored in milliseconds; later than the previous
  one. */
  void Add(const Image& image, double time);
  /** Returns the file's bytes; the animation loops forever. Can be called once.
  @param end  end of the last picture [s]. @pre at least one picture was added. */
  std::string Finish(double end);

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace graspbench
