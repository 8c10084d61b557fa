#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/base/version.h"
#include "reports/campaign/campaign_section.h"

namespace graspbench {
namespace {

Html DrawMethods(const CampaignData& data) {
  const OptimiseConfig& optimise = data.campaign.config.optimise;
  const SessionConfig& session = data.campaign.config.session;
  std::vector<std::string> text = {
      "Step 1 runs one trial without variation and records the lag of each digit's joints behind "
      "their commands at first contact. Geometry then predicts when each digit meets the object at "
      "rest. The pre-grasp is shifted along the closing motion such that all digits touch at one "
      "common share: the largest that joint limits allow, the largest without table contact, or "
      "half of that. The procedure is repeated once from its own result. Of the new pre-grasps the "
      "one with the highest success rate and the lowest median GFT% in " +
      FormatCount(optimise.choice_trials, "trial") + " is checked."};
  text.push_back(
      std::string("Step 2 searches ") + FindGraspSpace(optimise.search).words +
      " within the joint limits and 25 degrees by the method \"" + optimise.method + "\" with " +
      FormatCount(optimise.evaluations, "evaluation") + " of " +
      FormatCount(optimise.fitness_trials, "trial") + " each. The fitness is " +
      FitnessOf(optimise).words +
      ", scaled to the permitted grip if the hand grips harder; without thumb contact the fitness "
      "decreases with the smallest thumb-object distance. The permitted grip is " +
      GripOf(optimise).words +
      ". The ten fittest distinct individuals are repeated in trials with variation; the one with "
      "the highest success rate and mean fitness is checked.");
  text.push_back(
      "A check tests the old and the new grasp on the same fresh draws, with a look after every " +
      FormatCount(kPairsPerLook, "pair") + " up to " + std::to_string(optimise.check_pairs) +
      ". The new grasp is accepted once its success is shown to be less than " +
      FormatFixed(100.0 * kSuccessMargin, 0) +
      " points lower (Tango's score) and it is better in most pairs (sign test): lower GFT% in "
      "step 1, higher fitness in step 2. Both tests are one-sided at 5 % over all looks (O'Brien "
      "and Fleming).");
  text.push_back(
      "The benchmark tests all variants on the same " + FormatCount(session.trials, "trial pose") +
      ": object moved by up to " + FormatFixed(MmFromM(session.variation.offset), 1) +
      " mm and turned by up to " + FormatFixed(DegFromRad(session.variation.yaw), 1) +
      " degrees, with a random error of the joint accuracy in every drive. Objects held at the end "
      "are pulled in six directions until they leave the hand (breaking force). Benchmark, search "
      "and checks use different random streams. Intervals are 95 % bootstrap intervals (BCa). "
      "Steps and measures are named after F. Röthling's thesis (Bielefeld, 2007); the rules of "
      "step 1, the search and the formula of sigma are proposals of graspbench.");
  text.push_back(std::string("All results were computed with graspbench ") + program_version() +
                 ", seed " + std::to_string(optimise.seed) + ".");
  return MakeMethodsText(text);
}

}  // namespace

CampaignSection methods_campaign_section() { return {"methods", "Methods", DrawMethods}; }

}  // namespace graspbench
