#pragma once
/** @file
What a hand feels with, and its file tactile.yaml.

A sensed surface is that part of its link's contact surface (its capsules). Each point of it belongs
to the nearest of its elements, so that there is no gap between cells. The surface is kept as points
some 0.7 mm apart, each with the area around it. Frames: L of the link; SI. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/error.h"
#include "core/base/file_keys.h"

namespace graspbench {

struct Hand;

enum class TactileResponse { kLinear, kExponential };
struct TactileResponseRow {
  TactileResponse value;
  const char* name;
};
inline constexpr TactileResponseRow kTactileResponses[] = {
    {TactileResponse::kLinear, "linear"}, {TactileResponse::kExponential, "exponential"}};

struct TactileElement {
  int link = -1;                                        ///< index into Hand::links
  Eigen::Vector3d p_LE = Eigen::Vector3d::Zero();       ///< on the surface [m]
  Eigen::Vector3d normal_L = Eigen::Vector3d::UnitX();  ///< unit, out of the hand
  double area = 0.0;                                    ///< of its cell [m^2]
};

struct SurfacePoint {
  Eigen::Vector3d p_L = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_L = Eigen::Vector3d::UnitX();  ///< unit, out of the hand
  double area = 0.0;                                    ///< around it [m^2]
  int element = -1;                                     ///< index into TactileSkin::elements
};

/** Which part of a link's surface is sensed. */
struct SensedPart {
  int link = -1;
  Eigen::Vector3d palmar = Eigen::Vector3d::Zero();  ///< zero: all round
  Eigen::Vector3d along = Eigen::Vector3d::Zero();   ///< zero: all of its length
  double from = 0.0;                                 ///< [m]
};

struct SensedSurface {
  SensedPart part;
  std::vector<SurfacePoint> points;
};

struct TactileSkin {
  TactileResponse response = TactileResponse::kExponential;
  std::vector<TactileElement> elements;
  std::vector<SensedSurface> surfaces;  ///< at most one a link
  std::string content_hash;             ///< of tactile.yaml

  const SensedSurface* FindSurface(int link) const;  ///< null: not sensed
};

/** The points of a part of a link's surface, without an element. */
std::vector<SurfacePoint> SampleSurface(const Hand& hand, const SensedPart& part);

/** Gives each point the nearest of the elements of its link, by p_LE. */
void AssignElements(const std::vector<TactileElement>& elements, SensedSurface& surface);

/** The nearest point of a link's contact surface. @pre the link has contact. */
Eigen::Vector3d ProjectOntoSurface(const Hand& hand, int link, const Eigen::Vector3d& p_L);

/** What a hand feels with, from tactile.yaml beside its hand.yaml (absent: nothing):

    response: exponential      # of each element to its force: exponential or linear
    surfaces:
      - link: ffdistal
        palmar: [0, -1, 0]     # only the side whose normal has a part along it; absent: all round
        along: [0, 0, 1]       # and only what lies beyond from_m in this direction; absent: all
        from_m: -0.001
        elements:
          - {position_m: [0, -0.007, 0.01], normal: [0, -1, 0], area_m2: 1.4e-5}

Frames: L of the link; SI. Directions need no length.

Every key of tactile.yaml, a line each. */
const FileKeys& ListTactileKeys();

/** From the text of a tactile.yaml; `file` is its name in messages. */
TactileSkin ParseTactile(const std::string& text, const std::string& file, const Hand& hand,
                         Diagnostics& problems);

}  // namespace graspbench
