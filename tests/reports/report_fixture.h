#pragma once
/** @file
Pages of results made of known numbers, read back by an XML parser. */

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "reports/session_report.h"
#include "tests/datasets/analysis/made_results.h"

namespace graspbench {

/** The page without models and pictures, under whose names the ids show. */
std::string MakePageOf(const Session& session);

/** Fails the test when `page` is not well-formed. */
void ParsePage(const std::string& page, tinyxml2::XMLDocument& document);

/** All text below an element, one space between elements; the style sheet is left out. */
std::string ListText(const tinyxml2::XMLElement& element);

/** All text of a page, and that of its element with this id. */
std::string TextOf(const std::string& page);
std::string TextOfId(const std::string& page, const std::string& id);

/** Every part must be in the text. */
void ExpectParts(const std::string& text, const std::vector<std::string>& parts);

/** The first element below `root` with this id; null: none. */
const tinyxml2::XMLElement* FindById(const tinyxml2::XMLElement& root, const std::string& id);

/** Every value of an attribute anywhere in the page. */
std::vector<std::string> ListAttribute(const tinyxml2::XMLElement& root, const char* name);

/** Links lead somewhere, ids are unique, nothing is fetched, headings do not skip a level. */
void ExpectSoundPage(const std::string& page);

}  // namespace graspbench
