#pragma once
/** @file
Mesh assets of a MuJoCo model: files, or vertices given in the model. */

#include <map>
#include <memory>
#include <string>

#include "core/hand/import/foreign_hand.h"
#include "core/hand/import/mjcf/mjcf_document.h"

namespace graspbench {

class MjcfMeshes {
 public:
  /** @param document  must outlive this object. */
  explicit MjcfMeshes(MjcfDocument& document) : document_(document) {}

  /** Reads an asset <mesh>; one that cannot be read is reported by a warning and left out. */
  void Read(tinyxml2::XMLElement& element);
  /** Sets the mesh that a geom names in its shape. Returns false if the geom names none. An unknown
  name gives a warning and a mesh without a file, which is an error if the hand touches with it. */
  bool Place(const MjcfNode& geom, const std::string& where, ForeignShape& shape) const;

 private:
  struct Mesh {
    std::string address;
    std::shared_ptr<const TriMesh> solid;  // of a mesh without a file
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();
    Pose X_GM = Pose::Identity();  // frame of the scaled vertices in the geom's frame
  };
  std::shared_ptr<const TriMesh> ReadInline(const MjcfNode& node, const std::string& where);

  MjcfDocument& document_;
  std::map<std::string, Mesh> meshes_;
};

}  // namespace graspbench
