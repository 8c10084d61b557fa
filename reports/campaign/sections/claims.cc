#include <cmath>

#include "core/base/text/text.h"
#include "datasets/analysis/campaign/thesis_claims.h"
#include "reports/campaign/campaign_section.h"
#include "reports/plots/line_plot.h"

namespace graspbench {
namespace {

const char* NameOf(ClaimVerdict verdict) { return RowOf(kClaimVerdicts, verdict).name; }

std::string FormatEvidence(const ClaimEvidence& evidence) {
  return FormatWithRange(evidence.value, evidence.interval.low, evidence.interval.high, 2) + ", " +
         evidence.counted;
}

/** "TUM Hand, GFT%". */
std::string NameEvidence(const ClaimEvidence& evidence, const SessionModels& models) {
  return (evidence.hand.empty() ? "all hands" : models.NameOfHand(evidence.hand)) + ", " +
         evidence.what;
}

/** Each number less what would say neither, so that zero is the line to cross in all of them. */
Html DrawEvidence(const std::vector<ThesisClaim>& claims, const SessionModels& models) {
  IntervalPlot plot;
  plot.text.title = "What the verdicts rest on";
  plot.text.description = "One row per number with its 95 % interval, grouped by claim.";
  plot.axis = "difference from the null value";
  int series = 0;
  for (const ThesisClaim& claim : claims) {
    plot.AddHeading(claim.topic);
    for (const ClaimEvidence& evidence : claim.evidence) {
      plot.rows.push_back({NameEvidence(evidence, models), evidence.value - claim.neutral,
                           evidence.interval.low - claim.neutral,
                           evidence.interval.high - claim.neutral, FormatEvidence(evidence), "",
                           series});
    }
    ++series;
  }
  return MakeFigure(
      "The numbers behind the verdicts with 95 % intervals, less the value that says neither: 1 "
      "for factors, 0 for correlations, 0.5 for shares.",
      "intervals beyond zero: they decide, but for correlations.",
      MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

std::string NameVerdict(const ThesisClaim& claim) {
  std::string text = NameOf(claim.verdict);
  if (claim.verdict == ClaimVerdict::kNotDecided) text += std::string("; would: ") + claim.decides;
  return text;
}

Html DrawClaims(const CampaignData& data) {
  if (CountComplete(data.scenes) == 0) {
    return MakeParagraph("No scene has trials of all three variants yet, so nothing is decided.");
  }
  const std::vector<ThesisClaim> claims = JudgeThesis(data.campaign, data.scenes);
  Table table("The thesis's claims and what these trials say of them.",
              {"Claim", "Verdict", "Design", "Evidence, with 95 % intervals"});
  for (const ThesisClaim& claim : claims) {
    std::string text;
    for (const ClaimEvidence& evidence : claim.evidence) {
      text += (text.empty() ? "" : "; ") + NameEvidence(evidence, data.models) + " " +
              FormatEvidence(evidence);
    }
    table.AddRow(
        {claim.sentence, NameVerdict(claim), claim.design, text.empty() ? "too little" : text},
        std::string("claim-") + claim.id);
  }
  return table.ToHtml() + DrawEvidence(claims, data.models) +
         MakeParagraph(
             "A claim about a step holds when the interval of its factor, over all scenes and for "
             "each hand alone, lies on the claimed side of 1, and does not hold when one lies on "
             "the other side; \"better\" asks also that success is not 5 points lower. What breaks "
             "later because the hand squeezes harder is better, too; breaking force over grip says "
             "what is left of it with the same grip. That GFT% goes with success or sigma among "
             "the trials as they came decides nothing: where the object lay makes digits late and "
             "grasps fail; the same draws with a digit made late decide. Sigma and breaking force "
             "agree when more than half of the changes have the same sign, for sure. Fewer than 5 "
             "scenes decide nothing. A simulation decides about this simulation; hands of flesh or "
             "metal may differ.");
}

}  // namespace

CampaignSection claims_campaign_section() { return {"claims", "What this says", DrawClaims}; }

}  // namespace graspbench
