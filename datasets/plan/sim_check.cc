#include "datasets/plan/sim_check.h"

#include "core/base/error.h"

namespace graspbench {

std::vector<std::pair<std::string, std::string>> FindSimProblems(const SimConfig& sim) {
  std::vector<std::pair<std::string, std::string>> problems;
  if (sim.table_friction_dynamic > sim.table_friction_static) {
    problems.emplace_back("sim.table_friction_dynamic",
                          "must not be higher than sim.table_friction_static");
  }
  if (sim.hand_friction_dynamic > sim.hand_friction_static) {
    problems.emplace_back("sim.hand_friction_dynamic",
                          "must not be higher than sim.hand_friction_static");
  }
  if (sim.multibody != "arrays" && sim.multibody != "simbody") {
    problems.emplace_back("sim.multibody", "no multibody \"" + sim.multibody + "\"" +
                                               SuggestNames(sim.multibody, {"arrays", "simbody"}));
  }
  return problems;
}

}  // namespace graspbench
