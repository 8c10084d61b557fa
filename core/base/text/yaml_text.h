#pragma once
/** @file
Names of people as YAML that is written: read again, they are the same names. */

#include <string>

namespace graspbench {

/** In double quotes, as YAML and JSON have them. Bytes that are no UTF-8 become U+FFFD. */
std::string QuoteYaml(const std::string& text);

/** As it is where that can only be read as this text: letters, digits, _, - and points behind a
letter, and no word that YAML takes for something else. Else in quotes. */
std::string FormatYamlWord(const std::string& text);

}  // namespace graspbench
