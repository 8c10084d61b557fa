#include "core/trial/protocols/protocol.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

TEST(Protocol, AnUnknownOneIsRefusedWithTheNearestAndInASetupIsAResult) {
  for (const Protocol* protocol : ListProtocols()) {
    EXPECT_EQ(&FindProtocol(protocol->id), protocol);
  }
  TrialSetup setup = MakeSetup("tum", "g2", MakeCube(0.0122, 0.5));
  setup.protocol = "table_lyft";
  const TrialResult result = RunSetup(setup);
  EXPECT_EQ(result.outcome, Outcome::kNumericalFailure);
  EXPECT_NE(result.reason.find("\"table_lyft\""), std::string::npos) << result.reason;
  EXPECT_NE(result.reason.find("table_lift"), std::string::npos) << result.reason;
}

}  // namespace
}  // namespace graspbench
