#pragma once
/** @file
Where an object touches the table z = 0: corners at vertices of its mesh, round parts at the lowest
point of their ball or of the circle that a rim stands for (mesh_outline.h).

A mesh that stands for a smooth surface must not roll on its vertices: each would be an impact.
Where a vertex and the vertices around it lie on a sphere and no edge there is sharper than a smooth
mesh of 16 segments has, that ball carries the object, and not the vertices. Every neighbour must
lie on it: where a flat begins, the surface bends in some directions only. What is round about one
axis (a can on its side, a coin, a cone) rolls on its rims' circles; they lie as far out as the
mesh's vertices, so it rests on them rather than on a side between them. Round in another way (an
egg on its side, a rounded edge) stays a polyhedron and rolls as one; that is not modelled.

A face presses evenly: some eight points at its outline hold the object against tipping, each for
its sector of the face, and the sector's friction acts nearer to the middle than its outline. Pulled
in towards the centre of pressure by

    f = mean distance of the face's area from its centroid / mean distance of the points

the points resist a turn about the normal as uniform pressure does (a disc: f = 2/3; on an edge:
1/2). Where only a rim touches, f is 1. */

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/pose.h"
#include "core/shape/grasp_object.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

class TableSupport {
 public:
  static constexpr int kNumDirections = 8;  ///< in which the outermost points carry

  struct Contact {
    int id = 0;                                     ///< the same for the same corner or ball
    Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< lowest point [m]
    bool is_round = false;                          ///< a ball
    bool rolls = false;                             ///< a ball or a circle
  };

  explicit TableSupport(const TriMesh& mesh);
  /** That of the object's mesh: made once for each distance field, which is as old as the mesh. */
  static std::shared_ptr<const TableSupport> Of(const GraspObject& object);

  int num_ids() const { return static_cast<int>(points_.size() + balls_.size() + circles_.size()); }
  double radius() const { return radius_; }  ///< of a ball around all of the object, about O [m]

  /** Contacts of the object at X_WO in a fixed order; empty when nothing is lower than `reach`.
  `face_factor` is f of the contacts that are not round. */
  void FindContacts(const Pose& X_WO, double reach, std::vector<Contact>& contacts,
                    double& face_factor) const;

  /** Height of the lowest point of the object [m]. */
  double CalcLowestPoint(const Pose& X_WO) const;

 private:
  struct Point {
    Eigen::Vector3d p_O;
    int ball = -1;               // index into balls_; -1: none
    int circle = -1;             // index into circles_; -1: none
    double neighbourhood = 0.0;  // distance to the farthest neighbour in the mesh [m]
  };
  struct Circle {
    Eigen::Vector3d p_OCentre, axis_O;
    double radius;
  };
  /** What is low enough to touch. */
  struct Candidate {
    int id;
    Eigen::Vector3d p_O;
    double height;  // [m]
    bool rolls;
  };
  struct Ball {
    Eigen::Vector3d p_OCentre;
    double radius;
  };
  /** A flat face that the object can stand on. */
  struct Face {
    Eigen::Vector3d normal_O;
    double offset;  // of the plane from O [m]
    double area;
    Eigen::Vector3d p_OCentroid;
    double mean_distance;  // of its area from its centroid [m]
  };

  void FindBalls(const TriMesh& mesh, const std::vector<size_t>& vertices);
  void FindCircles(const TriMesh& mesh, const std::vector<size_t>& vertices);
  void FindFaces(const TriMesh& mesh);
  /** In O; nothing for a circle that lies level. */
  static std::optional<Eigen::Vector3d> FindLowestOf(const Circle& circle,
                                                     const Eigen::Vector3d& up_O);
  /** Whether the ball of `point` carries: its lowest point lies among the point's neighbours. */
  bool IsOnBall(const Point& point, const Pose& X_WO) const;
  /** Of the candidates not higher than `most`, by index. */
  static void AddOutermost(const Eigen::Vector3d& up_O, double most,
                           const std::vector<Candidate>& candidates, std::vector<int>& chosen);
  double CalcFaceFactor(const Eigen::Vector3d& up_O, const std::vector<Candidate>& candidates,
                        const std::vector<int>& chosen) const;

  std::vector<Point> points_;
  std::vector<Ball> balls_;
  std::vector<Circle> circles_;
  std::vector<Face> faces_;
  double radius_ = 0.0;
};

}  // namespace graspbench
