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

/** Plots each number minus its null value, so that zero means no effect in every row. */
Html DrawEvidence(const std::vector<ThesisClaim>& claims, const SessionModels& models) {
  IntervalPlot plot;
  plot.text.title = "Evidence for the verdicts";
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
      "Numbers behind the verdicts with 95 % intervals, as differences from the null value: 1 for "
      "ratios, 0 for correlations, 0.5 for shares.",
      "intervals that exclude 0: they decide, except for correlations.",
      MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

std::string NameVerdict(const ThesisClaim& claim) {
  std::string text = NameOf(claim.verdict);
  if (claim.verdict == ClaimVerdict::kNotDecided) text += std::string("; would: ") + claim.decides;
  return text;
}

Html DrawClaims(const CampaignData& data) {
  if (CountComplete(data.scenes) == 0) {
    return MakeParagraph(
        "No scene has trials of all three variants yet, so all claims are undecided.");
  }
  const std::vector<ThesisClaim> claims = JudgeThesis(data.campaign, data.scenes);
  Table table("The thesis's claims and the evidence of these trials.",
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
             "A claim about a step holds if the interval of its ratio lies on the claimed side of "
             "1, over all scenes and for each hand alone. It does not hold if one of these "
             "intervals lies on the other side. \"Better\" also requires that success is not 5 "
             "points lower. A stronger grip counts as better, too; breaking force over grip "
             "removes this effect. Correlations of GFT% with success or sigma decide nothing, "
             "because the object's position affects both; delays of one digit on the same draws "
             "decide. Sigma and breaking force agree if significantly more than half of their "
             "changes have the same sign. Fewer than 5 scenes decide nothing. These verdicts "
             "concern the simulation; real hands may differ.");
}

}  // namespace

CampaignSection claims_campaign_section() { return {"claims", "What this says", DrawClaims}; }

}  // namespace graspbench
