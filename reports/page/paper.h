#pragma once
/** @file
What a paper takes from a page: its figures, its tables, the methods text and the references, as
files of their own. Works on the finished page, so it is the same for every kind of result. */

#include <string>
#include <vector>

namespace graspbench {

struct PaperFile {
  std::string name;  ///< "figures/figure-1-success-rate.svg", with slashes
  std::string content;
};

/** `figures/ID.svg` in the light colours without variables, links and scripts; `tables/ID.csv`; the
captions of both with the page's numbers and the methods, in Markdown; the references. The same page
gives the same bytes. @pre a page of MakePage. */
std::vector<PaperFile> MakePaperFiles(const std::string& page);

}  // namespace graspbench
