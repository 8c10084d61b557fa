#include "core/hand/generate/hand_visuals.h"

#include <cmath>
#include <functional>
#include <vector>

#include "core/base/pose.h"
#include "core/base/units.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr int kSegments = 24;

/** An outline in a plane z = const: a superellipse about (x, y), in millimetres. */
struct Section {
  double z_mm, x_mm, y_mm, half_x_mm, half_y_mm;
};

Ring MakeRing(const Section& s, double exponent) {
  Ring ring;
  for (int i = 0; i < kSegments; ++i) {
    const double angle = 2.0 * kPi * i / kSegments;
    const double c = std::cos(angle), d = std::sin(angle);
    const Vector3d p_mm(
        s.x_mm + s.half_x_mm * std::copysign(std::pow(std::abs(c), 2.0 / exponent), c),
        s.y_mm + s.half_y_mm * std::copysign(std::pow(std::abs(d), 2.0 / exponent), d), s.z_mm);
    ring.push_back({MFromMm(p_mm.x()), MFromMm(p_mm.y()), MFromMm(p_mm.z())});
  }
  return ring;
}

/** A smooth body through sections of increasing z, with its ends rounded inwards by `round_mm`. An
`exponent` of 2 gives ellipses; larger ones approach boxes. */
TriMesh MakeBody(const std::vector<Section>& sections, double exponent, double round_mm) {
  constexpr int kArc = 4;
  std::vector<Ring> rings;
  const auto add_end = [&](const Section& end, double outward, int from, int to) {
    for (int i = from; i != to; i += from < to ? 1 : -1) {
      const double angle = 0.5 * kPi * i / kArc;
      Section s = end;
      const double inset = round_mm * (1.0 - std::cos(angle));
      s.z_mm -= outward * round_mm * (1.0 - std::sin(angle));
      s.half_x_mm -= inset;
      s.half_y_mm -= inset;
      rings.push_back(MakeRing(s, exponent));
    }
  };
  add_end(sections.front(), -1.0, kArc, -1);
  for (size_t i = 1; i + 1 < sections.size(); ++i) rings.push_back(MakeRing(sections[i], exponent));
  add_end(sections.back(), 1.0, 0, kArc + 1);
  return MakeLoft(rings);
}

TriMesh Moved(TriMesh mesh, const Pose& X) {
  for (Vector3d& p : mesh.vertices) p = X * p;
  return mesh;
}

TriMesh Joined(const std::vector<TriMesh>& parts) {
  TriMesh whole;
  for (const TriMesh& part : parts) {
    const Eigen::Vector3i offset = Eigen::Vector3i::Constant(whole.num_vertices());
    whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const Eigen::Vector3i& t : part.triangles) whole.triangles.push_back(t + offset);
  }
  return whole;
}

/** Barrel of a joint about x at z_mm, with a bolt on either side. */
TriMesh MakeBarrel(double radius_mm, double half_length_mm, double z_mm = 0.0) {
  const double r = MFromMm(radius_mm), h = MFromMm(half_length_mm), bevel = MFromMm(1.0);
  const double bolt = 0.5 * r, out = h + MFromMm(0.6);
  const TriMesh barrel = MakeRevolution({{0.0, -out},
                                         {bolt, -out},
                                         {bolt, -h},
                                         {r - bevel, -h},
                                         {r, -h + bevel},
                                         {r, h - bevel},
                                         {r - bevel, h},
                                         {bolt, h},
                                         {bolt, out},
                                         {0.0, out}},
                                        kSegments);
  return Moved(barrel, MakePose(MakeRotationRpy(0.0, 0.5 * kPi, 0.0), {0.0, 0.0, MFromMm(z_mm)}));
}

/** Bone of a phalanx from joint to joint: slimmer in the middle, offset towards the back of the
hand (+y). `r_mm` is the contact radius about the z axis. */
TriMesh MakeBone(double r_mm, double length_mm) {
  const double first = 0.16 * length_mm, last = length_mm - 0.55 * r_mm;
  return MakeBody({{first, 0.0, 0.1 * r_mm, 0.86 * r_mm, 0.86 * r_mm},
                   {0.5 * (first + last), 0.0, 0.14 * r_mm, 0.74 * r_mm, 0.76 * r_mm},
                   {last, 0.0, 0.1 * r_mm, 0.82 * r_mm, 0.82 * r_mm}},
                  3.2, 0.2 * r_mm);
}

/** Flesh on the inside (-y) of a phalanx, extending to the contact radius. */
TriMesh MakeFlesh(double r_mm, double from_mm, double to_mm) {
  const double middle = 0.5 * (from_mm + to_mm);
  return MakeBody({{from_mm, 0.0, -0.40 * r_mm, 0.78 * r_mm, 0.48 * r_mm},
                   {middle, 0.0, -0.44 * r_mm, 0.94 * r_mm, 0.58 * r_mm},
                   {to_mm, 0.0, -0.40 * r_mm, 0.78 * r_mm, 0.48 * r_mm}},
                  2.4, 0.35 * r_mm);
}

/** A fingertip: the hull of a ball A on the z axis and a smaller ball B nearer to the tip and to
the inside (-y), as the contact shapes in hand.urdf. */
struct Fingertip {
  double r_A_mm, z_A_mm;
  double r_B_mm, y_B_mm, z_B_mm;
};

constexpr Fingertip kShadowTip = {7.0, 15.0, 3.5, -3.5, 22.5};
constexpr Fingertip kShadowThumbTip = {10.0, 11.0, 4.0, -6.0, 23.5};
constexpr Fingertip kTumTip = {7.0, 9.0, 3.5, -3.5, 16.5};

TriMesh MakeFingertipFlesh(const Fingertip& tip) {
  const double r = tip.r_A_mm;
  return Joined({MakeBody({{0.35 * r, 0.0, 0.0, 0.7 * r, 0.7 * r},
                           {0.5 * (0.35 * r + tip.z_A_mm), 0.0, 0.0, 0.92 * r, 0.92 * r},
                           {tip.z_A_mm + 0.1 * r, 0.0, 0.0, 0.97 * r, 0.97 * r}},
                          2.0, 0.1 * r),
                 MakeTaperedCapsule({0.0, 0.0, MFromMm(tip.z_A_mm)}, MFromMm(r),
                                    {0.0, MFromMm(tip.y_B_mm), MFromMm(tip.z_B_mm)},
                                    MFromMm(tip.r_B_mm), 32)});
}

/** A nail on the back (+y) of a fingertip, along the line that is tangent to both balls. */
TriMesh MakeNail(const Fingertip& tip) {
  const double r = tip.r_A_mm;
  const double distance = std::hypot(tip.y_B_mm, tip.z_B_mm - tip.z_A_mm);
  const double slope =
      std::atan2(tip.y_B_mm, tip.z_B_mm - tip.z_A_mm) - std::asin((r - tip.r_B_mm) / distance);
  const double from_mm = -0.55 * r, to_mm = 0.75 * distance;
  std::vector<Section> sections;
  constexpr int kSteps = 10;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    const double end = std::pow(2.0 * t - 1.0, 4.0);
    sections.push_back({from_mm + t * (to_mm - from_mm), 0.0, r - 0.11 * r,
                        (0.66 - 0.12 * t - 0.2 * end) * r, 0.17 * r});
  }
  const Pose X = MakePose(MakeRotationRpy(-slope, 0.0, 0.0), {0.0, 0.0, MFromMm(tip.z_A_mm)});
  return Moved(MakeBody(sections, 2.4, 0.08 * r), X);
}

/** Bone and joint of a last phalanx: a cap that holds the fingertip. */
TriMesh MakeTipHolder(double r_mm, double tip_mm) {
  return MakeBody({{0.15 * r_mm, 0.0, 0.08 * r_mm, 0.86 * r_mm, 0.84 * r_mm},
                   {0.26 * tip_mm, 0.0, 0.06 * r_mm, 0.97 * r_mm, 0.92 * r_mm},
                   {0.36 * tip_mm, 0.0, 0.10 * r_mm, 0.98 * r_mm, 0.94 * r_mm}},
                  2.4, 0.12 * r_mm);
}

/** Muscles or hoses, side by side on a ring that narrows upwards. */
TriMesh MakeMuscles(int count, double ring_mm, double radius_mm, double from_mm, double to_mm) {
  std::vector<TriMesh> muscles;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * kPi * (i + 0.5) / count;
    const double x = MFromMm(ring_mm) * std::cos(angle), y = MFromMm(ring_mm) * std::sin(angle);
    muscles.push_back(MakeTaperedCapsule({x, y, MFromMm(from_mm)}, MFromMm(radius_mm),
                                         {0.8 * x, 0.8 * y, MFromMm(to_mm)},
                                         MFromMm(0.7 * radius_mm), 12));
  }
  return Joined(muscles);
}

using AddMesh = std::function<void(const std::string& name, const TriMesh& mesh)>;

void AddShadowDigits(const AddMesh& add) {
  // Fingers: contact radius 7 mm; thumb 12, 11 and 10 mm.
  add("knuckle", MakeBarrel(8.0, 8.0));
  add("joint", MakeBarrel(6.3, 6.9));
  add("proximal", MakeBone(7.4, 45.0));
  add("proximal_flesh", MakeFlesh(7.0, 9.0, 37.0));
  add("middle", MakeBone(7.2, 25.0));
  add("middle_flesh", MakeFlesh(7.0, 6.5, 20.0));
  add("distal", MakeTipHolder(7.0, 26.0));
  add("distal_flesh", MakeFingertipFlesh(kShadowTip));
  add("nail", MakeNail(kShadowTip));
  add("thbase", Joined({MakeBarrel(12.5, 11.0), MakeSphere(MFromMm(13.0), kSegments)}));
  add("thproximal", MakeBone(11.8, 38.0));
  add("thproximal_flesh", MakeFlesh(12.0, 5.0, 35.0));
  add("thhub", MakeBarrel(9.5, 10.0));
  add("thmiddle", MakeBone(10.6, 32.0));
  add("thmiddle_flesh", MakeFlesh(11.0, 8.0, 26.5));
  add("thjoint", MakeBarrel(8.8, 9.6));
  add("thdistal", MakeTipHolder(10.0, 27.5));
  add("thdistal_flesh", MakeFingertipFlesh(kShadowThumbTip));
  add("thnail", MakeNail(kShadowThumbTip));
}

void AddShadowPalm(const AddMesh& add) {
  // The palm spans x -22..42 at y = -11..11; its little edge is the metacarpal.
  add("palm", MakeBody({{0.0, 0.0, 1.0, 17.0, 11.0},
                        {12.0, 4.0, 1.5, 22.0, 10.5},
                        {40.0, 8.0, 2.0, 31.0, 9.5},
                        {70.0, 10.0, 2.0, 32.0, 9.0},
                        {92.0, 11.0, 1.5, 31.0, 7.5}},
                       3.6, 3.0));
  const TriMesh thenar = MakeBody({{6.0, 16.0, -5.0, 10.0, 4.0},
                                   {20.0, 24.0, -6.0, 16.0, 6.2},
                                   {38.0, 26.0, -6.0, 15.0, 6.0},
                                   {55.0, 23.0, -5.5, 10.0, 4.5}},
                                  2.2, 2.5);
  const TriMesh heel = MakeBody({{8.0, -4.0, -5.5, 11.0, 4.0},
                                 {28.0, -6.0, -6.0, 15.0, 5.0},
                                 {56.0, -4.0, -6.0, 15.0, 4.6},
                                 {70.0, -2.0, -5.5, 14.0, 4.0}},
                                2.4, 2.5);
  std::vector<TriMesh> flesh = {thenar, heel};
  for (const auto& [x, z] : {std::pair{33.0, 76.0}, {11.0, 80.0}, {-11.0, 76.0}}) {
    flesh.push_back(MakeBody(
        {{z - 13.0, x, -5.0, 8.0, 4.5}, {z, x, -5.5, 10.4, 5.5}, {z + 13.0, x, -4.0, 8.5, 4.0}},
        2.4, 2.5));
  }
  add("palm_flesh", Joined(flesh));
  std::vector<TriMesh> plate;
  for (const auto& [x, top] : {std::pair{33.0, 88.0}, {11.0, 92.0}, {-11.0, 88.0}}) {
    plate.push_back(MakeTaperedCapsule({MFromMm(0.4 * x + 3.0), MFromMm(8.5), MFromMm(18.0)},
                                       MFromMm(3.2), {MFromMm(x), MFromMm(6.0), MFromMm(top)},
                                       MFromMm(4.2), 16));
  }
  add("palm_plate", Joined(plate));
}

void AddShadowForearm(const AddMesh& add) {
  // Along z of a frame that is rotated to the palm's own axes in hand.urdf.
  add("lfmetacarpal", MakeBody({{-8.0, 8.0, 1.0, 6.0, 7.0},
                                {8.0, 2.0, 1.5, 10.5, 8.5},
                                {36.0, 0.0, 1.5, 11.0, 8.5},
                                {60.0, 0.0, 1.0, 9.5, 7.5}},
                               3.2, 2.5));
  add("lfmetacarpal_flesh", MakeBody({{-10.0, 8.0, -4.5, 6.0, 4.0},
                                      {6.0, 2.0, -5.5, 10.5, 5.5},
                                      {36.0, 0.0, -5.5, 10.8, 5.5},
                                      {54.0, 0.0, -4.5, 8.5, 4.5}},
                                     2.3, 2.5));
  add("wrist", Joined({MakeBarrel(13.0, 21.0, 34.0), MakeBody({{-8.0, 0.0, 0.0, 24.0, 19.0},
                                                               {10.0, 0.0, 0.0, 17.0, 15.0},
                                                               {36.0, 0.0, 0.0, 16.0, 12.0}},
                                                              3.0, 2.0)}));
  add("forearm", Joined({MakeMuscles(14, 33.0, 7.4, -130.0, -22.0),
                         MakeBody({{-136.0, 0.0, 0.0, 31.0, 31.0}, {-14.0, 0.0, 0.0, 24.0, 24.0}},
                                  2.0, 3.0)}));
  add("forearm_ring",
      Joined(
          {MakeBody({{-20.0, 0.0, 0.0, 33.0, 30.0}, {-8.0, 0.0, 0.0, 31.0, 28.0}}, 2.2, 2.0),
           MakeBody({{-146.0, 0.0, 0.0, 43.0, 43.0}, {-130.0, 0.0, 0.0, 43.0, 43.0}}, 2.0, 2.0)}));
}

void AddShadow(std::map<std::string, TriMesh>& meshes) {
  const auto add = [&](const std::string& name, const TriMesh& mesh) {
    meshes["shadow/meshes/" + name + ".obj"] = mesh;
  };
  AddShadowDigits(add);
  AddShadowPalm(add);
  AddShadowForearm(add);
}

void AddTum(std::map<std::string, TriMesh>& meshes) {
  // The finger is built like Shadow's, with its pad towards -y, and rotated to the TUM Hand's +x.
  const auto add = [&](const std::string& name, const TriMesh& mesh) {
    meshes["tum/meshes/" + name + ".obj"] =
        Moved(mesh, MakePose(MakeRotationRpy(0.0, 0.0, 0.5 * kPi), Vector3d::Zero()));
  };
  add("base",
      Joined({MakeBody({{-9.0, 0.0, 1.0, 10.5, 11.0}, {4.0, 0.0, 1.0, 10.0, 10.0}}, 5.0, 1.5),
              MakeBarrel(7.5, 11.0)}));
  const auto make_link = [](double length_mm, double r_mm) {
    return MakeBody({{5.0, 0.0, 0.3, r_mm, r_mm - 0.3},
                     {0.5 * length_mm, 0.0, 0.6, r_mm - 1.2, r_mm - 0.9},
                     {length_mm - 4.5, 0.0, 0.3, r_mm - 0.4, r_mm - 0.6}},
                    5.0, 1.0);
  };
  add("proximal", make_link(51.0, 7.0));
  add("middle", make_link(30.0, 7.0));
  add("joint", MakeBarrel(6.6, 7.6));
  add("distal", MakeBody({{3.0, 0.0, 0.6, 6.6, 6.0}, {8.5, 0.0, 2.2, 6.8, 5.2}}, 4.0, 1.0));
  add("pad", MakeFingertipFlesh(kTumTip));

  const auto add_palm = [&](const std::string& path, const TriMesh& mesh) { meshes[path] = mesh; };
  const auto plate = [](double half_x_mm, double half_y_mm, double exponent) {
    return MakeBody(
        {{-24.0, 0.0, 0.0, half_x_mm, half_y_mm}, {-1.0, 0.0, 0.0, half_x_mm, half_y_mm}}, exponent,
        3.0);
  };
  add_palm("tum/meshes/palm_plate.obj", plate(56.0, 38.0, 5.0));
  add_palm("tum-original/meshes/palm_plate.obj", plate(54.0, 54.0, 2.0));
  add_palm("tum/meshes/palm_body.obj", MakeBody({{-84.0, 0.0, 0.0, 28.0, 28.0},
                                                 {-60.0, 0.0, 0.0, 32.0, 29.0},
                                                 {-36.0, 0.0, 0.0, 44.0, 32.0},
                                                 {-22.0, 0.0, 0.0, 48.0, 33.0}},
                                                3.2, 2.0));
  add_palm(
      "tum/meshes/flange.obj",
      Joined({MakeBody({{-96.0, 0.0, 0.0, 36.0, 36.0}, {-84.0, 0.0, 0.0, 36.0, 36.0}}, 2.0, 1.5),
              MakeMuscles(9, 17.0, 4.0, -125.0, -95.0)}));
}

}  // namespace

std::map<std::string, TriMesh> MakeHandVisuals() {
  std::map<std::string, TriMesh> meshes;
  AddShadow(meshes);
  AddTum(meshes);
  return meshes;
}

}  // namespace graspbench
