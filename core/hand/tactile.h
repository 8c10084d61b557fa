#pragma once
/** @file
Tactile sensors of a hand, and their file tactile.yaml.

A sensed surface is a part of its link's contact surface (its capsules). Each of its points belongs
to the nearest element, so that the cells leave no gaps. The surface is stored as points about 0.7
mm apart, each with the area around it. Frame: L of the link; SI units. */

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
  Eigen::Vector3d p_LE = Eigen::Vector3d::Zero();       ///< position on the surface [m]
  Eigen::Vector3d normal_L = Eigen::Vector3d::UnitX();  ///< unit outward normal
  double area = 0.0;                                    ///< area of its cell [m^2]
};

struct SurfacePoint {
  Eigen::Vector3d p_L = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_L = Eigen::Vector3d::UnitX();  ///< unit outward normal
  double area = 0.0;                                    ///< area around the point [m^2]
  int element = -1;                                     ///< index into TactileSkin::elements
};

/** The part of a link's surface that is sensed. */
struct SensedPart {
  int link = -1;
  Eigen::Vector3d palmar = Eigen::Vector3d::Zero();  ///< side that is sensed; zero: all sides
  Eigen::Vector3d along = Eigen::Vector3d::Zero();   ///< direction of `from`; zero: whole length
  double from = 0.0;                                 ///< least coordinate along `along` [m]
};

struct SensedSurface {
  SensedPart part;
  std::vector<SurfacePoint> points;
};

struct TactileSkin {
  TactileResponse response = TactileResponse::kExponential;
  std::vector<TactileElement> elements;
  std::vector<SensedSurface> surfaces;  ///< at most one per link
  std::string content_hash;             ///< of tactile.yaml

  const SensedSurface* FindSurface(int link) const;  ///< null: the link has no sensors
};

/** Samples a part of a link's surface; the points have no element yet. */
std::vector<SurfacePoint> SampleSurface(const Hand& hand, const SensedPart& part);

/** Assigns to each point the element of its link whose p_LE is nearest. */
void AssignElements(const std::vector<TactileElement>& elements, SensedSurface& surface);

/** Returns the nearest point of a link's contact surface. @pre the link has contact. */
Eigen::Vector3d ProjectOntoSurface(const Hand& hand, int link, const Eigen::Vector3d& p_L);

/** Tactile sensors of a hand, from tactile.yaml in the folder of its hand.yaml (absent: none):

    response: exponential      # of each element to its force: exponential or linear
    surfaces:
      - link: ffdistal
        palmar: [0, -1, 0]     # only where the normal has a component along it; absent: all sides
        along: [0, 0, 1]       # and only what lies beyond from_m in this direction; absent: all
        from_m: -0.001
        elements:
          - {position_m: [0, -0.007, 0.01], normal: [0, -1, 0], area_m2: 1.4e-5}

Frame: L of the link; SI units. Directions need not be unit vectors.

All keys of tactile.yaml. */
const FileKeys& ListTactileKeys();

/** Parses the text of a tactile.yaml; `file` names it in messages. */
TactileSkin ParseTactile(const std::string& text, const std::string& file, const Hand& hand,
                         Diagnostics& problems);

}  // namespace graspbench
