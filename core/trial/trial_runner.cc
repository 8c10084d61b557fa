#include "core/trial/trial_runner.h"

#include <fmt/core.h>

#include <cmath>

#include "core/base/error.h"
#include "core/physics/implicit_world.h"
#include "core/physics/simbody_model.h"
#include "core/trial/trial_course.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/** Largest relative difference from Simbody's mass matrix and bias. */
constexpr double kSimbodyTolerance = 1e-9;

/** Largest difference over the largest of their entries. */
double CalcDifference(const Eigen::MatrixXd& ours, const Eigen::MatrixXd& theirs) {
  return (ours - theirs).cwiseAbs().maxCoeff() / theirs.cwiseAbs().maxCoeff();
}

bool IsSame(const SimConfig& a, const SimConfig& b) {
  bool same = true;
  std::vector<double> values;
  SimConfig copy_a = a, copy_b = b;
  copy_a.Visit([&](const char*, double& value) { values.push_back(value); });
  size_t i = 0;
  copy_b.Visit([&](const char*, double& value) { same = same && value == values[i++]; });
  return same;
}

}  // namespace

struct TrialRunner::Impl {
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  SimbodyModel simbody;
  std::unique_ptr<const World> world;  // for `sim`; each trial runs in a clone
  SimConfig sim;

  Impl(std::shared_ptr<const Hand> the_hand, std::shared_ptr<const GraspObject> the_object)
      : hand(std::move(the_hand)),
        object(std::move(the_object)),
        simbody(*hand, object->mass_properties) {}

  JudgedTrial Run(const TrialSetup& setup, bool is_judged);
  std::unique_ptr<World> MakeWorld(const SimConfig& config);
  double CalcSimbodyDifference(World& own);
};

std::unique_ptr<World> TrialRunner::Impl::MakeWorld(const SimConfig& config) {
  if (!world || !IsSame(config, sim)) {
    sim = config;
    world = std::make_unique<ImplicitWorld>(*hand, *object, config);
  }
  return world->Clone();
}

/** Largest difference of our mass matrix and bias from Simbody's at the world's state, relative to
the largest entry. */
double TrialRunner::Impl::CalcSimbodyDifference(World& own) {
  HandDynamics& dynamics = own.dynamics();
  const WorldState& state = own.state();
  const int joints = dynamics.num_joints(), speeds = dynamics.num_speeds();
  // Theirs = T ours: rates of joints, then the base.
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(joints + 6, speeds);
  for (int j = 0; j < joints; ++j) T(j, dynamics.dof_of_joint(j)) = dynamics.rate_of_joint(j);
  T.bottomRightCorner<6, 6>().setIdentity();

  VectorXd u(joints + 12);
  u << T * own.CalcHandSpeeds(), state.w_WO, state.v_WOcm;
  simbody.SetPositions(state.X_WH, state.q, MakePose(state.R_WO, state.p_WOcm));
  simbody.SetSpeeds(u);
  const Eigen::MatrixXd M_theirs =
      T.transpose() * simbody.CalcMassMatrix().topLeftCorner(joints + 6, joints + 6) * T;
  const VectorXd bias_theirs = T.transpose() * simbody.CalcBias(state.gravity_W).head(joints + 6);

  dynamics.UpdatePositions(state.X_WH, state.q);
  Eigen::MatrixXd M(speeds, speeds);
  dynamics.CalcMassMatrix(M);
  VectorXd bias(speeds);
  dynamics.CalcBias(own.CalcHandSpeeds(), state.gravity_W, bias);
  // The base is so much heavier than a finger that both have a scale of their own.
  const int dofs = dynamics.num_dofs();
  return std::max({CalcDifference(M, M_theirs),
                   CalcDifference(M.topLeftCorner(dofs, dofs), M_theirs.topLeftCorner(dofs, dofs)),
                   CalcDifference(bias, bias_theirs),
                   CalcDifference(bias.head(dofs), bias_theirs.head(dofs))});
}

TrialRunner::TrialRunner(std::shared_ptr<const Hand> hand,
                         std::shared_ptr<const GraspObject> object)
    : impl_(std::make_unique<Impl>(std::move(hand), std::move(object))) {
  const HandDynamics dynamics(*impl_->hand);
  for (size_t link = 0; link < impl_->hand->links.size(); ++link) {
    const size_t length = dynamics.chain(static_cast<int>(link)).size();
    if (length > ContactPoint::kMaxChain) {
      throw Error(ErrorKind::kUnsupported,
                  "hand \"" + impl_->hand->id + "\" has " + std::to_string(length) +
                      " joints between its root and link \"" + impl_->hand->links[link].name +
                      "\"; the simulation takes at most " +
                      std::to_string(ContactPoint::kMaxChain));
    }
  }
}

TrialRunner::~TrialRunner() = default;

TrialResult TrialRunner::Run(const TrialSetup& setup) { return impl_->Run(setup, false).result; }

JudgedTrial TrialRunner::Judge(const TrialSetup& setup) { return impl_->Run(setup, true); }

JudgedTrial TrialRunner::Impl::Run(const TrialSetup& setup, bool is_judged) {
  GRASPBENCH_DEMAND(setup.hand == hand && setup.object == object,
                    "a runner serves one hand and one object");
  JudgedTrial trial;
  TrialResult& result = trial.result;
  try {
    TrialCourse course(MakeWorld(setup.sim), setup);
    result = course.Run();
    if (result.outcome == Outcome::kNumericalFailure) return trial;
    if (const double difference = CalcSimbodyDifference(course.world());
        !(difference < kSimbodyTolerance)) {
      result.outcome = Outcome::kNumericalFailure;
      result.reason =
          fmt::format("mass matrix or bias differs from Simbody's by {:.1e}", difference);
      return trial;
    }
    if (is_judged && course.is_held()) trial.judgement = course.Judge();
  } catch (const std::exception& e) {
    // Simbody reports impossible states this way.
    trial = JudgedTrial();
    result.outcome = Outcome::kNumericalFailure;
    result.reason = e.what();
  }
  return trial;
}

}  // namespace graspbench
