#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <map>
#include <utility>

#include "core/base/error.h"
#include "core/render/display_mesh.h"
#include "core/render/gl_context.h"
#include "core/render/picture_passes.h"
#include "core/render/scene.h"
#include "core/render/shaders.h"
#include "core/render/stage.h"

namespace graspbench {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kMaxSize = 4096;         // of a picture's side [pixel]
constexpr int kDraftTriangles = 8000;  // of a scene
constexpr int kFewTriangles = 64;      // of a mesh: less would not show what it is

// Sides of the maps [texel]: finer than the picture's pixels would not be seen.
int ChooseLightMapSize(int picture_size) { return std::clamp(picture_size, 256, 1024); }
int ChooseTableLightSize(int picture_size) { return std::clamp(picture_size / 4, 64, 256); }

// Of a shadow's filter on a surface; large pictures show what few leave behind.
int ChooseTaps(int picture_size) { return picture_size > 512 ? 4 : 2; }

constexpr double kFadeShare = 0.1;   // of the picture, at each edge, for what it may cut
constexpr double kGridShare = 0.25;  // of the table's light that the lines of its grid take

// Inverse of the encoding at the end of the shaders; for values beyond its linear part.
Vector3f DecodeSrgb(const Vector3f& srgb) { return ((srgb.array() + 0.055f) / 1.055f).pow(2.4f); }

struct GpuMesh {
  std::weak_ptr<const TriMesh> source;
  GLuint vertex_array = 0;
  GLuint vertex_buffer = 0;
  GLuint index_buffer = 0;
  GLsizei num_indices = 0;
  bool is_closed = false;
  StageBox box;  // in M
};

// Texture and the framebuffer object that draws into it.
struct Target {
  GLuint texture = 0;
  GLuint framebuffer = 0;
  int width = 0;
  int height = 0;
};

// Address space that making a renderer takes: up to 500 MB for the first one, which loads Mesa with
// its compiler and starts threads with arenas of their own; 10 MB for others. Drawing takes 30 MB.
constexpr size_t kFirstMemory = 512u << 20, kFurtherMemory = 64u << 20, kDrawingMemory = 40u << 20;
// Colour and depth of a pixel, twice: Mesa copies what it draws into; pixels that are read back, in
// GL's order, in the picture's and with smooth edges; a triangle, here and as Mesa has it.
constexpr size_t kBytesOfTarget = 16, kBytesOfPixel = 18, kBytesOfTriangle = 168;

}  // namespace

struct Renderer::Impl {
  Impl(int w, int h, RenderQuality quality)
      : gl(context.functions()),
        is_fast(quality != RenderQuality::kFull),
        is_draft(quality == RenderQuality::kDraft),
        width(w),
        height(h) {
    const int size = std::max(w, h), taps = is_fast ? 0 : ChooseTaps(size);
    surface = MakeProgram(gl, MakeSurfaceShader(taps));
    table = MakeProgram(gl, MakeTableShader());
    if (is_fast) {
      MakeWhiteTableLight();
    } else {
      depth = MakeProgram(gl, MakeDepthShader());
      MakeLightMaps(size);
    }
    picture = MakePictureTarget(GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
    gl.GenVertexArrays(1, &no_vertices);
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  }

  Image Render(const Scene& scene, const StageView& view) {
    BeginPicture(scene);
    int num_triangles = 0;
    for (const Drawable& drawable : scene.drawables)
      num_triangles += drawable.mesh->num_triangles();
    const double share =
        is_draft ? static_cast<double>(kDraftTriangles) / std::max(num_triangles, 1) : 1.0;
    items.clear();
    marks.clear();
    std::vector<Vector3d> corners;  // of the meshes' boxes, in S
    for (const Drawable& drawable : scene.drawables) {
      const GpuMesh& mesh = FindOrUpload(drawable, share);
      if (mesh.num_indices == 0) continue;
      const Pose X_SM = view.X_SW * drawable.X_WM;
      const bool may_be_cut = !drawable.must_be_seen && !drawable.is_mark;
      (drawable.is_mark ? marks : items)
          .push_back({&mesh, X_SM.matrix(), drawable.colour, may_be_cut});
      if (drawable.is_mark) continue;
      for (int i = 0; i < 8; ++i) corners.push_back(X_SM * mesh.box.Corner(i));
    }
    if (corners.empty()) corners.push_back(Vector3d::Zero());
    const StageLight key = MakeStageLight(kToKey, corners);
    const StageLight sky = MakeStageLight(Vector3d::UnitZ(), corners);

    gl.Enable(GL_DEPTH_TEST);
    if (!is_fast) {
      DrawDepth(key_map, key);
      DrawDepth(sky_map, sky);
    }
    Begin(picture, surface);
    gl.ClearColor(scene.background_srgb.x(), scene.background_srgb.y(), scene.background_srgb.z(),
                  1.0f);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    if (!is_fast) BindLights(key, sky);
    surface.Set("shade", is_fast ? 0.0 : 1.0);
    DrawItems(items, view, scene);

    if (scene.has_table && view.p_SEye.z() > 0.0) {
      const Eigen::Vector4d area = FindShadowArea(corners);
      if (!is_fast) {
        FillTableLight(CalcTableLight(ReadLightMap(key_map, key), ReadLightMap(sky_map, sky), area,
                                      table_light_size));
      }
      DrawTable(view, area, scene);
    }
    DrawMarks(view, scene);
    gl.Disable(GL_DEPTH_TEST);
    return is_fast ? ReadPicture() : SmoothEdges(ReadPicture());
  }

  GeometryPicture RenderGeometry(const Scene& scene, const PinholeCamera& camera) {
    BeginPicture(scene);
    if (geometry.id == 0) {
      geometry = MakeProgram(gl, MakeGeometryShader());
      table_geometry = MakeProgram(gl, MakeTableGeometryShader());
      geometry_target = MakePictureTarget(GL_RG32F, GL_RG, GL_FLOAT);
    }
    const StageView view = MakeStageView(camera, width, height);
    Begin(geometry_target, geometry);
    gl.Enable(GL_DEPTH_TEST);
    gl.ClearColor(GeometryPicture::kNothing, 0.0f, 0.0f, 0.0f);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    for (size_t i = 0; i < scene.drawables.size(); ++i) {
      const Drawable& drawable = scene.drawables[i];
      const GpuMesh& mesh = FindOrUpload(drawable, 1.0);
      if (drawable.is_mark || mesh.num_indices == 0) continue;
      geometry.Set("clip_from_M",
                   Matrix4d(view.clip_from_S * (view.X_SW * drawable.X_WM).matrix()));
      geometry.Set("id", static_cast<double>(i));
      DrawMesh(mesh, GL_BACK);
    }
    gl.Disable(GL_CULL_FACE);
    if (scene.has_table) {
      Begin(geometry_target, table_geometry);
      table_geometry.Set("clip_from_S", view.clip_from_S);
      table_geometry.Set("id", static_cast<double>(GeometryPicture::kTable));
      gl.BindVertexArray(no_vertices);
      gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }

    const size_t num_pixels = static_cast<size_t>(width) * height;
    std::vector<float> pixels(2 * num_pixels);
    gl.ReadPixels(0, 0, width, height, GL_RG, GL_FLOAT, pixels.data());
    GeometryPicture result{width, height, std::vector<int>(num_pixels),
                           std::vector<float>(num_pixels)};
    for (int y = 0; y < height; ++y) {  // OpenGL's rows run upwards
      const float* row = &pixels[2 * static_cast<size_t>(height - 1 - y) * width];
      for (int x = 0; x < width; ++x) {
        const size_t pixel = static_cast<size_t>(y) * width + x;
        result.id[pixel] = static_cast<int>(row[2 * x]);
        result.depth[pixel] = row[2 * x + 1];
      }
    }
    return result;
  }

  GLuint MakeTexture(GLint internal_format, GLenum format, GLenum type, int w, int h,
                     GLint filter) {
    GLuint texture = 0;
    gl.GenTextures(1, &texture);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.TexImage2D(GL_TEXTURE_2D, 0, internal_format, w, h, 0, format, type, nullptr);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
  }

  Target MakeTarget(GLenum attachment, GLuint texture, int w, int h) {
    Target target = {texture, 0, w, h};
    gl.GenFramebuffers(1, &target.framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture, 0);
    const GLenum buffer = attachment == GL_DEPTH_ATTACHMENT ? GL_NONE : attachment;
    gl.DrawBuffer(buffer);
    gl.ReadBuffer(buffer);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      throw Error(ErrorKind::kEnvironment, "Mesa refuses a picture of " + std::to_string(w) +
                                               " x " + std::to_string(h) +
                                               " pixels; is memory scarce (ulimit -v)?");
    }
    return target;
  }

  void MakeLightMaps(int picture_size) {
    const auto make_light_map = [this, side = ChooseLightMapSize(picture_size)] {
      const GLuint texture = MakeTexture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT,
                                         side, side, GL_NEAREST);
      return MakeTarget(GL_DEPTH_ATTACHMENT, texture, side, side);
    };
    key_map = make_light_map();
    sky_map = make_light_map();
    gl.GenSamplers(1, &compare_sampler);
    gl.SamplerParameteri(compare_sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.SamplerParameteri(compare_sampler, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.SamplerParameteri(compare_sampler, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.SamplerParameteri(compare_sampler, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.SamplerParameteri(compare_sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.SamplerParameteri(compare_sampler, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);

    table_light_size = ChooseTableLightSize(picture_size);
    table_light =
        MakeTexture(GL_RG8, GL_RG, GL_UNSIGNED_BYTE, table_light_size, table_light_size, GL_LINEAR);
  }

  void MakeWhiteTableLight() {
    table_light_size = 1;
    table_light = MakeTexture(GL_RG8, GL_RG, GL_UNSIGNED_BYTE, 1, 1, GL_NEAREST);
    FillTableLight({255, 255});
  }

  void FillTableLight(const std::vector<uint8_t>& light) {
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);  // rows of any length
    gl.BindTexture(GL_TEXTURE_2D, table_light);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RG8, table_light_size, table_light_size, 0, GL_RG,
                  GL_UNSIGNED_BYTE, light.data());
  }

  void BeginPicture(const Scene& scene) {
    size_t num_triangles = 0;
    for (const Drawable& drawable : scene.drawables)
      num_triangles += drawable.mesh->triangles.size();
    DemandMemory(kDrawingMemory + kBytesOfTriangle * num_triangles +
                 kBytesOfPixel * static_cast<size_t>(width) * static_cast<size_t>(height));
    context.MakeCurrent();
    DropUnusedMeshes();
  }

  void DropUnusedMeshes() {
    for (auto it = meshes.begin(); it != meshes.end();) {
      if (!it->second.source.expired()) {
        ++it;
        continue;
      }
      gl.DeleteVertexArrays(1, &it->second.vertex_array);
      gl.DeleteBuffers(1, &it->second.vertex_buffer);
      gl.DeleteBuffers(1, &it->second.index_buffer);
      it = meshes.erase(it);
    }
  }

  /** @param share  of its triangles that is drawn at least. */
  const GpuMesh& FindOrUpload(const Drawable& drawable, double share) {
    const auto [it, is_new] = meshes.try_emplace({drawable.mesh.get(), drawable.crease_angle});
    GpuMesh& mesh = it->second;
    if (!is_new) return mesh;

    const int wanted =
        std::max(static_cast<int>(share * drawable.mesh->num_triangles()), kFewTriangles);
    const DisplayMesh display =
        share < 1.0 ? MakeDisplayMesh(MakeCoarseMesh(*drawable.mesh, wanted), drawable.crease_angle)
                    : MakeDisplayMesh(*drawable.mesh, drawable.crease_angle);
    mesh.source = drawable.mesh;
    mesh.num_indices = static_cast<GLsizei>(display.indices.size());
    mesh.is_closed = display.is_closed;
    for (const DisplayVertex& vertex : display.vertices)
      mesh.box.Add(vertex.position.cast<double>());
    gl.GenVertexArrays(1, &mesh.vertex_array);
    gl.BindVertexArray(mesh.vertex_array);
    gl.GenBuffers(1, &mesh.vertex_buffer);
    gl.BindBuffer(GL_ARRAY_BUFFER, mesh.vertex_buffer);
    gl.BufferData(GL_ARRAY_BUFFER, display.vertices.size() * sizeof(DisplayVertex),
                  display.vertices.data(), GL_STATIC_DRAW);
    gl.GenBuffers(1, &mesh.index_buffer);
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh.index_buffer);
    gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, display.indices.size() * sizeof(uint32_t),
                  display.indices.data(), GL_STATIC_DRAW);
    gl.EnableVertexAttribArray(0);
    gl.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(DisplayVertex), nullptr);
    gl.EnableVertexAttribArray(1);
    gl.VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(DisplayVertex),
                           reinterpret_cast<const void*>(offsetof(DisplayVertex, normal)));
    return mesh;
  }

  void Begin(const Target& target, const GlProgram& program) {
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    gl.Viewport(0, 0, target.width, target.height);
    gl.UseProgram(program.id);
  }

  void BindTexture(const GlProgram& program, const char* name, int unit, GLuint texture) {
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    gl.BindTexture(GL_TEXTURE_2D, texture);
    gl.BindSampler(unit, 0);
    program.Set(name, unit);
  }

  void BindLights(const StageLight& key, const StageLight& sky) {
    BindTexture(surface, "key_map", 0, key_map.texture);
    gl.BindSampler(0, compare_sampler);
    BindTexture(surface, "sky_map", 1, sky_map.texture);
    gl.BindSampler(1, compare_sampler);
    surface.Set("key_from_S", key.map_from_S);
    surface.Set("key_extent", key.extent);
    surface.Set("sky_from_S", sky.map_from_S);
    surface.Set("sky_extent", sky.extent);
  }

  void DrawDepth(const Target& map, const StageLight& light) {
    Begin(map, depth);
    gl.Clear(GL_DEPTH_BUFFER_BIT);
    Matrix4d clip_from_map = Matrix4d::Identity();
    clip_from_map.diagonal().head<3>().setConstant(2.0);
    clip_from_map.topRightCorner<3, 1>().setConstant(-1.0);
    for (const Item& item : items) {
      depth.Set("clip_from_M", Matrix4d(clip_from_map * light.map_from_S * item.S_from_M));
      DrawMesh(*item.mesh, GL_FRONT);  // a light map is a mirrored picture
    }
  }

  LightMap ReadLightMap(const Target& map, const StageLight& light) {
    LightMap result = {light, map.width, {}};
    result.depth.resize(static_cast<size_t>(map.width) * map.height);
    gl.BindFramebuffer(GL_FRAMEBUFFER, map.framebuffer);
    gl.ReadPixels(0, 0, map.width, map.height, GL_DEPTH_COMPONENT, GL_FLOAT, result.depth.data());
    return result;
  }

  void DrawMesh(const GpuMesh& mesh, GLenum inner_side) {
    (mesh.is_closed ? gl.Enable : gl.Disable)(GL_CULL_FACE);
    gl.CullFace(inner_side);
    gl.BindVertexArray(mesh.vertex_array);
    gl.DrawElements(GL_TRIANGLES, mesh.num_indices, GL_UNSIGNED_INT, nullptr);
  }

  struct Item {
    const GpuMesh* mesh;
    Matrix4d S_from_M;
    Vector3f colour;
    bool may_be_cut;
  };
  void DrawItems(const std::vector<Item>& drawn, const StageView& view, const Scene& scene) {
    surface.Set("clip_from_S", view.clip_from_S);
    surface.Set("p_SEye", view.p_SEye);
    surface.Set("to_key", kToKey);
    surface.Set("to_fill", kToFill);
    surface.Set("to_rim", kToRim);
    surface.Set("background_srgb", scene.background_srgb);
    surface.Set("picture_size", Vector3f(static_cast<float>(picture.width),
                                         static_cast<float>(picture.height), 0.0f));
    for (const Item& item : drawn) {
      surface.Set("fade_share", item.may_be_cut && view.fades_at_edges ? kFadeShare : 0.0);
      surface.Set("S_from_M", item.S_from_M);
      surface.Set("albedo", item.colour);
      DrawMesh(*item.mesh, GL_BACK);
    }
    gl.Disable(GL_CULL_FACE);
    gl.BindVertexArray(no_vertices);
  }

  void DrawMarks(const StageView& view, const Scene& scene) {
    if (marks.empty()) return;
    Begin(picture, surface);
    gl.Clear(GL_DEPTH_BUFFER_BIT);
    surface.Set("shade", 0.0);
    DrawItems(marks, view, scene);
  }

  void DrawTable(const StageView& view, const Eigen::Vector4d& area, const Scene& scene) {
    Begin(picture, table);
    BindTexture(table, "table_light", 0, table_light);
    table.Set("table_area", area);
    table.Set("clip_from_S", view.clip_from_S);
    table.Set("background", DecodeSrgb(scene.table_srgb));
    table.Set("grid", scene.has_grid ? kGridShare : 0.0);
    table.Set("fade_radius", 3.0 * view.half_height);
    const Pose X_WS = view.X_SW.inverse();
    table.Set("world_from_S", Eigen::Vector4d(X_WS.linear()(0, 0), X_WS.linear()(1, 0),
                                              X_WS.translation().x(), X_WS.translation().y()));
    gl.Enable(GL_POLYGON_OFFSET_FILL);  // what lies on the table stays before it
    gl.PolygonOffset(1.0f, 4.0f);
    gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    gl.Disable(GL_POLYGON_OFFSET_FILL);
  }

  /** Colours of the picture's size, with their depth. */
  Target MakePictureTarget(GLint internal_format, GLenum format, GLenum type) {
    const Target target = MakeTarget(
        GL_COLOR_ATTACHMENT0, MakeTexture(internal_format, format, type, width, height, GL_NEAREST),
        width, height);
    const GLuint depths = MakeTexture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT,
                                      width, height, GL_NEAREST);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depths, 0);
    return target;
  }

  Image ReadPicture() {
    std::vector<uint8_t> pixels(3 * static_cast<size_t>(width) * height);
    gl.ReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
    const GLenum error = gl.GetError();
    GRASPBENCH_DEMAND(error == GL_NO_ERROR, "OpenGL error " + std::to_string(error));

    Image image;
    image.width = width;
    image.height = height;
    const size_t row = 3 * static_cast<size_t>(width);
    image.rgb.reserve(pixels.size());
    for (int y = height - 1; y >= 0; --y) {  // OpenGL's rows run upwards
      image.rgb.insert(image.rgb.end(), pixels.begin() + y * row, pixels.begin() + (y + 1) * row);
    }
    return image;
  }

  GlContext context;
  const GlFunctions& gl;
  const bool is_fast;   // no shadows, edges as they come
  const bool is_draft;  // coarse meshes, too
  int width;
  int height;
  GlProgram depth, surface, table;
  GlProgram geometry, table_geometry;  // made at first use, with their target
  Target key_map, sky_map, picture, geometry_target;
  GLuint table_light = 0;  // a texture
  int table_light_size = 0;
  GLuint compare_sampler = 0;  // compares with the depth in the map; without it: the depth itself
  GLuint no_vertices = 0;
  std::map<std::pair<const TriMesh*, double>, GpuMesh> meshes;

  std::vector<Item> items, marks;  // of the picture being drawn
};

/** No shadow anywhere. */

/** What they lie on hides none of them, but they hide each other. */

/** @param area  that the texture of its light covers. */

/** Every picture begins here. */

Renderer::Renderer(int width, int height, RenderQuality quality) {
  if (width < 1 || height < 1 || width > kMaxSize || height > kMaxSize) {
    throw Error(ErrorKind::kRange, "a picture of " + std::to_string(width) + " x " +
                                       std::to_string(height) + " pixels; expected 1 to " +
                                       std::to_string(kMaxSize) + " on each side");
  }
  const auto num_pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  static std::atomic<bool> is_loaded{false};
  DemandMemory((is_loaded ? kFurtherMemory : kFirstMemory) + kBytesOfTarget * num_pixels);
  impl_ = std::make_unique<Impl>(width, height, quality);
  is_loaded = true;
}

Renderer::~Renderer() = default;

Image Renderer::Render(const Scene& scene, const Camera& camera) {
  return impl_->Render(scene,
                       MakeStageView(camera, static_cast<double>(impl_->width) / impl_->height));
}

Image Renderer::Render(const Scene& scene, const PinholeCamera& camera) {
  return impl_->Render(scene, MakeStageView(camera, impl_->width, impl_->height));
}

GeometryPicture Renderer::RenderGeometry(const Scene& scene, const PinholeCamera& camera) {
  return impl_->RenderGeometry(scene, camera);
}

}  // namespace graspbench
