#pragma once
/** @file
Off-screen pictures: a list of meshes with poses and colours, a camera, an image.

OSMesa core 3.3 is loaded at first use and every GL function is taken from its own loader, so a
program without pictures pays nothing and libGL cannot get in between. Smoothed edges, soft ground
shadow. The same scene gives the same bytes on one Mesa version. */

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
  bool is_mark = false;       ///< over all that is none, without shadow: a note on the picture
  /** A camera made for the scene (hand_scene.h) keeps it in the picture; what need not be seen fades
  away towards the picture's edge. */
  bool must_be_seen = true;
};

/** Pinhole that looks from `p_WEye` at `p_WTarget`; z of the world is up in the picture (looking
straight down: y). Nothing nearer than 10 mm is drawn.
@pre eye and target differ, 0 < field_of_view < pi. */
struct Camera {
  Eigen::Vector3d p_WEye = Eigen::Vector3d(0.4, -0.5, 0.35);    ///< [m]
  Eigen::Vector3d p_WTarget = Eigen::Vector3d(0.0, 0.0, 0.06);  ///< [m]
  double field_of_view = 0.6;                                   ///< vertical [rad]
};

/** A camera that stands somewhere, rolled as it may be. A point at (x, y, z) in K (x right, y down,
z forward) appears at

    u = focal_x x / z + centre_x,   v = focal_y y / z + centre_y

pixels from the picture's left and upper edge; the first pixel's middle is at (0.5, 0.5). Nothing
nearer than 10 mm is drawn. @pre the focal lengths are positive. */
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
  bool has_table = true;                     ///< the plane z = 0, catching the shadow
  bool has_grid = true;                      ///< its lines, 50 mm apart
  Eigen::Vector3f table_srgb = kPaper;       ///< where all light reaches it, encoded, 0 to 1
  Eigen::Vector3f background_srgb = kPaper;  ///< where there is nothing, encoded, 0 to 1
};

/** 8-bit sRGB, rows from the top. */
struct Image {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> rgb;  ///< (height x width x 3)
};

/** What each pixel's middle shows, rows from the top: the truth for what is found in pictures. */
struct GeometryPicture {
  static constexpr int kNothing = -1, kTable = -2;
  int width = 0;
  int height = 0;
  std::vector<int> id;       ///< index of the drawable (not of a mark), kTable or kNothing
  std::vector<float> depth;  ///< z in K [m]; 0: nothing
};

enum class RenderQuality {
  kFull,
  /** For a camera whose pictures are many: no shadows, edges as they come. */
  kFast,
  /** For a look into a terminal many times a second: the same, and meshes are coarsened to some
  8,000 triangles in all. */
  kDraft
};

/** For a program that draws one picture: shaders are ready 0.2 s sooner and draw slower by a sixth,
to the same bytes. Before the first Renderer, or without effect. */
void CompileShadersQuickly();

/** Draws pictures of one size. For a Camera the lights are fixed to its heading: the key light comes
from the left before the scene, high up, so shadows fall to the right and back. For a PinholeCamera
they are fixed to the world, as if it looked along y, and nothing fades at the picture's edge.

Not to be used by two threads at once; each thread may have its own. Meshes are uploaded when they
are first seen and kept as long as somebody owns them, so a filmstrip costs little more than its
pixels. @pre a mesh is not changed once it was drawn. */
class Renderer {
 public:
  /** @throws Error(kEnvironment) when neither OSMesa nor EGL can be loaded, saying what to install;
  Error(kRange) for sides outside 1 to 4096 pixels. */
  Renderer(int width, int height, RenderQuality quality = RenderQuality::kFull);
  ~Renderer();
  Image Render(const Scene& scene, const Camera& camera);
  Image Render(const Scene& scene, const PinholeCamera& camera);
  /** One sample a pixel, with the meshes of the same quality as the pictures. */
  GeometryPicture RenderGeometry(const Scene& scene, const PinholeCamera& camera);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/** PNG bytes, without time stamps: exact. */
std::string EncodePng(const Image& image);

/** WebP bytes, lossy, for pages with many pictures that are shown smaller than they are: 480 x 360
pixels of a hand take some 8 KB. Every current browser shows it.
@throws Error(kUnsupported) when the image is larger than 16383 pixels on a side. */
std::string EncodeWebp(const Image& image);

/** An animated WebP file, which every current browser shows. Takes the pictures one by one, so that
a long film needs the memory of few. */
class AnimatedWebp {
 public:
  /** @throws Error(kUnsupported) outside of 1 to 16383 pixels on a side. */
  AnimatedWebp(int width, int height);
  ~AnimatedWebp();
  /** @param time  at which it begins to be shown [s], in milliseconds when stored; later than the
  one before. @pre of the constructor's size. */
  void Add(const Image& image, double time);
  /** The file's bytes. It starts over for ever. @param end  of the last picture [s]. @pre something
  was added; to be called once. */
  std::string Finish(double end);

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace graspbench
