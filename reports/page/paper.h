#pragma once
/** @file
What a paper takes from a page: its figures, its tables, the methods text and the references, as
files of their own. Works on the finished page, so it is the same for every kind of result. */

#include <string>
#include <vector>

namespace graspbench {

struct PaperFile {
  std::string name;  ///< "figures/fig-01-success-rate-by-hand.svg", with slashes
  std::string content;
};

enum class PaperParts {
  kShown,  ///< what the page shows unfolded, at most 20 figures and 12 tables
  kAll,
};

/** `figures/fig-NN-WORDS.svg` in the light colours without variables, links and scripts;
`tables/tab-NN-WORDS.csv` and .tex (booktabs); NN is the page's number. Versions and
provenance are no table of a paper. The captions of both and the methods, in Markdown; the
references. The same page gives the same bytes. @pre a page of MakePage. */
std::vector<PaperFile> MakePaperFiles(const std::string& page, PaperParts parts);

}  // namespace graspbench
