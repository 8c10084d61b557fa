#include "core/trial/chain_limit.h"

#include <algorithm>
#include <set>

#include "core/base/error.h"
#include "core/physics/contact.h"
#include "core/physics/hand_dynamics.h"

namespace graspbench {

void DemandShortChains(const Hand& hand) {
  const HandDynamics dynamics(hand);
  for (size_t link = 0; link < hand.links.size(); ++link) {
    const std::vector<int>& chain = dynamics.chain(static_cast<int>(link));
    std::set<int> dofs;
    for (int joint : chain) {
      dynamics.ForEachSpeed(joint, [&](int dof, double) { dofs.insert(dof); });
    }
    const size_t length = std::max(chain.size(), dofs.size());
    if (length > ContactPoint::kMaxChain) {
      throw Error(ErrorKind::kUnsupported,
                  "hand \"" + hand.id + "\" has " + std::to_string(length) +
                      " joints between its root and link \"" + hand.links[link].name +
                      "\"; the simulation takes at most " +
                      std::to_string(ContactPoint::kMaxChain));
    }
  }
}

}  // namespace graspbench
