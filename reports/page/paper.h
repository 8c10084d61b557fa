#pragma once
/** @file
Extracts from a page the files for a paper: figures, tables, methods text and references. It works
on the finished page, so it is the same for every kind of result. */

#include <string>
#include <vector>

namespace graspbench {

struct PaperFile {
  std::string name;  ///< "figures/fig-01-success-rate-by-hand.svg", with slashes
  std::string content;
};

enum class PaperParts {
  kShown,  ///< what the page shows expanded, at most 20 figures and 12 tables
  kAll,
};

/** Makes `figures/fig-NN-WORDS.svg` in light colours, without variables, links and scripts, and
`tables/tab-NN-WORDS.csv` and .tex (booktabs), where NN is the number in the page. The tables of
versions and provenance are left out. Also makes Markdown with all captions and the methods, and the
references. Equal pages give equal bytes. @pre `page` comes from MakePage. */
std::vector<PaperFile> MakePaperFiles(const std::string& page, PaperParts parts);

}  // namespace graspbench
