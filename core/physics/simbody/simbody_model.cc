#include "core/physics/simbody/simbody_model.h"

#include "core/physics/simbody/simtk_conversions.h"

namespace graspbench {
struct SimbodyModel::Impl {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  std::vector<SimTK::MobilizedBody> links;
  SimTK::MobilizedBody::Free root;
  SimTK::MobilizedBody::Free object;
  std::vector<int> link_of_joint;
  Pose X_HR = Pose::Identity();                      ///< root link in H
  Eigen::Vector3d p_HR_W = Eigen::Vector3d::Zero();  ///< root's origin relative to H's, in W
  Eigen::Vector3d w_WH = Eigen::Vector3d::Zero();
  SimTK::State state;

  /** Returns Simbody's index of each of our speeds. */
  std::vector<int> FindSpeedIndices() const {
    std::vector<int> indices;
    for (int link : link_of_joint) indices.push_back(links[link].getFirstUIndex(state));
    for (int i = 0; i < 6; ++i) indices.push_back(root.getFirstUIndex(state) + i);
    for (int i = 0; i < 6; ++i) indices.push_back(object.getFirstUIndex(state) + i);
    return indices;
  }
  /** Maps our speeds to Simbody's, in our order: its root's origin differs from H's. */
  Eigen::MatrixXd MakeSpeedMap() const {
    const auto num_joints = static_cast<Eigen::Index>(link_of_joint.size());
    Eigen::MatrixXd T = Eigen::MatrixXd::Identity(num_joints + 12, num_joints + 12);
    for (int k = 0; k < 3; ++k) {
      T.block<3, 1>(num_joints + 3, num_joints + k) =
          Eigen::Vector3d(Eigen::Vector3d::Unit(k)).cross(p_HR_W);
    }
    return T;
  }
  /** Returns the weight of every body. */
  SimTK::Vector_<SimTK::SpatialVec> MakeWeights(const Eigen::Vector3d& gravity_W) const {
    SimTK::Vector_<SimTK::SpatialVec> forces(matter.getNumBodies(),
                                             SimTK::SpatialVec(SimTK::Vec3(0)));
    for (SimTK::MobilizedBodyIndex b(1); b < matter.getNumBodies(); ++b) {
      const SimTK::MobilizedBody& body = matter.getMobilizedBody(b);
      const SimTK::MassProperties& mass = body.getBodyMassProperties(state);
      body.applyForceToBodyPoint(state, mass.getMassCenter(),
                                 ToSimTK(Eigen::Vector3d(mass.getMass() * gravity_W)), forces);
    }
    return forces;
  }
};

SimbodyModel::SimbodyModel(const Hand& hand, const MassProperties& object,
                           std::optional<DistalMode> coupled)
    : impl_(std::make_unique<Impl>()) {
  Impl& model = *impl_;
  for (const HandLink& link : hand.links) {
    const SimTK::Body::Rigid body(MakeMassProperties(link.mass, link.p_LLcm, link.I_LLcm));
    if (link.parent < 0) {
      model.X_HR = link.X_PJ;
      model.root = SimTK::MobilizedBody::Free(model.matter.updGround(), SimTK::Transform(), body,
                                              SimTK::Transform());
      model.links.push_back(model.root);
    } else {
      model.links.push_back(AddLink(hand, link, model.links[link.parent], body));
    }
  }
  for (const HandJoint& joint : hand.joints) model.link_of_joint.push_back(joint.link);
  model.object = SimTK::MobilizedBody::Free(
      model.matter.updGround(), SimTK::Transform(),
      SimTK::Body::Rigid(MakeMassProperties(object.mass, Eigen::Vector3d::Zero(), object.I_OOcm)),
      SimTK::Transform());
  for (const HandJoint& joint : hand.joints) {
    if (joint.coupled_to < 0 || !coupled) continue;
    // The ratio of the joints' rates is fixed: rate_distal q_middle - rate_middle q_distal =
    // constant.
    const DistalRates rates =
        joint.is_mimic ? DistalRates{1.0, joint.mimic_ratio}
                       : CalcDistalRates(hand.coupling, hand.fixed_coupling_ratio, *coupled);
    const SimTK::Vector coefficients(SimTK::Vec3(rates.distal, -rates.middle, 0.0));
    const int middle_link = hand.joints[joint.coupled_to].link;
    SimTK::Array_<SimTK::MobilizedBodyIndex> bodies;
    bodies.push_back(model.links[middle_link].getMobilizedBodyIndex());
    bodies.push_back(model.links[joint.link].getMobilizedBodyIndex());
    SimTK::Constraint::CoordinateCoupler(model.matter, new SimTK::Function::Linear(coefficients),
                                         bodies, {2, SimTK::MobilizerQIndex(0)});
  }
  model.state = model.system.realizeTopology();
  model.system.realizeModel(model.state);
  model.root.lock(model.state, SimTK::Motion::Acceleration);
}

SimbodyModel::~SimbodyModel() = default;

int SimbodyModel::num_speeds() const { return static_cast<int>(impl_->link_of_joint.size()) + 12; }

void SimbodyModel::SetPositions(const Pose& X_WH, const Eigen::VectorXd& q, const Pose& X_WOcm) {
  Impl& model = *impl_;
  model.root.setQToFitTransform(model.state, ToSimTK(X_WH * model.X_HR));
  model.p_HR_W = X_WH.linear() * model.X_HR.translation();
  for (size_t j = 0; j < model.link_of_joint.size(); ++j) {
    model.links[model.link_of_joint[j]].setOneQ(model.state, 0, q[static_cast<Eigen::Index>(j)]);
  }
  model.object.setQToFitTransform(model.state, ToSimTK(X_WOcm));
}

void SimbodyModel::SetSpeeds(const Eigen::VectorXd& u) {
  Impl& model = *impl_;
  const auto num_joints = static_cast<Eigen::Index>(model.link_of_joint.size());
  model.w_WH = u.segment<3>(num_joints);
  const Eigen::Vector3d v_WR = u.segment<3>(num_joints + 3) + model.w_WH.cross(model.p_HR_W);
  model.root.setUToFitVelocity(model.state, SimTK::SpatialVec(ToSimTK(model.w_WH), ToSimTK(v_WR)));
  for (Eigen::Index j = 0; j < num_joints; ++j) {
    model.links[model.link_of_joint[static_cast<size_t>(j)]].setOneU(model.state, 0, u[j]);
  }
  model.object.setUToFitVelocity(
      model.state, SimTK::SpatialVec(ToSimTK(Eigen::Vector3d(u.segment<3>(num_joints + 6))),
                                     ToSimTK(Eigen::Vector3d(u.segment<3>(num_joints + 9)))));
}

void SimbodyModel::CalcLinkPoses(std::vector<Pose>& X_WL) {
  Impl& model = *impl_;
  model.system.realize(model.state, SimTK::Stage::Position);
  X_WL.resize(model.links.size());
  for (size_t i = 0; i < model.links.size(); ++i) {
    X_WL[i] = FromSimTK(model.links[i].getBodyTransform(model.state));
  }
}

Eigen::MatrixXd SimbodyModel::CalcMassMatrix() {
  Impl& model = *impl_;
  model.system.realize(model.state, SimTK::Stage::Position);
  SimTK::Matrix M;
  model.matter.calcM(model.state, M);
  const std::vector<int> indices = model.FindSpeedIndices();
  Eigen::MatrixXd result(num_speeds(), num_speeds());
  for (int i = 0; i < num_speeds(); ++i) {
    for (int j = 0; j < num_speeds(); ++j) result(i, j) = M(indices[i], indices[j]);
  }
  const Eigen::MatrixXd T = model.MakeSpeedMap();
  return T.transpose() * result * T;
}

Eigen::VectorXd SimbodyModel::CalcBias(const Eigen::Vector3d& gravity_W) {
  Impl& model = *impl_;
  model.system.realize(model.state, SimTK::Stage::Velocity);
  const SimTK::Vector_<SimTK::SpatialVec> forces = model.MakeWeights(gravity_W);
  const SimTK::Vector no_mobility_forces(model.state.getNU(), 0.0);
  SimTK::Vector accelerations(model.state.getNU(), 0.0);
  // When H has constant velocity, the root's origin moves on a circle.
  const Eigen::Vector3d a_WR = model.w_WH.cross(model.w_WH.cross(model.p_HR_W));
  for (int k = 0; k < 3; ++k)
    accelerations[model.root.getFirstUIndex(model.state) + 3 + k] = a_WR[k];
  SimTK::Vector residual;
  model.matter.calcResidualForceIgnoringConstraints(model.state, no_mobility_forces, forces,
                                                    accelerations, residual);
  const std::vector<int> indices = model.FindSpeedIndices();
  Eigen::VectorXd result(num_speeds());
  for (int i = 0; i < num_speeds(); ++i) result[i] = residual[indices[i]];
  return model.MakeSpeedMap().transpose() * result;
}

Eigen::VectorXd SimbodyModel::CalcJointAccelerations(const Eigen::VectorXd& torques,
                                                     const Eigen::Vector3d& gravity_W) {
  Impl& model = *impl_;
  model.system.realize(model.state, SimTK::Stage::Dynamics);
  const std::vector<int> indices = model.FindSpeedIndices();
  SimTK::Vector mobility_forces(model.state.getNU(), 0.0);
  for (Eigen::Index j = 0; j < torques.size(); ++j) {
    mobility_forces[indices[static_cast<size_t>(j)]] = torques[j];
  }
  SimTK::Vector udot;
  SimTK::Vector_<SimTK::SpatialVec> body_accelerations;
  model.matter.calcAcceleration(model.state, mobility_forces, model.MakeWeights(gravity_W), udot,
                                body_accelerations);
  Eigen::VectorXd result(torques.size());
  for (Eigen::Index j = 0; j < result.size(); ++j) {
    result[j] = udot[indices[static_cast<size_t>(j)]];
  }
  return result;
}

}  // namespace graspbench
