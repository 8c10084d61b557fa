#include "workbench/text/plain_text.h"

namespace graspbench {

std::string MakePlainText(std::string text) {
  const std::string no_break = "\u00a0";
  for (size_t at = text.find(no_break); at != std::string::npos; at = text.find(no_break, at)) {
    text.replace(at, no_break.size(), " ");
  }
  return text;
}

}  // namespace graspbench
