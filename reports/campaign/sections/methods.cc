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
      "Step 1 watches one trial without variation and records by how much the joints of each digit "
      "fall short of their commands when it first touches. With that, geometry gives when each "
      "digit meets the object at rest, and the pre-grasp is moved along the closing so that all do "
      "so at one common share: the largest that joint limits allow, the largest that keeps off "
      "the table, or half of that way. It is done once and again from its own result; "
      "of the new pre-grasps the one that succeeds most often and has the lowest median GFT% in " +
      FormatCount(optimise.choice_trials, "trial") + " is checked."};
  text.push_back(
      std::string("Step 2 searches ") + FindGraspSpace(optimise.search).words +
      " within the joint limits and 25 degrees by the method \"" + optimise.method + "\" with " +
      FormatCount(optimise.evaluations, "evaluation") + " of " +
      FormatCount(optimise.fitness_trials, "trial") + " each. The fitness is " +
      FitnessOf(optimise).words +
      ", times the grip that the hand may use over the one it does where that is more; where the "
      "thumb never touches, it falls with its smallest distance to the object. The hand may grip "
      "with " +
      GripOf(optimise).words +
      ". The ten fittest individuals that differ clearly are tried again on drawn trials; the one "
      "that succeeds most often, with the highest mean fitness, is checked.");
  text.push_back(
      "A check tries the old and the new grasp on the same draws, seen by nothing else, and looks "
      "after every " +
      FormatCount(kPairsPerLook, "pair") + " up to " + std::to_string(optimise.check_pairs) +
      ". The new one is taken as soon as it is shown to succeed less than " +
      FormatFixed(100.0 * kSuccessMargin, 0) +
      " points less often (Tango's score) and to be better in most pairs (sign test): a lower GFT% "
      "in step 1, a higher fitness in step 2. Both tests are one-sided at 5 % over all looks "
      "(O'Brien and Fleming).");
  text.push_back(
      "The benchmark tries all variants on the same " + FormatCount(session.trials, "trial pose") +
      ": object moved by up to " + FormatFixed(MmFromM(session.variation.offset), 1) +
      " mm and turned by up to " + FormatFixed(DegFromRad(session.variation.yaw), 1) +
      " degrees, an error of the hand's joint accuracy in every drive. What is held at the end is "
      "pulled in six directions until it leaves the hand: the breaking force. The draws, those of "
      "the "
      "search and those of the checks come from different random streams. Intervals are 95 % "
      "bootstrap intervals (BCa). Steps and measures are named by F. Röthling's thesis (Bielefeld, "
      "2007); the rules of step 1, the search and the formula of sigma are graspbench's.");
  text.push_back(std::string("All of it was made with graspbench ") + program_version() +
                 ", seed " + std::to_string(optimise.seed) + ".");
  return MakeMethodsText(text);
}

}  // namespace

CampaignSection methods_campaign_section() { return {"methods", "Methods", DrawMethods}; }

}  // namespace graspbench
