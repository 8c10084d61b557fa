#pragma once
/** @file
What every page says of itself beside its sections: how it was made, with what, and whom to cite.
Nothing of it depends on when or where the page was made. */

#include <string>
#include <utility>
#include <vector>

#include "reports/page/html.h"

namespace graspbench {

struct PageFrame {
  std::string title;
  std::string subtitle = {};
  std::vector<std::string> commands = {};  ///< that give the same page again
  /** Of the results, beside the versions: {"Seed", "1"}. */
  std::vector<std::pair<std::string, std::string>> facts = {};
  std::vector<std::string> references =
      {};  ///< keys of assets/references.bib that the methods rest on
};

/** The entries with these keys, after that of the program. @pre known keys. */
std::string MakeBibtex(const std::vector<std::string>& keys);

/** The page's last part: commands, versions and facts as a table, BibTeX. */
Html DrawProvenance(const PageFrame& frame);

/** The same for machines, in the words of schema.org, without characters that end a script. */
std::string MakeJsonLd(const PageFrame& frame);

/** Of results by another physics, or by one that their folder does not name, for a subtitle: ";
simulated with physics 12, this graspbench has 13"; else empty. @param version  0: not named. */
std::string DescribePhysics(int version);

/** A framed text for a paper; `report --paper` takes it from the page. */
Html MakeMethodsText(const std::vector<std::string>& paragraphs);

}  // namespace graspbench
