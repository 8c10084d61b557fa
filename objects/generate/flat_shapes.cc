// Things with flat sides: boxes, prisms, packs. Millimetres.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/shape/repair/mesh_topology.h"
#include "objects/generate/object_shapes.h"
#include "objects/generate/shape_parts.h"

namespace graspbench {
namespace {

// A bar in a foil wrapper, along x: a body with the wrapper's flat, pressed fins at both ends.
TriMesh MakeWrappedBar(const Eigen::Vector3d& size, double fin, double shoulder, double radius) {
  constexpr int kShoulderSteps = 6;
  std::vector<Ring> rings;
  const auto add = [&](double fullness, double z) {
    const double height = 0.8 + fullness * (size.z() - 0.8);
    const double width = size.y() * (0.93 + 0.07 * fullness);
    rings.push_back(
        MakeRing(MakeRoundedRectangle(width, height, std::min(radius, 0.45 * height), 4), z));
  };
  const double half = 0.5 * size.x();
  add(0.0, -half);
  for (int i = 0; i <= kShoulderSteps; ++i) {
    const double s = static_cast<double>(i) / kShoulderSteps;
    add(std::sin(0.5 * kPi * s), -half + fin + shoulder * (1.0 - std::cos(0.5 * kPi * s)));
  }
  for (int i = kShoulderSteps; i >= 0; --i) {
    const double s = static_cast<double>(i) / kShoulderSteps;
    add(std::sin(0.5 * kPi * s), half - fin - shoulder * (1.0 - std::cos(0.5 * kPi * s)));
  }
  add(0.0, half);
  return MakeLying(MakeLoft(rings));
}

// A box with rounded vertical edges whose top is a panel of raised rectangular buttons.
class ButtonPanel {
 public:
  ButtonPanel(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y)) {
    raised_.assign(x_.size() - 1, std::vector<bool>(y_.size() - 1, false));
  }
  void Raise(int column, int row) { raised_[column][row] = true; }

  // Grid points once around the panel, counter-clockwise from above.
  Outline Boundary() const {
    Outline outline;
    for (size_t i = 0; i + 1 < x_.size(); ++i) outline.emplace_back(x_[i], y_.front());
    for (size_t j = 0; j + 1 < y_.size(); ++j) outline.emplace_back(x_.back(), y_[j]);
    for (size_t i = x_.size() - 1; i > 0; --i) outline.emplace_back(x_[i], y_.back());
    for (size_t j = y_.size() - 1; j > 0; --j) outline.emplace_back(x_.front(), y_[j]);
    return outline;
  }

  // Appends the panel's surface at height z, buttons `rise` higher, unwelded.
  void AppendTo(double z, double rise, TriMesh& mesh) const {
    const int num_columns = static_cast<int>(raised_.size());
    const int num_rows = static_cast<int>(raised_.front().size());
    const auto quad = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
      const int first = mesh.num_vertices();
      mesh.vertices.insert(mesh.vertices.end(), {a, b, c, d});
      mesh.triangles.emplace_back(first, first + 1, first + 2);
      mesh.triangles.emplace_back(first, first + 2, first + 3);
    };
    const auto height = [&](int i, int j) { return raised_[i][j] ? z + rise : z; };
    for (int i = 0; i < num_columns; ++i) {
      for (int j = 0; j < num_rows; ++j) {
        const double x0 = x_[i], x1 = x_[i + 1], y0 = y_[j], y1 = y_[j + 1], top = height(i, j);
        quad({x0, y0, top}, {x1, y0, top}, {x1, y1, top}, {x0, y1, top});
        if (const double right = i + 1 < num_columns ? height(i + 1, j) : top; right != top) {
          quad({x1, y0, top}, {x1, y0, right}, {x1, y1, right}, {x1, y1, top});
        }
        if (const double behind = j + 1 < num_rows ? height(i, j + 1) : top; behind != top) {
          quad({x1, y1, top}, {x1, y1, behind}, {x0, y1, behind}, {x0, y1, top});
        }
      }
    }
  }

 private:
  std::vector<double> x_, y_;              // grid lines
  std::vector<std::vector<bool>> raised_;  // (columns x rows)
};

}  // namespace

// A wooden cube with two slats crossed on top, held by a bolt with a round head.
TriMesh DrawToyPropeller() {
  const auto cube = [](double inset) {
    return MakeRoundedRectangle(31.0 - 2.0 * inset, 31.0 - 2.0 * inset, 1.5, 2);
  };
  const auto slat = [](double inset) {
    return MakeRoundedRectangle(91.2 - 2.0 * inset, 22.0 - 2.0 * inset, 10.9 - inset, 6);
  };
  const auto crossed = [&](double inset) { return MakeTurned(slat(inset), 0.5 * kPi); };
  const auto head = [](double diameter) { return MakeEllipse(diameter, diameter, 24); };
  return MakeStack({{cube(1.0), 0.0},
                    {cube(0.0), 1.0},
                    {cube(0.0), 31.0},
                    {slat(0.5), 31.0},
                    {slat(0.0), 31.5},
                    {slat(0.0), 36.7},
                    {slat(0.5), 37.2},
                    {crossed(0.5), 37.2},
                    {crossed(0.0), 37.7},
                    {crossed(0.0), 42.9},
                    {crossed(0.5), 43.4},
                    {head(19.0), 43.4},
                    {head(19.0), 48.0},
                    {head(16.0), 50.4},
                    {head(10.0), 51.4}});
}

TriMesh DrawToyCube() { return MakeRoundedBox({31.0, 31.0, 31.0}, 2.0, 5); }

TriMesh DrawTissuePack() { return MakeWrappedBar({107.0, 53.0, 28.0}, 3.5, 9.0, 6.0); }

TriMesh DrawChocolateBar() { return MakeWrappedBar({101.0, 32.0, 24.0}, 8.0, 5.0, 4.0); }

// A thick remote control: rows of buttons, and one wide button near the front.
TriMesh DrawRemoteControl() {
  std::vector<double> x = {-79.5, -76.0, -72.0, -64.0};
  for (int column = 0; column < 9; ++column) {
    x.push_back(-60.0 + 14.0 * column);
    x.push_back(-60.0 + 14.0 * column + 8.0);
  }
  x.insert(x.end(), {66.0, 72.0, 76.0, 79.5});
  const std::vector<double> y = {-22.0, -19.0, -16.0, -8.0, -4.0, 4.0, 8.0, 16.0, 19.0, 22.0};
  ButtonPanel panel(x, y);
  for (int column = 0; column < 9; ++column) {
    if (column == 2) continue;  // a gap between the groups
    for (int row = 2; row <= 6; ++row) {
      const bool is_wide = column == 8;
      if (row % 2 == 0 || is_wide) panel.Raise(4 + 2 * column, row);
    }
  }
  const Outline boundary = panel.Boundary();
  // A ring around the body for every point of the panel's boundary.
  const auto body = [&](double inset, double z) {
    const Outline outline = MakeRoundedRectangle(165.0 - 2.0 * inset, 50.0 - 2.0 * inset, 9.0, 8);
    Ring ring;
    for (const Eigen::Vector2d& p : boundary) {
      const double angle = std::atan2(p.y(), p.x());
      const double radius = CalcRadius(outline, angle);
      ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
    return ring;
  };
  TriMesh mesh = MakeLoft({body(4.0, 0.0), body(1.5, 1.2), body(0.0, 5.0), body(0.0, 18.0),
                           body(0.6, 18.4), body(0.6, 19.4), body(0.0, 19.8), body(0.0, 34.0),
                           body(1.0, 37.0), MakeRing(boundary, 38.2)});
  // The loft's flat lid makes room for the panel.
  mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(),
                                      [&](const Eigen::Vector3i& t) {
                                        return mesh.vertices[t[0]].z() > 38.1 &&
                                               mesh.vertices[t[1]].z() > 38.1 &&
                                               mesh.vertices[t[2]].z() > 38.1;
                                      }),
                       mesh.triangles.end());
  panel.AppendTo(38.2, 1.8, mesh);
  return WeldVertices(mesh, 1e-6);
}

// The sleeve, with the drawer seen a little inside both ends.
TriMesh DrawMatchbox() {
  const auto outline = [](double inset) {
    return MakeRoundedRectangle(37.0 - 2.0 * inset, 13.5 - 2.0 * inset, std::max(0.1, 0.5 - inset),
                                2);
  };
  std::vector<Ring> rings;
  for (const auto& [inset, z] : std::vector<std::pair<double, double>>{{0.9, -24.8},
                                                                       {0.9, -25.9},
                                                                       {0.1, -26.0},
                                                                       {0.0, -25.8},
                                                                       {0.0, 25.8},
                                                                       {0.1, 26.0},
                                                                       {0.9, 25.9},
                                                                       {0.9, 24.8}}) {
    rings.push_back(MakeRing(outline(inset), z));
  }
  return MakeLying(MakeLoft(rings));
}

// Ten legs folded flat on each other, their ends staggered, a groove between each two.
TriMesh DrawFoldingRule() {
  constexpr int kLegs = 10;
  constexpr double kLeg = 3.9;
  std::vector<Layer> layers;
  for (int leg = 0; leg < kLegs; ++leg) {
    const auto add = [&](double inset, double z) {
      Outline outline = MakeRoundedRectangle(232.0 - 2.0 * inset, 16.4 - 2.0 * inset, 6.0, 4);
      for (Eigen::Vector2d& p : outline) p.x() += leg % 2 == 0 ? -1.5 : 1.5;
      layers.push_back({outline, kLeg * leg + z});
    };
    add(0.5, 0.0);
    add(0.0, 0.4);
    add(0.0, kLeg - 0.4);
    add(0.5, kLeg);
  }
  return MakeStack(layers);
}

// Blade at -x; a six-sided handle with a collar and a domed end.
TriMesh DrawVoltageTester() {
  std::vector<Ring> rings;
  const auto blade = [&](double width, double height, double z) {
    rings.push_back(MakeRing(MakeRoundedRectangle(width, height, 0.45 * height, 5), z));
  };
  const auto handle = [&](double size, double z) {
    // A hexagon with rounded corners and as many points as the blade.
    const Outline hexagon =
        MakeEllipse(size * 17.5 / 15.0, size * 15.0 / 15.0 * 2.0 / std::sqrt(3.0), 6);
    const Outline limit = MakeEllipse(size * 17.2 / 15.0, size * 17.2 / 15.0, 48);
    Outline outline;
    for (const Eigen::Vector2d& p : MakeEllipse(1.0, 1.0, 24)) {
      const double angle = std::atan2(p.y(), p.x());
      outline.push_back(std::min(CalcRadius(hexagon, angle), CalcRadius(limit, angle)) *
                        Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    rings.push_back(MakeRing(outline, z));
  };
  blade(3.4, 0.7, 0.0);
  blade(3.6, 1.6, 7.0);
  blade(3.4, 3.0, 14.0);
  blade(3.4, 3.2, 55.0);
  handle(6.5, 56.0);
  handle(9.0, 60.0);
  handle(13.5, 62.0);
  handle(13.5, 64.0);
  handle(11.0, 66.0);
  handle(11.0, 68.0);
  handle(15.0, 72.0);
  handle(15.0, 128.0);
  handle(13.0, 131.0);
  handle(9.5, 132.0);
  handle(9.0, 138.0);
  handle(7.0, 139.3);
  return MakeLying(MakeLoft(rings));
}

// Standing on its narrow side, a paper sleeve around two thirds of it.
TriMesh DrawEraser() {
  std::vector<Ring> rings;
  const auto add = [&](double inset, double radius, double z) {
    rings.push_back(
        MakeRing(MakeRoundedRectangle(10.3 - 2.0 * inset, 24.2 - 2.0 * inset, radius, 3), z));
  };
  // A rounded end: the edge falls back by a quarter circle of 1 mm.
  for (const double angle_deg : {0.0, 30.0, 60.0, 90.0}) {
    const double back = 1.0 - std::sin(RadFromDeg(angle_deg));
    add(0.4 + back, 1.5 - back, 1.0 - std::cos(RadFromDeg(angle_deg)));
  }
  add(0.4, 1.5, 15.0);
  add(0.0, 1.0, 15.0);
  add(0.0, 1.0, 47.0);
  add(0.4, 1.5, 47.0);
  for (const double angle_deg : {90.0, 60.0, 30.0, 0.0}) {
    const double back = 1.0 - std::sin(RadFromDeg(angle_deg));
    add(0.4 + back, 1.5 - back, 48.0 + std::cos(RadFromDeg(angle_deg)));
  }
  return MakeLying(MakeLoft(rings));
}

// Five keys on one pin through their bows, fanned a little; bows of three shapes, the notched edges
// to alternate sides, rounded edges so that each key shows.
TriMesh DrawBunchOfKeys() {
  struct Key {
    double turn_deg, length;
    bool is_flipped;
    int bow_corners;
  };
  constexpr Key kKeys[] = {{7.0, 57.0, false, 16},
                           {-9.0, 54.0, true, 6},
                           {2.0, 57.5, false, 8},
                           {-5.0, 50.0, false, 16},
                           {10.0, 52.0, true, 6}};
  constexpr double kThickness = 3.4;
  constexpr double kChamfer = 0.5;
  // About the middle of the bow: the bow's far side, then the blade with its notches.
  const auto draw = [](const Key& key, double inset) {
    const double bow_radius = 12.0 - inset;
    const double half_blade = 3.6 - inset;
    const double tip = key.length - inset;
    Outline outline;
    for (const Eigen::Vector2d& p :
         MakeEllipse(2.0 * bow_radius, 2.0 * bow_radius, key.bow_corners)) {
      if (std::abs(std::atan2(p.y(), p.x())) > RadFromDeg(20.0)) outline.push_back(p);
    }
    std::sort(outline.begin(), outline.end(), [](const auto& a, const auto& b) {
      const auto turn = [](const Eigen::Vector2d& p) {
        const double angle = std::atan2(p.y(), p.x());
        return angle < 0.0 ? angle + 2.0 * kPi : angle;
      };
      return turn(a) < turn(b);
    });
    outline.emplace_back(14.0, -half_blade);
    outline.emplace_back(tip - 3.0, -half_blade);
    outline.emplace_back(tip, -0.6);
    outline.emplace_back(tip - 2.0, 2.0 - inset);
    for (double x = key.length - 4.0; x > 26.0; x -= 7.0) {
      outline.emplace_back(x, half_blade);
      outline.emplace_back(x - 2.5, half_blade - 1.7);
      outline.emplace_back(x - 4.5, half_blade);
    }
    outline.emplace_back(16.0, half_blade);
    if (key.is_flipped) {
      for (Eigen::Vector2d& p : outline) p.y() = -p.y();
      std::reverse(outline.begin(), outline.end());
    }
    return MakeTurned(outline, RadFromDeg(key.turn_deg));
  };
  std::vector<Layer> layers;
  double z = 0.0;
  for (const Key& key : kKeys) {
    layers.push_back({draw(key, kChamfer), z});
    layers.push_back({draw(key, 0.0), z + kChamfer});
    layers.push_back({draw(key, 0.0), z + kThickness - kChamfer});
    layers.push_back({draw(key, kChamfer), z + kThickness});
    z += kThickness;
  }
  return MakeStack(layers);
}

// Six sides, sharpened at -x, flat at the other end.
TriMesh DrawPencil() {
  constexpr int kPoints = 24;
  constexpr double kHalf = 3.8;
  const Outline hexagon = MakeEllipse(2.0 * kHalf, 2.0 * kHalf, 6);
  std::vector<Ring> rings;
  // Inside the cone the section is round, outside it is the hexagon: their intersection.
  const auto add = [&](double cone_radius, double z) {
    Outline outline;
    for (int i = 0; i < kPoints; ++i) {
      const double angle = 2.0 * kPi * i / kPoints;
      outline.push_back(std::min(CalcRadius(hexagon, angle), cone_radius) *
                        Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    rings.push_back(MakeRing(outline, z));
  };
  constexpr double kConeLength = 19.0;
  add(0.3, 0.0);
  add(1.0, 3.5);
  add(1.15, 3.5);
  for (const double radius : {2.2, 3.2, 3.3, 3.4, 3.5, 3.6, 3.7, 3.8}) {
    add(radius, kConeLength * radius / kHalf);
  }
  add(kHalf, 175.0);
  return MakeLying(MakeLoft(rings));
}

}  // namespace graspbench
