#pragma once
/** @file A small session made of known numbers, and pages read back by an XML parser. */

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "datasets/session/session_store.h"
#include "reports/session_report.h"

namespace graspbench {

/** A finished trial of thumb and two fingers that touch at 0.4, 0.5 and 0.6 s plus 0.01 s for every
trial, so that GCT = 0.6 + 0.01 k, GFT = 0.2 and GOT = 0.1. */
TrialRecord MakeRecord(const PlannedTrial& plan, Outcome outcome);

/** Every hand on every object with one grasp; every trial a success. */
Session MakeSession(const std::vector<std::string>& hands, const std::vector<std::string>& objects,
                    const std::string& grasp, int trials);

/** The page without models and pictures, under whose names the ids show. */
std::string MakePageOf(const Session& session);

/** Fails the test when `page` is not well-formed. */
void ParsePage(const std::string& page, tinyxml2::XMLDocument& document);

/** All text below an element, one space between elements; the style sheet is left out. */
std::string ListText(const tinyxml2::XMLElement& element);

/** The first element below `root` with this id; null: none. */
const tinyxml2::XMLElement* FindById(const tinyxml2::XMLElement& root, const std::string& id);

/** Every value of an attribute anywhere in the page. */
std::vector<std::string> ListAttribute(const tinyxml2::XMLElement& root, const char* name);

/** Links lead somewhere, ids are unique, nothing is fetched, headings do not skip a level. */
void ExpectSoundPage(const std::string& page);

}  // namespace graspbench
